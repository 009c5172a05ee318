// Constraints as measured data give them.

#include "Constraints/Constraints.h"

#include "Support/MeshFactory.h"
#include "Support/Random.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>

#include <limits>

using namespace dmg;
using namespace dmg::test;

TEST(Constraints, ThatSayNothingAreLeftOutAndCounted)
{
  const FramedMesh surface(Icosphere(1).Mesh());
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const Vector3 along = surface.Faces.ToVector(3, 1.0);
  Constraints constraints;
  constraints.OnFaces = { { 2, 3.0 * surface.Faces.Normal(2), 1.0 }, { 3, along, 2.0 }, { 4, { nan, 0.0, 0.0 }, 1.0 },
    { 5, Vector3::Zero(), 1.0 } };
  constraints.AtVertices = { { 7, surface.Vertices.Normal(7), 1.0 }, { 8, surface.Vertices.ToVector(8, 1.0), 1.0 } };
  const UnusableDirections unusable = LeaveOutUnusable(constraints, surface);
  EXPECT_EQ(unusable.NotFinite, 1);
  EXPECT_EQ(unusable.Zero, 1);
  EXPECT_EQ(unusable.Perpendicular, 2);
  ASSERT_EQ(constraints.OnFaces.size(), 1u);
  EXPECT_EQ(constraints.OnFaces[0].Element, 3);
  ASSERT_EQ(constraints.AtVertices.size(), 1u);
  EXPECT_EQ(constraints.AtVertices[0].Element, 8);
  EXPECT_TRUE(LeaveOutUnusable(constraints, surface).AreNone());
}

// The oracle is Eigen's solver for the tensor, projected into the tangent plane.
TEST(PrincipalDirection, IsTheEigenvectorInThePlane)
{
  const FramedMesh surface(Icosphere(1).Mesh());
  Random random(5);
  for (int face = 0; face < surface.Mesh.NumberOfFaces(); ++face)
  {
    Eigen::Matrix3d tensor;
    for (int i = 0; i < 9; ++i)
    {
      tensor(i / 3, i % 3) = random.Uniform(-1.0, 1.0);
    }
    tensor = 1e200 * (tensor + tensor.transpose().eval());
    const Vector3 normal = surface.Faces.Normal(face);
    const Eigen::Matrix3d projection = Eigen::Matrix3d::Identity() - normal * normal.transpose();
    const Eigen::Matrix3d inPlane = projection * (tensor / 1e200) * projection - 100.0 * normal * normal.transpose();
    const Vector3 expected = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(inPlane).eigenvectors().col(2);
    const Vector3 direction = PrincipalDirection(tensor, surface.Faces, face);
    EXPECT_NEAR(std::abs(direction.dot(expected)), 1.0, 1e-9);
    const Vector3 values = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(inPlane).eigenvalues();
    const auto [along, across] = PrincipalValues(tensor, surface.Faces, face);
    EXPECT_NEAR(along / 1e200, values[2], 1e-12);
    EXPECT_NEAR(across / 1e200, values[1], 1e-12);
    EXPECT_TRUE(PrincipalDirection(Eigen::Matrix3d::Identity(), surface.Faces, face).isZero());
    EXPECT_TRUE(PrincipalDirection(Eigen::Matrix3d::Zero(), surface.Faces, face).isZero());
  }
}
