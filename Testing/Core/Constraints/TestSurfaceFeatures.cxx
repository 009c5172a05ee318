#include "Constraints/SurfaceFeatures.h"

#include "Support/Errors.h"
#include "Support/Identities.h"
#include "Support/MeshFactory.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace
{

using namespace dmg;
using namespace dmg::test;

Vector3 Centre(const TriangleMesh& mesh, int face)
{
  Vector3 sum = Vector3::Zero();
  for (int k = 0; k < 3; ++k)
  {
    sum += mesh.Position(mesh.FaceCorners()(face, k)) / 3.0;
  }
  return sum;
}

WeightsOfFaces WeightsOf(const TriangleMesh& mesh)
{
  return { mesh, SizesOf(mesh) };
}

/// [0, 1] cubed, each of whose sides is cut into 2 4^subdivisions triangles.
Surface Cube(int subdivisions)
{
  Surface cube;
  cube.V.resize(8, 3);
  for (int i = 0; i < 8; ++i)
  {
    cube.V.row(i) << (i & 1), ((i >> 1) & 1), ((i >> 2) & 1);
  }
  cube.F.resize(12, 3);
  cube.F << 0, 2, 3, 0, 3, 1, 4, 5, 7, 4, 7, 6, 0, 1, 5, 0, 5, 4, 2, 6, 7, 2, 7, 3, 0, 4, 6, 0, 6, 2, 1, 3, 7, 1, 7, 5;
  for (int i = 0; i < subdivisions; ++i)
  {
    cube = Subdivide(cube);
  }
  return cube;
}

/// What the weights make of a unit difference from what is prescribed: the penalties of faces are multiples of their
/// areas over the mean one.
double EnergyOfUnit(const TriangleMesh& mesh, const std::vector<Constraint>& directions)
{
  const Vector<double> areas = mesh.FaceAreas();
  double sum = 0.0;
  for (const Constraint& given : directions)
  {
    sum += given.Weight * areas[given.Element] / areas.mean();
  }
  return sum;
}

TEST(SurfaceFeatures, TheBoundaryRunsWithTheSurfaceOnTheLeft)
{
  const TriangleMesh annulus = Annulus(48, 6).Mesh();
  const auto directions = AlongBoundary(annulus, WeightsOf(annulus), 1.0);
  EXPECT_EQ(directions.size(), 96u);
  for (const auto& [face, direction, weight, side] : directions)
  {
    const Vector3 centre = Centre(annulus, face);
    const double turn = centre.normalized().cross(direction)[2];
    EXPECT_NEAR(turn, centre.norm() > 1.5 ? 1.0 : -1.0, 0.02);
    EXPECT_NEAR(direction.norm(), 1.0, 1e-12);
    EXPECT_GT(weight, 0.0);
  }
}

TEST(SurfaceFeatures, WeightsAreThoseOfIntegralsAtAnySizeAndResolution)
{
  for (const double scale : { 1.0, 1000.0 })
  {
    for (const int subdivisions : { 2, 3 })
    {
      const FramedMesh cube(RotatedAndScaled(Cube(subdivisions), 0.5, scale).Mesh());
      // Twelve edges, each with two faces; half of the smoothness energy of power fields is the Dirichlet energy.
      EXPECT_NEAR(EnergyOfUnit(cube.Mesh, AlongSharpEdges(cube, WeightsOf(cube.Mesh), 30.0, 3.0)),
        2.0 * 3.0 * 24.0 * 30.0 / std::sqrt(6.0), 1e-9);
      const int faces = cube.Mesh.NumberOfFaces();
      PrincipalCurvatures clear{ Vector<Complex>::Ones(faces), Vector<double>::Ones(faces), Vector<double>::Zero(faces),
        Vector<double>::Constant(faces, 0.25) };
      EXPECT_NEAR(EnergyOfUnit(cube.Mesh, AlongCurvature(cube, WeightsOf(cube.Mesh), clear, false, 3.0)),
        2.0 * 3.0 * 0.25 * 900.0, 1e-9);
    }
  }
  const TriangleMesh grid = PlaneGrid(12, 3).Mesh();
  EXPECT_NEAR(EnergyOfUnit(grid, AlongBoundary(grid, WeightsOf(grid), 2.0)), 2.0 * 2.0 * 30.0 * 30.0 / 6.0, 1e-9);
}

TEST(SurfaceFeatures, SharpEdgesAreThoseBeyondTheFeatureAngle)
{
  const FramedMesh cube(Cube(2).Mesh());
  const auto directions = AlongSharpEdges(cube, WeightsOf(cube.Mesh), 89.0, 1.0);
  EXPECT_EQ(directions.size(), 12u * 4u * 2u);
  for (const auto& [face, direction, weight, side] : directions)
  {
    EXPECT_NEAR(direction.cwiseAbs().maxCoeff(), 1.0, 1e-12);
    EXPECT_NEAR(direction.dot(cube.Faces.Normal(face)), 0.0, 1e-12);
  }
  EXPECT_TRUE(AlongSharpEdges(cube, WeightsOf(cube.Mesh), 91.0, 1.0).empty());
}

TEST(SurfaceFeatures, LinesFollowTheMaximumOrTheMinimum)
{
  const FramedMesh torus(Torus(40, 20).Mesh());
  const PrincipalCurvatures curvatures = FindPrincipalDirections(torus, 2.0).Faces;
  const auto maximum = AlongCurvature(torus, WeightsOf(torus.Mesh), curvatures, false, 1.0);
  const auto minimum = AlongCurvature(torus, WeightsOf(torus.Mesh), curvatures, true, 1.0);
  ASSERT_EQ(maximum.size(), minimum.size());
  EXPECT_GT(maximum.size(), 1500u);
  for (std::size_t i = 0; i < maximum.size(); ++i)
  {
    EXPECT_NEAR(maximum[i].Direction.dot(minimum[i].Direction), 0.0, 1e-12);
    const Vector3 centre = Centre(torus.Mesh, maximum[i].Element);
    EXPECT_NEAR(std::abs(Vector3(-centre[1], centre[0], 0.0).normalized().dot(minimum[i].Direction)), 1.0, 0.02);
  }
}

TEST(SurfaceFeatures, WhatIsNotThereOrHasNoSignIsAWarning)
{
  FeatureOptions all;
  all.BoundaryWeight = all.SharpEdgesWeight = all.CurvatureWeight = 1.0;
  const FramedMesh sphere(Icosphere(3).Mesh()), plane(PlaneGrid(5, 5).Mesh());

  const PrincipalCurvatures flat = FindPrincipalDirections(plane, 3.0).Faces;
  const FollowedFeatures ofPlane = FollowFeatures(plane, 4, all, &flat);
  EXPECT_EQ(ofPlane.Directions.size(), 20u);
  ASSERT_EQ(ofPlane.Warnings.size(), 2u);
  EXPECT_NE(ofPlane.Warnings[0].find("sharper than FeatureOptions::FeatureAngle"), std::string::npos);
  EXPECT_NE(ofPlane.Warnings[1].find("bends alike"), std::string::npos);
  EXPECT_EQ(ofPlane.Features, std::vector{ SurfaceFeature::Boundary });
  FeatureOptions silent = all;
  silent.WarnsOfMissing = false;
  for (const int N : { 1, 4 })
  {
    const FollowedFeatures same = FollowFeatures(plane, N, silent, &flat);
    EXPECT_EQ(same.Directions.size(), 20u);
    EXPECT_TRUE(same.Warnings.empty());
  }

  for (const int N : { 1, 3, 5, 7 })
  {
    const FollowedFeatures ofSphere = FollowFeatures(sphere, N, all, nullptr);
    EXPECT_TRUE(ofSphere.Directions.empty());
    ASSERT_EQ(ofSphere.Warnings.size(), 2u);
    EXPECT_NE(ofSphere.Warnings[0].find("no boundary"), std::string::npos);
    EXPECT_NE(ofSphere.Warnings[1].find("without a sign"), std::string::npos);
    EXPECT_NE(ofSphere.Warnings[1].find("FeatureOptions::SharpEdgesWeight and FeatureOptions::CurvatureWeight have"),
      std::string::npos);
    EXPECT_EQ(FollowFeatures(plane, N, all, nullptr).Directions.size(), 20u);
    FeatureOptions edges;
    edges.SharpEdgesWeight = 1.0;
    const FollowedFeatures ofEdges = FollowFeatures(sphere, N, edges, nullptr);
    ASSERT_EQ(ofEdges.Warnings.size(), 1u);
    EXPECT_NE(ofEdges.Warnings[0].find("so FeatureOptions::SharpEdgesWeight has no effect"), std::string::npos);
  }
  EXPECT_TRUE(FollowFeatures(sphere, 4, {}, nullptr).Directions.empty());
  EXPECT_TRUE(FollowFeatures(sphere, 4, {}, nullptr).Warnings.empty());
}

TEST(SurfaceFeatures, EachTurnsByAnAngleOfItsOwn)
{
  const FramedMesh tube(Prism(24, 8).Mesh());
  const PrincipalCurvatures curvatures = FindPrincipalDirections(tube, 2.0).Faces;
  const auto alone = [](double FeatureOptions::*weight)
  {
    FeatureOptions options;
    options.*weight = 2.0;
    options.FeatureAngle = 5.0;
    return options;
  };
  const std::pair<double FeatureOptions::*, double FeatureOptions::*> features[] = {
    { &FeatureOptions::BoundaryWeight, &FeatureOptions::BoundaryRotation },
    { &FeatureOptions::SharpEdgesWeight, &FeatureOptions::SharpEdgesRotation },
    { &FeatureOptions::CurvatureWeight, &FeatureOptions::CurvatureRotation }
  };
  for (const auto& [weight, rotation] : features)
  {
    FeatureOptions options = alone(weight);
    const auto straight = FollowFeatures(tube, 2, options, &curvatures).Directions;
    for (const auto& [other, ofOther] : features)
    {
      options.*ofOther = -70.0;
    }
    options.*rotation = 40.0;
    const auto turned = FollowFeatures(tube, 2, options, &curvatures).Directions;
    ASSERT_FALSE(straight.empty());
    ASSERT_EQ(turned.size(), straight.size());
    for (std::size_t i = 0; i < turned.size(); ++i)
    {
      EXPECT_EQ(turned[i].Element, straight[i].Element);
      EXPECT_EQ(turned[i].Weight, straight[i].Weight);
      EXPECT_LT(
        std::abs(tube.Faces.ToComplex(turned[i].Element, turned[i].Direction) -
          std::polar(1.0, 40.0 * Pi / 180.0) * tube.Faces.ToComplex(straight[i].Element, straight[i].Direction)),
        20 * MachinePrecision);
    }
  }
}

// Rounding of coordinates is no curvature to follow; an ellipsoid that is 5 % longer than wide is.
TEST(SurfaceFeatures, ASphereHasNoPrincipalDirections)
{
  FeatureOptions options;
  options.CurvatureWeight = 1.0;
  for (const double axis : { 1.0, 1.05 })
  {
    Surface surface = Icosphere(5);
    surface.V.col(2) *= axis;
    surface.V = surface.V.cast<float>().cast<double>();
    const FramedMesh framed(surface.Mesh());
    const PrincipalCurvatures ofFaces = FindPrincipalDirections(framed, 3.0).Faces;
    const FollowedFeatures followed = FollowFeatures(framed, 4, options, &ofFaces);
    EXPECT_EQ(followed.Directions.empty(), axis == 1.0) << ofFaces.Confidence.maxCoeff();
    EXPECT_EQ(followed.Warnings.empty(), axis != 1.0);
  }
}

TEST(SurfaceFeatures, RefuseNegativeWeights)
{
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (double FeatureOptions::*weight :
    { &FeatureOptions::BoundaryWeight, &FeatureOptions::SharpEdgesWeight, &FeatureOptions::CurvatureWeight })
  {
    for (const double bad : { -1.0, nan, std::numeric_limits<double>::infinity(), 1e-11, 1e11 })
    {
      FeatureOptions options;
      options.*weight = bad;
      EXPECT_THROW(CheckFeatures(options), InvalidInput);
    }
  }
}

TEST(SurfaceFeatures, DirectionsTurnCounterClockwiseAboutTheNormal)
{
  const FramedMesh surface(IrregularSphere(2, 3).Mesh());
  RotationAngles angles;
  angles.Everywhere = 0.3;
  angles.Faces.setConstant(surface.Mesh.NumberOfFaces(), 0.5);
  angles.Vertices.setConstant(surface.Mesh.NumberOfVertices(), -1.0);
  const Vector3 given(1.0, 2.0, 0.5);
  Constraints directions{ { { 7, given, 1.0 } }, { { 9, given, 1.0 } } };
  Turn(directions, surface, angles);
  const Vector3 onFace = directions.OnFaces[0].Direction;
  EXPECT_LT(std::abs(surface.Faces.ToComplex(7, onFace) - std::polar(1.0, 0.8) * surface.Faces.ToComplex(7, given)),
    20 * MachinePrecision);
  EXPECT_NEAR(onFace.dot(surface.Faces.Normal(7)), given.dot(surface.Faces.Normal(7)), 1e-14);
  EXPECT_LT(std::abs(surface.Vertices.ToComplex(9, directions.AtVertices[0].Direction) -
              std::polar(1.0, -0.7) * surface.Vertices.ToComplex(9, given)),
    20 * MachinePrecision);
}

TEST(SurfaceFeatures, AnAngleThatIsNotFiniteCountsWhereSomethingIsPrescribed)
{
  const FramedMesh surface(Icosphere(1).Mesh());
  RotationAngles angles;
  angles.Faces.setZero(surface.Mesh.NumberOfFaces());
  angles.Faces[3] = std::numeric_limits<double>::quiet_NaN();
  Constraints elsewhere{ { { 4, Vector3(1.0, 2.0, 0.5), 1.0 } }, {} };
  EXPECT_NO_THROW(Turn(elsewhere, surface, angles));
  Constraints there{ { { 3, Vector3(1.0, 2.0, 0.5), 1.0 } }, {} };
  EXPECT_THROW(Turn(there, surface, angles), InvalidInput);
}

}
