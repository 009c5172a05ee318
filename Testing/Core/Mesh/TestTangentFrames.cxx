#include "Mesh/TangentFrames.h"

#include "Support/Identities.h"
#include "Support/MeshFactory.h"
#include "Support/Random.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <cmath>

namespace
{

using namespace dmg;
using namespace dmg::test;

void ExpectOrthonormal(const TangentFrames& frames)
{
  for (int i = 0; i < frames.X.rows(); ++i)
  {
    Eigen::Matrix3d frame;
    frame << frames.X.row(i), frames.Y.row(i), frames.Normal(i).transpose();
    EXPECT_LT((frame * frame.transpose() - Eigen::Matrix3d::Identity()).norm(), 20.0 * MachinePrecision);
    EXPECT_GT(frame.determinant(), 0.0);
  }
}

TEST(TangentFrames, OfFacesAreOrthonormalAndAlongTheFirstSide)
{
  for (const Surface& surface : { IrregularSphere(2, 1), Needle(2, 1e3), PlaneGrid(3, 2) })
  {
    const TriangleMesh mesh = surface.Mesh();
    const TangentFrames frames = FaceFrames(mesh);
    ExpectOrthonormal(frames);
    for (int f = 0; f < mesh.NumberOfFaces(); ++f)
    {
      const Vector3 side = mesh.Position(mesh.Head(3 * f)) - mesh.Position(mesh.Tail(3 * f));
      EXPECT_NEAR(frames.X.row(f).dot(side), side.norm(), 4.0 * MachinePrecision * side.norm());
      EXPECT_NEAR(frames.Normal(f).dot(mesh.FaceAreaVector(f)), 2.0 * mesh.FaceArea(f), 1e-12 * mesh.FaceArea(f));
    }
  }
}

TEST(TangentFrames, OfZeroAreaFacesComeFromTheirNeighbours)
{
  // A flat square whose diagonal carries a chain of zero-area faces; all normals must be z.
  Surface surface{ Points(6, 3), Triangles(4, 3) };
  surface.V << 0, 0, 0, 3, 0, 0, 3, 3, 0, 0, 3, 0, 1, 1, 0, 2, 2, 0;
  surface.F << 0, 1, 2, 0, 2, 4, 4, 2, 5, 0, 4, 3;
  // 0-2-4 and 4-2-5 are slits; the upper half is cut into 0-4-3, 4-5-3, 5-2-3.
  surface.F.conservativeResize(6, 3);
  surface.F.row(4) << 4, 5, 3;
  surface.F.row(5) << 5, 2, 3;
  const TriangleMesh mesh = surface.Mesh();
  ASSERT_EQ(mesh.FaceArea(1), 0.0);
  ASSERT_EQ(mesh.FaceArea(2), 0.0);
  const TangentFrames frames = FaceFrames(mesh);
  ExpectOrthonormal(frames);
  for (int f = 0; f < mesh.NumberOfFaces(); ++f)
  {
    EXPECT_LT((frames.Normal(f) - Vector3(0.0, 0.0, 1.0)).norm(), 4 * MachinePrecision);
  }

  const TriangleMesh sphere = SphereWithZeroAreaFaces(3, 8).Mesh();
  const TangentFrames onSphere = FaceFrames(sphere);
  ExpectOrthonormal(onSphere);
  ExpectOrthonormal(VertexFrames(sphere));
  for (int f = 0; f < sphere.NumberOfFaces(); ++f)
  {
    // Outwards, as everywhere on the sphere: within the angle between neighbouring facets.
    EXPECT_GT(onSphere.Normal(f).dot(sphere.Position(sphere.Tail(3 * f))), 0.9);
  }
}

TEST(TangentFrames, OfAComponentWithoutAreaAreStillFrames)
{
  Surface line{ Points(4, 3), Triangles(2, 3) };
  line.V << 0, 0, 0, 1, 1, 1, 2, 2, 2, 3, 3, 3;
  line.F << 0, 1, 2, 2, 1, 3;
  ExpectOrthonormal(FaceFrames(line.Mesh()));
  ExpectOrthonormal(VertexFrames(line.Mesh()));
}

TEST(TangentFrames, SidesEncloseTheAnglesOfTheFace)
{
  const TriangleMesh mesh = IrregularSphere(1, 3).Mesh();
  const TangentFrames frames = FaceFrames(mesh);
  for (int f = 0; f < mesh.NumberOfFaces(); ++f)
  {
    const std::array<Complex, 3> sides = SideDirections(mesh, frames, f);
    for (int k = 0; k < 3; ++k)
    {
      const int h = 3 * f + k;
      const Vector3 side = mesh.Position(mesh.Head(h)) - mesh.Position(mesh.Tail(h));
      EXPECT_LT((frames.ToVector(f, sides[k]) - side.normalized()).norm(), 20 * MachinePrecision);
    }
  }
}

TEST(TangentFrames, SidesOfZeroAreaFacesTurnOnceAround)
{
  // Collinear corners in every order, and every pair of corners in one place.
  Surface surface{ Points(3, 3), Triangles{ { 0, 1, 2 } } };
  const Vector3 u = Vector3(1.0, -2.0, 0.5);
  for (double middle : { 0.0, 1e-9, 0.3, 1.0 })
  {
    for (int k = 0; k < 3; ++k)
    {
      surface.V.row(k).setZero();
      surface.V.row((k + 1) % 3) = u.transpose();
      surface.V.row((k + 2) % 3) = middle * u.transpose();
      const TriangleMesh mesh = surface.Mesh();
      const std::array<Complex, 3> sides = SideDirections(mesh, FaceFrames(mesh), 0);
      double rotation = 0.0;
      for (int j = 0; j < 3; ++j)
      {
        EXPECT_NEAR(std::abs(sides[j]), 1.0, 4.0 * MachinePrecision);
        const double outer = std::arg(sides[(j + 1) % 3] * std::conj(sides[j]));
        rotation += outer < -0.5 * Pi ? outer + 2.0 * Pi : outer;
      }
      EXPECT_NEAR(rotation, 2.0 * Pi, 20.0 * MachinePrecision);
    }
  }
}

TEST(TangentFrames, OfVerticesFollowTheSphere)
{
  const TriangleMesh mesh = Icosphere(3).Mesh();
  const TangentFrames frames = VertexFrames(mesh);
  ExpectOrthonormal(frames);
  for (int v = 0; v < mesh.NumberOfVertices(); ++v)
  {
    EXPECT_GT(frames.Normal(v).dot(mesh.Position(v)), 0.999);
    const Vector3 edge = mesh.Position(mesh.Head(mesh.OutgoingHalfedge(v))) - mesh.Position(v);
    EXPECT_NEAR(frames.Y.row(v).dot(edge), 0.0, 8.0 * MachinePrecision);
    EXPECT_GT(frames.X.row(v).dot(edge), 0.0);
  }
}

TEST(TransportTurn, IsTheShortestRotationBetweenTheNormals)
{
  Random random(7);
  TangentFrames frames{ Points(200, 3), Points(200, 3) };
  for (int i = 0; i < 200; ++i)
  {
    const Eigen::Matrix3d turn =
      Eigen::Quaterniond(random.Uniform(-1, 1), random.Uniform(-1, 1), random.Uniform(-1, 1), random.Uniform(-1, 1))
        .normalized()
        .toRotationMatrix();
    frames.X.row(i) = turn.col(0).transpose();
    frames.Y.row(i) = turn.col(1).transpose();
  }
  for (int i = 0; i + 1 < 200; ++i)
  {
    const Eigen::Quaterniond shortest = Eigen::Quaterniond::FromTwoVectors(frames.Normal(i), frames.Normal(i + 1));
    const Vector3 carried = shortest * Vector3(frames.X.row(i).transpose());
    const Complex turn = TransportTurn(frames, i, frames, i + 1);
    EXPECT_NEAR(std::abs(turn), 1.0, 4.0 * MachinePrecision);
    // Near opposite normals the rotation is ill-conditioned, like one over the cosine of half the
    // angle between them, squared.
    const double condition = 1.0 + frames.Normal(i).dot(frames.Normal(i + 1));
    EXPECT_LT(std::abs(frames.ToComplex(i + 1, carried) - turn), 100.0 * MachinePrecision / condition);
    EXPECT_LT(
      std::abs(TransportTurn(frames, i + 1, frames, i) - std::conj(turn)), 100.0 * MachinePrecision / condition);
  }
}

TEST(TransportTurn, IsDefinedBetweenOppositeNormals)
{
  TangentFrames frames{ Points(2, 3), Points(2, 3) };
  frames.X << 1, 0, 0, 0, 1, 0;
  frames.Y << 0, 1, 0, 1, 0, 0;
  // Every half turn about a tangential axis is a shortest one; ours keeps X of the first frame.
  EXPECT_LT(std::abs(TransportTurn(frames, 0, frames, 1) - Complex(0.0, 1.0)), 4.0 * MachinePrecision);
}

TEST(Corners, AddUpToHalfATurnPerFace)
{
  for (const Surface& surface : { IrregularTorus(8, 5, 3), SphereWithZeroAreaFaces(2, 3) })
  {
    const TriangleMesh mesh = surface.Mesh();
    const TangentFrames faces = FaceFrames(mesh);
    const TangentFrames vertices = VertexFrames(mesh);
    const Unfilled<Complex> sides = SideDirections(mesh, faces);
    const Unfilled<Corner> corners = Corners(mesh, sides, faces, vertices);
    for (int h = 0; h < 3 * mesh.NumberOfFaces(); ++h)
    {
      EXPECT_GE(corners[h].Angle, 0.0);
      EXPECT_EQ(corners[h].Turn, TransportTurn(faces, h / 3, vertices, mesh.Tail(h)));
      // From one side to the other, counter-clockwise.
      const Complex turned = sides[h] * std::polar(1.0, corners[h].Angle);
      EXPECT_LT(std::abs(turned + sides[TriangleMesh::Previous(h)]), 20.0 * MachinePrecision);
    }
  }
}

}
