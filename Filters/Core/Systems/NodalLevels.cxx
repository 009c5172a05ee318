#include "Systems/NodalLevels.h"

#include "Operators/ExteriorCalculus.h"
#include "Support/SparseKernels.h"

#include <cassert>

namespace dmg
{

LeastSquaresLevels NodalLevelsOfFaceFields(
  const std::vector<TransportOperator>& nodal, const ExecutionContext& context)
{
  assert(!nodal.empty());
  const int faces = static_cast<int>(nodal[0].rows());
  const std::size_t skipped = nodal.size() > 1 ? 1 : 0;
  LeastSquaresLevels levels;
  levels.Prolongation = RowsOfComponents(
    skipped > 0 ? Product(nodal[0], nodal[1], context) : nodal[0], context);
  for (std::size_t l = skipped + 1; l < nodal.size(); ++l)
  {
    levels.Coarser.push_back(OnComponents(nodal[l], context));
  }
  levels.Blocks.Unknowns.reserve(2 * faces);
  for (int face = 0; face < faces; ++face)
  {
    levels.Blocks.Unknowns.push_back(2 * face);
    levels.Blocks.Unknowns.push_back(2 * face + 1);
    levels.Blocks.EndBlock();
  }
  return levels;
}

LeastSquaresLevels NodalLevelsOfOneForms(const TriangleMesh& mesh, const TangentFrames& faceFrames,
  const std::vector<TransportOperator>& nodal, const ExecutionContext& context)
{
  LeastSquaresLevels levels = NodalLevelsOfFaceFields(nodal, context);
  levels.Prolongation =
    Product(FormFromFaceField(mesh, faceFrames, context), levels.Prolongation, context);
  levels.Blocks = {};
  levels.Blocks.Unknowns.reserve(3 * mesh.NumberOfFaces());
  for (int face = 0; face < mesh.NumberOfFaces(); ++face)
  {
    for (int h = 3 * face; h < 3 * face + 3; ++h)
    {
      levels.Blocks.Unknowns.push_back(mesh.EdgeOf(h));
    }
    levels.Blocks.EndBlock();
  }
  return levels;
}

}
