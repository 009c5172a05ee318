// Shortest paths against exact ones: around holes and corners, and on curved surfaces.

#include "Geodesics/ParallelTransport.h"

#include "Support/MeshFactory.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>
#include <vector>

using namespace dmg;
using namespace dmg::test;

namespace
{

/// The largest errors of a map.
struct MapErrors
{
  double Distance = 0.0;
  double Angle = 0.0;
};

/// Expects errors to fall by at least four fifths of the order that theory says, from the first to the last of resolutions that double.
void ExpectOrder(double order, const std::vector<double>& errors)
{
  EXPECT_LE(errors.back(), errors.front() * std::pow(2.0, -0.8 * order * (static_cast<double>(errors.size()) - 1.0)));
}

/// A path as polar coordinates, whose angle counts from the x axis.
using ExactPath = std::function<std::pair<double, double>(const Vector3& from, const Vector3& to)>;

MapErrors ErrorsOf(
  const Surface& shape, const Vector3& place, const ExactPath& exact, const std::function<bool(const Vector3&)>& counts)
{
  const FramedMesh surface(shape.Mesh());
  int from = 0;
  (surface.Mesh.VertexPositions().rowwise() - place.transpose()).rowwise().norm().minCoeff(&from);
  ParallelTransport transport(surface);
  const LogarithmicMap map = transport.Map(from, surface.Vertices.ToComplex(from, Vector3::UnitX()));
  EXPECT_EQ(map.Unreached, 0);
  MapErrors errors;
  for (int vertex = 0; vertex < surface.Mesh.NumberOfVertices(); ++vertex)
  {
    const Vector3 to = surface.Mesh.Position(vertex);
    if (vertex != from && counts(to))
    {
      const auto [distance, angle] = exact(surface.Mesh.Position(from), to);
      errors.Distance = std::max(errors.Distance, std::abs(map.Distances[vertex] - distance));
      errors.Angle = std::max(errors.Angle, std::abs(std::remainder(map.Angles[vertex] - angle, 2.0 * Pi)));
    }
  }
  return errors;
}

/// Between the circles of radius 0.8 and 1, whose inner one bars the way.
Surface Ring(int rings)
{
  const int around = 18 * rings;
  Surface ring{ Points((rings + 1) * around, 3), Triangles(2 * rings * around, 3) };
  for (int i = 0; i <= rings; ++i)
  {
    for (int j = 0; j < around; ++j)
    {
      const double radius = 0.8 + 0.2 * i / rings, angle = 2.0 * Pi * j / around;
      ring.V.row(i * around + j) << radius * std::cos(angle), radius * std::sin(angle), 0.0;
      if (i < rings)
      {
        const int a = i * around + j, b = a + around, c = i * around + (j + 1) % around, d = c + around;
        ring.F.row(2 * a) << a, b, d;
        ring.F.row(2 * a + 1) << a, d, c;
      }
    }
  }
  return ring;
}

/// Straight, or along a tangent of the hole, an arc of it, and another tangent.
std::pair<double, double> AroundTheHole(const Vector3& from, const Vector3& to)
{
  constexpr double Hole = 0.8;
  const Vector3 way = to - from;
  const double nearest = std::clamp(-way.dot(from) / way.squaredNorm(), 0.0, 1.0);
  if ((from + nearest * way).norm() >= Hole - 1e-9)
  {
    return { way.norm(), std::atan2(way.y(), way.x()) };
  }
  const double a = from.norm(), b = to.norm();
  const double turn = std::acos(std::clamp(from.dot(to) / (a * b), -1.0, 1.0));
  const double arc = turn - std::acos(Hole / a) - std::acos(std::min(Hole / b, 1.0));
  const double side = from.cross(to).z() > 0.0 ? 1.0 : -1.0;
  const double start = std::atan2(from.y(), from.x()) + side * (Pi - std::asin(Hole / a));
  return { std::sqrt(a * a - Hole * Hole) + std::sqrt(std::max(b * b - Hole * Hole, 0.0)) + Hole * arc, start };
}

}

TEST(ShortestPaths, GoAroundAHoleWithErrorsOfFirstOrder)
{
  const auto counts = [](const Vector3& to)
  { return std::abs(to.y()) > 0.05 || to.x() > 0.0; }; // two paths are as long
  std::vector<double> distances, angles;
  for (const int rings : { 5, 10, 20 })
  {
    const MapErrors errors = ErrorsOf(Ring(rings), { 0.9, 0.0, 0.0 }, AroundTheHole, counts);
    const double edge = 2.0 * Pi / (18 * rings);
    EXPECT_LE(errors.Distance, edge);
    EXPECT_LE(errors.Angle, 2.0 * edge / std::sqrt(0.9 * 0.9 - 0.8 * 0.8)); // seen from the start of the tangent
    distances.push_back(errors.Distance);
    angles.push_back(errors.Angle);
  }
  ExpectOrder(1.0, distances);
  // Lengths of paths that touch the hole a little before or behind the tangent differ by the third power only, so that their directions,
  // which differ by the second, have the order 2/3.
  ExpectOrder(2.0 / 3.0, angles);
}

TEST(ShortestPaths, BendAroundAReentrantCornerWithErrorsOfAlmostFirstOrder)
{
  std::vector<double> distances, angles;
  for (const int cells : { 10, 20, 40 })
  {
    Surface plate = PlaneGrid(cells, cells);
    plate.V *= 2.0 / cells;
    plate.V.leftCols(2).array() -= 1.0;
    Surface bent{ plate.V, Triangles(plate.F.rows(), 3) }; // without the quarter of positive x and y
    int faces = 0;
    for (int face = 0; face < plate.F.rows(); ++face)
    {
      const Vector3 centre =
        (plate.V.row(plate.F(face, 0)) + plate.V.row(plate.F(face, 1)) + plate.V.row(plate.F(face, 2))).transpose() /
        3.0;
      if (centre.x() < 0.0 || centre.y() < 0.0)
      {
        bent.F.row(faces++) = plate.F.row(face);
      }
    }
    bent.F.conservativeResize(faces, 3);
    std::vector<int> numbers(plate.V.rows(), -1);
    int points = 0;
    for (int& corner : bent.F.reshaped())
    {
      if (numbers[corner] < 0)
      {
        bent.V.row(points) = plate.V.row(corner);
        numbers[corner] = points++;
      }
      corner = numbers[corner];
    }
    bent.V.conservativeResize(points, 3);
    const ExactPath exact = [](const Vector3& from, const Vector3& to)
    {
      // Hidden by the corner at the origin where the way passes on its far side.
      const bool isHidden = to.y() > 1e-9 && from.cross(to).z() > 1e-9 && to.x() <= 0.0;
      const Vector3 way = isHidden ? Vector3(-from) : Vector3(to - from);
      return std::make_pair(isHidden ? from.norm() + to.norm() : way.norm(), std::atan2(way.y(), way.x()));
    };
    SCOPED_TRACE(cells);
    const MapErrors errors =
      ErrorsOf(bent, { 0.8, -0.2, 0.0 }, exact, [](const Vector3& to) { return !(to.x() > 0.0 && to.y() > 0.0); });
    const double edge = 2.0 / cells;
    EXPECT_LE(errors.Distance, edge * std::log(cells));
    EXPECT_LE(errors.Angle, 2.0 * edge);
    distances.push_back(errors.Distance / std::log(cells));
    angles.push_back(errors.Angle);
  }
  ExpectOrder(1.0, distances); // divided by the logarithm
  ExpectOrder(1.0, angles);
}

TEST(ShortestPaths, AreGreatCirclesWithErrorsOfFirstOrder)
{
  const Vector3 pole = Vector3(0.6, -0.3, 0.4).normalized();
  const ExactPath exact = [](const Vector3& from, const Vector3& to)
  {
    const Vector3 x = (Vector3::UnitX() - from.x() * from).normalized(), y = from.cross(x);
    return std::make_pair(std::acos(std::clamp(from.dot(to), -1.0, 1.0)), std::atan2(to.dot(y), to.dot(x)));
  };
  std::vector<double> distances;
  for (const int level : { 3, 4, 5 })
  {
    const MapErrors errors = ErrorsOf(Icosphere(level), pole, exact,
      [&](const Vector3& to) { return pole.dot(to) > std::cos(2.6) && pole.dot(to) < 0.9; });
    const double edge = std::acos(1.0 / std::sqrt(5.0)) / (1 << level); // of an icosahedron, divided
    EXPECT_LE(errors.Distance, edge);
    EXPECT_LE(errors.Angle, edge);
    distances.push_back(errors.Distance);
  }
  ExpectOrder(1.0, distances);
}
