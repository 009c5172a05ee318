// Quad meshes of surfaces with known answers.

#include "QuadExamples.h"
#include "Quads/Crosses/AlignedEdges.h"
#include "Quads/SurfaceQuads.h"
#include "Support/Errors.h"
#include "Support/LinesAlongEdges.h"
#include "Support/Random.h"
#include "Support/TbbContext.h"

#include <algorithm>
#include <cmath>

using namespace dmg;
using namespace dmg::test;

namespace
{

/// A square of \p n by \p n squares, diagonals at random, scaled to side 1.
Surface Square(int n)
{
  Surface square = IrregularPlane(n, n, 7, 0.0);
  square.V /= n;
  return square;
}

/// Leaves out the faces that a test names, and the points that no other one uses.
template <class IsLeftOut>
Surface Without(const Surface& surface, const IsLeftOut& isLeftOut)
{
  std::vector<std::array<int, 3>> kept;
  std::vector<int> numbers(surface.V.rows(), -1);
  std::vector<int> points;
  for (int face = 0; face < surface.F.rows(); ++face)
  {
    const Vector3 middle =
      (surface.V.row(surface.F(face, 0)) + surface.V.row(surface.F(face, 1)) + surface.V.row(surface.F(face, 2)))
        .transpose() /
      3.0;
    if (isLeftOut(middle))
    {
      continue;
    }
    std::array<int, 3> corners{};
    for (int k = 0; k < 3; ++k)
    {
      int& number = numbers[surface.F(face, k)];
      if (number < 0)
      {
        number = static_cast<int>(points.size());
        points.push_back(surface.F(face, k));
      }
      corners[k] = number;
    }
    kept.push_back(corners);
  }
  Surface rest;
  rest.V.resize(static_cast<int>(points.size()), 3);
  for (int k = 0; k < rest.V.rows(); ++k)
  {
    rest.V.row(k) = surface.V.row(points[k]);
  }
  rest.F.resize(static_cast<int>(kept.size()), 3);
  for (int k = 0; k < rest.F.rows(); ++k)
  {
    rest.F.row(k) << kept[k][0], kept[k][1], kept[k][2];
  }
  return rest;
}

/// The side of a cylinder of height 1 and circumference 1.
Surface Cylinder(int around, int along)
{
  Surface cylinder = PlaneGrid(around, along);
  Surface rolled;
  rolled.V.resize(around * (along + 1), 3);
  const auto number = [around](const Points& V, int point)
  { return static_cast<int>(std::lround(V(point, 1))) * around + static_cast<int>(std::lround(V(point, 0))) % around; };
  for (int point = 0; point < cylinder.V.rows(); ++point)
  {
    const double angle = 2.0 * Pi * cylinder.V(point, 0) / around;
    rolled.V.row(number(cylinder.V, point)) << std::cos(angle) / (2.0 * Pi), std::sin(angle) / (2.0 * Pi),
      cylinder.V(point, 1) / along;
  }
  rolled.F.resize(cylinder.F.rows(), 3);
  for (int k = 0; k < cylinder.F.size(); ++k)
  {
    rolled.F.data()[k] = number(cylinder.V, cylinder.F.data()[k]);
  }
  return rolled;
}

/// The unit sphere along meridians and circles of latitude, with a pole at either end.
Surface Globe(int around, int along)
{
  Surface globe;
  globe.V.resize(around * (along - 1) + 2, 3);
  globe.F.resize(2 * around * (along - 1), 3);
  const int south = static_cast<int>(globe.V.rows()) - 2, north = south + 1;
  globe.V.row(south) << 0.0, 0.0, -1.0;
  globe.V.row(north) << 0.0, 0.0, 1.0;
  int face = 0;
  for (int j = 0; j + 1 < along; ++j)
  {
    const double latitude = Pi * (j + 1) / along - 0.5 * Pi;
    for (int i = 0; i < around; ++i)
    {
      const double longitude = 2.0 * Pi * i / around;
      const int here = j * around + i, east = j * around + (i + 1) % around;
      globe.V.row(here) << std::cos(latitude) * std::cos(longitude), std::cos(latitude) * std::sin(longitude),
        std::sin(latitude);
      globe.F.row(face++) << here, j == 0 ? south : here - around, east;
      globe.F.row(face++) << here, east, j + 2 == along ? north : east + around;
    }
  }
  // A triangle on one side of each circle shares its diagonal with that on the other side.
  for (int k = 0; k < face; k += 2)
  {
    const int i = k / 2 % around, j = k / 2 / around;
    if (j > 0)
    {
      globe.F.row(k) << j * around + i, (j - 1) * around + (i + 1) % around, j * around + (i + 1) % around;
    }
    if (j + 2 < along)
    {
      globe.F.row(k + 1) << j * around + i, j * around + (i + 1) % around, (j + 1) * around + i;
    }
  }
  return globe;
}

/// The surface of [-1, 1]^3, each side cut into \p n by \p n squares.
Surface Cube(int n)
{
  std::map<std::array<int, 3>, int> numbers;
  std::vector<std::array<int, 3>> points, faces;
  const auto number = [&](const std::array<int, 3>& point)
  {
    const auto [place, isNew] = numbers.emplace(point, static_cast<int>(points.size()));
    if (isNew)
    {
      points.push_back(point);
    }
    return place->second;
  };
  for (int axis = 0; axis < 3; ++axis)
  {
    for (const int side : { 0, n })
    {
      for (int i = 0; i < n; ++i)
      {
        for (int j = 0; j < n; ++j)
        {
          const auto at = [&](int x, int y)
          {
            std::array<int, 3> point{};
            point[axis] = side;
            point[(axis + 1) % 3] = i + x;
            point[(axis + 2) % 3] = j + y;
            return number(point);
          };
          const std::array<int, 4> square = side == 0 ? std::array<int, 4>{ at(0, 0), at(0, 1), at(1, 1), at(1, 0) }
                                                      : std::array<int, 4>{ at(0, 0), at(1, 0), at(1, 1), at(0, 1) };
          const int first = (i + j) % 2;
          faces.push_back({ square[first], square[first + 1], square[first + 2] });
          faces.push_back({ square[first], square[first + 2], square[(first + 3) % 4] });
        }
      }
    }
  }
  Surface cube;
  cube.V.resize(static_cast<int>(points.size()), 3);
  cube.F.resize(static_cast<int>(faces.size()), 3);
  for (int k = 0; k < cube.V.rows(); ++k)
  {
    cube.V.row(k) << 2.0 * points[k][0] / n - 1.0, 2.0 * points[k][1] / n - 1.0, 2.0 * points[k][2] / n - 1.0;
  }
  for (int k = 0; k < cube.F.rows(); ++k)
  {
    cube.F.row(k) << faces[k][0], faces[k][1], faces[k][2];
  }
  return cube;
}

/// Quads of a surface along its features, after the check of ExpectGoodMesh.
QuadMesh QuadsOf(const Surface& shape, double number)
{
  const FramedMesh surface(shape.Mesh());
  const QuadMesh mesh = MakeQuads(surface, CrossesOf(surface), NumberOfQuads(number));
  ExpectGoodMesh(surface, mesh);
  return mesh;
}

TEST(QuadMesh, OfSquareIsGrid)
{
  for (const int n : { 10, 30 })
  {
    const QuadMesh mesh = QuadsOf(Square(24), n * n);
    const CountedMesh counted(mesh.Quads);
    EXPECT_EQ(static_cast<int>(mesh.Quads.size()), n * n);
    EXPECT_EQ(counted.Inner, (Valences{ { 4, (n - 1) * (n - 1) } }));
    EXPECT_EQ(counted.Boundary, (Valences{ { 1, 4 }, { 2, 4 * (n - 1) } }));
    EXPECT_EQ(counted.BoundaryEdges, 4 * n);
    EXPECT_GT(mesh.Report.MeanScaledJacobian, 1.0 - 1e-6);
    EXPECT_EQ(mesh.Report.FlippedFaces, 0);
  }
}

TEST(QuadMesh, OfSquareWithHoleIsGridWithHole)
{
  const auto isHole = [](const Vector3& middle)
  { return std::max(std::abs(middle[0] - 0.5), std::abs(middle[1] - 0.5)) < 1.0 / 6.0; };
  const QuadMesh mesh = QuadsOf(Without(Square(24), isHole), 800.0);
  const CountedMesh counted(mesh.Quads);
  EXPECT_EQ(mesh.Quads.size(), 800u); // 30^2 - 10^2
  EXPECT_EQ(counted.Inner.size(), 1u);
  EXPECT_EQ(counted.Boundary, (Valences{ { 1, 4 }, { 2, 4 * 29 + 4 * 9 }, { 3, 4 } }));
  EXPECT_EQ(counted.BoundaryEdges, 160);
}

TEST(QuadMesh, OfCylinderHasAsManyQuadsAroundAsAlong)
{
  for (const int n : { 10, 20 })
  {
    const QuadMesh mesh = QuadsOf(Cylinder(60, 40), n * n);
    const CountedMesh counted(mesh.Quads);
    EXPECT_EQ(static_cast<int>(mesh.Quads.size()), n * n);
    EXPECT_EQ(counted.Inner, (Valences{ { 4, n * (n - 1) } }));
    EXPECT_EQ(counted.Boundary, (Valences{ { 2, 2 * n } }));
  }
}

TEST(QuadMesh, OfCubeHasEightVerticesOfThreeQuads)
{
  for (const int n : { 5, 12 })
  {
    const QuadMesh mesh = QuadsOf(Cube(16), 6 * n * n);
    const CountedMesh counted(mesh.Quads);
    EXPECT_EQ(static_cast<int>(mesh.Quads.size()), 6 * n * n);
    EXPECT_EQ(counted.Inner, (Valences{ { 3, 8 }, { 4, 6 * n * n - 6 } }));
    EXPECT_EQ(mesh.Report.IrregularWithoutSingularity, 0);
    EXPECT_GT(mesh.Report.MeanScaledJacobian, 1.0 - 1e-6);
  }
}

/// The boundary, and the sharp edges: two coordinates are 1 or -1 all along.
std::vector<char> EdgesOfCube(const TriangleMesh& mesh)
{
  std::vector<char> areSharp(mesh.NumberOfEdges());
  for (int edge = 0; edge < mesh.NumberOfEdges(); ++edge)
  {
    const auto [a, b] = mesh.EdgeVertices(edge);
    const Vector3 tail = mesh.Position(a), head = mesh.Position(b);
    areSharp[edge] = ((tail.array() == head.array()) && (tail.array().abs() == 1.0)).count() >= 2 ||
      mesh.Twin(mesh.HalfedgeOf(edge)) < 0;
  }
  return areSharp;
}

TEST(QuadMesh, HasEdgesAlongAllBoundaryAndSharpEdges)
{
  const auto isInCorner = [](const Vector3& middle) { return middle.minCoeff() > 0.2; };
  const Surface shape = Without(Cube(20), isInCorner); // open where a smaller cube begins
  const FramedMesh surface(shape.Mesh());
  const QuadMesh mesh = QuadsOf(shape, 500.0);
  const std::vector<char> features = EdgesOfCube(surface.Mesh);
  EXPECT_NEAR(ShareAlongEdges(surface.Mesh, features, mesh.Quads, mesh.Positions), 1.0, 1e-12);
  Points shifted = mesh.Positions; // the measure sees a third of an edge
  shifted.array() += mesh.Report.LengthOfEdges / 3.0;
  EXPECT_LT(ShareAlongEdges(surface.Mesh, features, mesh.Quads, shifted), 0.1);
}

TEST(QuadMesh, FollowsSharpLinesButNoNoise)
{
  const int n = 12;
  const FramedMesh cube(Cube(n).Mesh());
  EXPECT_EQ(AlongSharpLines(cube, {}, 1.0).size(), 2u * 12u * n) << "both faces of each edge";
  Surface scan = Icosphere(5);
  Random random(8);
  for (int point = 0; point < scan.V.rows(); ++point)
  {
    scan.V.row(point) *= 1.0 + 0.015 * random.Uniform(-1.0, 1.0);
  }
  const FramedMesh noisy(scan.Mesh());
  AlignmentOptions all;
  all.ShortestFeature = all.ShortestPart = 0.0;
  const std::size_t sharp = AlongSharpLines(noisy, all, 1.0).size();
  EXPECT_GT(sharp, 1000u);
  EXPECT_LT(AlongSharpLines(noisy, {}, 1.0).size(), 0.3 * static_cast<double>(sharp));
}

TEST(QuadMesh, OfSphereHasEightVerticesOfThreeQuads)
{
  for (const double number : { 600.0, 24.0 })
  {
    const QuadMesh mesh = QuadsOf(IrregularSphere(4, 3), number);
    const CountedMesh counted(mesh.Quads);
    EXPECT_EQ(counted.Inner.at(3), 8);
    EXPECT_EQ(counted.Inner.size(), 2u) << "the rest have four";
    EXPECT_EQ(mesh.Report.Singularities, 8);
  }
}

TEST(QuadMesh, OfTorusWithoutSingularitiesIsRegular)
{
  const FramedMesh surface(IrregularTorus(60, 30, 5).Mesh());
  const QuadMesh mesh =
    MakeQuads(surface, CrossesOf(surface, std::vector<PrescribedSingularity>()), NumberOfQuads(640.0));
  ExpectGoodMesh(surface, mesh);
  const CountedMesh counted(mesh.Quads);
  EXPECT_EQ(counted.Inner.size(), 1u);
  EXPECT_EQ(counted.Inner.begin()->first, 4);
  EXPECT_EQ(mesh.Report.Singularities, 0);
}

TEST(QuadMesh, HasEulerNumberOfHandles)
{
  for (const double number : { 150.0, 1500.0 })
  {
    const QuadMesh mesh = QuadsOf(DoubleTorus(6), number);
    EXPECT_EQ(mesh.Report.EulerOfMesh, -2);
  }
}

/// A torus with a neck, of a radius that is as much of the tube's as \p part.
Surface TorusWithNeck(double part)
{
  Surface torus = IrregularTorus(120, 24, 3, 1.0, 0.3);
  for (int point = 0; point < torus.V.rows(); ++point)
  {
    const double x = torus.V(point, 0), y = torus.V(point, 1), tube = std::hypot(x, y) - 1.0;
    const double angle = std::pow(std::atan2(y, x) / Pi, 3) * Pi; // more points at the neck
    const double radius = part + (1.0 - part) * (1.0 - std::exp(-10.0 * angle * angle));
    const double ring = 1.0 + radius * tube;
    torus.V.row(point) << ring * std::cos(angle), ring * std::sin(angle), radius * torus.V(point, 2);
  }
  return torus;
}

TEST(QuadMesh, KeepsHandlesWithNecksThatAreMuchThinnerThanQuadsByFewMoreQuads)
{
  for (const double part : { 1e-2, 1e-3 }) // necks of circumferences of 0.02 and 0.002
  {
    const FramedMesh surface(TorusWithNeck(part).Mesh());
    const QuadMesh mesh = MakeQuadsAlongFeatures(surface, NumberOfQuads(1000.0)); // of edges of 0.1
    ExpectGoodMesh(surface, mesh);
    EXPECT_EQ(mesh.Report.EulerOfMesh, 0);
    EXPECT_FALSE(mesh.Report.RefinedFaces.empty());
    EXPECT_NEAR(static_cast<double>(mesh.Quads.size()), 1000.0, 150.0); // each halving of lengths takes a ring or two
  }
}

TEST(QuadMesh, OfComponentsHasThemAll)
{
  const Surface shape =
    Union(Union(IrregularSphere(3, 1), Square(8), { 4, 0, 0 }), IrregularTorus(24, 12, 2), { -4, 0, 0 });
  const QuadMesh mesh = QuadsOf(shape, 800.0);
  EXPECT_EQ(mesh.Report.EulerOfMesh, 2 + 1 + 0);
}

TEST(QuadMesh, OfEachComponentIsThatOfTheComponentAlone)
{
  // Lengths of edges and the field are given: components have nothing in common.
  QuadOptions options;
  options.EdgeLength = 0.3;
  const auto quadsOf = [&options](const Surface& surface, const Vector<Complex>& powers)
  { return CountedMesh(MakeQuads(FramedMesh(surface.Mesh()), powers, options).Quads); };
  const Surface one = IrregularSphere(3, 1);
  const Vector<Complex> field = CrossesOf(FramedMesh(one.Mesh()));
  constexpr int Copies = 6;
  Surface all = one;
  for (int k = 1; k < Copies; ++k)
  {
    all = Union(all, one, { 4.0 * k, 0, 0 });
  }
  const CountedMesh alone = quadsOf(one, field), counted = quadsOf(all, field.replicate(Copies, 1));
  ASSERT_EQ(counted.Inner.size(), alone.Inner.size());
  for (const auto& [valence, number] : alone.Inner)
  {
    EXPECT_EQ(counted.Inner.at(valence), Copies * number) << valence;
  }
  EXPECT_EQ(counted.EulerNumber, Copies * alone.EulerNumber);
}

TEST(QuadMesh, KeepsComponentThatIsMuchSmallerThanOneQuad)
{
  Surface small = IrregularSphere(2, 1);
  small.V *= 0.01;
  const QuadMesh mesh = QuadsOf(Union(IrregularSphere(3, 1), small, { 4, 0, 0 }), 200.0);
  EXPECT_EQ(mesh.Report.EulerOfMesh, 4);
}

/// A cone of \p sides triangles, closed below by as many.
Surface DoubleCone(int sides)
{
  Surface cone;
  cone.V.resize(sides + 2, 3);
  cone.F.resize(2 * sides, 3);
  cone.V.bottomRows(2) << 0.0, 0.0, 1.0, 0.0, 0.0, 0.0;
  for (int k = 0; k < sides; ++k)
  {
    cone.V.row(k) << std::cos(2.0 * Pi * k / sides), std::sin(2.0 * Pi * k / sides), 0.0;
    cone.F.row(2 * k) << k, (k + 1) % sides, sides;
    cone.F.row(2 * k + 1) << (k + 1) % sides, k, sides + 1;
  }
  return cone;
}

// They have no room for the singularities.
TEST(QuadMesh, OfFewTrianglesHasTheirEulerNumber)
{
  Surface triangle;
  triangle.V = Points::Identity(3, 3);
  triangle.F.resize(1, 3);
  triangle.F << 0, 1, 2;
  const QuadMesh one = QuadsOf(triangle, 3.0);
  EXPECT_EQ(one.Report.EulerOfMesh, 1);
  for (const double number : { 20.0, 500.0 })
  {
    const QuadMesh mesh = QuadsOf(DoubleCone(5), number);
    EXPECT_EQ(mesh.Report.EulerOfMesh, 2);
    EXPECT_LT(static_cast<double>(mesh.Quads.size()), 4.0 * number);
  }
}

TEST(QuadMesh, LeavesTrianglesBackToBackOutThatNoQuadsFit)
{
  Surface pair;
  pair.V.resize(3, 3);
  pair.V << 0.0, 0.0, 0.0, 0.1, 0.0, 0.0, 0.06, 0.001, 0.0;
  pair.F.resize(2, 3);
  pair.F << 0, 1, 2, 2, 1, 0;
  const FramedMesh surface(Union(IrregularSphere(3, 1), pair, { 4, 0, 0 }).Mesh());
  const QuadMesh mesh = MakeQuads(surface, CrossesOf(surface), NumberOfQuads(200.0));
  EXPECT_EQ(mesh.Report.Error, "");
  EXPECT_EQ(mesh.Report.LeftOut, 1);
  EXPECT_EQ(CountedMesh(mesh.Quads).EulerNumber, 2);
  EXPECT_EQ(mesh.Report.EulerOfSurface, 2);
}

// Both sides of the point have the same integer in the map.
TEST(QuadMesh, OfAcutePointIsGoodWithoutIt)
{
  Surface wedge = PlaneGrid(30, 4);
  for (int point = 0; point < wedge.V.rows(); ++point)
  {
    const double along = wedge.V(point, 0) / 30.0;
    wedge.V(point, 1) *= 0.25 * (1e-4 + along * along);
    wedge.V(point, 0) = along;
  }
  const QuadMesh mesh = QuadsOf(wedge, 100.0);
  EXPECT_EQ(mesh.Report.EulerOfMesh, 1);
  EXPECT_GT(mesh.Positions.col(0).maxCoeff(), 1.0 - 1e-9);
}

TEST(QuadMesh, SplitsSingularityOfIndexOneAtPole)
{
  const FramedMesh surface(Globe(32, 32).Mesh());
  Vector<Complex> crosses(surface.Mesh.NumberOfFaces());
  for (int face = 0; face < crosses.size(); ++face)
  {
    const Vector3 middle = PositionOf(surface.Mesh, { face, Vector3::Constant(1.0 / 3.0) });
    const Complex east = surface.Faces.ToComplex(face, Vector3(-middle[1], middle[0], 0.0));
    crosses[face] = std::pow(east / std::abs(east), 4);
  }
  const QuadMesh mesh = MakeQuads(surface, crosses, NumberOfQuads(600.0));
  ExpectGoodMesh(surface, mesh);
  EXPECT_EQ(mesh.Report.SplitSingularities, 2);
  EXPECT_EQ(mesh.Report.Singularities, 8);
  EXPECT_EQ(CountedMesh(mesh.Quads).Inner.at(3), 8);
}

TEST(QuadMesh, HasPlacesNearItsSurfaceAndEdgesOfTheLength)
{
  const FramedMesh surface(IrregularSphere(4, 3).Mesh());
  QuadOptions options;
  options.EdgeLength = 0.2;
  const QuadMesh mesh = MakeQuads(surface, CrossesOf(surface), options);
  ExpectGoodMesh(surface, mesh);
  EXPECT_NEAR(static_cast<double>(mesh.Quads.size()), 4.0 * Pi / 0.04, 0.15 * 4.0 * Pi / 0.04);
  for (int vertex = 0; vertex < mesh.Positions.rows(); ++vertex)
  {
    EXPECT_LT((PositionOf(surface.Mesh, mesh.Places[vertex]).transpose() - mesh.Positions.row(vertex)).norm(), 1e-12);
  }
}

TEST(QuadMesh, HasSmallerQuadsWhereSizesAreSmaller)
{
  const FramedMesh surface(Square(24).Mesh());
  QuadOptions options = NumberOfQuads(1000.0);
  options.Sizes.resize(surface.Mesh.NumberOfFaces());
  for (int face = 0; face < options.Sizes.size(); ++face)
  {
    options.Sizes[face] = surface.Mesh.Position(surface.Mesh.Tail(3 * face))[0] < 0.5 ? 1.0 : 2.0;
  }
  const QuadMesh mesh = MakeQuads(surface, CrossesOf(surface), options);
  ExpectGoodMesh(surface, mesh);
  const int left = static_cast<int>((mesh.Positions.col(0).array() < 0.4).count());
  const int right = static_cast<int>((mesh.Positions.col(0).array() > 0.6).count());
  EXPECT_GT(left, 1.3 * right);
}

TEST(QuadMesh, LeavesBoundaryWhereItIsNotAligned)
{
  const FramedMesh surface(Square(24).Mesh());
  QuadOptions options;
  options.AlignBoundary = false;
  for (const double angle : { 0.2, 0.5, 0.6, 0.7 })
  {
    SCOPED_TRACE(angle);
    Vector<Complex> crosses(surface.Mesh.NumberOfFaces());
    for (int face = 0; face < crosses.size(); ++face)
    {
      crosses[face] = std::pow(surface.Faces.ToComplex(face, Vector3(std::cos(angle), std::sin(angle), 0.0)), 4);
    }
    for (options.NumberOfQuads = 100.0; options.NumberOfQuads < 900.0; options.NumberOfQuads *= 1.2)
    {
      const QuadMesh mesh = MakeQuads(surface, crosses, options);
      ExpectGoodMesh(surface, mesh);
      for (const auto& quad : mesh.Quads)
      {
        const Vector3 tail = mesh.Positions.row(quad[0]).transpose(),
                      way = mesh.Positions.row(quad[1]).transpose() - tail;
        const bool isInside = (tail - Vector3(0.5, 0.5, 0.0)).norm() < 0.25;
        EXPECT_TRUE(!isInside || std::abs(std::remainder(std::atan2(way[1], way[0]) - angle, Pi / 2.0)) < 0.2);
      }
    }
  }
}

TEST(QuadMesh, FollowsSeams)
{
  const FramedMesh surface(IrregularTorus(48, 24, 5).Mesh());
  const QuadMesh mesh = MakeQuads(surface, CrossesOf(surface), NumberOfQuads(400.0));
  ASSERT_TRUE(mesh.Finer);
  const TriangleMesh& triangles = mesh.Finer->Geometry.Mesh;
  for (int h = 0; h < 3 * triangles.NumberOfFaces(); ++h)
  {
    const int twin = triangles.Twin(h);
    const auto side = [&mesh](int halfedge)
    {
      const auto &a = mesh.Map[halfedge], &b = mesh.Map[TriangleMesh::Next(halfedge)];
      return std::array<FixedPoint, 2>{ b[0] - a[0], b[1] - a[1] };
    };
    const std::array<FixedPoint, 2> here = side(h), there = side(twin);
    EXPECT_EQ(here[0] * here[0] + here[1] * here[1], there[0] * there[0] + there[1] * there[1])
      << "an isometry of the grid";
    if (!mesh.IsCut[triangles.EdgeOf(h)])
    {
      EXPECT_EQ(here[0], -there[0]);
      EXPECT_EQ(here[1], -there[1]);
    }
  }
}

TEST(QuadMesh, HasTheSameBitsForAnyNumberOfThreads)
{
  const FramedMesh surface(IrregularTorus(48, 24, 5).Mesh());
  const Vector<Complex> crosses = CrossesOf(surface);
  const QuadMesh one = MakeQuads(surface, crosses, NumberOfQuads(400.0));
  const QuadMesh many = MakeQuads(surface, crosses, NumberOfQuads(400.0), TbbContext(4));
  EXPECT_EQ(one.Quads, many.Quads);
  EXPECT_EQ(one.Positions, many.Positions);
  EXPECT_EQ(one.Map, many.Map);
}

TEST(QuadMesh, StopsWhenAsked)
{
  const FramedMesh surface(IrregularSphere(3, 3).Mesh());
  const Vector<Complex> crosses = CrossesOf(surface);
  for (const int checkpoints : { 0, 3, 10, 20 })
  {
    TbbContext context(1);
    context.CancelAfter(checkpoints);
    EXPECT_THROW(MakeQuads(surface, crosses, NumberOfQuads(200.0), context), Cancelled) << checkpoints;
  }
}

TEST(QuadMesh, RefusesOptionsThatMeanNothing)
{
  const FramedMesh surface(Square(4).Mesh());
  const Vector<Complex> crosses = CrossesOf(surface);
  EXPECT_THROW(MakeQuads(surface, crosses, NumberOfQuads(0.0)), InvalidInput);
  EXPECT_THROW(MakeQuads(surface, crosses, NumberOfQuads(std::nan(""))), InvalidInput);
  EXPECT_THROW(MakeQuads(surface, crosses.head(3)), InvalidInput);
  Vector<Complex> notFinite = crosses;
  notFinite[2] = std::nan("");
  EXPECT_THROW(MakeQuads(surface, notFinite), InvalidInput);
  QuadOptions options;
  options.EdgeLength = 1e-20; // more quads than there is room for
  EXPECT_THROW(MakeQuads(surface, crosses, options), InvalidInput);
  options.EdgeLength = 0.0;
  options.Sizes = Vector<double>::Zero(crosses.size());
  EXPECT_THROW(MakeQuads(surface, crosses, options), InvalidInput);
}

}
