#include "Discretisations/VertexPowerField.h"

#include "Constraints/Guides.h"
#include "Constraints/SurfaceFeatures.h"
#include "FieldSolver.h"
#include "Operators/ConnectionLaplacian.h"
#include "Support/ComplexPairs.h"
#include "Support/Errors.h"
#include "Support/FieldProblem.h"
#include "Support/Identities.h"
#include "Support/MeshFactory.h"
#include "Support/Random.h"
#include "Support/SolverOfUnknowns.h"
#include "Support/TbbContext.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <string>
#include <vector>

using namespace dmg;
using namespace dmg::test;

namespace
{

FieldOptions PointFields(
  int N, ConstraintKind constraints = ConstraintKind::Hard, SolverKind solver = SolverKind::ConjugateGradients)
{
  FieldOptions options;
  options.Field.Kind = DiscretisationKind::VertexPowerField;
  options.Field.N = N;
  options.Constraints = constraints;
  options.Solver.Kind = solver;
  return options;
}

/// How the diagonals of a grid run.
enum class Diagonals
{
  Alike,
  Alternating,
  Random,
};

/// A grid of n by n squares on [-1, 1]^2, mapped to somewhere in the plane.
Surface MappedGrid(int n, Diagonals diagonals, const std::function<Vector3(double, double)>& map)
{
  Surface surface{ Points((n + 1) * (n + 1), 3), Triangles(2 * n * n, 3) };
  Random random(3);
  for (int i = 0; i <= n; ++i)
  {
    for (int j = 0; j <= n; ++j)
    {
      surface.V.row(i * (n + 1) + j) = map(2.0 * i / n - 1.0, 2.0 * j / n - 1.0).transpose();
    }
  }
  for (int i = 0; i < n; ++i)
  {
    for (int j = 0; j < n; ++j)
    {
      const int a = i * (n + 1) + j, b = a + n + 1, c = b + 1, d = a + 1;
      const bool rises = diagonals == Diagonals::Alike || (diagonals == Diagonals::Alternating && (i + j) % 2 == 0) ||
        (diagonals == Diagonals::Random && random.Index(2) == 0);
      const int cell = 2 * (i * n + j);
      if (rises)
      {
        surface.F.row(cell) << a, b, c;
        surface.F.row(cell + 1) << a, c, d;
      }
      else
      {
        surface.F.row(cell) << a, b, d;
        surface.F.row(cell + 1) << b, c, d;
      }
    }
  }
  return surface;
}

Vector3 OnDisc(double x, double y)
{
  return { x * std::sqrt(1.0 - y * y / 2.0), y * std::sqrt(1.0 - x * x / 2.0), 0.0 };
}

/// Cells of 1 : 4, sheared.
Vector3 OnParallelogram(double x, double y)
{
  return { x + 0.25 * y, 0.25 * y, 0.0 };
}

/// Half a ring, its cells sheared along the angle.
Vector3 OnRing(double x, double y)
{
  const double radius = 1.5 + 0.5 * x;
  const double angle = 0.5 * Pi * (y + 0.15 * x);
  return { radius * std::cos(angle), radius * std::sin(angle), 0.0 };
}

/// The N-th powers, in one frame of the plane, of the directions of a solution at the vertices.
Vector<Complex> InThePlane(const FramedMesh& surface, const Vector<double>& unknowns, int N)
{
  const Vector<Complex> x = PowersOfDirection(surface.Vertices, Vector3(1.0, 0.0, 0.0), N);
  return AsComplex(unknowns).cwiseProduct(x.conjugate());
}

/// The error in the mean of squares over that of the solution, where the exact solution is held at the boundary.
double RelativeError(const Surface& shape, int N, const std::function<Complex(Complex)>& harmonic)
{
  const TriangleMesh mesh = shape.Mesh();
  Constraints held;
  const auto exactAt = [&](int vertex) { return harmonic({ mesh.Position(vertex)[0], mesh.Position(vertex)[1] }); };
  for (int vertex = 0; vertex < mesh.NumberOfVertices(); ++vertex)
  {
    if (mesh.IsBoundaryVertex(vertex))
    {
      const Complex power = exactAt(vertex);
      const Complex direction = std::polar(std::abs(power), std::arg(power) / N);
      held.AtVertices.push_back({ vertex, { direction.real(), direction.imag(), 0.0 }, 1.0 });
    }
  }
  SolverOfUnknowns solver(mesh);
  solver.Solve(held, PointFields(N), { 1e-10, 200 });
  EXPECT_TRUE(solver.Report().Converged);
  const Vector<Complex> X = InThePlane(solver.Surface(), solver.Unknowns(), N);
  double ofError = 0.0;
  double ofExact = 0.0;
  for (int vertex = 0; vertex < mesh.NumberOfVertices(); ++vertex)
  {
    ofError += std::norm(X[vertex] - exactAt(vertex));
    ofExact += std::norm(exactAt(vertex));
  }
  return std::sqrt(ofError / ofExact);
}

std::vector<Constraint> SomeDirections(const FramedMesh& surface, int count, unsigned seed)
{
  Random random(seed);
  std::vector<Constraint> directions;
  for (int i = 0; i < count; ++i)
  {
    const int face = random.Index(surface.Mesh.NumberOfFaces());
    const Complex v = std::polar(random.Uniform(0.5, 2.0), random.Uniform(-3.0, 3.0));
    directions.push_back({ face, surface.Faces.ToVector(face, v), random.Uniform(0.5, 2.0) });
  }
  return directions;
}

}

// The power of crosses along the boundary of a disc is r^4 e^{4 i angle}, up to its sign: a harmonic function.
TEST(VertexPowerField, HarmonicPowersAreFoundWithOrderTwoOnAnyTriangles)
{
  const auto power = [](Complex z) { return std::pow(z, 4) + 0.3 * std::conj(z * z * z) + Complex(0.2, 0.1) * z; };
  for (const auto& map : { OnDisc, OnParallelogram, OnRing })
  {
    for (const Diagonals diagonals : { Diagonals::Alike, Diagonals::Alternating, Diagonals::Random })
    {
      for (int N : { 1, 4 })
      {
        const double coarse = RelativeError(MappedGrid(24, diagonals, map), N, power);
        const double fine = RelativeError(MappedGrid(48, diagonals, map), N, power);
        EXPECT_GT(coarse / fine, 3.4) << coarse << ' ' << fine;
        EXPECT_LT(fine, 0.02);
      }
    }
  }
}

TEST(VertexPowerField, OneDirectionOnAFlatPatchGivesTheConstantField)
{
  for (const Surface& shape : { IrregularPlane(8, 6, 4), Disk(4), Annulus(10, 3) })
  {
    const FramedMesh surface(shape.Mesh());
    const Vector3 v(0.28, 0.96, 0.0);
    for (int N = 1; N <= 8; ++N)
    {
      for (const ConstraintKind kind : { ConstraintKind::Soft, ConstraintKind::Hard })
      {
        for (const Constraints& one : { Constraints{ { { 17, v, 1.0 } }, {} }, Constraints{ {}, { { 17, v, 1.0 } } } })
        {
          SolverOfUnknowns solver(surface.Mesh);
          const Vector<Complex> X =
            AsComplex(solver.Solve(one, PointFields(N, kind, SolverKind::Cholesky), { 1e-12, 50 }));
          EXPECT_LT(RelativeDifference(X, PowersOfDirection(surface.Vertices, v, N)), 1e-9);
        }
      }
    }
  }
}

// The penalties of a direction on all faces, and of one at all vertices, are the mass.
TEST(VertexPowerField, WeightsAreSharesOfArea)
{
  const FramedMesh surface(IrregularSphere(2, 3).Mesh());
  const VertexPowerField field(surface, 4);
  Constraints onFaces;
  for (int face = 0; face < surface.Mesh.NumberOfFaces(); ++face)
  {
    onFaces.OnFaces.push_back({ face, surface.Faces.ToVector(face, 1.0), 1.0 });
  }
  const FieldConstraints constraints = field.Prescribe(onFaces, {});
  ASSERT_EQ(constraints.Elements.size(), static_cast<std::size_t>(surface.Mesh.NumberOfVertices()));
  for (const double weight : constraints.Weights)
  {
    EXPECT_NEAR(weight, 1.0, 1e-12);
  }
  const FieldConstraints two = field.Prescribe(
    { {}, { { 9, surface.Vertices.ToVector(9, 1.0), 3.0 }, { 9, surface.Vertices.ToVector(9, { 0.0, 1.0 }), 1.0 } } },
    {});
  EXPECT_EQ(two.Elements, std::vector<int>{ 9 });
  EXPECT_EQ(two.Weights, std::vector<double>{ 4.0 });
  EXPECT_LT((two.Values - Eigen::Vector2d(1.0, 0.0)).norm(), 1e-12); // 0 and 90 degrees agree
}

// A harmonic vector field that is held on the faces of a band is found inside of it with order two.
TEST(VertexPowerField, RegionsOfFacesHoldTheFieldWithOrderTwo)
{
  const auto exactAt = [](const Vector3& p)
  { return Vector3(1.0 + 3.0 * (p[0] * p[0] - p[1] * p[1]), 0.5 - 6.0 * p[0] * p[1], 0.0); };
  std::vector<double> errors;
  for (int n : { 20, 40 })
  {
    const TriangleMesh mesh =
      MappedGrid(n, Diagonals::Alike, [](double x, double y) { return Vector3(x, y, 0.0); }).Mesh();
    Constraints held;
    for (int face = 0; face < mesh.NumberOfFaces(); ++face)
    {
      Vector3 centre = Vector3::Zero();
      for (int k = 0; k < 3; ++k)
      {
        centre += mesh.Position(mesh.FaceCorners()(face, k)) / 3.0;
      }
      if (centre.cwiseAbs().maxCoeff() > 0.75)
      {
        held.OnFaces.push_back({ face, exactAt(centre), 1.0 });
      }
    }
    SolverOfUnknowns solver(mesh);
    solver.Solve(held, PointFields(1), { 1e-10, 200 });
    double largest = 0.0;
    for (int vertex = 0; vertex < mesh.NumberOfVertices(); ++vertex)
    {
      const Vector3 p = mesh.Position(vertex);
      if (p.cwiseAbs().maxCoeff() < 0.75)
      {
        const Complex x(solver.Unknowns()[2 * vertex], solver.Unknowns()[2 * vertex + 1]);
        largest = std::max(largest, (solver.Surface().Vertices.ToVector(vertex, x) - exactAt(p)).norm());
      }
    }
    errors.push_back(largest);
  }
  EXPECT_LT(errors[1], 0.02);
  EXPECT_GT(errors[0] / errors[1], 3.0) << errors[0] << ' ' << errors[1];
}

// Along a side of a face, its two ends are held, with half of the face each.
TEST(VertexPowerField, DirectionsAlongSidesHoldTheirEnds)
{
  const FramedMesh surface(IrregularPlane(8, 6, 4).Mesh());
  const VertexPowerField field(surface, 4);
  const Vector<double> areas = LumpedMass(surface.Mesh);
  const int face = 31;
  for (int side = 0; side < 3; ++side)
  {
    const FieldConstraints held = field.Prescribe({ { { face, { 0.6, 0.8, 0.0 }, 3.0, side } }, {} }, {});
    const int h = 3 * face + side;
    const auto ends = std::minmax({ surface.Mesh.Tail(h), surface.Mesh.Head(h) });
    ASSERT_EQ(held.Elements, (std::vector<int>{ ends.first, ends.second }));
    for (int end = 0; end < 2; ++end)
    {
      EXPECT_NEAR(held.Weights[end], 1.5 * surface.Mesh.FaceArea(face) / areas[held.Elements[end]], 1e-12);
    }
  }
}

// Also where a line passes all faces around a vertex, which are no region that is prescribed as a whole.
TEST(VertexPowerField, GuidesWeighTheSameWhereverTheyRun)
{
  const int n = 40;
  const FramedMesh surface(IrregularPlane(n, n, 3).Mesh());
  const NearestPlaces places(surface);
  const VertexPowerField field(surface, 1);
  const Vector<double> areas = LumpedMass(surface.Mesh);
  const WeightsOfFaces weights(surface.Mesh, places.Sizes);
  const double expected = weights.OfLine(0, n) * surface.Mesh.FaceArea(0); // whatever the face
  for (double x = 1.02; x < n - 1.0; x += 0.51)
  {
    const Guides guide{ { { { { x, 0.0, 0.0 }, { x, 1.0 * n, 0.0 } } } } };
    const FieldConstraints held = field.Prescribe({ FollowGuides(guide, places).Directions, {} }, {});
    double sum = 0.0;
    for (std::size_t k = 0; k < held.Elements.size(); ++k)
    {
      sum += held.Weights[k] * areas[held.Elements[k]];
    }
    EXPECT_NEAR(sum, expected, 1e-3 * expected) << x;
  }
}

// An ellipse through points at uneven distances.
TEST(VertexPowerField, TangentsOfTheBoundaryHaveOrderTwoOnUnevenEdges)
{
  const auto error = [](int number)
  {
    Surface fan{ Points(2 * number + 1, 3), Triangles(2 * number, 3) };
    const double step = Pi / (2.0 * number);
    fan.V.row(0).setZero();
    for (int k = 0; k < 2 * number; ++k)
    {
      const double angle = step * (2.0 * k + (k % 2 == 0 ? 0.5 : -0.5)); // distances of 1 and 3 steps
      fan.V.row(k + 1) << 2.0 * std::cos(angle), std::sin(angle), 0.0;
      fan.F.row(k) << 0, k + 1, (k + 1) % (2 * number) + 1;
    }
    const FramedMesh surface(fan.Mesh());
    const WeightsOfFaces weights(surface.Mesh, SizesOf(surface.Mesh));
    const FieldConstraints held =
      VertexPowerField(surface, 1).Prescribe({ AlongBoundary(surface.Mesh, weights, 1.0), {} }, {});
    EXPECT_EQ(held.Elements.size(), static_cast<std::size_t>(2 * number));
    double largest = 0.0;
    for (std::size_t k = 0; k < held.Elements.size(); ++k)
    {
      const Vector3 place = surface.Mesh.Position(held.Elements[k]);
      const Complex exact = surface.Vertices.ToComplex(held.Elements[k], { -2.0 * place[1], 0.5 * place[0], 0.0 });
      const Complex found(held.Values[2 * k], held.Values[2 * k + 1]);
      largest = std::max(largest, std::abs(std::arg(found / exact)));
    }
    return largest;
  };
  EXPECT_LT(error(16), 0.3 * error(8));
  EXPECT_LT(error(32), 0.3 * error(16));
}

TEST(VertexPowerField, IsItsStatedEnergy)
{
  const FramedMesh surface(IrregularTorus(10, 6, 1).Mesh());
  const Vector<double> areas = LumpedMass(surface.Mesh);
  Random random(2);
  for (int N : { 1, 4, 8 })
  {
    FieldOptions options = PointFields(N, ConstraintKind::Soft, SolverKind::Cholesky);
    options.Smoothness = 0.25;
    options.Alignment = 3.0;
    const Constraints prescribed{ SomeDirections(surface, 7, 3), {} };
    SolverOfUnknowns solver(surface.Mesh);
    const Vector<Complex> X = AsComplex(solver.Solve(prescribed, options, { 1e-13, 50 }));
    const FieldConstraints& constraints = solver.Constrained();
    // The gradient of the energy vanishes.
    Vector<Complex> gradient = 0.25 * (ConnectionLaplacian(surface.Mesh, VertexConnection(surface), N) * X);
    for (std::size_t b = 0; b < constraints.Elements.size(); ++b)
    {
      const int vertex = constraints.Elements[b];
      gradient[vertex] += 3.0 * constraints.Weights[b] * areas[vertex] / areas.mean() *
        (X[vertex] - Complex(constraints.Values[2 * b], constraints.Values[2 * b + 1]));
    }
    EXPECT_LT(gradient.cwiseAbs().maxCoeff(), 1e-9);
  }
}

TEST(VertexPowerField, SolversAndLevelsAgree)
{
  for (const Surface& shape : { IrregularSphere(4, 3), IrregularTorus(64, 32, 4), IrregularPlane(60, 50, 5) })
  {
    const FramedMesh surface(shape.Mesh());
    for (const ConstraintKind kind : { ConstraintKind::Soft, ConstraintKind::Hard })
    {
      const Constraints prescribed{ SomeDirections(surface, 20, 5), {} };
      SolverOfUnknowns direct(surface.Mesh);
      const Vector<double> expected =
        direct.Solve(prescribed, PointFields(4, kind, SolverKind::Cholesky), { 1e-12, 100 });
      for (const CoarseSpaceKind space : { CoarseSpaceKind::LinearInterpolation, CoarseSpaceKind::StructurePreserving })
      {
        FieldOptions options = PointFields(4, kind);
        options.CoarseSpace = space;
        SolverOfUnknowns solver(surface.Mesh);
        const Vector<double> x = solver.Solve(prescribed, options, { 1e-12, 100 });
        EXPECT_LE((x - expected).norm(), 1e-9 * expected.norm()) << solver.Report().Solver;
        EXPECT_LE(solver.Report().Iterations.size(), 26u) << solver.Report().Solver;
      }
    }
  }
}

TEST(VertexPowerField, FollowsRotationAndScale)
{
  const Surface shape = IrregularTorus(12, 8, 9);
  const FramedMesh surface(shape.Mesh());
  Eigen::Matrix3d rotation;
  const FramedMesh moved(RotatedAndScaled(shape, 2.1, 1e-3, &rotation).Mesh());
  Constraints prescribed{ SomeDirections(surface, 6, 10), {} };
  Constraints there = prescribed;
  for (Constraint& direction : there.OnFaces)
  {
    direction.Direction = rotation * direction.Direction;
  }
  for (const ConstraintKind kind : { ConstraintKind::Soft, ConstraintKind::Hard })
  {
    SolverOfUnknowns here(surface.Mesh);
    SolverOfUnknowns elsewhere(moved.Mesh);
    const FieldOptions options = PointFields(4, kind, SolverKind::Cholesky);
    const Vector<double> x = here.Solve(prescribed, options, { 1e-12, 50 });
    const Vector<double> y = elsewhere.Solve(there, options, { 1e-12, 50 });
    EXPECT_LT((x - y).cwiseAbs().maxCoeff(), 1e-8 * x.cwiseAbs().maxCoeff()); // the frames move along
  }
}

// The report has the Dirichlet energy over the integral of |X|^2: N on the unit sphere.
TEST(VertexPowerField, TheSmoothestFieldOnASphereHasTheKnownEigenvalue)
{
  for (int N : { 1, 2, 4 })
  {
    SolverOfUnknowns solver(IrregularSphere(5, 3).Mesh());
    solver.Solve({}, PointFields(N, ConstraintKind::Soft));
    ASSERT_EQ(solver.Report().Eigenvalues.size(), 1u);
    EXPECT_NEAR(solver.Report().Eigenvalues[0], N, 0.005 * N);
  }
}

TEST(VertexPowerField, ZeroAreaFacesGetAField)
{
  const FramedMesh surface(SphereWithZeroAreaFaces(3, 8).Mesh());
  for (int N : { 1, 4 })
  {
    SolverOfUnknowns solver(surface.Mesh);
    const Vector<double> x =
      solver.Solve({ SomeDirections(surface, 4, 14), {} }, PointFields(N, ConstraintKind::Soft, SolverKind::Cholesky));
    EXPECT_TRUE(x.allFinite());
    EXPECT_LT(x.cwiseAbs().maxCoeff(), 3.0); // prescribed are up to 2
  }
}

TEST(VertexPowerField, HasTheSameBitsForAnyNumberOfThreads)
{
  const FramedMesh surface(IrregularTorus(80, 60, 4).Mesh());
  const auto solve = [&](const ExecutionContext& context)
  {
    SolverOfUnknowns solver(surface.Mesh, context);
    return solver.Solve({ SomeDirections(surface, 20, 5), {} }, PointFields(4, ConstraintKind::Soft), {}, context);
  };
  const Vector<double> expected = solve(SerialContext());
  EXPECT_EQ(solve(TbbContext(2)), expected);
  EXPECT_EQ(solve(TbbContext(3)), expected);
}

TEST(VertexPowerField, RefusesWhatItCannotSolve)
{
  const FramedMesh surface(Icosphere(1).Mesh());
  EXPECT_THROW(VertexPowerField(surface, 0), InvalidInput);
  EXPECT_THROW(VertexPowerField(surface, 9), InvalidInput);
  const VertexPowerField field(surface, 4);
  const Vector3 outwards = surface.Mesh.Position(5);
  const Vector3 nan(std::nan(""), 0.0, 0.0);
  for (const Constraints& wrong : { Constraints{ { { -1, outwards, 1.0 } }, {} },
         Constraints{ {}, { { 42, outwards, 1.0 } } }, Constraints{ {}, { { 5, outwards, 1.0 } } },
         Constraints{ { { 5, nan, 1.0 } }, {} }, Constraints{ {}, { { 5, { 1.0, 2.0, 3.0 }, 0.0 } } } })
  {
    EXPECT_THROW(field.Prescribe(wrong, {}), InvalidInput);
  }
}
