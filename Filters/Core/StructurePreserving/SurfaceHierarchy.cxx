#include "StructurePreserving/SurfaceHierarchy.h"

#include "Analysis/HarmonicForms.h"
#include "Mesh/SpatialOrder.h"
#include "Mesh/TangentFrames.h"
#include "StructurePreserving/Decimation/MeshHierarchy.h"
#include "StructurePreserving/Overlay/OverlayProlongation.h"
#include "StructurePreserving/Transfers/FaceFieldProlongation.h"
#include "StructurePreserving/Transfers/LinearProlongation.h"
#include "StructurePreserving/Transfers/OneFormProlongation.h"
#include "StructurePreserving/Transfers/PowerFieldProlongation.h"
#include "StructurePreserving/Transfers/ScalarProlongation.h"
#include "Support/Permutations.h"
#include "Support/SparseAssembly.h"

#include <utility>

namespace dmg
{

namespace
{

/// The operators between two levels; S1 and SX are empty where nobody asked for them.
struct LevelOperators
{
  SparseMatrix<double> S0;
  SparseMatrix<double> S1;
  SparseMatrix<double> SX;
  TransportOperator SP;
};

LevelOperators OperatorsFromPaths(const LevelTransition& transition, const TangentFrames& fineFrames,
  const TangentFrames& coarseFrames, const OperatorSelection& selection, const ExecutionContext& context)
{
  LevelOperators operators;
  operators.S0 = ScalarProlongation(transition, context);
  const FineEdgePaths paths(transition, context);
  if (selection.OneForms)
  {
    operators.S1 = OneFormProlongation(paths, context);
  }
  if (selection.FaceFields)
  {
    operators.SX = FaceFieldProlongation(paths, fineFrames, coarseFrames, context);
  }
  operators.SP = PowerFieldProlongation(paths, fineFrames, coarseFrames, context);
  return operators;
}

LevelOperators OperatorsFromOverlay(const LevelTransition& transition, const TangentFrames& fineFrames,
  const TangentFrames& coarseFrames, const ExecutionContext& context)
{
  OverlayProlongation overlay(transition, fineFrames, coarseFrames, context);
  return { std::move(overlay.S0), std::move(overlay.S1), std::move(overlay.SX), std::move(overlay.SP) };
}

void AppendSizes(const TriangleMesh& mesh, ProlongationOperators& operators)
{
  operators.NumbersOfVertices.push_back(mesh.NumberOfVertices());
  operators.NumbersOfEdges.push_back(mesh.NumberOfEdges());
  operators.NumbersOfFaces.push_back(mesh.NumberOfFaces());
}

void AppendSelected(LevelOperators&& level, const OperatorSelection& selection, ProlongationOperators& operators)
{
  if (selection.PowerFields)
  {
    operators.SP.push_back(std::move(level.SP));
  }
  if (selection.FaceFields)
  {
    operators.SX.push_back(std::move(level.SX));
  }
  if (selection.OneForms)
  {
    operators.S1.push_back(std::move(level.S1));
  }
  operators.S0.push_back(std::move(level.S0));
}

/// Renumbers level 0 in the caller's order.
void RenumberFinest(const TriangleMesh& mesh, const TriangleMesh& sorted, const SpatialOrder& order,
  ProlongationOperators& operators, const ExecutionContext& context)
{
  const auto renumber = [&context](auto& matrices, const std::vector<int>& numbers)
  {
    if (!matrices.empty())
    {
      matrices[0] = RenumberRows(matrices[0], numbers, context);
    }
  };
  renumber(operators.S0, order.Vertices());
  renumber(operators.SX, PairsOf(order.Faces()));
  renumber(operators.SP, order.Faces());
  renumber(operators.Linear, order.Faces());
  if (!operators.S1.empty())
  {
    const SpatialOrder::SignedEdges edges = order.Edges(mesh, sorted);
    operators.S1[0] = edges.Signs.asDiagonal() * operators.S1[0];
    renumber(operators.S1, edges.Numbers);
  }
}

}

SurfaceHierarchy BuildSurfaceHierarchy(const TriangleMesh& mesh, const HierarchyOptions& options,
  const ExecutionContext& context, const OperatorSelection& selection)
{
  SurfaceHierarchy result;
  ProlongationOperators& operators = result.Operators;
  AppendSizes(mesh, operators);

  // Neighbours stand near each other in memory; coarse levels inherit the order.
  const SpatialOrder order(mesh.VertexPositions(), mesh.FaceCorners(), context);
  const TriangleMesh sorted = order.Apply(mesh.VertexPositions(), mesh.FaceCorners(), context);
  TangentFrames fineFrames = order.ApplyToFaces(FaceFrames(mesh, context), context);
  std::vector<Complex> fineCornerTurns; // from level 1 on
  const auto addLevel = [&](const LevelTransition& transition, const ExecutionContext& part)
  {
    const TriangleMesh& coarse = transition.Coarse;
    TangentFrames coarseFrames = FaceFrames(coarse, context);
    LevelOperators level = options.Construction == ProlongationConstruction::ExactOverlay
      ? OperatorsFromOverlay(transition, fineFrames, coarseFrames, part)
      : OperatorsFromPaths(transition, fineFrames, coarseFrames, selection, context);
    std::vector<Complex> coarseCornerTurns = CornerTurns(coarse, coarseFrames, context);
    operators.Linear.push_back(operators.Linear.empty()
        ? FacesFromVertices(sorted, level.S0, level.SP, coarse, coarseCornerTurns, context)
        : VerticesFromVertices(
            transition.Fine, fineCornerTurns, level.S0, level.SP, coarse, coarseCornerTurns, context));
    AppendSelected(std::move(level), selection, operators);
    AppendSizes(coarse, operators);
    fineFrames = std::move(coarseFrames);
    fineCornerTurns = std::move(coarseCornerTurns);
  };
  result.CoarseLevels = BuildMeshHierarchy(sorted, options, context, addLevel);
  RenumberFinest(mesh, sorted, order, operators, context);
  if (!operators.S1.empty() && !AreTooManyToHold(NumberOfGenerators(mesh), mesh))
  {
    operators.ClosedForms = ClosedForms(result.CoarseLevels.back(), context).sparseView();
  }
  return result;
}

}
