#include "Quads/Crosses/AlignedEdges.h"

#include "Constraints/SurfaceFeatures.h"
#include "Mesh/SurfaceSizes.h"
#include "Quads/Crosses/LinesOfEdges.h"
#include "Support/DisjointSets.h"

#include <algorithm>
#include <cmath>
#include <utility>

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

std::vector<Constraint> AlongAllSharpEdges(const FramedMesh& surface, double degrees, double weight)
{
  return AlongSharpEdges(surface, WeightsOfFaces(surface.Mesh, SizesOf(surface.Mesh)), degrees, weight);
}

/// Directions along edges that are sharper than an angle and on lines.
std::vector<Constraint> AlongLines(
  const FramedMesh& surface, double degrees, const std::vector<char>& isOnLine, double weight)
{
  std::vector<Constraint> along = AlongAllSharpEdges(surface, degrees, weight);
  const auto isOther = [&](const Constraint& constraint)
  { return !isOnLine[surface.Mesh.EdgeOf(3 * constraint.Element + constraint.Side)]; };
  along.erase(std::remove_if(along.begin(), along.end(), isOther), along.end());
  return along;
}

/// The edges between regions, as a flag per edge.
std::vector<char> Borders(const TriangleMesh& mesh, const AlignmentOptions& options)
{
  std::vector<char> isBorder(mesh.NumberOfEdges(), 0);
  for (int edge = 0; edge < mesh.NumberOfEdges() && !options.Regions.empty(); ++edge)
  {
    const int h = mesh.HalfedgeOf(edge), twin = mesh.Twin(h);
    isBorder[edge] =
      twin >= 0 && options.Regions[TriangleMesh::FaceOf(h)] != options.Regions[TriangleMesh::FaceOf(twin)];
  }
  return isBorder;
}

/// Removes the parts of lines between two corners that are short.
void RemoveShortParts(const TriangleMesh& mesh, double shortest, std::vector<char>& isSharp)
{
  const LinesOfEdges lines(mesh, isSharp);
  DisjointSets parts(mesh.NumberOfEdges());
  for (int vertex = 0; vertex < mesh.NumberOfVertices(); ++vertex)
  {
    const std::vector<std::pair<int, int>> edges = lines.EdgesAt(vertex);
    if (edges.size() == 2 && !lines.IsCorner(vertex))
    {
      parts.Unite(edges[0].first, edges[1].first);
    }
  }
  std::vector<double> lengths(mesh.NumberOfEdges(), 0.0);
  for (int edge = 0; edge < mesh.NumberOfEdges(); ++edge)
  {
    const auto [a, b] = mesh.EdgeVertices(edge);
    lengths[parts.Smallest(edge)] += isSharp[edge] ? (mesh.Position(a) - mesh.Position(b)).norm() : 0.0;
  }
  for (int edge = 0; edge < mesh.NumberOfEdges(); ++edge)
  {
    isSharp[edge] = isSharp[edge] && lengths[parts.Smallest(edge)] >= shortest;
  }
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

std::vector<char> SharpLines(const FramedMesh& surface, const AlignmentOptions& options)
{
  const TriangleMesh& mesh = surface.Mesh;
  std::vector<char> isSharp(mesh.NumberOfEdges(), 0);
  for (const Constraint& along : AlongAllSharpEdges(surface, options.FeatureAngle, 1.0))
  {
    isSharp[mesh.EdgeOf(3 * along.Element + along.Side)] = 1;
  }
  const double diagonal = SizesOf(mesh).Diagonal();
  RemoveShortParts(mesh, options.ShortestPart * diagonal, isSharp);
  RemoveShortLines(mesh, options.ShortestFeature * diagonal, isSharp);
  return isSharp;
}

/// Removes sharp edges that the field does not follow on both sides.
void RemoveDeviating(const TriangleMesh& mesh, const SurfaceAngles& angles, const CrossField& field, double largest,
  std::vector<char>& isSharp)
{
  for (int edge = 0; edge < mesh.NumberOfEdges(); ++edge)
  {
    const int h = mesh.HalfedgeOf(edge);
    isSharp[edge] =
      isSharp[edge] && Deviation(angles, field, h) <= largest && Deviation(angles, field, mesh.Twin(h)) <= largest;
  }
}

}

std::vector<Constraint> AlongSharpLines(const FramedMesh& surface, const AlignmentOptions& options, double weight)
{
  return AlongLines(surface, options.FeatureAngle, SharpLines(surface, options), weight);
}

std::vector<Constraint> AlongBorders(const FramedMesh& surface, const AlignmentOptions& options, double weight)
{
  constexpr double AnyAngle = -1.0;
  return options.Regions.empty() ? std::vector<Constraint>()
                                 : AlongLines(surface, AnyAngle, Borders(surface.Mesh, options), weight);
}

std::vector<char> FindAlignedEdges(
  const FramedMesh& surface, const SurfaceAngles& angles, const CrossField& field, const AlignmentOptions& options)
{
  const TriangleMesh& mesh = surface.Mesh;
  std::vector<char> isAligned(mesh.NumberOfEdges(), 0);
  if (options.AlignSharpEdges)
  {
    isAligned = SharpLines(surface, options);
    RemoveDeviating(mesh, angles, field, options.LargestDeviation * Pi / 180.0, isAligned);
    RemoveShortLines(mesh, options.ShortestFeature * SizesOf(mesh).Diagonal(), isAligned);
  }
  const std::vector<char> isBorder = Borders(mesh, options);
  for (int edge = 0; edge < mesh.NumberOfEdges(); ++edge)
  {
    isAligned[edge] =
      isAligned[edge] || isBorder[edge] || (options.AlignBoundary && mesh.Twin(mesh.HalfedgeOf(edge)) < 0);
  }
  return isAligned;
}

std::vector<int> LinesAgainstField(
  const TriangleMesh& mesh, const SurfaceAngles& angles, const CrossField& field, const AlignmentOptions& options)
{
  const std::vector<char> isBorder = Borders(mesh, options);
  std::vector<int> against;
  for (int edge = 0; edge < mesh.NumberOfEdges(); ++edge)
  {
    const int h = mesh.HalfedgeOf(edge);
    const bool isHeld = isBorder[edge] || (options.AlignBoundary && mesh.Twin(h) < 0);
    if (isHeld && Deviation(angles, field, h) > options.LargestDeviation * Pi / 180.0)
    {
      against.push_back(h);
    }
  }
  std::sort(against.begin(), against.end());
  return against;
}

bool RunsAlongU(const SurfaceAngles& angles, const CrossField& field, int halfedge)
{
  const Complex along = AlongSide(angles, field, halfedge);
  return std::abs(along.real()) > std::abs(along.imag());
}

}
