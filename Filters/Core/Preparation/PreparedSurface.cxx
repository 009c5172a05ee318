#include "Preparation/PreparedSurface.h"

#include "Mesh/PositiveSide.h"
#include "Mesh/SpatialOrder.h"
#include "Preparation/CoincidingPoints.h"
#include "Preparation/PartsWithoutArea.h"
#include "Preparation/SurfaceRepair.h"
#include "Support/Errors.h"
#include "Support/Permutations.h"
#include "Support/Remedy.h"

#include <algorithm>
#include <limits>
#include <optional>
#include <string>
#include <utility>

namespace dmg
{

namespace
{

constexpr int Grain = 8192;

/// \throw InvalidInput no triangle has an area above 1e-10 times the square of its longest side: then no direction is
/// tangential to the surface.
void CheckArea(const TriangleMesh& mesh)
{
  constexpr double SmallestArea = 1e-10;
  for (int face = 0; face < mesh.NumberOfFaces(); ++face)
  {
    double longest = 0.0;
    for (int h = 3 * face; h < 3 * face + 3; ++h)
    {
      longest = std::max(longest, (mesh.Position(mesh.Head(h)) - mesh.Position(mesh.Tail(h))).squaredNorm());
    }
    if (mesh.FaceArea(face) > SmallestArea * longest)
    {
      return;
    }
  }
  RefuseSurfaceWithoutArea();
}

void CheckSizes(const CellTriangles& given)
{
  constexpr long long Largest = std::numeric_limits<int>::max() / 3;
  if (given.Corners.rows() > Largest)
  {
    throw InvalidInput("the surface has " + std::to_string(given.Corners.rows()) + " triangles, at most " +
      std::to_string(Largest) + " can be numbered; " + TextOf(Remedy::FewerTriangles));
  }
  const int numberOfPoints = static_cast<int>(given.Positions.rows());
  for (int i = 0; i < static_cast<int>(given.Corners.size()); ++i)
  {
    const int point = given.Corners.data()[i];
    if (point < 0 || point >= numberOfPoints)
    {
      throw InvalidInput("cell " + std::to_string(given.FirstCell + given.CellOf(i / 3)) + " uses point " +
        std::to_string(point) + ", and the surface has " + std::to_string(numberOfPoints) +
        " points; repair the source of the surface");
    }
  }
}

/// The triangles of a mesh, numbered as they were given, before anything is checked.
SurfaceParts PartsAsGiven(const CellTriangles& given, const UsedPoints& used)
{
  SurfaceParts parts;
  parts.FirstCell = given.FirstCell;
  const int size = static_cast<int>(given.Corners.rows());
  parts.CellsOfFaces = given.Cells.empty() ? Identity(size) : given.Cells;
  parts.FacesOfCells = RowsOf(given.NumberOfCells, parts.CellsOfFaces);
  parts.PointsOfVertices = used.Points;
  parts.VerticesOfPoints.Items = used.Rows;
  return parts;
}

void Renumber(std::vector<int>& items, const std::vector<int>& numbers, const ExecutionContext& context)
{
  context.ParallelFor(0, static_cast<int>(items.size()), Grain,
    [&](int first, int last)
    {
      for (int i = first; i < last; ++i)
      {
        items[i] = items[i] < 0 ? -1 : numbers[items[i]];
      }
    });
}

std::vector<int> Permuted(const std::vector<int>& items, const std::vector<int>& order, const ExecutionContext& context)
{
  std::vector<int> permuted(items.size());
  context.ParallelFor(0, static_cast<int>(items.size()), Grain,
    [&](int first, int last)
    {
      for (int i = first; i < last; ++i)
      {
        permuted[i] = items[order[i]];
      }
    });
  return permuted;
}

SurfaceRelation RelationOf(SurfaceParts&& parts)
{
  return { parts.FirstCell, std::move(parts.CellsOfFaces), std::move(parts.FacesOfCells),
    std::move(parts.PointsOfVertices), std::move(parts.VerticesOfPoints) };
}

PreparedSurface InSpatialOrder(
  const Points& positions, const Triangles& corners, SurfaceParts&& parts, const ExecutionContext& context)
{
  const SpatialOrder order(positions, corners, context);
  TriangleMesh mesh = order.Apply(positions, corners, context);
  CheckArea(mesh);
  parts.CellsOfFaces = Permuted(parts.CellsOfFaces, order.Faces(), context);
  parts.PointsOfVertices = Permuted(parts.PointsOfVertices, order.Vertices(), context);
  Renumber(parts.FacesOfCells.Items, Inverse(order.Faces(), context), context);
  Renumber(parts.VerticesOfPoints.Items, Inverse(order.Vertices(), context), context);
  return { std::move(mesh), RelationOf(std::move(parts)), {} };
}

PreparedSurface InGivenOrder(
  const Points& positions, const Triangles& corners, SurfaceParts&& parts, const ExecutionContext& context)
{
  SurfaceRelation relation = RelationOf(std::move(parts));
  TriangleMesh mesh(positions, corners, relation.Names(), context);
  CheckArea(mesh);
  return { std::move(mesh), std::move(relation), {} };
}

/// \throw InvalidInput the mesh is none; the first reason in the caller's order.
PreparedSurface MakeMesh(const Points& positions, const Triangles& corners, const SurfaceParts& parts, Numbering order,
  const ExecutionContext& context)
{
  if (order == Numbering::Spatial)
  {
    try
    {
      return InSpatialOrder(positions, corners, SurfaceParts(parts), context);
    }
    catch (const InvalidInput&)
    {
      // It is refused below, with the caller's numbers.
    }
  }
  return InGivenOrder(positions, corners, SurfaceParts(parts), context);
}

bool HasCoincidingBoundary(const TriangleMesh& mesh)
{
  BoundaryPoints boundary;
  for (int side = 0; side < 3 * mesh.NumberOfFaces(); ++side)
  {
    if (mesh.Twin(side) < 0)
    {
      boundary.Add(mesh.VertexPositions(), mesh.Tail(side), mesh.Head(side), mesh.Tail(TriangleMesh::Previous(side)));
    }
  }
  const std::vector<BoundaryPoint> points = boundary.Take();
  if (points.empty())
  {
    return false;
  }
  DisjointSets sets(mesh.NumberOfVertices());
  return JoinBoundary(mesh.VertexPositions(), points, sets);
}

bool HasPartWithoutArea(const TriangleMesh& mesh)
{
  return !InPartsWithoutArea(mesh.VertexPositions(), mesh.FaceCorners(),
    [&mesh](int side) {
      return mesh.Twin(side);
    }).empty();
}

/// \throw InvalidInput the surface is no oriented manifold; the message says so, if it can be made one.
PreparedSurface MakeStrict(const CellTriangles& given, const UsedPoints& used, const SurfaceParts& parts,
  Numbering order, const ExecutionContext& context)
{
  try
  {
    return MakeMesh(given.Positions, given.Corners, parts, order, context);
  }
  catch (const InvalidInput& error)
  {
    const std::string reason = error.what();
    try
    {
      const RepairedSurface repaired = Repair(given, used, true, context);
      MakeMesh(repaired.Positions, repaired.Corners, repaired.Parts, Numbering::AsGiven, context);
    }
    catch (const InvalidInput&)
    {
      throw InvalidInput(reason);
    }
    throw InvalidInput(
      reason + "; or " + TextOf(Remedy::Lenient) + ", which parts and turns triangles inside as is needed");
  }
}

/// The surface as it is, if that is an oriented manifold; without a report.
std::optional<PreparedSurface> AsItIs(const CellTriangles& given, const UsedPoints& used,
  const PreparationOptions& options, const ExecutionContext& context)
{
  if (options.Strict)
  {
    return MakeStrict(given, used, PartsAsGiven(given, used), options.Order, context);
  }
  try
  {
    return options.Order == Numbering::Spatial
      ? InSpatialOrder(given.Positions, given.Corners, PartsAsGiven(given, used), context)
      : InGivenOrder(given.Positions, given.Corners, PartsAsGiven(given, used), context);
  }
  catch (const InvalidInput&)
  {
    // It is repaired, or refused by the one that repairs.
  }
  return std::nullopt;
}

PreparedSurface Repaired(const CellTriangles& given, const UsedPoints& used, const PreparationOptions& options,
  const ExecutionContext& context)
{
  const RepairedSurface repaired = Repair(given, used, options.JoinPoints, context);
  PreparedSurface surface = MakeMesh(repaired.Positions, repaired.Corners, repaired.Parts, options.Order, context);
  surface.Report = repaired.Report;
  return surface;
}

/// Whether a corner of a polygon is where the next one is.
bool HasDoubledCorner(const PolygonSurface& polygons, int first, int last)
{
  constexpr double SmallestShare = 1e-6; // of the longest side
  double shortest = std::numeric_limits<double>::infinity(), longest = 0.0;
  for (int i = first; i < last; ++i)
  {
    const int next = i + 1 == last ? first : i + 1;
    const double length =
      (polygons.Positions.row(polygons.Corners[i]) - polygons.Positions.row(polygons.Corners[next])).norm();
    shortest = std::min(shortest, length);
    longest = std::max(longest, length);
  }
  return shortest <= SmallestShare * longest;
}

/// (cell, mean of its corners), for cells of one polygon. Polygons with corners that are no points are refused later.
std::vector<std::pair<long long, Vector3>> CentresOfDoubledCorners(const PolygonSurface& polygons)
{
  const auto cellOf = [&polygons](int p) { return polygons.Cells.empty() ? p : polygons.Cells[p]; };
  const auto isPoint = [&polygons](int corner) { return corner >= 0 && corner < polygons.Positions.rows(); };
  std::vector<std::pair<long long, Vector3>> centres;
  for (int p = 0; p < polygons.Size(); ++p)
  {
    const int first = polygons.Offsets[p], last = polygons.Offsets[p + 1];
    const bool isAlone =
      (p == 0 || cellOf(p - 1) != cellOf(p)) && (p + 1 == polygons.Size() || cellOf(p + 1) != cellOf(p));
    if (last - first < 4 || !isAlone ||
      !std::all_of(polygons.Corners.begin() + first, polygons.Corners.begin() + last, isPoint) ||
      !HasDoubledCorner(polygons, first, last))
    {
      continue;
    }
    Vector3 sum = Vector3::Zero();
    for (int i = first; i < last; ++i)
    {
      sum += polygons.Positions.row(polygons.Corners[i]).transpose();
    }
    centres.emplace_back(
      static_cast<long long>(polygons.FirstCell) + cellOf(p), sum / static_cast<double>(last - first));
  }
  return centres;
}

/// Turns the faces of components whose corners are clockwise, seen from the positive side.
PreparedSurface SeenFromPositiveSide(PreparedSurface&& surface, const ExecutionContext& context)
{
  SidesOfSurface sides = FindSides(surface.Mesh);
  surface.Report.Sides = std::move(sides.Kinds);
  if ((sides.OfFaces.array() > 0.0).all())
  {
    return std::move(surface);
  }
  Triangles corners = surface.Mesh.FaceCorners();
  std::vector<char> isTurned(corners.rows());
  for (Eigen::Index face = 0; face < corners.rows(); ++face)
  {
    isTurned[face] = sides.OfFaces[face] < 0.0;
    if (isTurned[face])
    {
      std::swap(corners(face, 0), corners(face, 1));
    }
  }
  TriangleMesh turned(surface.Mesh.VertexPositions(), std::move(corners), surface.Relation.Names(), context);
  surface.Relation.SetTurned(std::move(isTurned));
  return { std::move(turned), std::move(surface.Relation), std::move(surface.Report) };
}

}

PreparedSurface PrepareSurface(
  CellTriangles&& given, const PreparationOptions& options, const ExecutionContext& context)
{
  CheckSizes(given);
  const UsedPoints used = DropUnusedPoints(given);
  std::optional<PreparedSurface> surface;
  const bool hasDuplicates =
    std::any_of(given.IsDuplicate.begin(), given.IsDuplicate.end(), [](char duplicate) { return duplicate != 0; });
  if (!hasDuplicates || options.Strict)
  {
    surface = AsItIs(given, used, options, context);
  }
  if (!surface ||
    (!options.Strict && options.JoinPoints &&
      (HasCoincidingBoundary(surface->Mesh) || HasPartWithoutArea(surface->Mesh))))
  {
    try
    {
      surface = Repaired(given, used, options, context);
    }
    catch (const InvalidInput&)
    {
      if (!surface)
      {
        throw;
      }
      // The whole surface is thinner than the rounding of coordinates: nothing of it is joined.
    }
  }
  given = CellTriangles(); // frees its memory before more is needed
  surface->Report.Sides = { PositiveSide::OfCells };
  PreparedSurface seen = options.KeepsSides ? std::move(*surface) : SeenFromPositiveSide(std::move(*surface), context);
  seen.Relation.SetEdges(seen.Mesh, context);
  return seen;
}

PreparedSurface PrepareSurface(
  PolygonSurface&& polygons, const PreparationOptions& options, const ExecutionContext& context)
{
  std::vector<std::pair<long long, Vector3>> centres = CentresOfDoubledCorners(polygons);
  PreparedSurface surface = PrepareSurface(Triangulate(std::move(polygons), context), options, context);
  surface.Relation.SetCentres(std::move(centres));
  return surface;
}

}
