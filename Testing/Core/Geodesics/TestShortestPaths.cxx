// Shortest paths against exact ones: around holes and corners, and on curved surfaces.

#include "Geodesics/ShortestPaths.h"

#include "Geodesics/ParallelTransport.h"
#include "Support/MeshFactory.h"
#include "Support/Random.h"
#include "Support/ReadPly.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <string>
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

/// A surface and its triangulation.
struct Triangulated
{
  explicit Triangulated(const Surface& shape)
    : On(shape.Mesh())
    , Connection(On)
    , Delaunay(On, Connection)
  {
  }

  std::vector<ShortestPath> From(int vertex) const { return FindShortestPaths(this->Delaunay, { { vertex } }); }

  FramedMesh On;
  VertexConnection Connection;
  IntrinsicTriangulation Delaunay;
};

/// The exact distance between two vertices.
using ExactDistance = std::function<double(int from, int to)>;

struct LengthErrors
{
  double Largest = 0.0;
  double LargestRelative = 0.0;
  double Mean = 0.0;
};

LengthErrors ErrorsOfLengths(
  const Triangulated& surface, int from, const ExactDistance& exact,
  const std::function<bool(int)>& counts = [](int) { return true; })
{
  LengthErrors errors;
  int counted = 0;
  const std::vector<ShortestPath> paths = surface.From(from);
  for (int to = 0; to < static_cast<int>(paths.size()); ++to)
  {
    if (to != from && counts(to))
    {
      const double error = std::abs(paths[to].Length - exact(from, to));
      errors.Largest = std::max(errors.Largest, error);
      errors.LargestRelative = std::max(errors.LargestRelative, error / exact(from, to));
      errors.Mean += error;
      ++counted;
    }
  }
  errors.Mean /= std::max(counted, 1);
  return errors;
}

/// A sheet whose points were moved at random, but for those on the border and in one row; none of its triangles is turned over.
Surface JitteredSheet(int cells, int row, double jitter, unsigned seed)
{
  Surface sheet = PlaneGrid(cells, cells);
  Random random(seed);
  for (int vertex = 0; vertex < sheet.V.rows(); ++vertex)
  {
    const double x = sheet.V(vertex, 0), y = sheet.V(vertex, 1);
    const bool isInside = std::min(x, y) > 0.5 && std::max(x, y) < cells - 0.5 && std::abs(y - row) > 0.5;
    const double dx = random.Uniform(-0.5, 0.5), dy = random.Uniform(-0.5, 0.5);
    sheet.V(vertex, 0) += isInside ? jitter * dx : 0.0;
    sheet.V(vertex, 1) += isInside ? jitter * dy : 0.0;
  }
  return sheet;
}

/// What is above a row stands upright.
Surface Folded(Surface sheet, double row)
{
  for (int vertex = 0; vertex < sheet.V.rows(); ++vertex)
  {
    const double above = std::max(sheet.V(vertex, 1) - row, 0.0);
    sheet.V(vertex, 1) -= above;
    sheet.V(vertex, 2) += above;
  }
  return sheet;
}

/// Triangles with an apex at the origin, side by side between rays; flat but there.
Surface Pyramid(const std::vector<Vector3>& rays, int rings)
{
  const int around = static_cast<int>(rays.size());
  Surface pyramid{ Points(1 + rings * around, 3), Triangles((2 * rings - 1) * around, 3) };
  pyramid.V.row(0).setZero();
  int face = 0;
  for (int ring = 0; ring < rings; ++ring)
  {
    for (int k = 0; k < around; ++k)
    {
      const int next = (k + 1) % around, a = 1 + (ring - 1) * around + k, b = 1 + (ring - 1) * around + next;
      const int c = 1 + ring * around + k, d = 1 + ring * around + next;
      pyramid.V.row(c) = (ring + 1.0) / rings * rays[k].transpose();
      if (ring == 0)
      {
        pyramid.F.row(face++) << 0, c, d;
      }
      else
      {
        pyramid.F.row(face++) << a, c, d;
        pyramid.F.row(face++) << a, d, b;
      }
    }
  }
  return pyramid;
}

/// Around the apex of a pyramid of rays of equal angles: straight in the plane where that is less than a half turn.
double AroundTheApex(double a, double b, double turn)
{
  return turn < Pi ? std::sqrt(a * a + b * b - 2.0 * a * b * std::cos(turn)) : a + b;
}

}

TEST(ShortestPaths, AreStraightOnAFoldedSheet)
{
  constexpr int Cells = 40, Row = 15;
  for (const double jitter : { 0.0, 0.3, 0.45 })
  {
    for (const unsigned seed : { 17u, 23u, 31u })
    {
      SCOPED_TRACE("jitter " + std::to_string(jitter) + ", seed " + std::to_string(seed));
      const Surface flat = JitteredSheet(Cells, Row, jitter, seed);
      const Triangulated folded(Folded(flat, Row));
      for (int from = 0; from < flat.V.rows(); from += 41)
      {
        const LengthErrors errors =
          ErrorsOfLengths(folded, from, [&](int a, int b) { return (flat.V.row(a) - flat.V.row(b)).norm(); });
        EXPECT_LE(errors.Largest, 1e-11 * Cells) << from;
      }
    }
  }
}

TEST(ShortestPaths, AreStraightInAPlaneOfNeedles)
{
  for (const double ratio : { 1.0, 5.0, 30.0 })
  {
    for (const bool isSheared : { false, true })
    {
      SCOPED_TRACE(ratio);
      Surface plane = isSheared ? PlaneGrid(30, 30) : IrregularPlane(30, 30, 7, 0.28);
      plane.V.col(1) /= ratio;
      plane.V.col(0) +=
        isSheared ? Vector<double>(plane.V.col(1) * (2.0 * ratio)) : Vector<double>(0.0 * plane.V.col(1));
      const Triangulated surface(plane);
      for (int from = 0; from < plane.V.rows(); from += 53)
      {
        const LengthErrors errors =
          ErrorsOfLengths(surface, from, [&](int a, int b) { return (plane.V.row(a) - plane.V.row(b)).norm(); });
        EXPECT_LE(errors.LargestRelative, 1e-11) << from;
      }
    }
  }
}

TEST(ShortestPaths, AreGreatCirclesWithErrorsOfSecondOrder)
{
  for (const bool isIrregular : { false, true })
  {
    std::vector<double> largest, mean;
    for (const int level : { 3, 4, 5 })
    {
      const Surface sphere = isIrregular ? IrregularSphere(level, 3) : Icosphere(level);
      const ExactDistance exact = [&](int from, int to)
      {
        const Vector3 a = sphere.V.row(from), b = sphere.V.row(to);
        return std::atan2(a.cross(b).norm(), a.dot(b));
      };
      const LengthErrors errors =
        ErrorsOfLengths(Triangulated(sphere), 5, exact, [&](int to) { return exact(5, to) < 2.9; });
      const double edge = std::acos(1.0 / std::sqrt(5.0)) / (1 << level);
      EXPECT_LE(errors.Largest, 0.5 * edge * edge);
      largest.push_back(errors.Largest);
      mean.push_back(errors.Mean);
    }
    ExpectOrder(2.0, largest);
    ExpectOrder(2.0, mean);
  }
}

TEST(ShortestPaths, UnrollTheCylinder)
{
  constexpr int Around = 32;
  const Surface tube = Prism(Around, 40);
  const Triangulated surface(tube);
  const double radius = tube.V.row(0).head<2>().norm();
  const double girth = 2.0 * Around * radius * std::sin(Pi / Around);
  const ExactDistance exact = [&](int from, int to)
  {
    const Vector3 a = tube.V.row(from), b = tube.V.row(to);
    const double turn = std::abs(std::atan2(a.cross(b).z(), a.head<2>().dot(b.head<2>())));
    return std::hypot(a.z() - b.z(), girth * turn / (2.0 * Pi));
  };
  for (const int from : { 0, 300, 700 })
  {
    EXPECT_LE(ErrorsOfLengths(surface, from, exact).LargestRelative, 1e-9) << from;
  }
}

TEST(ShortestPaths, UnfoldThePyramid)
{
  for (const double slope : { 0.4, 1.0, 3.0 })
  {
    SCOPED_TRACE(slope);
    constexpr int Around = 12, Rings = 20;
    std::vector<Vector3> rays;
    for (int k = 0; k < Around; ++k)
    {
      const double angle = 2.0 * Pi * k / Around;
      rays.emplace_back(std::cos(angle), std::sin(angle), -slope);
      rays.back().normalize();
    }
    const Triangulated surface(Pyramid(rays, Rings));
    const double sector = std::acos(rays[0].dot(rays[1]));
    const ExactDistance exact = [&](int from, int to)
    {
      const double a = surface.On.Mesh.Position(from).norm(), b = surface.On.Mesh.Position(to).norm();
      const int steps = std::abs((from - 1) % Around - (to - 1) % Around);
      return from == 0 || to == 0 ? a + b : AroundTheApex(a, b, sector * std::min(steps, Around - steps));
    };
    EXPECT_LE(ErrorsOfLengths(surface, 0, exact).LargestRelative, 1e-9);
    for (const int from : { 1 + 3 * Around, 1 + (Rings - 1) * Around })
    {
      // Wavefronts from both sides of the apex meet behind it.
      const auto isInFront = [&](int to)
      { return to == 0 || std::min((to - 1) % Around, Around - (to - 1) % Around) <= 2; };
      EXPECT_LE(ErrorsOfLengths(surface, from, exact, isInFront).LargestRelative, 1e-9);
      EXPECT_LE(ErrorsOfLengths(surface, from, exact).LargestRelative, 6e-3);
    }
  }
}

TEST(ShortestPaths, BendAroundASaddle)
{
  constexpr int Around = 12, Rings = 20;
  std::vector<Vector3> rays;
  for (int k = 0; k < Around; ++k)
  {
    const double angle = 2.0 * Pi * k / Around;
    rays.emplace_back(std::cos(angle), std::sin(angle), k % 2 == 0 ? 0.4 : -0.4);
    rays.back().normalize();
  }
  const Triangulated surface(Pyramid(rays, Rings));
  const double sector = std::acos(rays[0].dot(rays[1]));
  ASSERT_GT(Around * sector, 2.5 * Pi);
  const ExactDistance exact = [&](int from, int to)
  {
    const double a = surface.On.Mesh.Position(from).norm(), b = surface.On.Mesh.Position(to).norm();
    const int steps = std::abs((from - 1) % Around - (to - 1) % Around);
    return to == 0 ? a : AroundTheApex(a, b, sector * std::min(steps, Around - steps));
  };
  const LengthErrors errors = ErrorsOfLengths(surface, 1 + 9 * Around, exact);
  EXPECT_LE(errors.LargestRelative, 8e-3);
  EXPECT_LE(errors.Mean, 1e-3);
}

TEST(ShortestPaths, UnfoldTheBox)
{
  // Half a cube, open below, from the middle of its lid.
  constexpr int Cells = 8;
  Surface box = PlaneGrid(3 * Cells, 3 * Cells);
  int faces = 0;
  for (int face = 0; face < box.F.rows(); ++face)
  {
    const Vector3 centre = (box.V.row(box.F(face, 0)) + box.V.row(box.F(face, 1)) + box.V.row(box.F(face, 2))) / 3.0;
    const bool isX = centre.x() > Cells && centre.x()<2 * Cells, isY = centre.y()> Cells && centre.y() < 2 * Cells;
    if (isX || isY)
    {
      box.F.row(faces++) = box.F.row(face);
    }
  }
  box.F.conservativeResize(faces, 3);
  box.V.array() -= 1.5 * Cells;
  // The sides of a cross hang down, and their points at the corners of the lid coincide in pairs.
  const double half = 0.5 * Cells;
  std::vector<int> numbers(box.V.rows(), -1);
  Points places(0, 3);
  for (int& corner : box.F.reshaped())
  {
    Vector3 place(box.V(corner, 0), box.V(corner, 1), 0.0);
    for (int axis = 0; axis < 2; ++axis)
    {
      const double beyond = std::max(std::abs(place[axis]) - half, 0.0);
      place[2] -= beyond;
      place[axis] = std::clamp(place[axis], -half, half);
    }
    int number = 0;
    while (number < places.rows() && (places.row(number).transpose() - place).norm() > 1e-9)
    {
      ++number;
    }
    if (number == places.rows())
    {
      places.conservativeResize(number + 1, 3);
      places.row(number) = place.transpose();
    }
    corner = number;
  }
  box.V = places;
  const Triangulated surface(box);
  int middle = 0;
  box.V.rowwise().norm().minCoeff(&middle);
  const ExactDistance exact = [&](int, int to)
  {
    const Vector3 place = box.V.row(to);
    const double x = std::abs(place.x()), y = std::abs(place.y()), down = -place.z();
    return x >= y ? std::hypot(x + down, y) : std::hypot(x, y + down);
  };
  EXPECT_LE(ErrorsOfLengths(surface, middle, exact).LargestRelative, 1e-9);
}

TEST(ShortestPaths, AreNearTheExactOnesOfPolyhedra)
{
  const std::filesystem::path data = DMG_EXACT_DISTANCES, meshes = DMG_MESHES;
  if (!std::filesystem::exists(meshes))
  {
    GTEST_SKIP() << "the meshes are not there";
  }
  for (const std::filesystem::directory_entry& file : std::filesystem::directory_iterator(data))
  {
    const std::filesystem::path mesh = meshes / file.path().stem().concat(".ply");
    if (file.path().extension() != ".txt" || !std::filesystem::exists(mesh))
    {
      continue;
    }
    SCOPED_TRACE(file.path().stem().string());
    const Triangulated surface(ReadPly(mesh.string()));
    const std::vector<ShortestPath> paths = surface.From(0);
    std::ifstream numbers(file.path());
    double sum = 0.0, exact = 0.0;
    int count = 0;
    for (int vertex = 0; numbers >> vertex >> exact; ++count)
    {
      const double error = std::abs(paths[vertex].Length / exact - 1.0);
      EXPECT_LE(error, 6e-3) << vertex;
      sum += error;
    }
    EXPECT_GE(count, 100);
    EXPECT_LE(sum / count, 1e-3);
  }
}

TEST(ShortestPaths, EndAtTheMaximumDistance)
{
  const Triangulated plane(PlaneGrid(20, 20));
  const std::vector<ShortestPath> all = plane.From(7);
  const std::vector<ShortestPath> near = FindShortestPaths(plane.Delaunay, { { 7 } }, 6.5);
  for (std::size_t vertex = 0; vertex < all.size(); ++vertex)
  {
    EXPECT_EQ(near[vertex].Length <= 6.5, all[vertex].Length <= 6.5);
    EXPECT_TRUE(near[vertex].Length > 6.5 || near[vertex].Length == all[vertex].Length);
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
    EXPECT_LE(errors.Distance, 0.02 * edge);
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
    EXPECT_LE(errors.Distance, 0.08 * edge);
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
    EXPECT_LE(errors.Distance, 0.04 * edge);
    EXPECT_LE(errors.Angle, edge);
    distances.push_back(errors.Distance);
  }
  ExpectOrder(1.0, distances);
}
