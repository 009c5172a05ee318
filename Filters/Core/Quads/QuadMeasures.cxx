#include "Quads/QuadMeasures.h"

#include "Quads/Isolines/QuadDistances.h"
#include "Quads/Isolines/QuadSmoothing.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

namespace dmg
{

namespace
{

void MeasureShapes(const MeasuredSurface& on, const QuadTopology& topology, QuadMesh& mesh)
{
  constexpr double Rounding = 1e-6; // straight corners on the boundary are not inverted
  QuadReport& report = mesh.Report;
  mesh.ScaledJacobians =
    ScaledJacobians(mesh.Quads, mesh.Positions, OutsidesOf(on.Surface, mesh.Quads, mesh.Faces, mesh.Places));
  report.InvertedQuads = static_cast<int>((mesh.ScaledJacobians.array() < -Rounding).count());
  report.MeanScaledJacobian = mesh.ScaledJacobians.size() > 0 ? mesh.ScaledJacobians.mean() : 0.0;
  report.EulerOfMesh =
    static_cast<int>(mesh.Places.size()) - topology.NumberOfEdges + static_cast<int>(mesh.Quads.size());
  for (std::size_t vertex = 0; vertex < mesh.Places.size(); ++vertex)
  {
    if (!mesh.IsOnBoundary[vertex] && mesh.Valences[vertex] != 4)
    {
      ++report.IrregularVertices;
      report.IrregularWithoutSingularity += mesh.Singularities[vertex] == 0 ? 1 : 0;
    }
  }
}

void MeasureDistances(
  const MeasuredSurface& on, const Vector<double>& areasOfQuads, QuadMesh& mesh, const ExecutionContext& context)
{
  const TriangleMesh& surface = on.Surface.Mesh;
  QuadDistances& found = mesh.Report.Distances;
  const Vector<double> fromQuads =
    DistancesFromQuads(surface, mesh.Quads, mesh.Positions, PartOfContext(context, 0.0, 0.7));
  if (fromQuads.size() > 0)
  {
    found.LargestFromQuads = fromQuads.maxCoeff(&found.FarthestVertex);
    found.FarthestPlace = surface.Position(found.FarthestVertex);
    const int face = TriangleMesh::FaceOf(surface.OutgoingHalfedge(found.FarthestVertex));
    found.InEdges = found.LargestFromQuads / (mesh.Report.LengthScale * on.Lengths[face]);
    const Vector<double> areas = surface.FaceAreas();
    double sum = 0.0;
    for (int h = 0; h < 3 * surface.NumberOfFaces(); ++h)
    {
      sum += areas[TriangleMesh::FaceOf(h)] / 3.0 * fromQuads[surface.Tail(h)];
    }
    found.MeanFromQuads = sum / areas.sum();
  }
  const Vector<double> fromSurface =
    DistancesFromSurface(on.Places, mesh.Quads, mesh.Faces, mesh.Positions, PartOfContext(context, 0.7, 1.0));
  if (fromSurface.size() > 0)
  {
    found.LargestFromSurface = fromSurface.maxCoeff(&found.FarthestQuad);
    found.MeanFromSurface = fromSurface.dot(areasOfQuads) / areasOfQuads.sum();
  }
}

void MeasureAreas(const MeasuredSurface& on, const Vector<double>& areasOfQuads, QuadMesh& mesh)
{
  const std::vector<int>& components = on.Components;
  const Vector<double> areas = on.Surface.Mesh.FaceAreas();
  const int count = 1 + *std::max_element(components.begin(), components.end());
  std::vector<double> ofSurface(count, 0.0), ofQuads(count, 0.0);
  for (int face = 0; face < areas.size(); ++face)
  {
    ofSurface[components[face]] += areas[face];
  }
  for (int quad = 0; quad < areasOfQuads.size(); ++quad)
  {
    ofQuads[components[mesh.Faces[quad]]] += areasOfQuads[quad];
  }
  for (int component = 0; component < count; ++component)
  {
    mesh.Report.AreaShares.push_back(ofSurface[component] > 0.0 ? ofQuads[component] / ofSurface[component] : 1.0);
  }
  const auto least = std::min_element(mesh.Report.AreaShares.begin(), mesh.Report.AreaShares.end());
  const auto face = std::find(components.begin(), components.end(), least - mesh.Report.AreaShares.begin());
  mesh.Report.LeastCovered = static_cast<int>(face - components.begin());
}

void CountLostRegions(const std::vector<int>& regions, QuadMesh& mesh)
{
  if (!regions.empty())
  {
    std::set<int> lost(regions.begin(), regions.end());
    for (const int face : mesh.Faces)
    {
      lost.erase(regions[face]);
    }
    mesh.Report.LostRegions = static_cast<int>(lost.size());
  }
}

/// Fits a power to the lengths of edges against those that were asked for, where no other reason makes them shorter.
void MeasureSizes(const MeasuredSurface& on, const Vector<double>& areasOfQuads, QuadMesh& mesh)
{
  const Vector<double>& sizes = on.Sizes;
  if (sizes.size() == 0)
  {
    return;
  }
  double weights = 0.0, meanAsked = 0.0, meanMade = 0.0, covariance = 0.0, variance = 0.0;
  const auto visit = [&](const auto& add)
  {
    for (int quad = 0; quad < areasOfQuads.size(); ++quad)
    {
      if (areasOfQuads[quad] > 0.0)
      {
        add(areasOfQuads[quad], std::log(sizes[mesh.Faces[quad]]), 0.5 * std::log(areasOfQuads[quad]));
      }
    }
  };
  visit(
    [&](double weight, double asked, double made)
    {
      weights += weight;
      meanAsked += weight * asked;
      meanMade += weight * made;
    });
  meanAsked /= weights;
  meanMade /= weights;
  visit(
    [&](double weight, double asked, double made)
    {
      covariance += weight * (asked - meanAsked) * (made - meanMade);
      variance += weight * (asked - meanAsked) * (asked - meanAsked);
    });
  mesh.Report.AskedRatio = sizes.maxCoeff() / sizes.minCoeff();
  mesh.Report.ReachedRatio =
    variance > 0.0 ? std::pow(mesh.Report.AskedRatio, std::clamp(covariance / variance, 0.0, 2.0)) : 1.0;
}

}

void MeasureQuads(
  const MeasuredSurface& on, const QuadTopology& topology, QuadMesh& mesh, const ExecutionContext& context)
{
  const Vector<double> areas = AreasOfQuads(mesh.Quads, mesh.Positions);
  mesh.Report.IrregularVertices = 0;
  mesh.Report.IrregularWithoutSingularity = 0;
  mesh.Report.AreaShares.clear();
  mesh.Report.Distances = {};
  mesh.Report.MeanLength = areas.size() > 0 ? std::sqrt(areas.mean()) : 0.0;
  mesh.Grid = LayOutOnGrid(topology);
  MeasureShapes(on, topology, mesh);
  MeasureAreas(on, areas, mesh);
  MeasureSizes(on, areas, mesh);
  CountLostRegions(on.Regions, mesh);
  MeasureDistances(on, areas, mesh, context);
}

}
