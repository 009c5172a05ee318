#include "Support/FieldSystems.h"

#include "Examples.h"
#include "Support/DenseAlgebra.h"
#include "Support/Errors.h"
#include "Support/Identities.h"
#include "Support/MeshFactory.h"
#include "Support/Random.h"
#include "Support/ReferenceOperators.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace
{

using namespace dmg;
using namespace dmg::test;

Vector<double> SolveForm(const TriangleMesh& mesh, const FieldConstraints& constraints, const FieldWeights& weights)
{
  const HarmonicSystem<double> system = MakeOneFormSystem(mesh, constraints, weights);
  return system.Expand(
    Solved(Densified(system.Matrix()), system.RightHandSide(constraints.Values)), constraints.Values);
}

FieldConstraints RandomConstraints(const TriangleMesh& mesh, int count, unsigned seed)
{
  const TangentFrames frames = FaceFrames(mesh);
  return OneFormConstraintsOnFaces(mesh, frames, RandomDirections(mesh, frames, count, seed));
}

/// A vertex whose faces lie in one plane.
int FlatVertex(const TriangleMesh& mesh)
{
  const TangentFrames faces = FaceFrames(mesh);
  const TangentFrames vertices = VertexFrames(mesh);
  std::vector<bool> isFlat(mesh.NumberOfVertices(), true);
  for (int h = 0; h < 3 * mesh.NumberOfFaces(); ++h)
  {
    if (faces.Normal(TriangleMesh::FaceOf(h)).dot(vertices.Normal(mesh.Tail(h))) < 1.0 - 1e-12)
    {
      isFlat[mesh.Tail(h)] = false;
    }
  }
  return static_cast<int>(std::find(isFlat.begin(), isFlat.end(), true) - isFlat.begin());
}

/// The stated energy of a form.
double Energy(const TriangleMesh& mesh, const Vector<double>& h, const FieldConstraints& constraints, double smoothness,
  double alignment)
{
  const Vector<double> curl = D1(mesh) * h;
  const Vector<double> divergence = D0(mesh).transpose() * (Star1(mesh).asDiagonal() * h);
  double energy = smoothness *
    (curl.dot(Star2(mesh).asDiagonal() * curl) + divergence.dot(Star0(mesh).cwiseInverse().asDiagonal() * divergence));
  const Vector<double> mass = PositiveStar1(mesh) / (2.0 * mesh.FaceAreas().mean());
  for (std::size_t b = 0; b < constraints.Elements.size(); ++b)
  {
    const int edge = constraints.Elements[b];
    energy += alignment * constraints.Weights[b] * mass[edge] * std::pow(h[edge] - constraints.Values[b], 2);
  }
  return energy;
}

}

// A convex quadratic is that of its stated energy if values agree at random places up to a constant; and
// a gradient that vanishes is checked on the stated energy itself, by differences, exact for quadratics.
TEST(OneFormSystem, MinimisesItsStatedEnergy)
{
  for (const Surface& surface :
    { IrregularSphere(1, 3), IrregularTorus(9, 6, 1), DoubleTorus(1), IrregularPlane(6, 5, 8), Annulus(9, 2) })
  {
    const TriangleMesh mesh = surface.Mesh();
    const FieldConstraints constraints = RandomConstraints(mesh, 7, 3);
    const HarmonicSystem<double> system =
      MakeOneFormSystem(mesh, constraints, Weights(ConstraintKind::Soft, 0.25, 3.0));
    EXPECT_GT(Eigenvalues(system.Matrix())[0], 0.0);
    const Vector<double> h = SolveForm(mesh, constraints, Weights(ConstraintKind::Soft, 0.25, 3.0));
    const auto energy = [&](const Vector<double>& form) { return Energy(mesh, form, constraints, 0.25, 3.0); };
    Random random(2);
    for (int trial = 0; trial < 5; ++trial)
    {
      const Vector<double> step = random.Numbers(mesh.NumberOfEdges()).real();
      const double up = energy(h + step);
      const double down = energy(h - step);
      EXPECT_NEAR(up, down, 1e-11 * (up + down));
      EXPECT_NEAR(0.5 * (up + down) - energy(h), step.dot(system.Matrix() * step), 1e-11 * up);
    }
  }
}

TEST(OneFormSystem, HardConstraintsHoldAndTheRestIsMinimal)
{
  const TriangleMesh mesh = IrregularTorus(9, 6, 1).Mesh();
  const FieldConstraints constraints = RandomConstraints(mesh, 4, 5);
  const Vector<double> h = SolveForm(mesh, constraints, Weights(ConstraintKind::Hard));
  Vector<double> gradient = OneFormLaplacian(mesh, SerialContext()) * h;
  const double size = gradient.cwiseAbs().maxCoeff();
  for (std::size_t b = 0; b < constraints.Elements.size(); ++b)
  {
    EXPECT_EQ(h[constraints.Elements[b]], constraints.Values[b]);
    gradient[constraints.Elements[b]] = 0.0;
  }
  EXPECT_GT(size, 0.1);
  EXPECT_LT(gradient.cwiseAbs().maxCoeff(), 1e-12 * size);
}

// An everywhere prescribed wave (sin kx, 0), which flows along the boundary x = 0, pi / k and has no curl,
// is damped by 1 / (1 + 2 mean A k^2 lambda_S / lambda_A): the same as for power fields, whose energy
// is twice the Dirichlet energy. Measured where the mesh is regular, hence the tolerance.
TEST(OneFormSystem, AlignmentPullsAsOnPowerFields)
{
  const int columns = 40;
  const TriangleMesh mesh = PlaneGrid(columns, 6).Mesh();
  const double k = Pi / columns;
  Points vectors = Points::Zero(mesh.NumberOfVertices(), 3);
  FieldConstraints constraints;
  for (int v = 0; v < mesh.NumberOfVertices(); ++v)
  {
    vectors(v, 0) = std::sin(k * mesh.Position(v).x());
  }
  constraints.Values = FormFromVertexVectors(mesh, vectors);
  for (int edge = 0; edge < mesh.NumberOfEdges(); ++edge)
  {
    constraints.Elements.push_back(edge);
    constraints.Weights.push_back(1.0);
  }
  const double smoothness = 200.0;
  const HarmonicSystem<double> system = MakeOneFormSystem(mesh, constraints, Weights(ConstraintKind::Soft, smoothness));
  const Vector<double> h = Solved(Densified(system.Matrix()), system.RightHandSide(constraints.Values));
  const double expected = 1.0 / (1.0 + 2.0 * 0.5 * k * k * smoothness);
  const double found = h.dot(constraints.Values) / constraints.Values.squaredNorm();
  EXPECT_NEAR(found, expected, 0.01 * expected);
}

// One direction on a flat torus is carried all over it as a parallel field: curl and divergence vanish.
TEST(OneFormSystem, OneDirectionOnAFlatTorusGivesAParallelField)
{
  const TriangleMesh mesh = FlatTorus(9, 1).Mesh();
  const TangentFrames frames = FaceFrames(mesh);
  for (ConstraintKind kind : { ConstraintKind::Soft, ConstraintKind::Hard })
  {
    const FieldConstraints constraints =
      OneFormConstraintsOnFaces(mesh, frames, { { 5, frames.ToVector(5, { 0.6, 0.8 }), 1.0 } });
    ASSERT_EQ(constraints.Elements.size(), 3u);
    const Points vectors = WhitneyAtFaces(mesh, SolveForm(mesh, constraints, Weights(kind)));
    EXPECT_LT((vectors.rowwise().norm().array() - 1.0).abs().maxCoeff(), 1e-10);
    EXPECT_LT((vectors.row(5) - frames.ToVector(5, { 0.6, 0.8 }).transpose()).norm(), 1e-10);
  }
}

// The field is that of the surface: other numbers, other orientations of edges, the same vectors.
TEST(OneFormSystem, DoesNotDependOnTheNumbering)
{
  const Surface surface = IrregularTorus(9, 6, 1);
  const TriangleMesh mesh = surface.Mesh();
  const Relabelled relabelled = Relabel(surface, 6);
  const TriangleMesh other = relabelled.Result.Mesh();
  const std::vector<Constraint> directions = RandomDirections(mesh, FaceFrames(mesh), 5, 7);
  std::vector<Constraint> otherDirections = directions;
  for (Constraint& direction : otherDirections)
  {
    direction.Element = relabelled.NewFaces[direction.Element];
  }
  for (ConstraintKind kind : { ConstraintKind::Soft, ConstraintKind::Hard })
  {
    const Points expected = WhitneyAtFaces(
      mesh, SolveForm(mesh, OneFormConstraintsOnFaces(mesh, FaceFrames(mesh), directions), Weights(kind)));
    const Points found = WhitneyAtFaces(
      other, SolveForm(other, OneFormConstraintsOnFaces(other, FaceFrames(other), otherDirections), Weights(kind)));
    double worst = 0.0;
    for (int face = 0; face < mesh.NumberOfFaces(); ++face)
    {
      worst = std::max(worst, (found.row(relabelled.NewFaces[face]) - expected.row(face)).norm());
    }
    EXPECT_LT(worst, 1e-11 * expected.cwiseAbs().maxCoeff());
  }
}

TEST(OneFormSystem, ComponentsWithoutAPrescriptionAreZero)
{
  const TriangleMesh mesh = Union(Icosphere(1), IrregularTorus(9, 6, 2), Vector3(4.0, 0.0, 0.0)).Mesh();
  const TangentFrames frames = FaceFrames(mesh);
  const FieldConstraints constraints =
    OneFormConstraintsOnFaces(mesh, frames, { { 100, frames.X.row(100).transpose(), 1.0 } });
  for (ConstraintKind kind : { ConstraintKind::Soft, ConstraintKind::Hard })
  {
    EXPECT_EQ(MakeOneFormSystem(mesh, constraints, Weights(kind)).NumberOfUnreached(), 120);
    EXPECT_EQ(SolveForm(mesh, constraints, Weights(kind)).head(120).norm(), 0.0);
  }
}

// By hand, on a square of two triangles.
TEST(FieldConstraints, OfFacesAverageOnCommonEdges)
{
  const TriangleMesh mesh = PlaneGrid(1, 1).Mesh();
  const TangentFrames frames = FaceFrames(mesh);
  const Vector3 x(1.0, 0.0, 0.0);
  const Vector3 y(0.0, 1.0, 0.0);
  const FieldConstraints one = OneFormConstraintsOnFaces(mesh, frames, { { 0, x + 7.0 * x.cross(y), 2.0 } });
  ASSERT_EQ(one.Elements.size(), 3u);
  for (std::size_t b = 0; b < 3; ++b)
  {
    const int edge = one.Elements[b];
    const auto [tail, head] = mesh.EdgeVertices(edge);
    EXPECT_NEAR(one.Values[b], (mesh.Position(head) - mesh.Position(tail)).x(), 1e-15);
    EXPECT_EQ(one.Weights[b], mesh.Twin(mesh.HalfedgeOf(edge)) < 0 ? 2.0 : 1.0);
  }
  const FieldConstraints both = OneFormConstraintsOnFaces(mesh, frames, { { 1, y, 3.0 }, { 0, x, 1.0 } });
  ASSERT_EQ(both.Elements.size(), 5u);
  for (int edge = 0; edge < 5; ++edge)
  {
    if (mesh.Twin(mesh.HalfedgeOf(edge)) >= 0)
    {
      const auto [tail, head] = mesh.EdgeVertices(edge);
      const Vector3 along = mesh.Position(head) - mesh.Position(tail);
      EXPECT_NEAR(both.Values[edge], 0.25 * along.x() + 0.75 * along.y(), 1e-15);
      EXPECT_EQ(both.Weights[edge], 2.0);
    }
  }
}

TEST(FieldConstraints, OfVerticesHoldTheEdgesAround)
{
  const TriangleMesh mesh = PlaneGrid(4, 4).Mesh();
  const TangentFrames faces = FaceFrames(mesh);
  const TangentFrames vertices = VertexFrames(mesh);
  const Vector3 x(1.0, 0.0, 0.0);
  const FieldConstraints one = OneFormConstraintsAtVertices(mesh, faces, vertices, { { 12, x, 2.0 } }); // has six edges
  ASSERT_EQ(one.Elements.size(), 6u);
  EXPECT_EQ(one.Weights[0], 1.0);
  EXPECT_NEAR(one.Values.cwiseAbs().sum(), 4.0, 1e-14);
  // Two neighbours, x and 3 x: the edge between is prescribed in full, by the trapezoidal rule.
  const FieldConstraints two =
    OneFormConstraintsAtVertices(mesh, faces, vertices, { { 13, 3.0 * x, 1.0 }, { 12, x, 1.0 } });
  ASSERT_EQ(two.Elements.size(), 11u);
  int full = 0;
  for (std::size_t b = 0; b < two.Elements.size(); ++b)
  {
    if (mesh.EdgeVertices(two.Elements[b]) == std::array<int, 2>{ 12, 13 })
    {
      EXPECT_EQ(two.Weights[b], 1.0);
      EXPECT_NEAR(two.Values[b], 2.0, 1e-15);
      ++full;
    }
    else
    {
      EXPECT_EQ(two.Weights[b], 0.5);
    }
  }
  EXPECT_EQ(full, 1);
}

// On a roof, a direction at the ridge is carried into both sides: along the ridge as it is, across it
// up one side and down the other, with its length.
TEST(FieldConstraints, OfVerticesAreNotShortenedByCreases)
{
  Surface roof = PlaneGrid(2, 2);
  for (int i = 0; i < roof.V.rows(); ++i)
  {
    roof.V(i, 2) = -std::abs(roof.V(i, 0) - 1.0);
  }
  const TriangleMesh mesh = roof.Mesh();
  const int ridge = 4; // the middle
  const Vector3 along(0.0, 2.0, 0.0);
  const Vector3 across(3.0, 0.0, 0.0);
  const FieldConstraints constraints =
    OneFormConstraintsAtVertices(mesh, FaceFrames(mesh), VertexFrames(mesh), { { ridge, along + across, 1.0 } });
  ASSERT_EQ(constraints.Elements.size(), 6u);
  for (std::size_t b = 0; b < constraints.Elements.size(); ++b)
  {
    const auto [tail, head] = mesh.EdgeVertices(constraints.Elements[b]);
    const Vector3 edge = mesh.Position(head) - mesh.Position(tail);
    EXPECT_NEAR(constraints.Values[b], 2.0 * edge.y() + 3.0 * std::sqrt(2.0) * edge.x(), 1e-14);
    EXPECT_EQ(constraints.Weights[b], 0.5);
  }
}

// One vertex is enough for a field: on a flat torus, the parallel one.
TEST(FieldConstraints, OfOneVertexFillAFlatTorus)
{
  const TriangleMesh mesh = FlatTorus(8, 2).Mesh();
  const TangentFrames faces = FaceFrames(mesh);
  const TangentFrames vertices = VertexFrames(mesh);
  const int inside = FlatVertex(mesh);
  ASSERT_LT(inside, mesh.NumberOfVertices());
  const Vector3 v = vertices.ToVector(inside, { 0.6, 0.8 });
  for (ConstraintKind kind : { ConstraintKind::Soft, ConstraintKind::Hard })
  {
    const Vector<double> form =
      SolveForm(mesh, OneFormConstraintsAtVertices(mesh, faces, vertices, { { inside, v, 1.0 } }), Weights(kind));
    const Points field = WhitneyAtFaces(mesh, form);
    EXPECT_LT((field.rowwise().norm().array() - 1.0).abs().maxCoeff(), 1e-10);
    const int face = TriangleMesh::FaceOf(mesh.OutgoingHalfedge(inside));
    EXPECT_LT((field.row(face) - v.transpose()).norm(), 1e-10);
  }
}

TEST(FieldConstraints, OfFacesAndVerticesJoin)
{
  const TriangleMesh mesh = PlaneGrid(3, 3).Mesh();
  const TangentFrames faces = FaceFrames(mesh);
  const TangentFrames vertices = VertexFrames(mesh);
  const Vector3 x(1.0, 0.0, 0.0);
  const Vector3 y(0.0, 1.0, 0.0);
  const int vertex = mesh.FaceCorners()(8, 0);
  const FieldConstraints a = OneFormConstraintsOnFaces(mesh, faces, { { 8, x, 1.0 } });
  const FieldConstraints b = OneFormConstraintsAtVertices(mesh, faces, vertices, { { vertex, y, 3.0 } });
  const FieldConstraints both = Joined(a, b);
  const auto spread = [&mesh](const FieldConstraints& constraints)
  {
    Vector<double> weights = Vector<double>::Zero(mesh.NumberOfEdges());
    Vector<double> moments = weights;
    for (std::size_t i = 0; i < constraints.Elements.size(); ++i)
    {
      const int edge = constraints.Elements[i];
      weights[edge] = constraints.Weights[i];
      moments[edge] = constraints.Weights[i] * constraints.Values[i];
    }
    return std::pair(weights, moments);
  };
  EXPECT_EQ(spread(both).first, spread(a).first + spread(b).first);
  EXPECT_LT((spread(both).second - spread(a).second - spread(b).second).norm(), 1e-14);
  EXPECT_EQ(both.Elements.size(), 7u); // six at the vertex, two of which the face shares
}

TEST(FieldConstraints, RefuseWhatHasNoDirection)
{
  const TriangleMesh mesh = PlaneGrid(2, 2).Mesh();
  const TangentFrames faces = FaceFrames(mesh);
  const TangentFrames vertices = VertexFrames(mesh);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const Vector3 x(1.0, 0.0, 0.0);
  for (const auto& [direction, weight] : std::vector<std::pair<Vector3, double>>{
         { Vector3(0.0, 0.0, 1.0), 1.0 }, { Vector3::Zero(), 1.0 }, { nan * x, 1.0 }, { x, 0.0 }, { x, nan } })
  {
    EXPECT_THROW(OneFormConstraintsOnFaces(mesh, faces, { { 1, direction, weight } }), InvalidInput);
    EXPECT_THROW(OneFormConstraintsAtVertices(mesh, faces, vertices, { { 1, direction, weight } }), InvalidInput);
  }
  EXPECT_THROW(OneFormConstraintsOnFaces(mesh, faces, { { 8, x, 1.0 } }), InvalidInput);
  EXPECT_THROW(OneFormConstraintsAtVertices(mesh, faces, vertices, { { 9, x, 1.0 } }), InvalidInput);
}

TEST(OneFormSystem, RefusesWhatItCannotSolve)
{
  const TriangleMesh mesh = Icosphere(0).Mesh();
  const FieldConstraints one{ { 3 }, { 1.0 } };
  FieldConstraints all;
  for (int edge = 0; edge < mesh.NumberOfEdges(); ++edge)
  {
    all.Elements.push_back(edge);
    all.Weights.push_back(1.0);
  }
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(MakeOneFormSystem(mesh, {}, Weights(ConstraintKind::Soft)), InvalidInput);
  EXPECT_THROW(MakeOneFormSystem(mesh, all, Weights(ConstraintKind::Hard)), InvalidInput);
  EXPECT_THROW(MakeOneFormSystem(mesh, one, Weights(ConstraintKind::Soft, nan)), InvalidInput);
  EXPECT_THROW(MakeOneFormSystem(mesh, one, Weights(ConstraintKind::Soft, 1.0, 0.0)), InvalidInput);
  EXPECT_NO_THROW(MakeOneFormSystem(mesh, all, Weights(ConstraintKind::Soft)));
}
