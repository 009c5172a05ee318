#include "Geodesics/ParallelTransport.h"

#include "Support/Errors.h"
#include "Support/MeshFactory.h"
#include "Support/Random.h"
#include "Support/TbbContext.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

using namespace dmg;
using namespace dmg::test;

namespace
{

/// A square of 2 by 2 with the origin in its middle.
Surface Centred(Surface surface, int cells)
{
  surface.V = (surface.V.array() * (2.0 / cells)).matrix();
  surface.V.leftCols(2).array() -= 1.0;
  return surface;
}

/// Its points moved along x by a multiple of y, and stretched along x.
Surface Sheared(Surface surface, double shear, double stretch)
{
  surface.V.col(0) = stretch * surface.V.col(0) + shear * surface.V.col(1);
  return surface;
}

/// Each fourth column of cells made a hundred times narrower.
Surface WithThinColumns(Surface surface, int cells)
{
  const double width = 2.0 / cells;
  for (double& x : surface.V.col(0))
  {
    const int column = static_cast<int>(std::lround((x + 1.0) / width));
    x -= 0.99 * width * (column / 4);
  }
  return surface;
}

/// The same square with good and bad triangles.
std::vector<std::pair<std::string, Surface>> Planes(int cells)
{
  const Surface alike = Centred(PlaneGrid(cells, cells), cells);
  return { { "diagonals alike", alike }, { "random", Centred(IrregularPlane(cells, cells, 7), cells) },
    { "sheared", Sheared(alike, 2.0, 1.0) }, { "stretched", Sheared(alike, 0.0, 5.0) },
    { "thin triangles", WithThinColumns(alike, cells) } };
}

int NearestVertex(const TriangleMesh& mesh, const Vector3& place)
{
  int nearest = 0;
  (mesh.VertexPositions().rowwise() - place.transpose()).rowwise().norm().minCoeff(&nearest);
  return nearest;
}

Constraints At(int vertex, const Vector3& vector)
{
  Constraints sources;
  sources.AtVertices.push_back({ vertex, vector, 1.0 });
  return sources;
}

/// The tangent vector x at s, carried along the great circle from s to p.
Vector3 CarriedOnSphere(const Vector3& s, const Vector3& p, const Vector3& x)
{
  return x - (x.dot(p) / (1.0 + s.dot(p))) * (s + p);
}

/// The logarithmic map of the unit sphere at s, in the frame whose first axis is x.
Complex LogOnSphere(const Vector3& s, const Vector3& p, const Vector3& x)
{
  const Vector3 tangent = p - s.dot(p) * s;
  const Complex direction(tangent.dot(x), tangent.dot(s.cross(x)));
  const double distance = std::atan2(tangent.norm(), s.dot(p));
  return direction == 0.0 ? Complex(0.0) : distance * direction / std::abs(direction);
}

/// The largest difference of vectors at vertices from what they are to be, where a place counts.
double LargestError(const FramedMesh& surface, const TransportedField& field, const std::function<Vector3(int)>& exact,
  const std::function<bool(int)>& counts)
{
  double largest = 0.0;
  for (int vertex = 0; vertex < surface.Mesh.NumberOfVertices(); ++vertex)
  {
    if (counts(vertex))
    {
      const Vector3 vector = surface.Vertices.ToVector(vertex, field.AtVertices[vertex]);
      largest = std::max(largest, (vector - exact(vertex)).norm());
    }
  }
  return largest;
}

bool Everywhere(int)
{
  return true;
}

}

TEST(ParallelTransport, CarriesAVectorOverThePlane)
{
  for (const auto& [name, plane] : Planes(24))
  {
    SCOPED_TRACE(name);
    const FramedMesh surface(plane.Mesh());
    ParallelTransport transport(surface);
    const Vector3 vector(0.6, -2.0, 0.0);
    for (const Vector3& place : { Vector3(0.0, 0.0, 0.0), Vector3(-1.0, -1.0, 0.0) })
    {
      const TransportedField field = transport.Carry(At(NearestVertex(surface.Mesh, place), vector));
      EXPECT_LE(LargestError(
                  surface, field, [&](int) { return vector; }, Everywhere),
        1e-9);
      EXPECT_TRUE(field.Warnings.empty());
      for (int face = 0; face < surface.Mesh.NumberOfFaces(); ++face)
      {
        EXPECT_LE((surface.Faces.ToVector(face, field.OnFaces[face]) - vector).norm(), 1e-9);
      }
    }
  }
}

TEST(ParallelTransport, TakesTheNearestOfSeveralVectors)
{
  for (const auto& [name, plane] : Planes(40))
  {
    SCOPED_TRACE(name);
    const FramedMesh surface(plane.Mesh());
    ParallelTransport transport(surface);
    Constraints sources;
    const std::vector<Vector3> vectors = { Vector3(1.0, 0.0, 0.0), Vector3(0.0, 3.0, 0.0), Vector3(-2.0, 1.0, 0.0) };
    std::vector<Vector3> places;
    const double size = surface.Mesh.VertexPositions().col(0).maxCoeff();
    for (const Vector3& place : { Vector3(-0.6, -0.5, 0.0), Vector3(0.7, -0.2, 0.0), Vector3(0.0, 0.7, 0.0) })
    {
      const int vertex = NearestVertex(surface.Mesh, Vector3(size * place.x(), place.y(), 0.0));
      sources.AtVertices.push_back({ vertex, vectors[places.size()], 1.0 });
      places.push_back(surface.Mesh.Position(vertex));
    }
    const auto distancesOf = [&](int vertex)
    {
      std::vector<std::pair<double, int>> distances;
      for (int k = 0; k < 3; ++k)
      {
        distances.emplace_back((surface.Mesh.Position(vertex) - places[k]).norm(), k);
      }
      std::sort(distances.begin(), distances.end());
      return distances;
    };
    // Which one is the nearest of two that are as near is a matter of rounding.
    const auto counts = [&](int vertex) { return distancesOf(vertex)[1].first - distancesOf(vertex)[0].first > 1e-9; };
    const TransportedField field = transport.Carry(sources);
    EXPECT_LE(LargestError(
                surface, field, [&](int vertex) { return vectors[distancesOf(vertex)[0].second]; }, counts),
      1e-9);
  }
}

TEST(ParallelTransport, LengthsDoNotReachBeyondTheMiddle)
{
  // A vector of length 1 on the left, and one of any length on the right.
  const FramedMesh surface(Centred(PlaneGrid(40, 40), 40).Mesh());
  const TriangleMesh& mesh = surface.Mesh;
  ParallelTransport transport(surface);
  for (const double length : { 1.0, 10.0, 1e3, 1e6 })
  {
    Constraints sources = At(NearestVertex(mesh, Vector3(-0.5, 0.0, 0.0)), Vector3::UnitY());
    sources.AtVertices.push_back({ NearestVertex(mesh, Vector3(0.5, 0.0, 0.0)), length * Vector3::UnitX(), 1.0 });
    const TransportedField field = transport.Carry(sources);
    for (int vertex = 0; vertex < mesh.NumberOfVertices(); ++vertex)
    {
      const double x = mesh.Position(vertex).x();
      const Vector3 exact = x < 0.0 ? Vector3::UnitY().eval() : (length * Vector3::UnitX()).eval();
      if (std::abs(x) > 1e-9)
      {
        EXPECT_LE((surface.Vertices.ToVector(vertex, field.AtVertices[vertex]) - exact).norm(), 1e-9 * length);
      }
    }
  }
}

/// A unit sphere of quadrilaterals between latitudes and longitudes, cut in two, and triangles around the poles.
Surface Globe(int around, int rows)
{
  Surface globe;
  globe.V.resize(2 + (rows - 1) * around, 3);
  globe.F.resize(2 * (rows - 1) * around, 3);
  globe.V.row(0) = Vector3(0.0, 0.0, -1.0).transpose();
  globe.V.row(1) = Vector3(0.0, 0.0, 1.0).transpose();
  const auto at = [around](int row, int column) { return 2 + (row - 1) * around + column % around; };
  int face = 0;
  for (int column = 0; column < around; ++column)
  {
    for (int row = 1; row < rows; ++row)
    {
      const double latitude = Pi * row / rows - 0.5 * Pi, longitude = 2.0 * Pi * column / around;
      globe.V.row(at(row, column)) =
        Vector3(std::cos(latitude) * std::cos(longitude), std::cos(latitude) * std::sin(longitude), std::sin(latitude))
          .transpose();
      if (row > 1)
      {
        globe.F.row(face++) << at(row - 1, column), at(row - 1, column + 1), at(row, column + 1);
        globe.F.row(face++) << at(row - 1, column), at(row, column + 1), at(row, column);
      }
    }
    globe.F.row(face++) << 0, at(1, column + 1), at(1, column);
    globe.F.row(face++) << 1, at(rows - 1, column), at(rows - 1, column + 1);
  }
  return globe;
}

/// The angles between vectors carried on a globe and those along great circles, in degrees: that which 99 of 100 are below.
double LargestTurns(const Surface& globe, const Vector3& from)
{
  const FramedMesh surface(globe.Mesh());
  const TriangleMesh& mesh = surface.Mesh;
  const int source = NearestVertex(mesh, from);
  const Vector3 s = mesh.Position(source);
  const Vector3 first = surface.Vertices.ToVector(source, 1.0);
  const Vector3 x = (first - first.dot(s) * s).normalized();
  const TransportedField field = ParallelTransport(surface).Carry(At(source, x));
  std::vector<double> turns;
  for (int vertex = 0; vertex < mesh.NumberOfVertices(); ++vertex)
  {
    const Vector3 p = mesh.Position(vertex);
    if (s.dot(p) > std::cos(2.6)) // near the antipode all directions are shortest
    {
      const Vector3 carried = CarriedOnSphere(s, p, x);
      turns.push_back(std::abs(std::arg(field.AtVertices[vertex] / surface.Vertices.ToComplex(vertex, carried))));
    }
  }
  const auto place = turns.begin() + static_cast<std::ptrdiff_t>(99 * turns.size() / 100);
  std::nth_element(turns.begin(), place, turns.end());
  return *place * 180.0 / Pi;
}

TEST(ParallelTransport, ConvergesOnGlobesOfLatitudesAndLongitudes)
{
  for (const Vector3& from : { Vector3(1.0, 0.2, 0.4), Vector3(0.3, -0.5, 0.8), Vector3(0.0, 0.0, 1.0) })
  {
    double former = 0.0;
    for (const int around : { 36, 72, 144 })
    {
      SCOPED_TRACE(std::to_string(around) + " around");
      const double turns = LargestTurns(Globe(around, around / 2), from.normalized());
      EXPECT_LE(turns, 240.0 / around); // two thirds of the angle of a cell
      if (former > 0.0)
      {
        EXPECT_LE(turns, 0.6 * former);
      }
      former = turns;
    }
  }
}

TEST(ParallelTransport, MapsThePlaneToItself)
{
  for (const auto& [name, plane] : Planes(24))
  {
    SCOPED_TRACE(name);
    const FramedMesh surface(plane.Mesh());
    ParallelTransport transport(surface);
    for (const Vector3& place : { Vector3(0.0, 0.0, 0.0), Vector3(-1.0, -1.0, 0.0), Vector3(0.0, 1.0, 0.0) })
    {
      const int source = NearestVertex(surface.Mesh, place);
      const Complex axis = surface.Vertices.ToComplex(source, Vector3(0.0, 2.0, 0.0));
      const LogarithmicMap map = transport.Map(source, axis);
      for (int vertex = 0; vertex < surface.Mesh.NumberOfVertices(); ++vertex)
      {
        const Vector3 offset = surface.Mesh.Position(vertex) - surface.Mesh.Position(source);
        EXPECT_LE(std::abs(map.Coordinates[vertex] - Complex(offset.y(), -offset.x())), 1e-6) << vertex;
        EXPECT_NEAR(map.Distances[vertex], offset.norm(), 1e-6);
      }
    }
  }
}

TEST(ParallelTransport, FollowsGreatCirclesOfTheSphere)
{
  struct Case
  {
    const char* Name;
    Surface Shape;
  };
  for (const Case& sphere : { Case{ "icosphere", Icosphere(4) }, Case{ "irregular", IrregularSphere(4, 3, 0.3) } })
  {
    SCOPED_TRACE(sphere.Name);
    const FramedMesh surface(sphere.Shape.Mesh());
    const TriangleMesh& mesh = surface.Mesh;
    ParallelTransport transport(surface);
    for (const int source : { 0, 700 })
    {
      const Vector3 s = mesh.Position(source);
      const Vector3 first = surface.Vertices.ToVector(source, 1.0);
      const Vector3 x = (first - first.dot(s) * s).normalized(); // tangential to the sphere, rather than to the mesh
      // Near the antipode all directions are shortest.
      const auto counts = [&](int vertex) { return s.dot(mesh.Position(vertex)) > std::cos(2.6); };
      const TransportedField field = transport.Carry(At(source, x));
      double largestTurn = 0.0;
      for (int vertex = 0; vertex < mesh.NumberOfVertices(); ++vertex)
      {
        const Vector3 carried = CarriedOnSphere(s, mesh.Position(vertex), x);
        const Complex turn = field.AtVertices[vertex] / surface.Vertices.ToComplex(vertex, carried);
        largestTurn = std::max(largestTurn, counts(vertex) ? std::abs(std::arg(turn)) : 0.0);
        EXPECT_NEAR(std::abs(field.AtVertices[vertex]), 1.0, 1e-2);
      }
      EXPECT_LE(largestTurn, 0.02);
      const LogarithmicMap map = transport.Map(source, 1.0);
      double largest = 0.0;
      for (int vertex = 0; vertex < mesh.NumberOfVertices(); ++vertex)
      {
        const Complex exact = LogOnSphere(s, mesh.Position(vertex), x);
        const double error = std::abs(map.Coordinates[vertex] - exact) / std::max(std::abs(exact), 0.1);
        largest = std::max(largest, counts(vertex) ? error : 0.0);
      }
      EXPECT_LE(largest, 0.02);
    }
  }
}

TEST(ParallelTransport, DevelopsTheCylinder)
{
  const int around = 64;
  Surface tube = Prism(around, 40);
  const double radius = tube.V.row(0).head<2>().norm();
  const FramedMesh surface(tube.Mesh());
  const TriangleMesh& mesh = surface.Mesh;
  ParallelTransport transport(surface);
  const int source = NearestVertex(mesh, Vector3(radius, 0.0, tube.V.col(2).mean()));
  const Vector3 s = mesh.Position(source);
  const LogarithmicMap map = transport.Map(source, surface.Vertices.ToComplex(source, Vector3::UnitZ()));
  const Vector3 vector = 0.6 * Vector3::UnitZ() + 0.8 * Vector3::UnitZ().cross(s).normalized();
  const TransportedField field = transport.Carry(At(source, vector));
  // A prism of so many sides has the length of their chords around it.
  const double girth = 2.0 * around * radius * std::sin(Pi / around);
  int counted = 0;
  for (int vertex = 0; vertex < mesh.NumberOfVertices(); ++vertex)
  {
    const Vector3 p = mesh.Position(vertex);
    const double angle = std::atan2(s.cross(p).z(), s.head<2>().dot(p.head<2>()));
    const Vector3 tangent = Vector3::UnitZ().cross(p).normalized();
    const Vector3 carried = surface.Vertices.ToVector(vertex, field.AtVertices[vertex]);
    EXPECT_LE((carried - 0.6 * Vector3::UnitZ() - 0.8 * tangent).norm(), 0.02) << vertex;
    if (std::abs(angle) < 2.5) // elsewhere two ways are about as short
    {
      const Complex exact(p.z() - s.z(), -angle / (2.0 * Pi) * girth);
      EXPECT_LE(std::abs(map.Coordinates[vertex] - exact), 0.02 * std::abs(exact) + 0.002 * girth) << vertex;
      ++counted;
    }
  }
  EXPECT_GE(counted, mesh.NumberOfVertices() / 2);
}

TEST(ParallelTransport, ReachesTheEndOfAStripOfThousandsOfEdges)
{
  // Heat would fall below the smallest double after 354 edges, were the time that of the edges alone.
  const int cells = 3000;
  const FramedMesh surface(PlaneGrid(cells, 2).Mesh());
  ParallelTransport transport(surface);
  const int source = NearestVertex(surface.Mesh, Vector3(0.0, 1.0, 0.0));
  const Vector3 vector(0.0, 2.0, 0.0);
  const TransportedField field = transport.Carry(At(source, vector));
  EXPECT_TRUE(field.Warnings.empty());
  EXPECT_LE(LargestError(
              surface, field, [&](int) { return vector; }, Everywhere),
    1e-9);
  const LogarithmicMap map = transport.Map(source, surface.Vertices.ToComplex(source, Vector3::UnitX()));
  for (int vertex = 0; vertex < surface.Mesh.NumberOfVertices(); ++vertex)
  {
    const Vector3 offset = surface.Mesh.Position(vertex) - surface.Mesh.Position(source);
    EXPECT_LE(std::abs(map.Coordinates[vertex] - Complex(offset.x(), offset.y())), 1e-6 * cells);
  }
}

TEST(ParallelTransport, CarriesVectorsOfFaces)
{
  const FramedMesh surface(IrregularPlane(20, 20, 5).Mesh());
  ParallelTransport transport(surface);
  Constraints sources;
  const Vector3 vector(-1.0, 0.5, 0.0);
  sources.OnFaces.push_back({ 123, vector, 1.0 });
  EXPECT_LE(LargestError(
              surface, transport.Carry(sources), [&](int) { return vector; }, Everywhere),
    1e-9);
  // Two of the same face have their mean.
  sources.OnFaces.push_back({ 123, -3.0 * vector.cross(Vector3::UnitZ()), 1.0 });
  const TransportedField field = transport.Carry(sources);
  EXPECT_NEAR(std::abs(field.AtVertices[0]), 2.0 * vector.norm(), 1e-9);
}

TEST(ParallelTransport, TellsOfVectorsThatCancelEachOther)
{
  const FramedMesh surface(PlaneGrid(4, 4).Mesh());
  ParallelTransport transport(surface);
  Constraints sources = At(12, Vector3::UnitX());
  sources.AtVertices.push_back({ 12, -3.0 * Vector3::UnitX(), 1.0 });
  const TransportedField field = transport.Carry(sources);
  ASSERT_EQ(field.Warnings.size(), 1u);
  EXPECT_NE(field.Warnings[0].find("1 of 1 points cancel each other"), std::string::npos) << field.Warnings[0];
  EXPECT_EQ(field.AtVertices.cwiseAbs().maxCoeff(), 0.0);
}

TEST(ParallelTransport, ReachesNoOtherComponentAndSaysSo)
{
  const Surface plane = PlaneGrid(8, 8);
  const FramedMesh surface(Union(plane, plane, Vector3(0.0, 0.0, 5.0)).Mesh());
  ParallelTransport transport(surface);
  const TransportedField field = transport.Carry(At(0, Vector3::UnitX()));
  EXPECT_EQ(field.WithoutSource, 81);
  EXPECT_TRUE(field.Warnings.empty()); // parts of a scan that nobody means
  const LogarithmicMap map = transport.Map(0, 1.0);
  EXPECT_EQ(map.Unreached, 81);
  for (int vertex = 0; vertex < 162; ++vertex)
  {
    EXPECT_NEAR(std::abs(field.AtVertices[vertex]), vertex < 81 ? 1.0 : 0.0, 1e-9);
    EXPECT_EQ(std::isnan(map.Distances[vertex]), vertex >= 81);
    EXPECT_EQ(std::isnan(map.Angles[vertex]), vertex >= 81);
  }
}

TEST(ParallelTransport, IsTheSameOnASurfaceOfAnotherSize)
{
  const Surface torus = IrregularTorus(40, 20, 3); // a symmetric one has points with two shortest paths
  for (const double scale : { 1e-30, 1e30 })
  {
    Surface scaled = torus;
    scaled.V *= scale;
    const FramedMesh small(torus.Mesh());
    const FramedMesh surface(scaled.Mesh());
    ParallelTransport transport(small);
    ParallelTransport scaledTransport(surface);
    const LogarithmicMap map = transport.Map(17, 1.0);
    const LogarithmicMap scaledMap = scaledTransport.Map(17, 1.0);
    EXPECT_LE((map.Distances - scaledMap.Distances / scale).cwiseAbs().maxCoeff(), 1e-6);
    EXPECT_LE((map.Coordinates - scaledMap.Coordinates / scale).cwiseAbs().maxCoeff(), 1e-6);
  }
}

TEST(ParallelTransport, IsFiniteOnDifficultSurfaces)
{
  const std::vector<Surface> surfaces = { SphereWithZeroAreaFaces(3, 6), Needle(3, 50.0), FlatTorus(8, 2),
    Flattened(Icosphere(3), 1e-3), DoubleTorus(4) };
  for (const Surface& shape : surfaces)
  {
    const FramedMesh surface(shape.Mesh());
    ParallelTransport transport(surface);
    const TransportedField field = transport.Carry(At(3, surface.Vertices.ToVector(3, 2.0)));
    const LogarithmicMap map = transport.Map(3, Complex(0.0, 1.0));
    EXPECT_TRUE(field.Warnings.empty());
    for (int vertex = 0; vertex < surface.Mesh.NumberOfVertices(); ++vertex)
    {
      EXPECT_NEAR(std::abs(field.AtVertices[vertex]), 2.0, 1e-6);
      EXPECT_TRUE(std::isfinite(std::abs(map.Coordinates[vertex])));
      // No way over the surface is shorter than that through space.
      const double straight = (surface.Mesh.Position(vertex) - surface.Mesh.Position(3)).norm();
      EXPECT_GE(map.Distances[vertex], straight * (1.0 - 1e-12));
    }
  }
}

TEST(ParallelTransport, HasDistancesOfASphereWithFacesWithoutArea)
{
  const FramedMesh surface(SphereWithZeroAreaFaces(3, 6).Mesh());
  ParallelTransport transport(surface);
  const LogarithmicMap map = transport.Map(3, 1.0);
  EXPECT_EQ(map.Unreached, 0);
  for (int vertex = 0; vertex < surface.Mesh.NumberOfVertices(); ++vertex)
  {
    const double exact = std::acos(
      std::clamp(surface.Mesh.Position(3).normalized().dot(surface.Mesh.Position(vertex).normalized()), -1.0, 1.0));
    if (exact < 2.6)
    {
      EXPECT_NEAR(map.Distances[vertex], exact, 0.02 * Pi);
    }
  }
}

TEST(ParallelTransport, HasTheSameBitsForAnyNumberOfThreads)
{
  const Surface shape = IrregularTorus(60, 30, 11);
  const FramedMesh surface(shape.Mesh());
  ParallelTransport one(surface);
  const TbbContext threads(3);
  ParallelTransport three(surface, {}, threads);
  const Constraints sources = At(5, surface.Vertices.ToVector(5, 1.0));
  EXPECT_EQ(one.Carry(sources).OnFaces, three.Carry(sources, threads).OnFaces);
  EXPECT_EQ(one.Map(5, 1.0).Coordinates, three.Map(5, 1.0, threads).Coordinates);
}

TEST(ParallelTransport, FactorsOnceForAnyNumberOfSolves)
{
  const FramedMesh surface(Icosphere(2).Mesh());
  ParallelTransport transport(surface);
  EXPECT_EQ(transport.Counts().Setups, 0);
  transport.Carry(At(0, surface.Vertices.ToVector(0, 1.0)));
  transport.Carry(At(1, surface.Vertices.ToVector(1, 1.0)));
  transport.Map(2, 1.0);
  EXPECT_EQ(transport.Counts().Setups, 1);
  EXPECT_EQ(transport.Counts().Solves, 3);
  EXPECT_GT(transport.Bytes(), 0);
}

TEST(ParallelTransport, RefusesWhatItCannotCarry)
{
  const FramedMesh surface(PlaneGrid(3, 3).Mesh());
  ParallelTransport transport(surface);
  EXPECT_THROW(transport.Carry({}), InvalidInput);
  EXPECT_THROW(transport.Carry(At(0, Vector3::UnitZ())), InvalidInput);
  EXPECT_THROW(transport.Carry(At(0, Vector3::Zero())), InvalidInput);
  EXPECT_THROW(transport.Carry(At(16, Vector3::UnitX())), InvalidInput);
  EXPECT_THROW(transport.Map(-1, 1.0), InvalidInput);
  EXPECT_THROW(transport.Map(0, 0.0), InvalidInput);
  EXPECT_THROW(ParallelTransport(surface, { 0.0 }), InvalidInput);
  EXPECT_THROW(ParallelTransport(surface, { std::nan("") }), InvalidInput);
}
