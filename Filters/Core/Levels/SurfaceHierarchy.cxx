#include "Levels/SurfaceHierarchy.h"

#include "Analysis/HarmonicForms.h"
#include "Levels/Decimation/MeshHierarchy.h"
#include "Levels/Overlay/OverlayProlongation.h"
#include "Levels/Sampling/PointSampling.h"
#include "Levels/Sampling/TangentGraph.h"
#include "Levels/Transfers/FaceFieldProlongation.h"
#include "Levels/Transfers/NodalProlongation.h"
#include "Levels/Transfers/OneFormProlongation.h"
#include "Levels/Transfers/PowerFieldProlongation.h"
#include "Levels/Transfers/SampledProlongation.h"
#include "Levels/Transfers/ScalarProlongation.h"
#include "Mesh/SpatialOrder.h"
#include "Mesh/TangentFrames.h"
#include "Support/Errors.h"
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

// Leaves one sample of four.
constexpr double DistanceOfCoarserSamples = 1.8;
// Of what a sample covers, in radians. With twice as much of both, surfaces full of folds and limbs take
// half as many iterations again.
constexpr double LargestCurvatureOfFaces = 0.5;
constexpr double LargestCurvatureOfSamples = 1.0;
// So few are factored at once, and every level less keeps more of what has nearly no energy.
constexpr int FewestSamplesToSample = 1500;
// A level that keeps more of the points than this is not worth its cost.
constexpr double LargestUsefulRatio = 0.5;

ProlongationOperators OperatorsFromSamples(const TriangleMesh& mesh, double distance, const ExecutionContext& context)
{
  ProlongationOperators operators;
  operators.NumbersOfVertices.push_back(mesh.NumberOfVertices());
  operators.NumbersOfEdges.push_back(mesh.NumberOfEdges());
  operators.NumbersOfFaces.push_back(mesh.NumberOfFaces());
  context.Checkpoint(0.0);
  operators.Nodal.reserve(16); // growth would copy
  const std::vector<int> order = FacesInSpatialOrder(mesh.VertexPositions(), mesh.FaceCorners(), context);
  TangentGraph points = FaceGraph(mesh, order, context);
  while (points.NumberOfPoints() > FewestSamplesToSample)
  {
    // Most of the work is in the finest level.
    context.Checkpoint(operators.Nodal.empty() ? 0.3 : 0.9);
    const bool areFaces = operators.Nodal.empty();
    const PointSampling sampling = SamplePoints(points, areFaces ? distance : DistanceOfCoarserSamples,
      areFaces ? LargestCurvatureOfFaces : LargestCurvatureOfSamples, context);
    const int numberOfSamples = static_cast<int>(sampling.Samples.size());
    if (numberOfSamples > LargestUsefulRatio * points.NumberOfPoints())
    {
      break; // so many pieces of surface, of few faces each
    }
    points = GraphOfSamples(points, sampling, context); // the finer one takes much memory, and makes room
    TransportOperator prolongation = areFaces ? SampledProlongation(sampling, points, Inverse(order, context), context)
                                              : SampledProlongation(sampling, points, context);
    operators.Nodal.emplace_back().swap(prolongation); // Eigen 3.4 would copy it
    operators.NumbersOfVertices.push_back(numberOfSamples);
    operators.NumbersOfEdges.push_back(points.NumberOfLinks() / 2);
    operators.NumbersOfFaces.push_back(numberOfSamples);
  }
  context.Checkpoint(1.0);
  return operators;
}

/// The levels of samples, which give nodal operators alone.
SurfaceHierarchy HierarchyOfSamples(const TriangleMesh& mesh, const HierarchyOptions& options,
  const OperatorSelection& selection, const ExecutionContext& context)
{
  if (selection.PowerFields || selection.FaceFields || selection.OneForms)
  {
    throw InvalidInput("structure-preserving operators need levels from edge collapses");
  }
  if (!(options.SampleDistance > 1.0))
  {
    throw InvalidInput("the distance of samples must be above 1");
  }
  return { {}, OperatorsFromSamples(mesh, options.SampleDistance, context) };
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

/// Level 0 goes back into the caller's order.
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
  renumber(operators.Nodal, order.Faces());
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
  if (options.Levels == LevelConstruction::Sampling)
  {
    return HierarchyOfSamples(mesh, options, selection, context);
  }
  SurfaceHierarchy result;
  ProlongationOperators& operators = result.Operators;
  AppendSizes(mesh, operators);

  // The work is done in an order that is kind to the caches; coarse levels inherit it.
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
    operators.Nodal.push_back(operators.Nodal.empty()
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
  if (!operators.S1.empty() && !AreTooManyToHold(NumberOfLoops(mesh), mesh))
  {
    operators.ClosedForms = ClosedForms(result.CoarseLevels.back(), context).sparseView();
  }
  return result;
}

}
