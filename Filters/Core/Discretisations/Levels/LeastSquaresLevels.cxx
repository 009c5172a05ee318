#include "Discretisations/Levels/LeastSquaresLevels.h"

#include "Discretisations/Levels/SmoothingBlocks.h"
#include "Operators/ExteriorCalculus.h"
#include "Support/SparseKernels.h"

#include <cassert>
#include <utility>

namespace dmg
{
namespace
{

/// The least number of faces per vector on the first coarse level.
constexpr long long FewestFacesForAVector = 6;

LeastSquaresLevels LinearLevels(
  const std::vector<TransportOperator>& linear, UnknownBlocks blocks, const ExecutionContext& context)
{
  assert(!linear.empty());
  const auto isCoarse = [](const TransportOperator& finest)
  { return FewestFacesForAVector * finest.cols() <= finest.rows(); };
  TransportOperator product;
  const TransportOperator* finest = &linear[0];
  std::size_t next = 1;
  for (; next < linear.size() && !isCoarse(*finest); ++next)
  {
    TransportOperator farther = Product(*finest, linear[next], context);
    product.swap(farther); // an assignment would copy
    finest = &product;
  }
  LeastSquaresLevels levels;
  levels.Blocks = std::move(blocks);
  PlanarProlongation rows = RowsOfComponents(*finest, context);
  levels.Prolongation.swap(rows);
  for (; next < linear.size(); ++next)
  {
    levels.Coarser.push_back(OnComponents(linear[next], context));
  }
  return levels;
}

}

LeastSquaresLevels LinearLevelsOfFaceFields(
  const TriangleMesh& mesh, const std::vector<TransportOperator>& linear, const ExecutionContext& context)
{
  return LinearLevels(linear, BlocksOfFaceFields(mesh), context);
}

LeastSquaresLevels LinearLevelsOfOneForms(const TriangleMesh& mesh, const TangentFrames& faceFrames,
  const std::vector<TransportOperator>& linear, const ExecutionContext& context)
{
  LeastSquaresLevels levels = LinearLevels(linear, BlocksOfOneForms(mesh), context);
  PlanarProlongation forms = Product(FormFromFaceField(mesh, faceFrames, context), levels.Prolongation, context);
  levels.Prolongation.swap(forms);
  return levels;
}

}
