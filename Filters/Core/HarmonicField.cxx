#include "HarmonicField.h"

#include "Hierarchy/MeshHierarchy.h"
#include "Mesh/SpatialOrder.h"
#include "Prolongation/NodalProlongation.h"
#include "Prolongation/PowerFieldProlongation.h"
#include "Prolongation/ScalarProlongation.h"
#include "Support/SparseAssembly.h"
#include "Systems/PowerFieldSystem.h"

#include <utility>

namespace dmg
{

namespace
{

// The couplings between faces are far from those of a linear function where triangles are uneven; the
// coarse levels, nodal by nature, are not. So the interpolation to the faces is smoothed, and the
// finest level gets more sweeps: all that sweeps gain, they gain there.
constexpr int FinestProlongationSteps = 2;
constexpr int FinestSweepsFactor = 2;

}

SurfaceHierarchy BuildSurfaceHierarchy(
  const TriangleMesh& mesh, const HierarchyOptions& options, const ExecutionContext& context)
{
  SurfaceHierarchy result;
  ProlongationOperators& operators = result.Operators;
  operators.NumbersOfVertices.push_back(mesh.NumberOfVertices());
  operators.NumbersOfFaces.push_back(mesh.NumberOfFaces());

  // The work is done in an order that is kind to the caches; coarse levels inherit it.
  const SpatialOrder order(mesh, context);
  const TriangleMesh sorted = order.Apply(mesh);
  TangentFrames fineFaceFrames = order.ApplyToFaces(FaceFrames(mesh, context), context);
  std::vector<Complex> fineCornerTurns; // from level 1 on
  result.CoarseLevels =
    BuildMeshHierarchy(sorted, options, context, [&](const LevelTransition& transition) {
      const TriangleMesh& coarse = transition.Coarse;
      TangentFrames coarseFaceFrames = FaceFrames(coarse, context);
      std::vector<Complex> coarseCornerTurns = CornerTurns(coarse, coarseFaceFrames, context);
      SparseMatrix<double> S0 = ScalarProlongation(transition, context);
      TransportOperator SP =
        PowerFieldProlongation(transition, fineFaceFrames, coarseFaceFrames, context);
      operators.Nodal.push_back(operators.Nodal.empty()
          ? FacesFromVertices(sorted, S0, SP, coarse, coarseCornerTurns, context)
          : VerticesFromVertices(transition.Fine, fineCornerTurns, S0, SP, coarse,
              coarseCornerTurns, context));
      operators.S0.push_back(std::move(S0));
      operators.SP.push_back(std::move(SP));
      operators.NumbersOfVertices.push_back(coarse.NumberOfVertices());
      operators.NumbersOfFaces.push_back(coarse.NumberOfFaces());
      fineFaceFrames = std::move(coarseFaceFrames);
      fineCornerTurns = std::move(coarseCornerTurns);
    });

  if (!operators.S0.empty())
  {
    operators.S0[0] = RenumberRows(operators.S0[0], order.Vertices(), context);
    operators.SP[0] = RenumberRows(operators.SP[0], order.Faces(), context);
    operators.Nodal[0] = RenumberRows(operators.Nodal[0], order.Faces(), context);
  }
  return result;
}

HarmonicProblem<Complex> MakePowerFieldProblem(const TriangleMesh& mesh,
  const TangentFrames& faceFrames, const ProlongationOperators* operators,
  const PrescribedFaces& prescribed, const PowerFieldOptions& options,
  const ExecutionContext& context)
{
  const bool isNodal = options.CoarseSpace == CoarseSpaceKind::Nodal;
  SolverOptions solver;
  solver.Kind = options.Solver;
  solver.Sweeps = options.Sweeps;
  if (isNodal)
  {
    solver.FinestSweepsFactor = FinestSweepsFactor;
    solver.FinestProlongationSteps = FinestProlongationSteps;
  }
  HarmonicProblem<Complex>::MakeProlongations makeProlongations;
  if (operators && !operators->SP.empty())
  {
    makeProlongations = [&](const ExecutionContext& part) {
      std::vector<SparseMatrix<Complex>> prolongations;
      for (const TransportOperator& transport : isNodal ? operators->Nodal : operators->SP)
      {
        prolongations.push_back(OnPowers(transport, options.N, part));
      }
      return prolongations;
    };
  }
  return HarmonicProblem<Complex>(
    [&](const ExecutionContext& part) {
      return MakePowerFieldSystem(mesh, faceFrames, options.N, prescribed,
        { options.Smoothness, options.Alignment, options.Constraints }, part);
    },
    makeProlongations, isNodal ? "nodal levels" : "levels of face powers", solver, context);
}

}
