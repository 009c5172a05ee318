// Quad meshes that are their own mirror images.

#include "Quads/SymmetricQuads.h"

#include "QuadExamples.h"
#include "Quads/SurfaceQuads.h"
#include "Support/TbbContext.h"

#include <algorithm>
#include <cmath>

using namespace dmg;
using namespace dmg::test;

namespace
{

/// A body with a head, two arms and two legs, about the plane x = 0, whose triangles are not symmetric.
/// \param armOfOneSide the length of a limb that has no mirror image.
Surface Figure(double armOfOneSide = 0.0)
{
  Surface figure = IrregularSphere(4, 3);
  const auto limb = [](const Vector3& direction, const Vector3& towards, double length)
  { return length * std::exp(-14.0 * (direction - towards.normalized()).squaredNorm()); };
  for (Eigen::Index vertex = 0; vertex < figure.V.rows(); ++vertex)
  {
    const Vector3 direction = figure.V.row(vertex).transpose().normalized();
    const Vector3 folded(std::abs(direction.x()), direction.y(), direction.z());
    const double radius = 1.0 + limb(folded, { 0.0, 0.0, 1.0 }, 0.7) + limb(folded, { 1.0, 0.1, 0.4 }, 0.9) +
      limb(folded, { 0.5, 0.0, -1.0 }, 0.9) + limb(direction, { 1.0, 1.0, 0.0 }, armOfOneSide);
    figure.V.row(vertex) = radius * direction.transpose();
  }
  return figure;
}

/// The vertex at the mirror image of each, to rounding; -1 where there is none.
std::vector<int> ImagesOf(const Points& positions, const MirrorPlane& plane)
{
  std::vector<int> images;
  for (int vertex = 0; vertex < positions.rows(); ++vertex)
  {
    const Vector3 image = plane.Mirrored(positions.row(vertex).transpose());
    int nearest = 0;
    const double distance = (positions.rowwise() - image.transpose()).rowwise().squaredNorm().minCoeff(&nearest);
    images.push_back(std::sqrt(distance) <= 1e-14 ? nearest : -1);
  }
  return images;
}

/// A quad from its smallest vertex on.
std::array<int, 4> FromSmallest(std::array<int, 4> quad)
{
  std::rotate(quad.begin(), std::min_element(quad.begin(), quad.end()), quad.end());
  return quad;
}

void ExpectMirrorImageOfItself(const QuadMesh& mesh, const MirrorPlane& plane)
{
  const std::vector<int> images = ImagesOf(mesh.Positions, plane);
  EXPECT_EQ(std::count(images.begin(), images.end(), -1), 0);
  std::set<std::array<int, 4>> quads;
  for (const std::array<int, 4>& quad : mesh.Quads)
  {
    quads.insert(FromSmallest(quad));
  }
  int inPlane = 0;
  for (const std::array<int, 4>& quad : mesh.Quads)
  {
    EXPECT_EQ(quads.count(FromSmallest({ images[quad[0]], images[quad[3]], images[quad[2]], images[quad[1]] })), 1U);
    double least = 0.0, most = 0.0;
    for (const int corner : quad)
    {
      const double distance = plane.DistanceOf(mesh.Positions.row(corner).transpose());
      least = std::min(least, distance);
      most = std::max(most, distance);
      inPlane += std::abs(distance) <= 1e-15 ? 1 : 0;
    }
    EXPECT_TRUE(least >= -1e-12 || most <= 1e-12); // edges run along the plane
  }
  EXPECT_GT(inPlane, 20);
}

TEST(SymmetricQuads, OfAFigureAreTheirOwnMirrorImage)
{
  const FramedMesh surface(Figure().Mesh());
  const MirrorPlane plane{ Vector3::Zero(), Vector3::UnitX() };
  const QuadMesh mesh = MakeSymmetricQuads(surface, {}, plane, NumberOfQuads(1000.0));
  ExpectGoodMesh(surface, mesh);
  ExpectMirrorImageOfItself(mesh, plane);
  EXPECT_NEAR(static_cast<double>(mesh.Quads.size()), 1000.0, 100.0);
  EXPECT_GT(mesh.Report.MeanScaledJacobian, 0.9);
  EXPECT_EQ(mesh.Report.InvertedQuads, 0);
  EXPECT_NEAR(mesh.Report.AreaShares.at(0), 1.0, 0.02);
}

TEST(SymmetricQuads, FollowAFieldOfTheSurface)
{
  const FramedMesh surface(IrregularSphere(4, 5).Mesh());
  const MirrorPlane plane{ Vector3::Zero(), Vector3::UnitZ() };
  // Meridians, without directions near the poles.
  Vector<Complex> powers(surface.Mesh.NumberOfFaces());
  for (int face = 0; face < powers.size(); ++face)
  {
    const Vector3 middle = PositionOf(surface.Mesh, SurfacePlace{ face, Vector3::Constant(1.0 / 3.0) });
    const Complex along = surface.Faces.ToComplex(face, Vector3(0.0, 0.0, 1.0));
    powers[face] = std::abs(middle.z()) < 0.8 ? std::pow(along / std::abs(along), 4) : Complex(0.0);
  }
  const QuadMesh mesh = MakeSymmetricQuads(surface, powers, plane, NumberOfQuads(800.0));
  ExpectGoodMesh(surface, mesh);
  ExpectMirrorImageOfItself(mesh, plane);
}

TEST(SymmetricQuads, OfASheetKeepItsBoundary)
{
  const FramedMesh surface(Disk(12).Mesh());
  const MirrorPlane plane{ Vector3::Zero(), Vector3(std::cos(0.3), std::sin(0.3), 0.0) };
  const QuadMesh mesh = MakeSymmetricQuads(surface, {}, plane, NumberOfQuads(300.0));
  ExpectGoodMesh(surface, mesh);
  ExpectMirrorImageOfItself(mesh, plane);
}

TEST(SymmetricQuads, FindTheirPlane)
{
  Eigen::Matrix3d rotation;
  const FramedMesh surface(RotatedAndScaled(Figure(), 0.7, 3.0, &rotation).Mesh());
  const QuadMesh mesh = MakeSymmetricQuads(surface, {}, {}, NumberOfQuads(600.0));
  ExpectGoodMesh(surface, mesh);
  ASSERT_TRUE(mesh.Report.IsSymmetric);
  EXPECT_GT(std::abs(mesh.Report.Mirror.Normal.dot(rotation * Vector3::UnitX())), 1.0 - 1e-4);
}

TEST(SymmetricQuads, OfAFigureWithAThirdArmAreNotSymmetric)
{
  const FramedMesh surface(Figure(0.5).Mesh());
  const QuadMesh mesh = MakeSymmetricQuads(surface, {}, {}, NumberOfQuads(600.0));
  ExpectGoodMesh(surface, mesh);
  EXPECT_FALSE(mesh.Report.IsSymmetric);
  EXPECT_GT(mesh.Report.Asymmetry, LargestAsymmetry);
  EXPECT_EQ(mesh.Quads, MakeQuadsAlongFeatures(surface, NumberOfQuads(600.0)).Quads);
}

TEST(SymmetricQuads, HaveTheSameBitsForAnyNumberOfThreads)
{
  const FramedMesh surface(Figure().Mesh());
  const MirrorPlane plane{ Vector3::Zero(), Vector3::UnitX() };
  const QuadMesh serial = MakeSymmetricQuads(surface, {}, plane, NumberOfQuads(300.0));
  const QuadMesh parallel = MakeSymmetricQuads(surface, {}, plane, NumberOfQuads(300.0), TbbContext(4));
  EXPECT_TRUE(serial.Positions == parallel.Positions);
  EXPECT_EQ(serial.Quads, parallel.Quads);
}

TEST(SymmetricQuads, HalfIsCutAtThePlane)
{
  const FramedMesh surface(IrregularSphere(3, 9).Mesh());
  const MirrorPlane plane{ Vector3(0.0, 0.0, 0.2), Vector3::UnitZ() };
  const auto half = HalfOf(surface, plane);
  ASSERT_TRUE(half);
  const TriangleMesh& mesh = half->Geometry.Mesh;
  EXPECT_EQ(mesh.EulerCharacteristic(), 1);
  EXPECT_GE(mesh.VertexPositions().col(2).minCoeff(), 0.2 - 1e-15);
  EXPECT_NEAR(mesh.FaceAreas().sum(), 2.0 * Pi * 0.8, 0.1); // of a cap
  for (int vertex = 0; vertex < mesh.NumberOfVertices(); ++vertex)
  {
    EXPECT_TRUE(!mesh.IsBoundaryVertex(vertex) || std::abs(mesh.Position(vertex).z() - 0.2) <= 1e-15);
  }
  EXPECT_FALSE(HalfOf(surface, { Vector3(0.0, 0.0, 3.0), Vector3::UnitZ() }));
}

TEST(MirrorPlane, OfATurnedFigureIsFound)
{
  Eigen::Matrix3d rotation;
  const FramedMesh surface(RotatedAndScaled(Figure(), 0.7, 3.0, &rotation).Mesh());
  const NearestPlaces places(surface);
  const MirrorPlane plane = FindMirrorPlane(places);
  const Vector3 expected = rotation * Vector3::UnitX();
  EXPECT_GT(std::abs(plane.Normal.dot(expected)), 1.0 - 1e-4);
  EXPECT_LT(AsymmetryOf(places, plane), LargestAsymmetry);
}

TEST(MirrorPlane, OfAnExactMirrorImageIsExact)
{
  const FramedMesh box(Icosphere(3).Mesh());
  const NearestPlaces places(box);
  const MirrorPlane plane = FindMirrorPlane(places);
  EXPECT_EQ(plane.Normal.cwiseAbs().maxCoeff(), 1.0);
  EXPECT_LT(AsymmetryOf(places, plane), 1e-12);
}

TEST(MirrorPlane, OfAFigureWithAThirdArmIsNone)
{
  const FramedMesh surface(Figure(0.5).Mesh());
  const NearestPlaces places(surface);
  EXPECT_GT(AsymmetryOf(places, FindMirrorPlane(places)), LargestAsymmetry);
}

}
