#include "NodalLevels.h"

#include "Operators/ExteriorCalculus.h"
#include "SmoothingBlocks.h"
#include "Support/SparseKernels.h"

#include <cassert>

namespace dmg
{
namespace
{

LeastSquaresLevels NodalLevels(
  const std::vector<TransportOperator>& nodal, const ExecutionContext& context)
{
  assert(!nodal.empty());
  const std::size_t skipped = nodal.size() > 1 ? 1 : 0;
  LeastSquaresLevels levels;
  PlanarProlongation rows = skipped > 0
    ? RowsOfComponents(Product(nodal[0], nodal[1], context), context)
    : RowsOfComponents(nodal[0], context);
  levels.Prolongation.swap(rows); // an assignment would copy
  for (std::size_t l = skipped + 1; l < nodal.size(); ++l)
  {
    levels.Coarser.push_back(OnComponents(nodal[l], context));
  }
  return levels;
}

}

LeastSquaresLevels NodalLevelsOfFaceFields(const TriangleMesh& mesh,
  const std::vector<TransportOperator>& nodal, const ExecutionContext& context)
{
  LeastSquaresLevels levels = NodalLevels(nodal, context);
  levels.Blocks = BlocksOfFaceFields(mesh);
  return levels;
}

LeastSquaresLevels NodalLevelsOfOneForms(const TriangleMesh& mesh, const TangentFrames& faceFrames,
  const std::vector<TransportOperator>& nodal, const ExecutionContext& context)
{
  LeastSquaresLevels levels = NodalLevels(nodal, context);
  PlanarProlongation forms =
    Product(FormFromFaceField(mesh, faceFrames, context), levels.Prolongation, context);
  levels.Prolongation.swap(forms);
  levels.Blocks = BlocksOfOneForms(mesh);
  return levels;
}

}
