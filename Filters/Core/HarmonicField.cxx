#include "HarmonicField.h"

#include "Hierarchy/MeshHierarchy.h"
#include "Mesh/SpatialOrder.h"
#include "Prolongation/NodalProlongation.h"
#include "Prolongation/PowerFieldProlongation.h"
#include "Prolongation/ScalarProlongation.h"
#include "Support/SparseAssembly.h"

namespace dmg
{

SurfaceHierarchy BuildSurfaceHierarchy(
  const TriangleMesh& mesh, const HierarchyOptions& options, const ExecutionContext& context)
{
  SurfaceHierarchy result;
  ProlongationOperators& operators = result.Operators;
  operators.NumbersOfVertices.push_back(mesh.NumberOfVertices());
  operators.NumbersOfFaces.push_back(mesh.NumberOfFaces());

  // The work is done in an order that is kind to the caches; coarse levels inherit it.
  const SpatialOrder order(mesh);
  const TriangleMesh sorted = order.Apply(mesh);
  TangentFrames fineFaceFrames = order.ApplyToFaces(FaceFrames(mesh));
  TangentFrames fineVertexFrames;

  result.CoarseLevels =
    BuildMeshHierarchy(sorted, options, context, [&](const LevelTransition& transition) {
      const TriangleMesh& coarse = transition.Coarse;
      TangentFrames coarseFaceFrames = FaceFrames(coarse);
      TangentFrames coarseVertexFrames = VertexFrames(coarse);
      SparseMatrix<double> S0 = ScalarProlongation(transition, context);
      operators.Nodal.push_back(operators.Nodal.empty()
          ? FacesFromVertices(sorted, S0, fineFaceFrames, coarseVertexFrames, context)
          : VerticesFromVertices(S0, fineVertexFrames, coarseVertexFrames, context));
      operators.S0.push_back(std::move(S0));
      operators.SP.push_back(
        PowerFieldProlongation(transition, fineFaceFrames, coarseFaceFrames, context));
      operators.NumbersOfVertices.push_back(coarse.NumberOfVertices());
      operators.NumbersOfFaces.push_back(coarse.NumberOfFaces());
      fineFaceFrames = std::move(coarseFaceFrames);
      fineVertexFrames = std::move(coarseVertexFrames);
    });

  if (!operators.S0.empty())
  {
    operators.S0[0] = RenumberRows(operators.S0[0], order.Vertices());
    operators.SP[0] = RenumberRows(operators.SP[0], order.Faces());
    operators.Nodal[0] = RenumberRows(operators.Nodal[0], order.Faces());
  }
  return result;
}

}
