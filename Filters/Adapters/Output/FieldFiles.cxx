#include "Adapters/Output/FieldFiles.h"

#include "Adapters/Data/CellChecks.h"
#include "Adapters/Data/NumberedCells.h"
#include "Adapters/Surface/ArrayNames.h"
#include "Drawing/DirectionsOnFaces.h"
#include "Mesh/PointChecks.h"
#include "Support/Errors.h"
#include "Support/Types.h"

#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkDataSet.h"
#include "vtkFieldData.h"
#include "vtkGenericCell.h"
#include "vtkIdList.h"
#include "vtkNew.h"
#include "vtkSmartPointer.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <utility>
#include <vector>

namespace dmg
{
namespace
{

/// A cell of two dimensions.
struct Face
{
  int Cell;
  std::vector<int> Points;
};

/// \throw InvalidInput a corner is nowhere, or farther away than the filters take it.
void CheckCorners(vtkDataSet* surface, const std::vector<Face>& faces)
{
  std::vector<bool> isCorner(surface->GetNumberOfPoints());
  for (const Face& face : faces)
  {
    for (const int point : face.Points)
    {
      isCorner[point] = true;
    }
  }
  ElementNames names;
  for (std::size_t point = 0; point < isCorner.size(); ++point)
  {
    if (isCorner[point])
    {
      names.Vertices.push_back(static_cast<long long>(point));
    }
  }
  Points corners(names.Vertices.size(), 3);
  for (Eigen::Index row = 0; row < corners.rows(); ++row)
  {
    surface->GetPoint(names.Vertices[row], corners.row(row).data());
  }
  if (corners.rows() > 0)
  {
    CheckPoints(corners, names);
  }
}

/// \throw InvalidInput cells or points are not what they should be.
std::vector<Face> FacesOf(vtkDataSet* surface)
{
  CheckCells(surface, "the surface");
  const vtkSmartPointer<vtkDataSet> numbered = WithNumberedCells(surface);
  std::vector<Face> faces;
  vtkNew<vtkGenericCell> cell;
  for (vtkIdType number = 0; number < numbered->GetNumberOfCells(); ++number)
  {
    numbered->GetCell(number, cell);
    if (cell->GetCellDimension() == 2)
    {
      if (cell->GetNumberOfPoints() < 3)
      {
        throw InvalidInput("cell " + std::to_string(number) +
          " has fewer than three points, which remeshers do not take; remove it with "
          "Clean (vtkCleanPolyData), and compute the field again");
      }
      Face face{ static_cast<int>(number), std::vector<int>(cell->GetNumberOfPoints()) };
      for (int k = 0; k < cell->GetNumberOfPoints(); ++k)
      {
        face.Points[k] = static_cast<int>(cell->GetPointId(k));
      }
      faces.push_back(std::move(face));
    }
  }
  CheckCorners(surface, faces);
  return faces;
}

/// The first face that is no triangle.
std::optional<std::size_t> FirstPolygon(const std::vector<Face>& faces)
{
  const auto found = std::find_if(faces.begin(), faces.end(), [](const Face& face) { return face.Points.size() != 3; });
  return found == faces.end() ? std::nullopt : std::optional(static_cast<std::size_t>(found - faces.begin()));
}

std::string NameOf(std::size_t face)
{
  return "face " + std::to_string(face);
}

Vector3 PositionOf(vtkDataSet* surface, int point)
{
  return Vector3(surface->GetPoint(point));
}

/// Twice the area of a face, along its normal.
Vector3 AreaOf(vtkDataSet* surface, const Face& face)
{
  const Vector3 first = PositionOf(surface, face.Points[0]);
  Vector3 sum = Vector3::Zero();
  for (std::size_t k = 1; k + 1 < face.Points.size(); ++k)
  {
    sum += (PositionOf(surface, face.Points[k]) - first).cross(PositionOf(surface, face.Points[k + 1]) - first);
  }
  return sum;
}

/// The array of a direction. \return null where it is not the first, and is not there.
vtkDataArray* DirectionOf(vtkDataSet* surface, int k)
{
  const std::string name = ArrayNames::Direction(k);
  vtkDataArray* const array = surface->GetCellData()->GetArray(name.c_str());
  if (!array && k == 0)
  {
    throw InvalidInput("the surface has no cell array Direction0; apply Directional Field (vtkDirectionalField) first");
  }
  if (array && array->GetNumberOfComponents() != 3)
  {
    throw InvalidInput("the array " + name + " has " + std::to_string(array->GetNumberOfComponents()) +
      " components instead of 3; apply Directional Field (vtkDirectionalField) again");
  }
  if (array && array->GetNumberOfTuples() < surface->GetNumberOfCells())
  {
    throw InvalidInput("the array " + name + " has " + std::to_string(array->GetNumberOfTuples()) + " tuples for " +
      std::to_string(surface->GetNumberOfCells()) +
      " cells; cells were added after the field was computed, so compute it again");
  }
  return array;
}

int NumberOfDirectionsOf(vtkDataSet* surface)
{
  vtkDataArray* const reported = surface->GetFieldData()->GetArray(ArrayNames::NumberOfDirections);
  if (reported)
  {
    const double number = reported->GetNumberOfValues() == 1 ? reported->GetTuple1(0) : 0.0;
    if (!(number >= 1.0 && number <= DirectionsOnFaces::LargestN) || number != std::floor(number))
    {
      throw InvalidInput("the field data array NumberOfDirections is not one number from 1 to " +
        std::to_string(DirectionsOnFaces::LargestN) + "; apply Directional Field (vtkDirectionalField) again");
    }
    return static_cast<int>(number);
  }
  int n = 1;
  while (surface->GetCellData()->HasArray(ArrayNames::Direction(n).c_str()))
  {
    ++n;
  }
  return n;
}

Vector3 VectorOf(vtkDataArray* array, const Face& face, std::size_t number)
{
  const Vector3 vector(array->GetTuple3(face.Cell));
  if (!vector.allFinite())
  {
    throw InvalidInput(std::string("the array ") + array->GetName() + " is not finite on " + NameOf(number) +
      "; compute the field again");
  }
  return vector;
}

/// Vectors on a line, with the digits that give the same numbers again, whatever the locale of the process.
std::string LineOf(const std::vector<Vector3>& vectors)
{
  std::string line;
  for (const Vector3& vector : vectors)
  {
    for (const double number : { vector.x(), vector.y(), vector.z() })
    {
      std::array<char, 32> text{};
      const std::to_chars_result end = std::to_chars(text.data(), text.data() + text.size(), number);
      line += (line.empty() ? "" : " ") + std::string(text.data(), end.ptr);
    }
  }
  return line + "\n";
}

/// A side of a triangle.
struct Side
{
  int Triangle, Number, Start, End;
};

using SidesOfEdges = std::map<std::pair<int, int>, std::vector<Side>>;

/// Finds the sides of each edge. Triangles that have a corner twice, or that are there already, take no part, as for the solver.
/// \param joined the point that stands for a point.
SidesOfEdges FindSides(const std::vector<Face>& triangles, const std::map<int, int>& joined)
{
  const auto standFor = [&joined](int point)
  {
    const auto found = joined.find(point);
    return found == joined.end() ? point : found->second;
  };
  SidesOfEdges edges;
  std::set<std::set<int>> known;
  for (std::size_t t = 0; t < triangles.size(); ++t)
  {
    const std::vector<int>& points = triangles[t].Points;
    const std::array<int, 3> corners{ standFor(points[0]), standFor(points[1]), standFor(points[2]) };
    const std::set<int> different(corners.begin(), corners.end());
    if (different.size() < 3 || !known.insert(different).second)
    {
      continue;
    }
    for (int k = 0; k < 3; ++k)
    {
      const int start = corners[k], end = corners[(k + 1) % 3];
      edges[std::minmax(start, end)].push_back({ static_cast<int>(t), k, start, end });
    }
  }
  return edges;
}

/// Points of the boundary at one place, to rounding of single precision, are the first of them.
std::map<int, int> JoinedPoints(vtkDataSet* surface, const SidesOfEdges& edges)
{
  const double spacing = std::max(1e-6 * surface->GetLength(), 1e-300);
  std::map<std::array<double, 3>, int> firstAt;
  std::map<int, int> joined;
  for (const auto& edge : edges)
  {
    for (const int point : { edge.second[0].Start, edge.second[0].End })
    {
      if (edge.second.size() == 1)
      {
        const Vector3 place = PositionOf(surface, point) / spacing;
        joined[point] =
          firstAt.emplace(std::array{ std::round(place.x()), std::round(place.y()), std::round(place.z()) }, point)
            .first->second;
      }
    }
  }
  return joined;
}

/// Whether an edge of two triangles is sharp, and whether it is convex. They count as if they were turned alike.
std::pair<bool, bool> SharpnessOf(
  vtkDataSet* surface, const std::vector<Face>& triangles, const Side& side, const Side& other, double degrees)
{
  const Vector3 normal = AreaOf(surface, triangles[side.Triangle]);
  const Vector3 beyond = AreaOf(surface, triangles[other.Triangle]) * (other.Start != side.Start ? 1.0 : -1.0);
  const Vector3 cross = normal.cross(beyond);
  const double angle = std::atan2(cross.norm(), normal.dot(beyond)) * 180.0 / Pi;
  const std::vector<int>& points = triangles[side.Triangle].Points;
  const Vector3 along = PositionOf(surface, points[(side.Number + 1) % 3]) - PositionOf(surface, points[side.Number]);
  return { angle > degrees, cross.dot(along) >= 0.0 };
}

}

std::string RosyFileOf(vtkDataSet* surface)
{
  vtkDataArray* const directions = DirectionOf(surface, 0);
  const std::vector<Face> faces = FacesOf(surface);
  std::string text = std::to_string(faces.size()) + "\n" + std::to_string(NumberOfDirectionsOf(surface)) + "\n";
  for (std::size_t k = 0; k < faces.size(); ++k)
  {
    const Vector3 vector = VectorOf(directions, faces[k], k);
    if (vector.isZero(0.0))
    {
      throw InvalidInput(NameOf(k) + " has no direction, which .rosy cannot say; prescribe one there");
    }
    text += LineOf({ vector.stableNormalized() });
  }
  return text;
}

std::string RawFieldFileOf(vtkDataSet* surface)
{
  std::vector<vtkDataArray*> arrays{ DirectionOf(surface, 0) };
  const int n = NumberOfDirectionsOf(surface);
  for (int k = 1; k < n; ++k)
  {
    arrays.push_back(DirectionOf(surface, k));
  }
  const std::vector<Face> faces = FacesOf(surface);
  std::string text = std::to_string(n) + " " + std::to_string(faces.size()) + "\n";
  for (std::size_t number = 0; number < faces.size(); ++number)
  {
    const Face& face = faces[number];
    const Vector3 first = VectorOf(arrays[0], face, number);
    const Vector3 area = AreaOf(surface, face);
    const double size = area.stableNorm();
    std::vector<Vector3> vectors{ first };
    for (int k = 1; k < n; ++k)
    {
      if (!arrays[k] && size == 0.0 && !first.isZero(0.0))
      {
        throw InvalidInput(NameOf(number) +
          " has no area, so its directions do not follow from Direction0; compute the field with All Directions");
      }
      const double angle = 2.0 * Pi * k / n;
      const Vector3 across = size > 0.0 ? Vector3((area / size).cross(first)) : Vector3(0.0, 0.0, 0.0);
      vectors.push_back(
        arrays[k] ? VectorOf(arrays[k], face, number) : Vector3(std::cos(angle) * first + std::sin(angle) * across));
    }
    if (size > 0.0) // arrays may be in any order, and the other way round in the file than for the solver
    {
      const auto angleOf = [&first, normal = Vector3(area / size)](const Vector3& vector)
      {
        const double angle = std::atan2(normal.dot(first.cross(vector)), first.dot(vector));
        return angle < 0.0 ? angle + 2.0 * Pi : angle;
      };
      std::stable_sort(vectors.begin() + 1, vectors.end(),
        [&angleOf](const Vector3& a, const Vector3& b) { return angleOf(a) < angleOf(b); });
    }
    text += LineOf(vectors);
  }
  return text;
}

std::string SharpFileOf(vtkDataSet* surface, double degrees)
{
  const std::vector<Face> triangles = FacesOf(surface);
  if (const auto polygon = FirstPolygon(triangles))
  {
    throw InvalidInput(NameOf(*polygon) + " is not a triangle; apply Triangulate (vtkTriangleFilter) first");
  }
  std::string lines;
  int number = 0;
  for (const auto& edge : FindSides(triangles, JoinedPoints(surface, FindSides(triangles, {}))))
  {
    const std::vector<Side>& sides = edge.second;
    const bool isInside = sides.size() == 2; // else the boundary, or an edge of more triangles
    const auto [isSharp, isConvex] =
      isInside ? SharpnessOf(surface, triangles, sides[0], sides[1], degrees) : std::pair(true, true);
    const std::size_t listed = !isSharp ? 0 : isInside ? 1 : sides.size(); // a reader knows of the other side of two
    for (std::size_t k = 0; k < listed; ++k, ++number)
    {
      lines += std::string(isConvex ? "1," : "0,") + std::to_string(sides[k].Triangle) + "," +
        std::to_string(sides[k].Number) + "\n";
    }
  }
  return std::to_string(number) + "\n" + lines;
}

std::string WarningOfPolygons(vtkDataSet* surface)
{
  const auto polygon = FirstPolygon(FacesOf(surface));
  return polygon ? NameOf(*polygon) +
      " is not a triangle, and remeshers read a direction for each triangle; apply Triangulate (vtkTriangleFilter) "
      "before the field"
                 : "";
}

}
