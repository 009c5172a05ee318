#include "Support/FieldSystems.h"

#include "Examples.h"
#include "Operators/FaceFieldOperators.h"
#include "Support/Errors.h"
#include "Support/FieldProblem.h"
#include "Support/Identities.h"
#include "Support/MeshFactory.h"
#include "Support/Pairs.h"
#include "Support/Random.h"
#include "Support/ReferenceOperators.h"

#include <Eigen/SparseLU>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

namespace
{

using namespace dmg;
using namespace dmg::test;

/// The field as vectors in space, by a general sparse LU.
Points SolveField(const TriangleMesh& mesh, const TangentFrames& frames, const std::vector<Constraint>& directions,
  const FieldWeights& weights)
{
  const FieldConstraints constraints = MakePowerConstraints(mesh, frames, 1, directions);
  const Vector<double>& values = constraints.Values;
  const HarmonicSystem<double> system = MakeFaceFieldSystem(mesh, frames, constraints, weights);
  const Eigen::SparseMatrix<double> A = system.Matrix();
  const Eigen::SparseLU<Eigen::SparseMatrix<double>> lu(A);
  const Vector<double> x = lu.solve(system.RightHandSide(values));
  return VectorsFromFaceField(frames, system.Expand(x, values));
}

TEST(FaceFieldSystem, IsItsStatedEnergy)
{
  const TriangleMesh mesh = IrregularTorus(10, 6, 1).Mesh();
  const TangentFrames frames = FaceFrames(mesh);
  const Vector<double> areas = mesh.FaceAreas();
  Random random(2);
  const FieldConstraints constraints = MakePowerConstraints(mesh, frames, 1, RandomDirections(mesh, frames, 7, 3));
  const Vector<double>& values = constraints.Values;
  const HarmonicSystem<double> system =
    MakeFaceFieldSystem(mesh, frames, constraints, Weights(ConstraintKind::Soft, 0.25, 3.0));
  ASSERT_EQ(system.NumberOfFree(), 2 * mesh.NumberOfFaces());
  EXPECT_NEAR(system.Mass().sum(), 2.0 * mesh.NumberOfFaces(), 1e-12 * mesh.NumberOfFaces());

  Vector<double> X(2 * mesh.NumberOfFaces());
  for (double& x : X)
  {
    x = random.Uniform(-1.0, 1.0);
  }
  double energy = 0.25 * X.dot(FaceFieldSmoothness(mesh, frames) * X);
  double constant = 0.0;
  for (std::size_t b = 0; b < constraints.Elements.size(); ++b)
  {
    const int face = constraints.Elements[b];
    const double pull = 3.0 * constraints.Weights[b] * areas[face] / areas.mean();
    const Vector2 y = values.segment<2>(2 * b);
    energy += pull * (X.segment<2>(2 * face) - y).squaredNorm();
    constant += pull * y.squaredNorm();
  }
  const double quadratic = X.dot(system.Matrix() * X) - 2.0 * system.RightHandSide(values).dot(X) + constant;
  EXPECT_NEAR(quadratic, energy, 1e3 * MachinePrecision * energy);
}

// On a flat torus the harmonic fields are the parallel ones: one vector determines the field.
TEST(FaceFieldSystem, OneVectorOnAFlatTorusGivesAParallelField)
{
  const TriangleMesh mesh = FlatTorus(12, 2).Mesh();
  const TangentFrames frames = FaceFrames(mesh);
  const Vector3 v = frames.ToVector(5, { 0.6, 0.8 });
  for (ConstraintKind kind : { ConstraintKind::Soft, ConstraintKind::Hard })
  {
    const Points X = SolveField(mesh, frames, { { 5, v, 1.0 } }, Weights(kind));
    EXPECT_LT((X.row(5) - v.transpose()).norm(), 1e-9);
    EXPECT_LT((X.rowwise().norm().array() - 1.0).abs().maxCoeff(), 1e-9);
  }
}

// In a ring the field runs around, along both boundaries, as the gradient of the angle does; its
// strength is as prescribed where it is prescribed.
TEST(FaceFieldSystem, InARingTheFieldRunsAround)
{
  const TriangleMesh mesh = Annulus(48, 12).Mesh();
  const TangentFrames frames = FaceFrames(mesh);
  const auto around = [&](int face)
  {
    const Vector3 centre = (mesh.Position(mesh.FaceCorners()(face, 0)) + mesh.Position(mesh.FaceCorners()(face, 1)) +
                             mesh.Position(mesh.FaceCorners()(face, 2))) /
      3.0;
    return Vector3(Vector3(-centre[1], centre[0], 0.0) / centre.squaredNorm());
  };
  const Points X = SolveField(mesh, frames, { { 100, around(100), 1.0 } }, Weights(ConstraintKind::Soft));
  double worst = 0.0;
  for (int face = 0; face < mesh.NumberOfFaces(); ++face)
  {
    worst = std::max(worst, (X.row(face).transpose() - around(face)).norm());
  }
  EXPECT_LT(worst, 0.1); // the faces' size over the radius
}

TEST(FaceFieldSystem, FieldsFollowRelabellingRotationAndScale)
{
  const Surface surface = IrregularTorus(12, 8, 9);
  const TriangleMesh mesh = surface.Mesh();
  const TangentFrames frames = FaceFrames(mesh);
  const std::vector<Constraint> directions = RandomDirections(mesh, frames, 6, 10);
  const Relabelled relabelled = Relabel(surface, 11);
  const TriangleMesh other = relabelled.Result.Mesh();
  Eigen::Matrix3d rotation;
  const TriangleMesh moved = RotatedAndScaled(surface, 2.1, 1e-3, &rotation).Mesh();
  std::vector<Constraint> otherDirections = directions;
  std::vector<Constraint> movedDirections = directions;
  for (std::size_t i = 0; i < directions.size(); ++i)
  {
    otherDirections[i].Element = relabelled.NewFaces[directions[i].Element];
    movedDirections[i].Direction = rotation * directions[i].Direction;
  }
  for (ConstraintKind kind : { ConstraintKind::Soft, ConstraintKind::Hard })
  {
    const Points X = SolveField(mesh, frames, directions, Weights(kind));
    const Points Y = SolveField(other, FaceFrames(other), otherDirections, Weights(kind));
    const Points Z = SolveField(moved, FaceFrames(moved), movedDirections, Weights(kind));
    for (int f = 0; f < mesh.NumberOfFaces(); ++f)
    {
      EXPECT_LT((Y.row(relabelled.NewFaces[f]) - X.row(f)).norm(), 1e-10);
      EXPECT_LT((Z.row(f).transpose() - rotation * X.row(f).transpose()).norm(), 1e-10);
    }
  }
}

TEST(FaceFieldSystem, HardConstraintsHoldAndStrongSoftOnesNearly)
{
  const TriangleMesh mesh = IrregularSphere(2, 12).Mesh();
  const TangentFrames frames = FaceFrames(mesh);
  const std::vector<Constraint> directions = { { 3, frames.ToVector(3, { 1.0, 0.5 }), 1.0 },
    { 77, frames.ToVector(77, { 0.0, -1.0 }), 1.0 } };
  const Points hard = SolveField(mesh, frames, directions, Weights(ConstraintKind::Hard));
  const Points strong = SolveField(mesh, frames, directions, Weights(ConstraintKind::Soft, 1.0, 1e8));
  for (const Constraint& d : directions)
  {
    EXPECT_LT((hard.row(d.Element).transpose() - d.Direction).norm(), 1e-14);
  }
  EXPECT_LT((strong - hard).cwiseAbs().maxCoeff(), 1e-6);
}

TEST(FaceFieldSystem, ComponentsWithoutAPrescriptionAreZero)
{
  const TriangleMesh mesh = Union(Icosphere(1), Disk(3), Vector3(4.0, 0.0, 0.0)).Mesh();
  const TangentFrames frames = FaceFrames(mesh);
  for (ConstraintKind kind : { ConstraintKind::Soft, ConstraintKind::Hard })
  {
    const HarmonicSystem<double> system = MakeFaceFieldSystem(mesh, frames, { { 81 }, { 1.0 } }, Weights(kind));
    EXPECT_EQ(system.NumberOfUnreached(), 160);
    const Points X = SolveField(mesh, frames, { { 81, Vector3(1.0, 0.0, 0.0), 1.0 } }, Weights(kind));
    EXPECT_EQ(X.topRows(80).norm(), 0.0);
    EXPECT_GT(X.bottomRows(54).norm(), 0.1);
  }
}

TEST(FaceFieldSystem, ZeroAreaFacesGetAField)
{
  const TriangleMesh mesh = SphereWithZeroAreaFaces(3, 8).Mesh();
  const TangentFrames frames = FaceFrames(mesh);
  const Points X = SolveField(mesh, frames, RandomDirections(mesh, frames, 4, 14), Weights(ConstraintKind::Soft));
  EXPECT_TRUE(X.allFinite());
  EXPECT_LT(X.cwiseAbs().maxCoeff(), 100.0);
}

TEST(FaceFieldSystem, RefusesWhatItCannotSolve)
{
  const FramedMesh surface(Icosphere(0).Mesh());
  const TriangleMesh& mesh = surface.Mesh;
  const TangentFrames& frames = surface.Faces;
  const FieldConstraints one{ { 3 }, { 1.0 } };
  FieldConstraints all;
  for (int f = 0; f < mesh.NumberOfFaces(); ++f)
  {
    all.Elements.push_back(f);
    all.Weights.push_back(1.0);
  }
  const auto expectRefusal = [&](
                               const FieldConstraints& prescribed, const FieldWeights& weights, const std::string& word)
  {
    try
    {
      FieldOptions options;
      options.Field.Kind = DiscretisationKind::FaceField;
      std::tie(options.Smoothness, options.Alignment, options.Constraints) =
        std::tie(weights.Smoothness, weights.Alignment, weights.Constraints);
      FieldProblem(surface, nullptr, { prescribed.Elements, prescribed.Weights, {} }, options, SerialContext());
      ADD_FAILURE() << "accepted; expected \"" << word << '"';
    }
    catch (const InvalidInput& error)
    {
      EXPECT_NE(std::string(error.what()).find(word), std::string::npos) << error.what();
    }
  };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  expectRefusal(one, Weights(ConstraintKind::Soft, 0.0, 1.0), "Smoothness");
  expectRefusal(one, Weights(ConstraintKind::Soft, 1.0, -1.0), "Alignment");
  expectRefusal(one, Weights(ConstraintKind::Soft, nan, 1.0), "Smoothness");
  EXPECT_NO_THROW(MakeFaceFieldSystem(mesh, frames, all, Weights(ConstraintKind::Soft)));
}

TEST(FaceFieldSystem, IsHeldEverywhereByHardConstraints)
{
  const FramedMesh surface(IrregularSphere(1, 5).Mesh());
  FieldConstraints held;
  for (int face = 0; face < surface.Mesh.NumberOfFaces(); ++face)
  {
    held.Elements.push_back(face);
    held.Weights.push_back(1.0);
  }
  held.Values = Vector<double>::LinSpaced(2 * surface.Mesh.NumberOfFaces(), -1.0, 1.0);
  FieldOptions options;
  options.Field.Kind = DiscretisationKind::FaceField;
  options.Constraints = ConstraintKind::Hard;
  FieldProblem problem(surface, nullptr, held, options, SerialContext());
  EXPECT_EQ(problem.Solve(held.Values, {}, StoppingCriteria(), SerialContext()), held.Values);
}

}
