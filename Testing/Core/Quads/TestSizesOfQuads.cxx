// Sizes of quads: given, and by curvature.

#include "Quads/SizesOfQuads.h"

#include "QuadExamples.h"
#include "Quads/SurfaceQuads.h"
#include "Support/Errors.h"

#include <algorithm>

using namespace dmg;
using namespace dmg::test;

namespace
{

Vector3 Middle(const Surface& shape, int face)
{
  return (shape.V.row(shape.F(face, 0)) + shape.V.row(shape.F(face, 1)) + shape.V.row(shape.F(face, 2))).transpose() /
    3.0;
}

/// The sizes that a surface has by its curvature.
Vector<double> SizesByCurvature(const Surface& shape, double adaptivity)
{
  QuadOptions options;
  options.Adaptivity = adaptivity;
  return WithSizesAlone(FramedMesh(shape.Mesh()), options, {}, SerialContext()).Sizes;
}

/// An ellipsoid with half axes 1, 1 and \p a along z.
Surface Ellipsoid(double a)
{
  Surface shape = IrregularSphere(5, 3);
  shape.V.col(2) *= a;
  return shape;
}

/// The larger curvature of that ellipsoid, F = x^2 + y^2 + z^2 / a^2 = 1, at a height z. With s = |grad F| / 2, it is 1 / s around the axis,
/// and 1 / (a^2 s^3) along meridians, as the Gaussian curvature is 1 / (a^2 s^4).
double LargerCurvature(double a, double z)
{
  const double s = std::sqrt(1.0 - z * z / (a * a) + z * z / (a * a * a * a));
  return std::max(1.0 / s, 1.0 / (a * a * s * s * s));
}

TEST(SizesOfQuads, AreThoseOfTheCurvatureOfAnEllipsoid)
{
  const double a = 3.0;
  const Surface shape = Ellipsoid(a);
  const Vector<double> sizes = SizesByCurvature(shape, 1.0), half = SizesByCurvature(shape, 0.5);
  const Vector<double> areas = shape.Mesh().FaceAreas();
  double mean = 0.0;
  for (int face = 0; face < areas.size(); ++face)
  {
    mean += LargerCurvature(a, Middle(shape, face).z()) * areas[face] / areas.sum();
  }
  for (int face = 0; face < sizes.size(); ++face)
  {
    const double bend = LargerCurvature(a, Middle(shape, face).z()) / mean;
    EXPECT_NEAR(sizes[face], 1.0 / std::sqrt(1.0 + bend * bend), 0.05 * sizes[face]);
    EXPECT_NEAR(half[face], std::sqrt(sizes[face]), 1e-12);
  }
}

TEST(SizesOfQuads, AreTheSameWhereCurvatureIsOrEdgesAreSharp)
{
  const Vector<double> ofSphere = SizesByCurvature(IrregularSphere(5, 3), 1.0);
  EXPECT_LT(ofSphere.maxCoeff() / ofSphere.minCoeff(), 1.1);
  Surface plane = PlaneGrid(30, 30);
  for (int vertex = 0; vertex < plane.V.rows(); ++vertex) // with a fold of 90 degrees
  {
    const double beyond = std::max(plane.V(vertex, 0) - 15.0, 0.0);
    plane.V(vertex, 0) -= beyond;
    plane.V(vertex, 2) = beyond;
  }
  const Vector<double> ofFold = SizesByCurvature(plane, 1.0);
  EXPECT_NEAR(ofFold.minCoeff(), 1.0, 1e-9);
}

TEST(SizesOfQuads, GrowByAFifthOfTheDistance)
{
  Surface strip = PlaneGrid(100, 4);
  const TriangleMesh mesh = strip.Mesh();
  Vector<double> lengths = Vector<double>::Constant(mesh.NumberOfFaces(), 10.0);
  for (int face = 0; face < lengths.size(); ++face)
  {
    lengths[face] = Middle(strip, face).x() < 20.0 ? 1.0 : lengths[face];
  }
  LimitGrowth(mesh, lengths);
  for (int face = 0; face < lengths.size(); ++face)
  {
    const double x = Middle(strip, face).x();
    EXPECT_NEAR(lengths[face], std::clamp(1.0 + 0.2 * (x - 20.0), 1.0, 10.0), 1e-9);
  }
}

/// Sizes that vary by a factor along x.
QuadOptions AlongX(const Surface& shape, double number, double ratio)
{
  QuadOptions options = NumberOfQuads(number);
  options.Sizes.resize(shape.F.rows());
  const double least = shape.V.col(0).minCoeff(), most = shape.V.col(0).maxCoeff();
  for (int face = 0; face < shape.F.rows(); ++face)
  {
    options.Sizes[face] = std::pow(ratio, (Middle(shape, face).x() - least) / (most - least));
  }
  return options;
}

TEST(QuadSizes, OfOneToFourAreReachedToATenth)
{
  const Surface shape = Ellipsoid(1.5);
  const FramedMesh surface(shape.Mesh());
  const QuadMesh mesh = MakeQuadsAlongFeatures(surface, AlongX(shape, 3000.0, 4.0));
  ExpectGoodMesh(surface, mesh);
  EXPECT_NEAR(mesh.Report.ReachedRatio, 4.0, 0.4);
  EXPECT_GT(mesh.Report.MeanScaledJacobian, 0.97);
  // By counting: the number of quads per area, at both ends.
  const Vector<double> areas = surface.Mesh.FaceAreas();
  std::array<double, 2> quads{ 0.0, 0.0 }, area{ 0.0, 0.0 }, wanted{ 0.0, 0.0 };
  const auto endOf = [&surface](int face)
  {
    const double x = PositionOf(surface.Mesh, { face, Vector3::Constant(1.0 / 3.0) }).x();
    return x < -0.6 ? 0 : x > 0.6 ? 1 : -1;
  };
  for (int face = 0; face < areas.size(); ++face)
  {
    if (const int end = endOf(face); end >= 0)
    {
      const double size = std::pow(4.0, 0.5 * Middle(shape, face).x());
      area[end] += areas[face];
      wanted[end] += areas[face] / (size * size);
    }
  }
  for (const int face : mesh.Faces)
  {
    if (const int end = endOf(face); end >= 0)
    {
      quads[end] += 1.0;
    }
  }
  const double expected = std::sqrt((wanted[0] / area[0]) / (wanted[1] / area[1]));
  EXPECT_NEAR(std::sqrt((quads[0] / area[0]) / (quads[1] / area[1])), expected, 0.12 * expected);
}

TEST(QuadSizes, MeanTheSameInMillimetres)
{
  Surface shape = Ellipsoid(1.5);
  QuadOptions options = AlongX(shape, 500.0, 2.0);
  options.Adaptivity = 0.5;
  const QuadMesh metres = MakeQuadsAlongFeatures(FramedMesh(shape.Mesh()), options);
  shape.V *= 1024.0;
  options.Sizes *= 8.0;
  const QuadMesh millimetres = MakeQuadsAlongFeatures(FramedMesh(shape.Mesh()), options);
  EXPECT_EQ(metres.Quads, millimetres.Quads);
  EXPECT_LT((1024.0 * metres.Positions - millimetres.Positions).cwiseAbs().maxCoeff(), 1e-6);
}

TEST(QuadSizes, FollowCurvature)
{
  const Surface shape = Ellipsoid(3.0);
  const FramedMesh surface(shape.Mesh());
  QuadOptions options = NumberOfQuads(1500.0);
  const QuadMesh even = MakeQuadsAlongFeatures(surface, options);
  options.Adaptivity = 1.0;
  const QuadMesh adapted = MakeQuadsAlongFeatures(surface, options);
  ExpectGoodMesh(surface, adapted);
  EXPECT_EQ(even.Report.AskedRatio, 1.0);
  EXPECT_GT(adapted.Report.ReachedRatio, 1.3);
  EXPECT_NEAR(static_cast<double>(adapted.Quads.size()), 1500.0, 150.0);
  const auto atTips = [](const QuadMesh& mesh)
  { return static_cast<double>((mesh.Positions.col(2).array().abs() > 2.7).count()); };
  EXPECT_GT(atTips(adapted), 1.5 * atTips(even));
  const auto farthest = [](const QuadMesh& mesh) { return mesh.Report.Distances.LargestFromQuads; };
  EXPECT_LT(farthest(adapted), farthest(even));
}

TEST(QuadSizes, RefuseAdaptivityThatMeansNothing)
{
  const FramedMesh surface(IrregularSphere(2, 3).Mesh());
  for (const double adaptivity : { -0.1, 1.1, std::nan("") })
  {
    QuadOptions options = NumberOfQuads(100.0);
    options.Adaptivity = adaptivity;
    EXPECT_THROW(MakeQuadsAlongFeatures(surface, options), InvalidInput);
  }
}

/// In the metric of 1 / |z|^2, an annulus is a cylinder, and radial directions are parallel.
TEST(QuadSizes, TurnTheFieldWithThem)
{
  const int around = 96;
  const auto shared = std::make_shared<const FramedMesh>(Annulus(around, 24).Mesh());
  const FramedMesh& surface = *shared;
  std::vector<double> lengths;
  for (int vertex = 0; vertex < surface.Mesh.NumberOfVertices(); ++vertex)
  {
    lengths.push_back(surface.Mesh.Position(vertex).norm());
  }
  FieldSolver solver(shared, lengths);
  FieldProblem problem;
  problem.Stop = { 1e-8, 100 };
  problem.Constraints.OnFaces.push_back({ 0, PositionOf(surface.Mesh, { 0, Vector3::Constant(1.0 / 3.0) }), 1e6 });
  const Vector<Complex> powers = solver.Solve(problem).Powers.Faces;
  double largest = 0.0;
  for (int face = 0; face < powers.size(); ++face)
  {
    const Complex radial =
      surface.Faces.ToComplex(face, PositionOf(surface.Mesh, { face, Vector3::Constant(1.0 / 3.0) }));
    largest = std::max(largest, std::abs(std::arg(powers[face] / std::pow(radial, 4))) / 4.0);
  }
  EXPECT_LT(largest, Pi / around) << "half of the angle of a triangle";
  lengths.pop_back();
  EXPECT_THROW(FieldSolver(shared, lengths), InvalidInput);
}

}
