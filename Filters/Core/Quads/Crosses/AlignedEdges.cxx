#include "Quads/Crosses/AlignedEdges.h"

#include "Constraints/SurfaceFeatures.h"
#include "Mesh/SurfaceSizes.h"
#include "Support/DisjointSets.h"

#include <cmath>

namespace dmg
{

namespace
{

/// The direction of the side of a halfedge, from direction 0 of its face.
Complex AlongSide(const SurfaceAngles& angles, const CrossField& field, int halfedge)
{
  return angles.Sides[halfedge] * std::polar(1.0, -field.Angles[TriangleMesh::FaceOf(halfedge)]);
}

/// The angle between a side and the nearest direction of its face, in [0, pi / 4].
double Deviation(const SurfaceAngles& angles, const CrossField& field, int halfedge)
{
  return std::abs(std::remainder(std::arg(AlongSide(angles, field, halfedge)), Pi / 2.0));
}

/// Sharp edges that the field follows on both sides.
std::vector<char> SharpEdges(
  const FramedMesh& surface, const SurfaceAngles& angles, const CrossField& field, const AlignmentOptions& options)
{
  const TriangleMesh& mesh = surface.Mesh;
  const double largest = options.LargestDeviation * Pi / 180.0;
  const WeightsOfFaces weights(mesh, SizesOf(mesh));
  std::vector<char> isSharp(mesh.NumberOfEdges(), 0);
  for (const Constraint& along : AlongSharpEdges(surface, weights, options.FeatureAngle, 1.0))
  {
    const int h = 3 * along.Element + along.Side;
    isSharp[mesh.EdgeOf(h)] =
      Deviation(angles, field, h) <= largest && Deviation(angles, field, mesh.Twin(h)) <= largest;
  }
  return isSharp;
}

/// Removes lines that are short and do not meet the boundary.
void RemoveShortLines(const TriangleMesh& mesh, double shortest, std::vector<char>& isSharp)
{
  DisjointSets lines(mesh.NumberOfVertices());
  for (int edge = 0; edge < mesh.NumberOfEdges(); ++edge)
  {
    if (isSharp[edge])
    {
      const auto [a, b] = mesh.EdgeVertices(edge);
      lines.Unite(a, b);
    }
  }
  std::vector<double> lengths(mesh.NumberOfVertices(), 0.0);
  for (int edge = 0; edge < mesh.NumberOfEdges(); ++edge)
  {
    const auto [a, b] = mesh.EdgeVertices(edge);
    lengths[lines.Smallest(a)] += isSharp[edge] ? (mesh.Position(a) - mesh.Position(b)).norm() : 0.0;
  }
  for (int vertex = 0; vertex < mesh.NumberOfVertices(); ++vertex)
  {
    lengths[lines.Smallest(vertex)] += mesh.IsBoundaryVertex(vertex) ? shortest : 0.0;
  }
  for (int edge = 0; edge < mesh.NumberOfEdges(); ++edge)
  {
    isSharp[edge] = isSharp[edge] && lengths[lines.Smallest(mesh.EdgeVertices(edge)[0])] >= shortest;
  }
}

}

std::vector<char> FindAlignedEdges(
  const FramedMesh& surface, const SurfaceAngles& angles, const CrossField& field, const AlignmentOptions& options)
{
  const TriangleMesh& mesh = surface.Mesh;
  std::vector<char> isAligned(mesh.NumberOfEdges(), 0);
  if (options.AlignSharpEdges)
  {
    isAligned = SharpEdges(surface, angles, field, options);
    RemoveShortLines(mesh, options.ShortestFeature * SizesOf(mesh).Diagonal(), isAligned);
  }
  if (options.AlignBoundary)
  {
    for (int edge = 0; edge < mesh.NumberOfEdges(); ++edge)
    {
      isAligned[edge] = isAligned[edge] || mesh.Twin(mesh.HalfedgeOf(edge)) < 0;
    }
  }
  return isAligned;
}

bool RunsAlongU(const SurfaceAngles& angles, const CrossField& field, int halfedge)
{
  const Complex along = AlongSide(angles, field, halfedge);
  return std::abs(along.real()) > std::abs(along.imag());
}

}
