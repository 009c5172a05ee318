#include "Levels/SampledLevels.h"

#include "Levels/GraphOfSamples.h"
#include "Levels/PointSampling.h"
#include "Levels/SampleSpacing.h"
#include "Levels/SampledProlongation.h"
#include "Levels/TangentGraph.h"
#include "Mesh/SpatialOrder.h"
#include "Support/Errors.h"
#include "Support/Permutations.h"

#include <utility>

namespace dmg
{

PointsToSample FacesToSample(const TriangleMesh& mesh, const ExecutionContext& context)
{
  std::vector<int> order = FacesInSpatialOrder(mesh.VertexPositions(), mesh.FaceCorners(), context);
  TangentGraph graph = FaceGraph(mesh, order, context);
  return { std::move(order), std::move(graph), LargestCurvatureOfElements, false };
}

PointsToSample VerticesToSample(
  const TriangleMesh& mesh, const VertexConnection& connection, const ExecutionContext& context)
{
  const SpatialOrder order(mesh.VertexPositions(), mesh.FaceCorners(), context);
  return { order.Vertices(), VertexGraph(mesh, connection, order.Vertices(), context), LargestCurvatureOfElements,
    true };
}

ProlongationOperators SampledLevels(const TriangleMesh& mesh, double distance, const ExecutionContext& context)
{
  context.Checkpoint(0.0);
  return SampledLevels(mesh, FacesToSample(mesh, context), distance, context);
}

ProlongationOperators SampledLevels(
  const TriangleMesh& mesh, PointsToSample toSample, double distance, const ExecutionContext& context)
{
  if (!(distance > 1.0))
  {
    throw InvalidInput("the distance of samples must be above 1");
  }
  ProlongationOperators operators;
  operators.NumbersOfVertices.push_back(mesh.NumberOfVertices());
  operators.NumbersOfEdges.push_back(mesh.NumberOfEdges());
  operators.NumbersOfFaces.push_back(mesh.NumberOfFaces());
  operators.IsLinearAtVertices = toSample.AreVertices;
  context.Checkpoint(0.1);
  operators.Linear.reserve(16); // growth would copy
  TangentGraph points = std::move(toSample.Graph);
  while (points.NumberOfPoints() > FewestSamplesToSample)
  {
    // Most of the work is in the finest level.
    context.Checkpoint(operators.Linear.empty() ? 0.3 : 0.9);
    const bool areFinest = operators.Linear.empty();
    const PointSampling sampling = SamplePoints(points, areFinest ? distance : DistanceOfCoarserSamples,
      areFinest ? toSample.LargestCurvature : LargestCurvatureOfSamples, context);
    const int numberOfSamples = static_cast<int>(sampling.Samples.size());
    if (numberOfSamples > LargestUsefulRatio * points.NumberOfPoints())
    {
      break; // so many pieces of surface, of few faces each
    }
    points = GraphOfSamples(points, sampling, context); // the finer one takes much memory, and makes room
    TransportOperator prolongation = areFinest
      ? SampledProlongation(sampling, points, Inverse(toSample.Order, context), context)
      : SampledProlongation(sampling, points, context);
    operators.Linear.emplace_back().swap(prolongation); // Eigen 3.4 would copy it
    operators.NumbersOfVertices.push_back(numberOfSamples);
    operators.NumbersOfEdges.push_back(points.NumberOfLinks() / 2);
    operators.NumbersOfFaces.push_back(numberOfSamples);
  }
  context.Checkpoint(1.0);
  return operators;
}

}
