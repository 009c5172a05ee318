#include "Mesh/MeshChecks.h"

#include "Mesh/PointChecks.h"
#include "Support/Errors.h"
#include "Support/Remedy.h"

#include <algorithm>
#include <limits>

namespace dmg
{

namespace
{

constexpr double SmallestSize = 1e-40;
constexpr double SmallestFace = 1e-60;
constexpr double LargestCoordinate = 1e40;

std::string NameOf(const char* kind, const std::vector<long long>& numbers, int i)
{
  return kind + std::to_string(numbers.empty() ? i : numbers[i]);
}

double Distance(const Points& points, int a, int b)
{
  return (points.row(a) - points.row(b)).cwiseAbs().maxCoeff();
}

}

void CheckPoints(const Points& points, const ElementNames& names)
{
  for (int v = 0; v < static_cast<int>(points.rows()); ++v)
  {
    if (!points.row(v).allFinite())
    {
      throw InvalidInput(
        names.Vertex(v) + " has a coordinate that is not finite; repair it or remove the cells around it");
    }
    if (!(points.row(v).cwiseAbs().maxCoeff() <= LargestCoordinate))
    {
      throw InvalidInput(names.Vertex(v) + " has a coordinate beyond 1e40, too large to compute with; repair it, or " +
        TextOf(Remedy::Shrink));
    }
  }
  const double size = (points.colwise().maxCoeff() - points.colwise().minCoeff()).maxCoeff();
  if (size > 0.0 && size <= SmallestSize)
  {
    throw InvalidInput("the surface is smaller than 1e-40, too small to compute with; " + TextOf(Remedy::Enlarge));
  }
}

std::string ElementNames::Vertex(int i) const
{
  return NameOf("point ", this->Vertices, i);
}

std::string ElementNames::Face(int i) const
{
  return NameOf("cell ", this->Faces, i);
}

void CheckElements(const Points& points, const Triangles& triangles, const ElementNames& names)
{
  if (triangles.rows() == 0)
  {
    throw InvalidInput("the surface has no triangles, so there is nothing to solve on; " + TextOf(Remedy::Triangulate));
  }
  if (triangles.rows() > std::numeric_limits<int>::max() / 3)
  {
    throw InvalidInput("the surface has more than 715,827,882 triangles; " + TextOf(Remedy::FewerTriangles));
  }
  CheckPoints(points, names);
  const int numberOfVertices = static_cast<int>(points.rows());
  const int numberOfFaces = static_cast<int>(triangles.rows());

  std::vector<char> used(numberOfVertices, 0);
  for (int f = 0; f < numberOfFaces; ++f)
  {
    const int* corner = triangles.data() + 3 * f;
    for (int k = 0; k < 3; ++k)
    {
      if (corner[k] < 0 || corner[k] >= numberOfVertices)
      {
        throw InvalidInput(names.Face(f) + " refers to point number " + std::to_string(corner[k]) + ", but there are " +
          std::to_string(numberOfVertices) + " points; repair its connectivity or remove it");
      }
      used[corner[k]] = 1;
    }
    if (corner[0] == corner[1] || corner[1] == corner[2] || corner[2] == corner[0])
    {
      throw InvalidInput(names.Face(f) + " uses " + names.Vertex(corner[0] == corner[1] ? corner[0] : corner[2]) +
        " twice; " + TextOf(Remedy::DropRepeatedCorner));
    }
    const double size = std::max(Distance(points, corner[0], corner[1]), Distance(points, corner[0], corner[2]));
    if (!(size > SmallestFace))
    {
      throw InvalidInput("the three corners of " + names.Face(f) + " lie in one place" +
        (size > 0.0 ? ", nearly; " + TextOf(Remedy::DropNearPoint) : "; " + TextOf(Remedy::DropPoint)));
    }
  }

  for (int v = 0; v < numberOfVertices; ++v)
  {
    if (!used[v])
    {
      throw InvalidInput(names.Vertex(v) + " belongs to no triangle; " + TextOf(Remedy::DropUnusedPoints));
    }
  }
}

}
