// Distances from anything, shortest paths and offset lines, against geometry.

#include "Geodesics/SurfaceDistance.h"

#include "Geodesics/SplitSurface.h"
#include "Support/Errors.h"
#include "Support/MeshFactory.h"
#include "Support/Random.h"
#include "Support/ReadPly.h"
#include "Support/TbbContext.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <limits>
#include <set>
#include <string>
#include <vector>

using namespace dmg;
using namespace dmg::test;

namespace
{

/// What is above a row stands upright.
Vector3 Folded(Vector3 place, double row)
{
  const double above = std::max(place.y() - row, 0.0);
  return { place.x(), place.y() - above, place.z() + above };
}

/// Irregular, with its points on one row left there, and squeezed along y.
Surface IrregularSheet(int cells, int row, double ratio)
{
  Surface sheet = PlaneGrid(cells, cells);
  Random random(29);
  for (int vertex = 0; vertex < sheet.V.rows(); ++vertex)
  {
    const double x = sheet.V(vertex, 0), y = sheet.V(vertex, 1);
    const bool isInside = std::min(x, y) > 0.5 && std::max(x, y) < cells - 0.5;
    sheet.V(vertex, 0) += isInside ? random.Uniform(-0.2, 0.2) : 0.0;
    sheet.V(vertex, 1) += isInside && std::abs(y - row) > 0.5 ? random.Uniform(-0.2, 0.2) : 0.0;
  }
  sheet.V.col(1) /= ratio;
  return sheet;
}

Surface Folded(Surface sheet, double row)
{
  for (int vertex = 0; vertex < sheet.V.rows(); ++vertex)
  {
    sheet.V.row(vertex) = Folded(Vector3(sheet.V.row(vertex).transpose()), row).transpose();
  }
  return sheet;
}

/// Of distances at vertices from what they are to be.
double LargestError(const Vector<double>& distances, const std::function<double(int)>& exact)
{
  double largest = 0.0;
  for (int vertex = 0; vertex < distances.size(); ++vertex)
  {
    const double error = std::abs(distances[vertex] - exact(vertex));
    largest = error <= largest ? largest : error; // NaN counts
  }
  return largest;
}

double GreatCircle(const Vector3& a, const Vector3& b)
{
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

double LengthOf(const std::vector<Vector3>& points)
{
  double length = 0.0;
  for (std::size_t k = 1; k < points.size(); ++k)
  {
    length += (points[k] - points[k - 1]).norm();
  }
  return length;
}

std::vector<Vector3> CircleOfLatitude(double z, int size)
{
  std::vector<Vector3> circle;
  for (int k = 0; k <= size; ++k)
  {
    const double angle = 2.0 * Pi * (k % size) / size, radius = std::sqrt(1.0 - z * z);
    circle.emplace_back(radius * std::cos(angle), radius * std::sin(angle), z);
  }
  return circle;
}

DistanceOptions Signed()
{
  DistanceOptions options;
  options.Signed = true;
  return options;
}

DistanceSources FromVertex(int vertex)
{
  DistanceSources sources;
  sources.Vertices.push_back(vertex);
  return sources;
}

DistanceSources FromLine(const std::vector<Vector3>& line)
{
  DistanceSources sources;
  sources.Lines = { line };
  return sources;
}

void ExpectOrderTwo(const std::vector<double>& errors)
{
  EXPECT_LE(errors.back(), errors.front() * std::pow(2.0, -1.6 * (static_cast<double>(errors.size()) - 1.0)));
}

}

TEST(SurfaceDistance, OfPlacesAnywhereIsStraightOnAFoldedSheet)
{
  constexpr int Cells = 24, Row = 9;
  for (const double ratio : { 1.0, 30.0 })
  {
    SCOPED_TRACE(ratio);
    const Surface flat = IrregularSheet(Cells, Row, ratio);
    const FramedMesh surface(Folded(flat, Row / ratio).Mesh());
    // In faces, on the fold, on the rim, at a corner, and at a vertex.
    std::vector<Vector3> places = { { 7.3, 3.61, 0.0 }, { 11.21, 17.77, 0.0 }, { 5.4, Row, 0.0 }, { 0.0, 6.3, 0.0 },
      { Cells, Cells, 0.0 }, { 12.0, 0.0, 0.0 }, { 12.7, 0.0, 0.0 } };
    for (Vector3& place : places)
    {
      place.y() /= ratio;
      DistanceSources sources;
      sources.Points = { Folded(place, Row / ratio) };
      const SurfaceDistance distance(surface, sources);
      EXPECT_EQ(distance.Field().Unreached, 0);
      EXPECT_LE(LargestError(distance.Field().Distances,
                  [&](int vertex) { return (flat.V.row(vertex).transpose() - place).norm(); }),
        1e-6)
        << place.transpose();
    }
  }
}

TEST(SurfaceDistance, OfAStraightLineIsExactInAPlane)
{
  constexpr int Cells = 24;
  for (const double ratio : { 1.0, 30.0 })
  {
    SCOPED_TRACE(ratio);
    const Surface sheet = IrregularSheet(Cells, 9, ratio);
    const FramedMesh surface(sheet.Mesh());
    struct Line
    {
      Vector3 Start, End;
    };
    const double top = Cells / ratio;
    // Across faces, and along a row of edges.
    for (const Line& line : { Line{ { 0.0, 0.31 * top, 0.0 }, { Cells, 0.31 * top, 0.0 } },
           Line{ { 0.0, 9.0 / ratio, 0.0 }, { Cells, 9.0 / ratio, 0.0 } } })
    {
      const SurfaceDistance distance(surface, FromLine({ line.Start, line.End }), Signed());
      ASSERT_TRUE(distance.Field().IsSigned);
      EXPECT_LE(LargestError(distance.Field().Distances,
                  [&](int vertex) { return line.Start.y() - sheet.V(vertex, 1); }), // the left side is inside
        1e-6 * top);
    }
  }
}

TEST(SurfaceDistance, OfAnObliqueSegmentIsExactToSomeHundredthsOfAnEdge)
{
  const Surface plane = IrregularPlane(20, 20, 5);
  const FramedMesh surface(plane.Mesh());
  const Vector3 start(4.3, 6.1, 0.0), end(15.2, 11.7, 0.0);
  const SurfaceDistance distance(surface, FromLine({ start, end }), Signed());
  EXPECT_FALSE(distance.Field().IsSigned);
  EXPECT_EQ(distance.Field().Warnings.size(), 1U);
  const auto exact = [&](int vertex)
  {
    const Vector3 place = surface.Mesh.Position(vertex);
    const double part = std::clamp((place - start).dot(end - start) / (end - start).squaredNorm(), 0.0, 1.0);
    return (place - start - part * (end - start)).norm();
  };
  // The second derivative of the squared distance jumps where the wavefronts of the segment and of its ends pass into each other.
  EXPECT_LE(LargestError(distance.Field().Distances, exact), 0.06);
  for (int vertex = 0; vertex < plane.V.rows(); ++vertex)
  {
    const Vector3 place = surface.Mesh.Position(vertex);
    const double part = (place - start).dot(end - start) / (end - start).squaredNorm();
    if (part > 0.1 && part < 0.9)
    {
      EXPECT_NEAR(distance.Field().Distances[vertex], exact(vertex), 1e-3 * std::max(exact(vertex), 4.0));
    }
  }
}

TEST(SurfaceDistance, KnowsTheNearestOfPointsOnASphere)
{
  std::vector<double> errors;
  for (const int level : { 3, 4, 5 })
  {
    const FramedMesh surface(IrregularSphere(level, 5).Mesh());
    Random random(41);
    DistanceSources sources;
    for (int k = 0; k < 12; ++k)
    {
      sources.Points.emplace_back(random.Uniform(-1.0, 1.0), random.Uniform(-1.0, 1.0), random.Uniform(-1.0, 1.0));
      sources.Points.back().normalize();
    }
    const SurfaceDistance distance(surface, sources);
    EXPECT_EQ(distance.Field().Taken, 12);
    double largest = 0.0;
    for (int vertex = 0; vertex < surface.Mesh.NumberOfVertices(); ++vertex)
    {
      std::vector<std::pair<double, int>> exact;
      for (int k = 0; k < 12; ++k)
      {
        exact.emplace_back(GreatCircle(surface.Mesh.Position(vertex), sources.Points[k]), k);
      }
      std::sort(exact.begin(), exact.end());
      largest = std::max(largest, std::abs(distance.Field().Distances[vertex] - exact[0].first));
      if (exact[1].first - exact[0].first > 2e-2)
      {
        EXPECT_EQ(distance.Field().Sources[vertex], exact[0].second) << vertex;
      }
    }
    errors.push_back(largest);
  }
  ExpectOrderTwo(errors);
}

TEST(SurfaceDistance, OfACircleHasSigns)
{
  std::vector<double> errors;
  for (const int level : { 3, 4, 5 })
  {
    const FramedMesh surface(Icosphere(level).Mesh());
    const SurfaceDistance distance(surface, FromLine(CircleOfLatitude(0.2, 400)), Signed());
    const DistanceField& field = distance.Field();
    ASSERT_TRUE(field.IsSigned);
    double mean = 0.0;
    for (int vertex = 0; vertex < surface.Mesh.NumberOfVertices(); ++vertex)
    {
      const double exact = std::asin(0.2) - std::asin(surface.Mesh.Position(vertex).z());
      mean += std::abs(field.Distances[vertex] - exact) / surface.Mesh.NumberOfVertices();
      EXPECT_TRUE(std::abs(exact) < 1e-2 || field.Distances[vertex] * exact > 0.0) << vertex;
      if (std::abs(exact) > 0.1 && std::abs(surface.Mesh.Position(vertex).z()) < 0.9)
      {
        const Vector3 away = field.Directions.row(vertex);
        EXPECT_GT((exact > 0.0 ? -1.0 : 1.0) * away.z(),
          0.98 * std::sqrt(1.0 - std::pow(surface.Mesh.Position(vertex).z(), 2)));
      }
    }
    errors.push_back(mean);
  }
  ExpectOrderTwo(errors);
}

TEST(SurfaceDistance, OfALoopThatDoesNotPartATorusHasNoSignAndSaysSo)
{
  const FramedMesh surface(IrregularTorus(48, 20, 3).Mesh());
  std::vector<Vector3> around, across;
  for (int k = 0; k <= 200; ++k)
  {
    const double angle = 2.0 * Pi * (k % 200) / 200;
    around.emplace_back(1.4 * std::cos(angle), 1.4 * std::sin(angle), 0.0);
    across.emplace_back(1.0 + 0.4 * std::cos(angle), 0.0, 0.4 * std::sin(angle));
  }
  for (const auto& loop : { around, across })
  {
    const SurfaceDistance distance(surface, FromLine(loop), Signed());
    EXPECT_FALSE(distance.Field().IsSigned);
    ASSERT_EQ(distance.Field().Warnings.size(), 1U);
    EXPECT_GE(distance.Field().Distances.minCoeff(), 0.0);
  }
}

TEST(SurfaceDistance, OfARegionIsZeroInsideOrNegative)
{
  constexpr int Cells = 20;
  const Surface plane = PlaneGrid(Cells, Cells);
  const FramedMesh surface(plane.Mesh());
  DistanceSources sources;
  sources.Region.resize(plane.F.rows());
  for (int face = 0; face < plane.F.rows(); ++face)
  {
    const Vector3 centre =
      (plane.V.row(plane.F(face, 0)) + plane.V.row(plane.F(face, 1)) + plane.V.row(plane.F(face, 2))) / 3.0;
    sources.Region[face] = centre.x() > 6.0 && centre.x() < 14.0 && centre.y() > 5.0 && centre.y() < 12.0;
  }
  const auto exact = [&](int vertex)
  {
    const double x = plane.V(vertex, 0), y = plane.V(vertex, 1);
    const double dx = std::max(6.0 - x, x - 14.0), dy = std::max(5.0 - y, y - 12.0);
    return dx > 0.0 && dy > 0.0 ? std::hypot(dx, dy) : std::max(dx, dy);
  };
  const SurfaceDistance outside(surface, sources);
  const SurfaceDistance both(surface, sources, Signed());
  ASSERT_TRUE(both.Field().IsSigned);
  EXPECT_LE(LargestError(outside.Field().Distances, [&](int vertex) { return std::max(exact(vertex), 0.0); }), 0.02);
  EXPECT_LE(LargestError(both.Field().Distances, exact), 0.02);
  EXPECT_EQ(outside.Field().Taken, 1);
}

TEST(SurfaceDistance, OfTheBoundaryOfASquareIsThatOfTheNearestSide)
{
  constexpr int Cells = 20;
  const Surface plane = IrregularPlane(Cells, Cells, 3);
  const FramedMesh surface(plane.Mesh());
  DistanceSources sources;
  sources.Boundary = true;
  const SurfaceDistance distance(surface, sources);
  const auto exact = [&](int vertex)
  {
    const double x = plane.V(vertex, 0), y = plane.V(vertex, 1);
    return std::min(std::min(x, Cells - x), std::min(y, Cells - y));
  };
  EXPECT_LE(
    LargestError(distance.Field().Distances, exact), 0.1); // in edges; fronts of two sides meet along the diagonals
  double mean = 0.0;
  for (int vertex = 0; vertex < plane.V.rows(); ++vertex)
  {
    mean += std::abs(distance.Field().Distances[vertex] - exact(vertex)) / static_cast<double>(plane.V.rows());
  }
  EXPECT_LE(mean, 1e-2);
}

TEST(SurfaceDistance, OfSharpEdgesIsThatOfTheFold)
{
  constexpr int Cells = 16, Row = 6;
  const Surface flat = IrregularSheet(Cells, Row, 1.0);
  const FramedMesh surface(Folded(flat, Row).Mesh());
  DistanceSources sources;
  sources.FeatureAngle = 30.0;
  const SurfaceDistance distance(surface, sources);
  EXPECT_LE(
    LargestError(distance.Field().Distances, [&](int vertex) { return std::abs(flat.V(vertex, 1) - Row); }), 1e-6);
}

TEST(SurfaceDistance, EndsAtTheMaximumAndOnOtherComponents)
{
  const Surface plane = PlaneGrid(10, 10);
  const FramedMesh surface(Union(plane, plane, Vector3(0.0, 0.0, 5.0)).Mesh());
  const DistanceSources sources = FromVertex(0);
  DistanceOptions options;
  options.MaximumDistance = 4.5;
  const DistanceField field = SurfaceDistance(surface, sources, options).Field();
  int unreached = 0;
  for (int vertex = 0; vertex < surface.Mesh.NumberOfVertices(); ++vertex)
  {
    const Vector3 place = surface.Mesh.Position(vertex);
    const bool isReached = place.z() < 1.0 && place.norm() <= 4.5;
    unreached += isReached ? 0 : 1;
    EXPECT_EQ(std::isnan(field.Distances[vertex]), !isReached) << vertex;
    EXPECT_EQ(field.Sources[vertex], isReached ? 0 : -1);
  }
  EXPECT_EQ(field.Unreached, unreached);
  EXPECT_LE(field.Largest, 4.5);
  const SurfaceDistance everywhere(surface, sources);
  EXPECT_EQ(everywhere.Field().Unreached, 121);
  EXPECT_TRUE(std::isnan(everywhere.Field().Distances[200]));
  EXPECT_TRUE(everywhere.PathTo(200).Points.empty());
  EXPECT_EQ(everywhere.OffsetLines({ 2.0 }).Offsets.size(), 2U);
}

TEST(SurfaceDistance, HasPathsThatAreStraightOnAFoldedSheet)
{
  constexpr int Cells = 20, Row = 7;
  const Surface flat = IrregularSheet(Cells, Row, 1.0);
  const FramedMesh surface(Folded(flat, Row).Mesh());
  const Vector3 start(2.31, 3.7, 0.0);
  const std::vector<Vector3> targets = { { 17.3, 15.9, 0.0 }, { 3.0, 19.2, 0.0 }, { 0.0, 0.0, 0.0 },
    { 19.5, 3.7, 0.0 } };
  DistanceSources sources;
  sources.Points = { Folded(start, Row) };
  const SurfaceDistance distance(surface, sources);
  for (int k = 0; k < static_cast<int>(targets.size()); ++k)
  {
    const SurfacePath path = distance.PathTo(Folded(targets[k], Row));
    EXPECT_NEAR(path.Distance, (targets[k] - start).norm(), 1e-6);
    EXPECT_NEAR(path.Length, (targets[k] - start).norm(), 1e-6);
    EXPECT_NEAR(LengthOf(path.Points), path.Length, 1e-6);
    EXPECT_LE((path.Points.front() - Folded(start, Row)).norm(), 1e-9);
    EXPECT_LE((path.Points.back() - Folded(targets[k], Row)).norm(), 1e-9);
    for (const Vector3& point : path.Points)
    {
      const Vector3 unfolded(point.x(), point.y() + point.z(), 0.0);
      EXPECT_LE((unfolded - start).cross(targets[k] - start).norm(), 1e-5);
    }
  }
}

TEST(SurfaceDistance, HasPathsThatStartAtTheNearestPlaceOfALine)
{
  constexpr int Cells = 20, Row = 7;
  const Surface flat = IrregularSheet(Cells, Row, 1.0);
  const FramedMesh surface(Folded(flat, Row).Mesh());
  const Vector3 start(3.2, 2.3, 0.0), end(14.7, 5.9, 0.0); // in the lower part
  DistanceSources sources;
  sources.Lines = { { start, end } };
  const SurfaceDistance distance(surface, sources);
  Random random(7);
  for (int k = 0; k < 60; ++k)
  {
    const Vector3 target(20.0 * random.Uniform(), 20.0 * random.Uniform(), 0.0);
    const double part = std::clamp((target - start).dot(end - start) / (end - start).squaredNorm(), 0.0, 1.0);
    const Vector3 foot = start + part * (end - start);
    const SurfacePath path = distance.PathTo(Folded(target, Row));
    EXPECT_NEAR(path.Length, (target - foot).norm(), 1e-6) << k;
    EXPECT_NEAR(LengthOf(path.Points), path.Length, 1e-6) << k;
    EXPECT_LE((path.Points.front() - foot).norm(), 2e-4) << k; // places move by 1e-5 of a face
    EXPECT_LE((path.Points.back() - Folded(target, Row)).norm(), 1e-6) << k;
  }
  EXPECT_EQ(distance.PathTo(Vector3(start + 0.3 * (end - start))).Length, 0.0);
}

TEST(SurfaceDistance, HasPathsFromCurvesThatLeaveThemAtARightAngle)
{
  const FramedMesh surface(IrregularSphere(4, 5).Mesh());
  DistanceSources sources;
  sources.Lines.emplace_back();
  for (int k = 0; k <= 90; ++k)
  {
    sources.Lines[0].emplace_back(std::cos(k * Pi / 45.0), std::sin(k * Pi / 45.0), 0.0); // the equator
  }
  DistanceOptions options;
  options.Signed = true;
  const SurfaceDistance distance(surface, sources, options);
  for (int vertex = 0; vertex < surface.Mesh.NumberOfVertices(); vertex += 50)
  {
    const Vector3 place = surface.Mesh.Position(vertex);
    const double latitude = std::asin(place.z() / place.norm());
    for (const SurfacePath& path : { distance.PathTo(vertex), distance.PathTo(place) })
    {
      EXPECT_NEAR(path.Length, std::abs(latitude), 0.005) << vertex;
      EXPECT_NEAR(path.Distance, -latitude, 0.005) << vertex; // the north is to the left, which is inside
      EXPECT_LE(path.Length, std::abs(path.Distance) + 1e-3) << vertex;
      if (std::abs(latitude) > 0.1 && std::abs(latitude) < 1.3)
      {
        const Vector3 first = path.Points.front();
        const double longitude = std::atan2(first.y(), first.x()) - std::atan2(place.y(), place.x());
        EXPECT_NEAR(std::remainder(longitude, 2.0 * Pi), 0.0, 0.05) << vertex;
      }
    }
  }
}

TEST(SurfaceDistance, IsZeroToPlacesInARegion)
{
  const Surface plane = PlaneGrid(6, 6);
  const FramedMesh surface(plane.Mesh());
  DistanceSources sources;
  for (int face = 0; face < surface.Mesh.NumberOfFaces(); ++face)
  {
    const Vector3 centre = (surface.Mesh.Position(plane.F(face, 0)) + surface.Mesh.Position(plane.F(face, 1)) +
                             surface.Mesh.Position(plane.F(face, 2))) /
      3.0;
    sources.Region.push_back(centre.x() < 3.0 ? 1 : 0);
  }
  const SurfaceDistance distance(surface, sources);
  EXPECT_EQ(distance.PathTo(Vector3(1.3, 2.4, 0.0)).Length, 0.0);
  EXPECT_EQ(distance.PathTo(Vector3(1.3, 2.4, 0.0)).Distance, 0.0);
  const SurfacePath path = distance.PathTo(Vector3(5.3, 2.4, 0.0));
  EXPECT_NEAR(path.Length, 2.3, 1e-9);
  EXPECT_NEAR(path.Distance, 2.3, 1e-9);
  EXPECT_LE((path.Points.front() - Vector3(3.0, 2.4, 0.0)).norm(), 1e-6);
}

TEST(SurfaceDistance, HasPathsAroundAHoleOnSurfacesWithBoundary)
{
  const FramedMesh surface(Annulus(64, 12).Mesh()); // around the unit circle
  DistanceSources sources;
  sources.Points = { { 1.5, 0.0, 0.0 } };
  const SurfaceDistance distance(surface, sources);
  const SurfacePath path = distance.PathTo(Vector3(-1.5, 0.01, 0.0));
  // The inner boundary is a polygon whose corners are on the circle.
  const double tangent = std::sqrt(1.5 * 1.5 - 1.0), arc = Pi - 2.0 * std::acos(1.0 / 1.5);
  EXPECT_NEAR(path.Length, 2.0 * tangent + arc, 0.02);
  EXPECT_NEAR(LengthOf(path.Points), path.Length, 1e-6);
  for (const Vector3& point : path.Points)
  {
    EXPECT_GE(point.norm(), std::cos(Pi / 64) - 1e-9);
  }
}

TEST(SurfaceDistance, HasPathsThatAreNoShorterThanExactOnesOfPolyhedra)
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
    const FramedMesh surface(ReadPly(mesh.string()).Mesh());
    const DistanceSources sources = FromVertex(0);
    const SurfaceDistance distance(surface, sources);
    std::ifstream numbers(file.path());
    double sum = 0.0, exact = 0.0;
    int count = 0, line = 0;
    for (int vertex = 0; numbers >> vertex >> exact; ++line)
    {
      if (line % 10 == 0)
      {
        const SurfacePath path = distance.PathTo(vertex);
        EXPECT_GE(path.Length, exact * (1.0 - 1e-6)) << vertex;
        EXPECT_NEAR(LengthOf(path.Points), path.Length, 1e-6 * exact) << vertex;
        sum += path.Length / exact - 1.0;
        ++count;
      }
    }
    EXPECT_LE(sum / count, 1e-3);
  }
}

TEST(SurfaceDistance, HasPathsOnCurvedSurfacesAsLongAsTheDistance)
{
  for (const Surface& shape : { IrregularTorus(40, 20, 3), IrregularSphere(3, 7), SphereWithZeroAreaFaces(3, 6),
         Needle(3, 10.0), PerforatedSlab(1, 1, 4) })
  {
    const FramedMesh surface(shape.Mesh());
    const DistanceSources sources = FromVertex(3);
    const SurfaceDistance distance(surface, sources);
    for (int vertex = 0; vertex < surface.Mesh.NumberOfVertices(); vertex += 11)
    {
      const SurfacePath path = distance.PathTo(vertex);
      const double length = distance.Field().Distances[vertex];
      EXPECT_NEAR(path.Length, length, 0.03 * length) << vertex;
      EXPECT_NEAR(LengthOf(path.Points), path.Length, 1e-4 * path.Length) << vertex;
    }
  }
}

TEST(SurfaceDistance, IsTheSameInBothDirections)
{
  const FramedMesh surface(IrregularTorus(60, 30, 3).Mesh());
  std::vector<int> vertices = { 5, 320, 777, 1500 };
  for (const int a : vertices)
  {
    for (const int b : vertices)
    {
      const double there = SurfaceDistance(surface, FromVertex(a)).Field().Distances[b];
      EXPECT_NEAR(there, SurfaceDistance(surface, FromVertex(b)).Field().Distances[a], 2e-3 * there);
    }
  }
}

TEST(SurfaceDistance, HasOffsetLinesThatAreCirclesOfLatitude)
{
  const FramedMesh surface(Icosphere(5).Mesh());
  const SurfaceDistance distance(surface, FromLine(CircleOfLatitude(0.2, 400)), Signed());
  const std::vector<double> offsets = { -0.5, 0.25, 0.5 };
  const ContourLines lines = distance.OffsetLines(offsets);
  ASSERT_EQ(lines.Offsets.size(), offsets.size() + 1);
  for (std::size_t line = 0; line < offsets.size(); ++line)
  {
    std::vector<Vector3> points;
    for (int k = lines.Offsets[line]; k < lines.Offsets[line + 1]; ++k)
    {
      points.emplace_back(lines.Positions.row(lines.Order[k]).transpose());
    }
    EXPECT_EQ(points.front(), points.back()); // closed
    const double offset = offsets[lines.Values[lines.Order[lines.Offsets[line]]]];
    EXPECT_NEAR(LengthOf(points), 2.0 * Pi * std::cos(std::asin(0.2) - offset), 0.01);
  }
}

TEST(SurfaceDistance, OfPointsAndLinesAtRandomIsRightToAPartOfAnEdge)
{
  double sum = 0.0;
  int count = 0;
  for (unsigned seed = 1; seed <= 30; ++seed)
  {
    SCOPED_TRACE(seed);
    const FramedMesh surface(IrregularPlane(8, 8, seed).Mesh());
    Random random(seed);
    const auto place = [&] { return Vector3(random.Uniform(0.0, 8.0), random.Uniform(0.0, 8.0), 0.0); };
    DistanceSources sources;
    std::vector<std::array<Vector3, 2>> segments;
    for (int k = 0; k < 3; ++k)
    {
      sources.Points.push_back(place());
      sources.Lines.push_back({ place(), place(), place() });
      segments.push_back({ sources.Points[k], sources.Points[k] });
      segments.push_back({ sources.Lines[k][0], sources.Lines[k][1] });
      segments.push_back({ sources.Lines[k][1], sources.Lines[k][2] });
    }
    const DistanceField field = SurfaceDistance(surface, sources).Field();
    EXPECT_EQ(field.Interrupted, 0);
    for (int vertex = 0; vertex < surface.Mesh.NumberOfVertices(); ++vertex)
    {
      double exact = std::numeric_limits<double>::infinity();
      for (const auto& [start, end] : segments)
      {
        const Vector3 way = surface.Mesh.Position(vertex) - start, along = end - start;
        const double squared = along.squaredNorm();
        const double part = squared > 0.0 ? std::clamp(way.dot(along) / squared, 0.0, 1.0) : 0.0;
        exact = std::min(exact, (way - part * along).norm());
      }
      EXPECT_NEAR(field.Distances[vertex], exact, 0.4) << vertex;
      sum += std::abs(field.Distances[vertex] - exact);
      ++count;
    }
  }
  EXPECT_LE(sum / count, 1e-2);
}

TEST(SurfaceDistance, TakesLinesThatCrossEachOtherAndRunAlongEdges)
{
  const FramedMesh surface(IrregularPlane(12, 12, 9).Mesh());
  DistanceSources sources;
  sources.Lines = { { { 1.0, 1.0, 0.0 }, { 11.0, 10.3, 0.0 } }, { { 1.0, 10.0, 0.0 }, { 11.0, 2.0, 0.0 } },
    { { 6.0, 0.0, 0.0 }, { 6.0, 12.0, 0.0 }, { 6.0, 0.0, 0.0 } }, { { 0.0, 0.0, 0.0 }, { 12.0, 0.0, 0.0 } } };
  const SurfaceDistance distance(surface, sources);
  EXPECT_EQ(distance.Field().Taken, 4);
  EXPECT_EQ(distance.Field().TooFar, 0);
  const auto exact = [&](int vertex)
  {
    double least = 1e300;
    for (const std::vector<Vector3>& line : sources.Lines)
    {
      const Vector3 place = surface.Mesh.Position(vertex) - line[0], along = line[1] - line[0];
      const double part = std::clamp(place.dot(along) / along.squaredNorm(), 0.0, 1.0);
      least = std::min(least, (place - part * along).norm());
    }
    return least;
  };
  EXPECT_LE(LargestError(distance.Field().Distances, exact), 0.1);
}

TEST(SurfaceDistance, IsFiniteOnDifficultSurfaces)
{
  const std::vector<Surface> surfaces = { SphereWithZeroAreaFaces(3, 6), Needle(3, 50.0), FlatTorus(8, 2),
    Flattened(Icosphere(3), 1e-3), DoubleTorus(4), PlaneWithThinTriangles(12, 6) };
  for (const Surface& shape : surfaces)
  {
    const FramedMesh surface(shape.Mesh());
    const TriangleMesh& mesh = surface.Mesh;
    Random random(3);
    DistanceSources sources;
    DistanceOptions options;
    options.MaximumSourceDistance = 10.0;
    std::vector<Vector3> targets;
    for (int k = 0; k < 10; ++k)
    {
      const auto place = [&] { return mesh.Position(random.Index(mesh.NumberOfVertices())); };
      sources.Points.emplace_back(0.6 * place() + 0.4 * place());
      sources.Lines.push_back({ place(), place(), place() });
      targets.push_back(place());
    }
    const SurfaceDistance distance(surface, sources, options);
    EXPECT_EQ(distance.Field().Unreached, 0);
    EXPECT_TRUE(distance.Field().Distances.allFinite());
    EXPECT_TRUE(distance.Field().Directions.allFinite());
    for (int k = 0; k < 10; ++k)
    {
      EXPECT_TRUE(std::isfinite(distance.PathTo(targets[k]).Length));
    }
  }
}

TEST(SurfaceDistance, CanBeCancelled)
{
  class Stopped : public SerialContext
  {
    bool IsCancelled() const override { return true; }
  };
  const FramedMesh surface(PlaneGrid(4, 4).Mesh());
  EXPECT_THROW(SurfaceDistance(surface, FromVertex(0), {}, Stopped()), Cancelled);
  EXPECT_THROW(SurfaceDistance(surface, FromVertex(0)).PathTo(24, Stopped()), Cancelled);
}

TEST(SurfaceDistance, OfOneLineOverManyFacesGoesOnAndStopsInside)
{
  const FramedMesh surface(PlaneGrid(60, 60).Mesh());
  DistanceSources sources;
  sources.Lines = { { Vector3(0.5, 0.2, 0.0), Vector3(59.5, 59.8, 0.0) } };
  TbbContext watched(1);
  SurfaceDistance(surface, sources, {}, watched);
  const std::vector<double>& progress = watched.Progress();
  EXPECT_TRUE(std::is_sorted(progress.begin(), progress.end()));
  const auto inLine = [](double done) { return done > 0.04 && done < 0.29; }; // places are the first three tenths
  const auto steps = std::count_if(progress.begin(), progress.end(), inLine);
  EXPECT_GE(steps, 5);
  for (const int stop : { 2, 5 })
  {
    TbbContext stopped(1);
    stopped.CancelAfter(stop);
    EXPECT_THROW(SurfaceDistance(surface, sources, {}, stopped), Cancelled);
    EXPECT_EQ(static_cast<int>(stopped.Progress().size()), stop);
    EXPECT_LT(stopped.Progress().back(), 0.29);
  }
}

TEST(SurfaceDistance, RefusesWhatItCannotUse)
{
  const FramedMesh surface(PlaneGrid(4, 4).Mesh());
  const auto refuses = [&](const DistanceSources& sources, const DistanceOptions& options = {})
  { EXPECT_THROW(SurfaceDistance(surface, sources, options), InvalidInput); };
  refuses({});
  refuses(FromVertex(25));
  DistanceSources sources;
  sources.Points = { { 0.0, 0.0, std::nan("") } };
  refuses(sources);
  sources.Points = { { 0.0, 0.0, 50.0 } };
  refuses(sources);
  sources = DistanceSources();
  sources.Region = { 1 };
  refuses(sources);
  sources.Region.assign(32, 0);
  refuses(sources);
  sources = FromVertex(0);
  DistanceOptions options;
  options.MaximumDistance = -1.0;
  refuses(sources, options);
  options.MaximumDistance = 2.0;
  const SurfaceDistance distance(surface, sources, options);
  EXPECT_THROW(distance.PathTo(25), InvalidInput);
  EXPECT_THROW(distance.PathTo(Vector3(0.0, std::nan(""), 0.0)), InvalidInput);
  EXPECT_TRUE(distance.PathTo(Vector3(0.0, 0.0, 50.0)).Points.empty());
  EXPECT_THROW(distance.OffsetLines({ 3.0 }), InvalidInput);
  EXPECT_TRUE(distance.PathTo(24).Points.empty());
}

TEST(SplitSurface, KeepsAreasAndMakesEdgesOfLines)
{
  const Surface shape = IrregularPlane(6, 6, 11);
  const FramedMesh surface(shape.Mesh());
  SplitSurface split(surface);
  Random random(13);
  for (int face = 0; face < shape.F.rows(); face += 3)
  {
    std::vector<int> vertices;
    for (int k = 0; k < 6; ++k)
    {
      const double a = random.Uniform(), b = random.Uniform() * (1.0 - a);
      const Vector3 place = a * surface.Mesh.Position(shape.F(face, 0)) + b * surface.Mesh.Position(shape.F(face, 1)) +
        (1.0 - a - b) * surface.Mesh.Position(shape.F(face, 2));
      vertices.push_back(split.AddPoint(face, place));
      EXPECT_EQ(split.AddPoint(face, place), vertices.back());
    }
    for (int k = 0; k + 1 < 6; ++k)
    {
      EXPECT_TRUE(split.AddLine(vertices[k], face, vertices[k + 1], face, { face }));
    }
  }
  const FramedMesh result = split.Make();
  EXPECT_NEAR(result.Mesh.FaceAreas().sum(), 36.0, 1e-9);
  EXPECT_EQ(result.Mesh.EulerCharacteristic(), 1);
  EXPECT_EQ(result.Mesh.HalfedgeTwins().size(), split.Lines().size());
  for (int h = 0; h < 3 * result.Mesh.NumberOfFaces(); ++h)
  {
    const int twin = result.Mesh.Twin(h);
    EXPECT_TRUE(twin < 0 || split.Lines()[h] == split.Lines()[twin]);
  }
}

TEST(SplitSurface, CutsAFaceByHundredsOfLinesThatCrossEachOther)
{
  Surface shape{ Points(3, 3), Triangles(1, 3) };
  shape.V << 0, 0, 0, 1, 0, 0, 0, 1, 0;
  shape.F << 0, 1, 2;
  const FramedMesh surface(shape.Mesh());
  SplitSurface split(surface);
  constexpr int Lines = 400;
  Random random(17);
  std::vector<std::array<Vector3, 2>> lines;
  for (int k = 0; k < Lines; ++k)
  {
    lines.push_back({ Vector3(random.Uniform(), 0.0, 0.0), Vector3(0.0, random.Uniform(), 0.0) });
    const int from = split.AddPoint(0, lines[k][0]), to = split.AddPoint(0, lines[k][1]);
    EXPECT_TRUE(split.AddLine(from, 0, to, 0, { k }));
  }
  int crossings = 0; // lines from one side to another cross where their ends are in different orders
  for (int k = 0; k < Lines; ++k)
  {
    for (int j = 0; j < k; ++j)
    {
      crossings += (lines[k][0].x() < lines[j][0].x()) != (lines[k][1].y() < lines[j][1].y()) ? 1 : 0;
    }
  }
  const FramedMesh result = split.Make();
  EXPECT_NEAR(result.Mesh.FaceAreas().sum(), 0.5, 1e-12);
  EXPECT_EQ(result.Mesh.EulerCharacteristic(), 1);
  std::vector<std::set<int>> linesAt(result.Mesh.NumberOfVertices());
  for (int h = 0; h < 3 * result.Mesh.NumberOfFaces(); ++h)
  {
    if (split.Lines()[h] >= 0)
    {
      linesAt[result.Mesh.Tail(h)].insert(split.Lines()[h]);
      linesAt[result.Mesh.Head(h)].insert(split.Lines()[h]);
    }
  }
  const auto found =
    std::count_if(linesAt.begin(), linesAt.end(), [](const std::set<int>& numbers) { return numbers.size() > 1; });
  EXPECT_LE(found, crossings);
  EXPECT_GE(found, 0.98 * crossings); // those that are nearer to each other than SplitSurface::Snap become one
  EXPECT_LE(result.Mesh.NumberOfVertices(), 3 + 2 * Lines + found); // and no other edge is split
}
