// The report of quad meshes: distances, areas, numbers and sizes against what was asked for.

#include "QuadExamples.h"
#include "Quads/Isolines/QuadDistances.h"
#include "SurfaceQuads.h"

#include <algorithm>

using namespace dmg;
using namespace dmg::test;

namespace
{

/// A grid of \p m by \p n squares on [0, 1] x [0, width].
Surface Strip(int m, int n, double width)
{
  Surface strip = PlaneGrid(m, n);
  strip.V.col(0) /= m;
  strip.V.col(1) *= width / n;
  return strip;
}

QuadMesh QuadsOf(const Surface& shape, const QuadOptions& options)
{
  return MakeQuadsAlongFeatures(std::make_shared<const FramedMesh>(shape.Mesh()), options);
}

/// The unit sphere with a thin horn of height 1 at its north pole.
Surface Horn()
{
  Surface sphere = Icosphere(5);
  for (int vertex = 0; vertex < sphere.V.rows(); ++vertex)
  {
    const double angle = std::acos(std::clamp(sphere.V(vertex, 2), -1.0, 1.0));
    sphere.V.row(vertex) *= 1.0 + std::exp(-std::pow(angle / 0.08, 2));
  }
  return sphere;
}

TEST(QuadDistances, AreThoseOfPlanes)
{
  Surface plane = Strip(6, 3, 0.5);
  plane.V.col(2).array() += 0.3;
  const FramedMesh surface(plane.Mesh());
  Points corners(6, 3); // two unit squares, of which the plane is above the first one
  corners << 0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 2, 0, 0, 2, 1, 0;
  const std::vector<std::array<int, 4>> quads{ { 0, 1, 2, 3 }, { 1, 4, 5, 2 } };
  const Vector<double> distances = DistancesFromQuads(surface.Mesh, quads, corners);
  EXPECT_NEAR(distances.minCoeff(), 0.3, 1e-15);
  EXPECT_NEAR(distances.maxCoeff(), 0.3, 1e-15);
  const Vector<double> back = DistancesFromSurface(NearestPlaces(surface), quads, { 0, 0 }, corners);
  EXPECT_NEAR(back[0], std::hypot(0.3, 0.5), 1e-12) << "the far side lies half a unit beyond the plane";
  EXPECT_NEAR(back[1], std::hypot(0.3, 1.0), 1e-12) << "as far as the middle of its right side";
  EXPECT_NEAR(AreasOfQuads(quads, corners).sum(), 2.0, 1e-15);
}

TEST(QuadReport, OfPlanesSaysThatNothingIsLost)
{
  const QuadMesh mesh = QuadsOf(Strip(40, 20, 0.5), NumberOfQuads(200.0));
  EXPECT_LT(mesh.Report.Distances.LargestFromQuads, 1e-12);
  EXPECT_LT(mesh.Report.Distances.LargestFromSurface, 1e-12);
  ASSERT_EQ(mesh.Report.AreaShares.size(), 1u);
  EXPECT_NEAR(mesh.Report.AreaShares[0], 1.0, 1e-12);
}

// Without its boundary, a strip that is thinner than quads is lost for the most part.
TEST(QuadReport, SaysHowMuchOfAStripIsLostAndWhere)
{
  QuadOptions options = NumberOfQuads(20.0);
  options.AlignBoundary = false;
  const QuadMesh mesh = QuadsOf(Strip(240, 4, 0.005), options);
  const QuadDistances& distances = mesh.Report.Distances;
  const double least = mesh.Positions.col(0).minCoeff(), most = mesh.Positions.col(0).maxCoeff();
  const double lost = std::max(least, 1.0 - most);
  EXPECT_GT(lost, 0.3);
  EXPECT_NEAR(distances.LargestFromQuads, lost, 0.01) << "the strip's end is left";
  EXPECT_NEAR(distances.FarthestPlace[0], least > 1.0 - most ? 0.0 : 1.0, 1e-12);
  EXPECT_NEAR(mesh.Report.AreaShares[0], most - least, 0.1 * (most - least));
  EXPECT_GT(distances.InEdges, 1.0);
  options.AlignBoundary = true;
  const QuadMesh whole = QuadsOf(Strip(240, 4, 0.005), options);
  EXPECT_NEAR(whole.Report.AreaShares[0], 1.0, 1e-9);
}

TEST(QuadReport, OfSphereHasTheDistancesOfChords)
{
  QuadOptions options;
  options.EdgeLength = 0.2;
  const QuadMesh mesh = QuadsOf(IrregularSphere(5, 3), options);
  // A square of side h with its corners on the unit sphere has its middle h^2 / 4 below it, and these have nearly squares.
  const double sagitta = 0.2 * 0.2 / 4.0;
  EXPECT_NEAR(mesh.Report.Distances.LargestFromSurface, sagitta, 0.6 * sagitta);
  EXPECT_NEAR(mesh.Report.Distances.LargestFromQuads, sagitta, 0.6 * sagitta);
  EXPECT_LT(mesh.Report.Distances.MeanFromQuads, mesh.Report.Distances.LargestFromQuads);
  EXPECT_NEAR(mesh.Report.AreaShares[0], 1.0, 0.02);
}

TEST(QuadMesh, KeepsHornThatIsThinnerThanQuads)
{
  const QuadMesh mesh = QuadsOf(Horn(), NumberOfQuads(300.0));
  EXPECT_EQ(mesh.Report.Error, "");
  EXPECT_LE(mesh.Report.Distances.InEdges, 1.0);
  EXPECT_GT(mesh.Positions.col(2).maxCoeff(), 1.75) << "the tip is at 2, edges are 0.2 long elsewhere";
  EXPECT_NEAR(static_cast<double>(mesh.Quads.size()), 300.0, 60.0);
}

/// The side and the ends of a cylinder of 60 sides, each of which is two triangles; the ends are fans around one of their corners.
Surface Can()
{
  const int n = 60;
  Surface can;
  can.V.resize(2 * n, 3);
  can.F.resize(4 * n - 4, 3);
  int face = 0;
  for (int k = 0; k < n; ++k)
  {
    const int next = (k + 1) % n;
    for (const int top : { 0, 1 })
    {
      can.V.row(k + top * n) << std::cos(2.0 * Pi * k / n), std::sin(2.0 * Pi * k / n), 8.0 * top;
    }
    can.F.row(face++) << k, next, next + n;
    can.F.row(face++) << k, next + n, k + n;
  }
  for (int k = 1; k + 1 < n; ++k)
  {
    can.F.row(face++) << 0, k + 1, k;
    can.F.row(face++) << n, n + k, n + k + 1;
  }
  return can;
}

TEST(QuadMesh, HasTheNumberOfQuadsThatIsAskedFor)
{
  for (const double number : { 500.0, 2000.0 })
  {
    const QuadMesh mesh = QuadsOf(Can(), NumberOfQuads(number));
    EXPECT_NEAR(static_cast<double>(mesh.Quads.size()), number, 0.1 * number);
    EXPECT_GT(mesh.Report.MeanScaledJacobian, 0.95);
  }
  EXPECT_LE(QuadsOf(IrregularSphere(4, 3), NumberOfQuads(10.0)).Quads.size(), 50u);
}

TEST(QuadMesh, HasTheSameQuadsForSizesThatAreTheSameEverywhere)
{
  const Surface shape = Strip(20, 20, 1.0);
  QuadOptions options = NumberOfQuads(150.0);
  const QuadMesh expected = QuadsOf(shape, options);
  for (const double size : { 0.25, 1000.0 })
  {
    options.Sizes = Vector<double>::Constant(shape.F.rows(), size);
    const QuadMesh mesh = QuadsOf(shape, options);
    EXPECT_EQ(mesh.Quads, expected.Quads);
    EXPECT_EQ(mesh.Report.AskedRatio, 1.0);
  }
}

TEST(QuadReport, SaysHowMuchLengthsOfEdgesVary)
{
  const Surface shape = Strip(40, 40, 1.0);
  QuadOptions options = NumberOfQuads(1000.0);
  options.Sizes.resize(shape.F.rows());
  for (int face = 0; face < shape.F.rows(); ++face)
  {
    options.Sizes[face] = shape.V(shape.F(face, 0), 0) < 0.5 ? 1.0 : 2.0;
  }
  const QuadMesh mesh = QuadsOf(shape, options);
  const Vector<double> areas = AreasOfQuads(mesh.Quads, mesh.Positions);
  double small = 0.0, smaller = 0.0, large = 0.0, larger = 0.0; // means of areas, left and right of the middle
  for (int quad = 0; quad < areas.size(); ++quad)
  {
    const bool isLeft = mesh.Positions(mesh.Quads[quad][0], 0) < 0.5;
    (isLeft ? small : large) += areas[quad];
    (isLeft ? smaller : larger) += 1.0;
  }
  EXPECT_EQ(mesh.Report.AskedRatio, 2.0);
  EXPECT_NEAR(mesh.Report.ReachedRatio, std::sqrt((large / larger) / (small / smaller)), 0.15);
}

}
