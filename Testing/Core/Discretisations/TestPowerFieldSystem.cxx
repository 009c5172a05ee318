#include "Support/FieldSystems.h"

#include "Examples.h"
#include "FieldSolver.h"
#include "Operators/PowerFieldOperators.h"
#include "Support/Errors.h"
#include "Support/FieldProblem.h"
#include "Support/Identities.h"
#include "Support/MeshFactory.h"
#include "Support/Random.h"
#include "Support/ReferenceOperators.h"
#include "Support/SolverOfUnknowns.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <tuple>

namespace
{

using namespace dmg;
using namespace dmg::test;

Vector<Complex> SolveField(const TriangleMesh& mesh, const TangentFrames& frames, int N,
  const FieldConstraints& constraints, const FieldWeights& weights)
{
  const HarmonicSystem<Complex> system = MakePowerFieldSystem(mesh, frames, N, constraints, weights);
  return system.Expand(
    SolveByLU(system.Matrix(), system.RightHandSide(ComplexValues(constraints))), ComplexValues(constraints));
}

TEST(PowerFieldSystem, IsItsStatedEnergy)
{
  const TriangleMesh mesh = IrregularTorus(10, 6, 1).Mesh();
  const TangentFrames frames = FaceFrames(mesh);
  const Vector<double> areas = mesh.FaceAreas();
  Random random(2);
  for (int N : { 1, 2, 4, 8 })
  {
    const FieldConstraints constraints = MakePowerConstraints(mesh, frames, N, RandomDirections(mesh, frames, 7, 3));
    const HarmonicSystem<Complex> system =
      MakePowerFieldSystem(mesh, frames, N, constraints, Weights(ConstraintKind::Soft, 0.25, 3.0));
    EXPECT_LE(HermitianResidual(system.Matrix()), MachinePrecision);
    EXPECT_NEAR(system.Mass().sum(), mesh.NumberOfFaces(), 1e-12 * mesh.NumberOfFaces());

    const Vector<Complex> X = random.Numbers(mesh.NumberOfFaces());
    double energy = 0.25 * X.dot(PowerLaplacian(mesh, frames, N) * X).real();
    double constant = 0.0;
    for (std::size_t b = 0; b < constraints.Elements.size(); ++b)
    {
      const int face = constraints.Elements[b];
      const double pull = 3.0 * constraints.Weights[b] * areas[face] / areas.mean();
      energy += pull * std::norm(X[face] - ComplexValues(constraints)[b]);
      constant += pull * std::norm(ComplexValues(constraints)[b]);
    }
    const double quadratic = X.dot(system.Matrix() * X).real() -
      2.0 * system.RightHandSide(ComplexValues(constraints)).dot(X).real() + constant;
    EXPECT_NEAR(quadratic, energy, 1e3 * MachinePrecision * energy);
  }
}

TEST(PowerFieldSystem, OneDirectionOnAFlatPatchGivesTheConstantField)
{
  for (const Surface& surface : { IrregularPlane(8, 6, 4), Disk(4), Annulus(10, 3) })
  {
    const TriangleMesh mesh = surface.Mesh();
    const TangentFrames frames = FaceFrames(mesh);
    const Vector3 v(0.28, 0.96, 0.0);
    for (int N = 1; N <= 8; ++N)
    {
      for (ConstraintKind kind : { ConstraintKind::Soft, ConstraintKind::Hard })
      {
        const FieldConstraints constraints = MakePowerConstraints(mesh, frames, N, { { 17, v, 1.0 } });
        const Vector<Complex> X = SolveField(mesh, frames, N, constraints, Weights(kind));
        EXPECT_LT(RelativeDifference(X, PowersOfDirection(frames, v, N)), 1e-10);
      }
    }
  }
}

TEST(PowerFieldSystem, OneDirectionOnAFlatTorusGivesAParallelField)
{
  const TriangleMesh mesh = FlatTorus(12, 2).Mesh();
  const TangentFrames frames = FaceFrames(mesh);
  for (int N = 1; N <= 8; ++N)
  {
    const FieldConstraints constraints =
      MakePowerConstraints(mesh, frames, N, { { 5, frames.ToVector(5, { 0.6, 0.8 }), 1.0 } });
    const Vector<Complex> X = SolveField(mesh, frames, N, constraints, Weights(ConstraintKind::Soft));
    EXPECT_LT((X.cwiseAbs().array() - 1.0).abs().maxCoeff(), 1e-10);
    for (int h = 0; h < 3 * mesh.NumberOfFaces(); ++h)
    {
      const Complex carried = X[TriangleMesh::FaceOf(h)] * std::polar(1.0, N * TransportAcrossEdge(mesh, frames, h));
      EXPECT_LT(std::abs(carried - X[TriangleMesh::FaceOf(mesh.Twin(h))]), 1e-10);
    }
    EXPECT_EQ(IndicesOf(mesh, frames, X, N).cwiseAbs().maxCoeff(), 0.0);
  }
}

TEST(PowerFieldSystem, SmoothFieldsHaveIndicesThatSumToTheEulerCharacteristic)
{
  for (const Surface& surface : { IrregularSphere(3, 6), IrregularTorus(20, 10, 7), DoubleTorus(3) })
  {
    const TriangleMesh mesh = surface.Mesh();
    const TangentFrames frames = FaceFrames(mesh);
    for (int N = 1; N <= 8; ++N)
    {
      const FieldConstraints constraints = MakePowerConstraints(mesh, frames, N, RandomDirections(mesh, frames, 3, 8));
      const Vector<Complex> X = SolveField(mesh, frames, N, constraints, Weights(ConstraintKind::Soft));
      const Vector<double> indices = IndicesOf(mesh, frames, X, N);
      EXPECT_NEAR(indices.sum(), mesh.EulerCharacteristic(), 1e-9);
      // A smooth field has few singularities; a random one has them at most vertices.
      EXPECT_LT((indices.array() != 0.0).count(), mesh.NumberOfVertices() / 4);
    }
  }
}

/// X as the vectors of one direction per face, chosen nearest to a reference, is awkward to
/// compare; powers with respect to a direction fixed in space are not.
Vector<Complex> RelativeTo(const TangentFrames& frames, const Vector<Complex>& X, const Vector3& direction, int N)
{
  return X.cwiseProduct(PowersOfDirection(frames, direction, N).conjugate());
}

TEST(PowerFieldSystem, FieldsFollowRelabellingRotationAndScale)
{
  const Surface surface = IrregularTorus(12, 8, 9);
  const TriangleMesh mesh = surface.Mesh();
  const TangentFrames frames = FaceFrames(mesh);
  const std::vector<Constraint> directions = RandomDirections(mesh, frames, 6, 10);
  const Vector3 reference(0.3, 0.5, -0.7);

  const Relabelled relabelled = Relabel(surface, 11);
  const TriangleMesh other = relabelled.Result.Mesh();
  const TangentFrames otherFrames = FaceFrames(other);
  std::vector<Constraint> otherDirections = directions;
  Eigen::Matrix3d rotation;
  const TriangleMesh moved = RotatedAndScaled(surface, 2.1, 1e-3, &rotation).Mesh();
  const TangentFrames movedFrames = FaceFrames(moved);
  std::vector<Constraint> movedDirections = directions;
  for (std::size_t i = 0; i < directions.size(); ++i)
  {
    otherDirections[i].Element = relabelled.NewFaces[directions[i].Element];
    movedDirections[i].Direction = rotation * directions[i].Direction;
  }

  for (ConstraintKind kind : { ConstraintKind::Soft, ConstraintKind::Hard })
  {
    for (int N : { 1, 2, 4, 6 })
    {
      const auto solve =
        [&](const TriangleMesh& m, const TangentFrames& fr, const std::vector<Constraint>& d, const Vector3& r)
      { return RelativeTo(fr, SolveField(m, fr, N, MakePowerConstraints(m, fr, N, d), Weights(kind)), r, N); };
      const Vector<Complex> X = solve(mesh, frames, directions, reference);
      const Vector<Complex> Y = solve(other, otherFrames, otherDirections, reference);
      Vector<Complex> YInOrder(Y.size());
      for (int f = 0; f < Y.size(); ++f)
      {
        YInOrder[f] = Y[relabelled.NewFaces[f]];
      }
      EXPECT_LT(RelativeDifference(YInOrder, X), 1e-10);
      const Vector<Complex> Z = solve(moved, movedFrames, movedDirections, rotation * reference);
      EXPECT_LT(RelativeDifference(Z, X), 1e-10);
    }
  }
}

TEST(PowerFieldSystem, HardConstraintsHoldAndStrongSoftOnesNearly)
{
  const TriangleMesh mesh = IrregularSphere(2, 12).Mesh();
  const TangentFrames frames = FaceFrames(mesh);
  const FieldConstraints constraints = MakePowerConstraints(mesh, frames, 4, RandomDirections(mesh, frames, 5, 13));
  const Vector<Complex> hard = SolveField(mesh, frames, 4, constraints, Weights(ConstraintKind::Hard));
  const Vector<Complex> strong = SolveField(mesh, frames, 4, constraints, Weights(ConstraintKind::Soft, 1.0, 1e8));
  for (std::size_t b = 0; b < constraints.Elements.size(); ++b)
  {
    EXPECT_EQ(hard[constraints.Elements[b]], ComplexValues(constraints)[b]);
  }
  EXPECT_LT(RelativeDifference(strong, hard), 1e-6);
}

TEST(PowerFieldSystem, ComponentsWithoutAPrescriptionHaveTheSmoothestField)
{
  const TriangleMesh mesh = Union(Icosphere(1), Disk(3), Vector3(4.0, 0.0, 0.0)).Mesh();
  const TangentFrames frames = FaceFrames(mesh);
  const FieldConstraints constraints = MakePowerConstraints(mesh, frames, 4, { { 81, Vector3(1.0, 0.0, 0.0), 1.0 } });
  for (ConstraintKind kind : { ConstraintKind::Soft, ConstraintKind::Hard })
  {
    const HarmonicSystem<Complex> system = MakePowerFieldSystem(mesh, frames, 4, constraints, Weights(kind));
    EXPECT_EQ(system.NumberOfUnreached(), 80);
    SolverOfUnknowns solver(mesh);
    FieldOptions options = PowersOnFaces();
    options.Constraints = kind;
    solver.Solve({ { { 81, Vector3(1.0, 0.0, 0.0), 1.0 } }, {} }, options);
    EXPECT_TRUE(solver.Report().Warnings.empty());
    EXPECT_EQ(solver.Report().Eigenvalues.size(), 1u);
    const Vector<Complex> X = SolveField(mesh, frames, 4, constraints, Weights(kind));
    EXPECT_LT((X.tail(54).cwiseAbs().array() - 1.0).abs().maxCoeff(), 1e-10);
  }

  const TriangleMesh sphere = Icosphere(1).Mesh();
  const HarmonicSystem<Complex> whole =
    MakePowerFieldSystem(sphere, FaceFrames(sphere), 2, { { 3 }, { 1.0 } }, Weights(ConstraintKind::Soft));
  EXPECT_EQ(whole.NumberOfUnreached(), 0);
}

TEST(PowerFieldSystem, ZeroAreaFacesGetAField)
{
  const TriangleMesh mesh = SphereWithZeroAreaFaces(3, 8).Mesh();
  const TangentFrames frames = FaceFrames(mesh);
  for (int N : { 1, 4 })
  {
    const FieldConstraints constraints = MakePowerConstraints(mesh, frames, N, RandomDirections(mesh, frames, 4, 14));
    const Vector<Complex> X = SolveField(mesh, frames, N, constraints, Weights(ConstraintKind::Soft));
    EXPECT_TRUE(X.allFinite());
    EXPECT_LT(X.cwiseAbs().maxCoeff(), ComplexValues(constraints).cwiseAbs().maxCoeff() * (1.0 + 1e-6));
    EXPECT_NEAR(IndicesOf(mesh, frames, X, N).sum(), 2.0, 1e-9);
  }
}

TEST(PowerFieldSystem, RefusesWhatItCannotSolve)
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
  const auto expectRefusal =
    [&](int N, const FieldConstraints& prescribed, const FieldWeights& weights, const std::string& word)
  {
    try
    {
      FieldOptions options = PowersOnFaces();
      options.Field.N = N;
      std::tie(options.Smoothness, options.Alignment, options.Constraints) =
        std::tie(weights.Smoothness, weights.Alignment, weights.Constraints);
      test::FieldProblem(surface, nullptr, { prescribed.Elements, prescribed.Weights, {} }, options, SerialContext());
      ADD_FAILURE() << "accepted; expected \"" << word << '"';
    }
    catch (const InvalidInput& error)
    {
      EXPECT_NE(std::string(error.what()).find(word), std::string::npos) << error.what();
    }
  };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  expectRefusal(0, one, Weights(ConstraintKind::Soft), "choose N from 1 to 8");
  expectRefusal(9, one, Weights(ConstraintKind::Soft), "choose N from 1 to 8");
  expectRefusal(4, one, Weights(ConstraintKind::Soft, 0.0, 1.0), "Smoothness");
  expectRefusal(4, one, Weights(ConstraintKind::Soft, 1.0, -1.0), "Alignment");
  expectRefusal(4, one, Weights(ConstraintKind::Soft, nan, 1.0), "Smoothness");
  EXPECT_NO_THROW(MakePowerFieldSystem(mesh, frames, 4, all, Weights(ConstraintKind::Soft)));
}

TEST(PowerFieldSystem, IsHeldEverywhereByHardConstraints)
{
  const FramedMesh surface(IrregularSphere(1, 5).Mesh());
  FieldConstraints held;
  for (int face = 0; face < surface.Mesh.NumberOfFaces(); ++face)
  {
    held.Elements.push_back(face);
    held.Weights.push_back(1.0);
  }
  held.Values = Vector<double>::LinSpaced(2 * surface.Mesh.NumberOfFaces(), -1.0, 1.0);
  FieldOptions options = PowersOnFaces();
  options.Field.Kind = DiscretisationKind::PowerField;
  options.Constraints = ConstraintKind::Hard;
  test::FieldProblem problem(surface, nullptr, held, options, SerialContext());
  EXPECT_EQ(problem.Solve(held.Values, {}, StoppingCriteria(), SerialContext()), held.Values);
}

}
