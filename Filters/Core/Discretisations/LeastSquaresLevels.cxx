#include "Discretisations/LeastSquaresLevels.h"

#include "Discretisations/SmoothingBlocks.h"
#include "Operators/ExteriorCalculus.h"
#include "Support/SparseKernels.h"

#include <cassert>
#include <utility>

namespace dmg
{
namespace
{

/// The finest level is coarsened at once so far that there are at least so many faces for a vector.
constexpr long long FewestFacesForAVector = 6;

LeastSquaresLevels NodalLevels(
  const std::vector<TransportOperator>& nodal, UnknownBlocks blocks, const ExecutionContext& context)
{
  assert(!nodal.empty());
  const auto isCoarse = [](const TransportOperator& finest)
  { return FewestFacesForAVector * finest.cols() <= finest.rows(); };
  TransportOperator product;
  const TransportOperator* finest = &nodal[0];
  std::size_t next = 1;
  for (; next < nodal.size() && !isCoarse(*finest); ++next)
  {
    TransportOperator farther = Product(*finest, nodal[next], context);
    product.swap(farther); // an assignment would copy
    finest = &product;
  }
  LeastSquaresLevels levels;
  levels.Blocks = std::move(blocks);
  PlanarProlongation rows = RowsOfComponents(*finest, context);
  levels.Prolongation.swap(rows);
  for (; next < nodal.size(); ++next)
  {
    levels.Coarser.push_back(OnComponents(nodal[next], context));
  }
  return levels;
}

}

LeastSquaresLevels NodalLevelsOfFaceFields(
  const TriangleMesh& mesh, const std::vector<TransportOperator>& nodal, const ExecutionContext& context)
{
  return NodalLevels(nodal, BlocksOfFaceFields(mesh), context);
}

LeastSquaresLevels NodalLevelsOfOneForms(const TriangleMesh& mesh, const TangentFrames& faceFrames,
  const std::vector<TransportOperator>& nodal, const ExecutionContext& context)
{
  LeastSquaresLevels levels = NodalLevels(nodal, BlocksOfOneForms(mesh), context);
  PlanarProlongation forms = Product(FormFromFaceField(mesh, faceFrames, context), levels.Prolongation, context);
  levels.Prolongation.swap(forms);
  return levels;
}

}
