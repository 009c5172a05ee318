// Fields where nothing is prescribed: the lowest eigenvectors of the smoothness energy.

#include "Directions/FieldTopology.h"
#include "Directions/PowerFieldDirections.h"
#include "Discretisations/MakeDiscretisation.h"
#include "FieldSolver.h"
#include "Support/ComplexPairs.h"
#include "Support/MeshFactory.h"
#include "Support/SolverOfUnknowns.h"
#include "Support/TbbContext.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <gtest/gtest.h>

#include <map>
#include <string>
#include <vector>

using namespace dmg;
using namespace dmg::test;

namespace
{

FieldOptions OptionsOf(DiscretisationKind kind, int N, SolverKind solver = SolverKind::Automatic)
{
  FieldOptions options;
  options.Field.Kind = kind;
  options.Field.N = N;
  options.Solver.Kind = solver;
  return options;
}

/// By a dense eigensolver, with the integral over the surface as inner product.
struct DenseEigenvectors
{
  Vector<double> Values;   ///< ascending
  Eigen::MatrixXd Vectors; ///< columns, orthonormal in Mass
  Vector<double> Mass;     ///< of unknowns

  DenseEigenvectors(const FramedMesh& surface, const FieldOptions& options, bool isPrecise = false)
  {
    const auto field = MakeDiscretisation(options.Field, surface);
    const Eigen::MatrixXd matrix = this->Matrix(*field);
    const Vector<double> mass = field->Mass(SerialContext());
    const Eigen::Index size = matrix.rows();
    this->Mass.resize(size);
    for (Eigen::Index i = 0; i < size; ++i)
    {
      this->Mass[i] = mass[i * mass.size() / size];
    }
    const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> solver(
      matrix, Eigen::MatrixXd(this->Mass.asDiagonal()));
    this->Values = solver.eigenvalues();
    this->Vectors = solver.eigenvectors();
    this->Unit = field->SquaredNormOfUnit(mass) / surface.Mesh.FaceAreas().sum();
    if (isPrecise)
    {
      this->FindLowestPrecisely(matrix);
    }
  }

  /// As it is reported, for fields of unit norm.
  double Lowest() const { return this->Values[0] * this->Unit; }

private:
  static Eigen::MatrixXd Matrix(const Discretisation& field)
  {
    const auto hierarchy = field.Assemble(nullptr, CoarseSpaceKind::LinearInterpolation, SerialContext());
    const auto R = hierarchy->Operator();
    const int size = field.NumberOfUnknowns();
    R->SetDiagonal(Vector<double>::Zero(size), SerialContext());
    Eigen::MatrixXd matrix(size, size);
    Vector<double> column(size);
    for (int i = 0; i < size; ++i)
    {
      R->Apply(Vector<double>::Unit(size, i), column, SerialContext());
      for (int j = 0; j < size; ++j)
      {
        matrix(hierarchy->Order[j], hierarchy->Order[i]) = column[j];
      }
    }
    return matrix;
  }

  /// The lowest few anew, by inverse iteration in extended precision: the dense solver's errors are about 1e-16 times the
  /// largest eigenvalue.
  void FindLowestPrecisely(const Eigen::MatrixXd& matrix)
  {
    using Long = Eigen::Matrix<long double, Eigen::Dynamic, Eigen::Dynamic>;
    const Long M = this->Mass.cast<long double>().asDiagonal();
    const Long R = (0.5 * (matrix + matrix.transpose())).cast<long double>();
    const long double shift = 1e-3L / M.trace();
    const Eigen::LDLT<Long> factor(R + shift * M);
    const Eigen::Index width = std::min<Eigen::Index>(12, M.rows());
    Long X = this->Vectors.leftCols(width).cast<long double>();
    Eigen::GeneralizedSelfAdjointEigenSolver<Long> ritz;
    for (int k = 0; k < 30; ++k)
    {
      X = factor.solve(M * X).eval();
      ritz.compute(X.transpose() * R * X, X.transpose() * M * X);
      X *= ritz.eigenvectors();
    }
    this->Values.head(width) = ritz.eigenvalues().cast<double>();
    this->Vectors.leftCols(width) = X.cast<double>();
  }

  double Unit;
};

FieldTopology TopologyOf(const SolverOfUnknowns& solver)
{
  const auto& [mesh, faces, vertices] = solver.Surface();
  const Points directions = solver.Directions(0);
  Vector<Complex> first(directions.rows());
  for (int face = 0; face < mesh.NumberOfFaces(); ++face)
  {
    first[face] = faces.ToComplex(face, directions.row(face).transpose());
  }
  return TopologyOfField(mesh, faces, first, solver.Field().DirectionsPerPoint());
}

/// How many singularities have which index, a multiple of 1 / N.
std::map<int, int> SingularitiesOf(const SolverOfUnknowns& solver)
{
  std::map<int, int> numbers;
  for (const double index : TopologyOf(solver).Indices)
  {
    const int times = static_cast<int>(std::lround(index * solver.Field().DirectionsPerPoint()));
    if (times != 0)
    {
      ++numbers[times];
    }
  }
  return numbers;
}

/// Its area is 4 pi.
Surface Ellipsoid(int subdivisions, const Vector3& axes)
{
  Surface surface = IrregularSphere(subdivisions, 7);
  surface.V = surface.V * axes.asDiagonal();
  return surface;
}

/// The cube [-1, 1]^3, from a sphere whose points are moved along the rays through its centre.
Surface Cube(int subdivisions)
{
  Surface surface = IrregularSphere(subdivisions, 7, 0.1);
  for (Eigen::Index v = 0; v < surface.V.rows(); ++v)
  {
    surface.V.row(v) /= surface.V.row(v).cwiseAbs().maxCoeff();
  }
  return surface;
}

/// A disc with two fans of triangles and a rim between them.
Surface ThinDisc(int sides, double height)
{
  Surface disc;
  disc.V.resize(2 * sides, 3);
  disc.F.resize(4 * sides - 4, 3);
  int face = 0;
  for (int i = 0; i < sides; ++i)
  {
    const double angle = 2.0 * Pi * i / sides;
    disc.V.row(i) << std::cos(angle), std::sin(angle), 0.0;
    disc.V.row(sides + i) << std::cos(angle), std::sin(angle), height;
    const int next = (i + 1) % sides;
    disc.F.row(face++) << i, next, sides + next;
    disc.F.row(face++) << i, sides + next, sides + i;
    if (i > 0 && i + 1 < sides)
    {
      disc.F.row(face++) << 0, i + 1, i;
      disc.F.row(face++) << sides, sides + i, sides + i + 1;
    }
  }
  return disc;
}

const std::vector<std::pair<std::string, Surface>>& SmallSurfaces()
{
  static const std::vector<std::pair<std::string, Surface>> surfaces{ { "sphere", IrregularSphere(2, 3) },
    { "ellipsoid", Ellipsoid(2, { 1.0, 1.3, 2.0 }) }, { "torus", IrregularTorus(16, 10, 4) },
    { "double torus", DoubleTorus(1) }, { "plane", IrregularPlane(14, 10, 3) }, { "annulus", Annulus(18, 4) },
    { "genus 3", PerforatedSlab(3, 1, 1) }, { "genus 4", PerforatedSlab(2, 2, 1) } };
  return surfaces;
}

}

TEST(SmoothestField, HasTheEigenvalueOfADenseSolver)
{
  const std::vector<FieldOptions> fields{ OptionsOf(DiscretisationKind::PowerField, 1),
    OptionsOf(DiscretisationKind::PowerField, 2), OptionsOf(DiscretisationKind::PowerField, 4),
    OptionsOf(DiscretisationKind::PowerField, 6), OptionsOf(DiscretisationKind::VertexPowerField, 1),
    OptionsOf(DiscretisationKind::VertexPowerField, 4), OptionsOf(DiscretisationKind::VertexPowerField, 6),
    OptionsOf(DiscretisationKind::FaceField, 1), OptionsOf(DiscretisationKind::OneForm, 1) };
  for (const auto& [name, surface] : SmallSurfaces())
  {
    for (const FieldOptions& options : fields)
    {
      SolverOfUnknowns solver(surface.Mesh());
      solver.Solve({}, options, { 1e-6, 300 });
      EXPECT_TRUE(solver.Report().Converged) << name;
      ASSERT_EQ(solver.Report().Eigenvalues.size(), 1u) << name;
      const double expected = DenseEigenvectors(solver.Surface(), options).Lowest();
      const double scale = 1.0 / solver.Surface().Mesh.FaceAreas().sum();
      EXPECT_NEAR(solver.Report().Eigenvalues[0], expected, 1e-9 * expected + 1e-10 * scale)
        << name << ", " << solver.Field().Name();
    }
  }
}

// At the default tolerance, too, which is meant for what is prescribed. The residual is the error times the relative distance to
// the next eigenvalue. Eigenvalues of power fields are double: a field and its quarter turn as a power.
TEST(SmoothestField, IsTheEigenvectorOfADenseSolver)
{
  for (const auto& [fieldKind, N] : { std::pair(DiscretisationKind::PowerField, 1),
         std::pair(DiscretisationKind::PowerField, 2), std::pair(DiscretisationKind::PowerField, 4),
         std::pair(DiscretisationKind::VertexPowerField, 1), std::pair(DiscretisationKind::VertexPowerField, 4) })
  {
    const FieldOptions options = OptionsOf(fieldKind, N);
    for (const SolverKind kind : { SolverKind::Cholesky, SolverKind::ConjugateGradients })
    {
      SolverOfUnknowns solver(Ellipsoid(2, { 1.0, 1.3, 2.0 }).Mesh());
      solver.Solve({}, OptionsOf(options.Field.Kind, N, kind), { 1e-4, 100 });
      const DenseEigenvectors expected(solver.Surface(), options);
      const auto lowest = expected.Vectors.leftCols(2);
      const auto inMass = [&](const Vector<double>& x) { return std::sqrt(x.cwiseAbs2().dot(expected.Mass)); };
      const Vector<double>& x = solver.Unknowns();
      const Vector<double> error = x - lowest * (lowest.transpose() * expected.Mass.cwiseProduct(x));
      const double distance = 1.0 - expected.Values[0] / expected.Values[2];
      EXPECT_LT(distance * inMass(error), 1e-5 * inMass(x)) << "N = " << N;
    }
  }
}

// On the unit sphere, fields of N directions have the lowest eigenvalue N of Bochner's Laplacian 2 N + 1 times: of spherical
// harmonics of spin N, l (l + 1) - N^2 for l = N. The smoothness energy is twice that. Triangles split it into values close together.
TEST(SmoothestField, IsFoundOnSpheresWhereManyAreAlmostAsSmooth)
{
  for (const int N : { 3, 7 })
  {
    SolverOfUnknowns solver(IrregularSphere(5, 3, 0.3).Mesh());
    solver.Solve({}, OptionsOf(DiscretisationKind::PowerField, N, SolverKind::ConjugateGradients), { 1e-4, 100 });
    EXPECT_TRUE(solver.Report().Converged) << N;
    EXPECT_NEAR(solver.Report().Eigenvalues[0], 2.0 * N, 0.04 * 2.0 * N) << N;
  }
}

// Both sides of a thin plate have fields of almost the same eigenvalue, and the triangles of its rim have another scale.
TEST(SmoothestField, IsFoundOnThinPlates)
{
  for (const double height : { 1e-1, 1e-2, 1e-3, 1e-4, 1e-5, 1e-6 })
  {
    const TriangleMesh mesh = ThinDisc(14, height).Mesh();
    for (const DiscretisationKind kind : { DiscretisationKind::PowerField, DiscretisationKind::VertexPowerField,
           DiscretisationKind::FaceField, DiscretisationKind::OneForm })
    {
      for (const int N : { 1, 2, 4, 6 })
      {
        if (N > 1 && kind != DiscretisationKind::PowerField && kind != DiscretisationKind::VertexPowerField)
        {
          continue;
        }
        SolverOfUnknowns solver(mesh);
        solver.Solve({}, OptionsOf(kind, N), { 1e-4, 100 });
        const std::string name = solver.Field().Name() + ", height " + std::to_string(1e6 * height);
        EXPECT_TRUE(solver.Report().Converged) << name;
        const DenseEigenvectors expected(solver.Surface(), OptionsOf(kind, N), true);
        ASSERT_EQ(solver.Report().Eigenvalues.size(), 1u) << name;
        EXPECT_NEAR(solver.Report().Eigenvalues[0], expected.Lowest(), 1e-5 * std::max(1.0, expected.Lowest())) << name;
      }
    }
  }
}

// The factor that small surfaces take and the cycles of large ones find the same field, if it is the only one.
TEST(SmoothestField, IsTheSameBySolversOfAllKinds)
{
  for (const DiscretisationKind kind : { DiscretisationKind::PowerField, DiscretisationKind::VertexPowerField,
         DiscretisationKind::FaceField, DiscretisationKind::OneForm })
  {
    const TriangleMesh mesh = Ellipsoid(4, { 1.0, 1.3, 2.0 }).Mesh();
    SolverOfUnknowns factored(mesh);
    factored.Solve({}, OptionsOf(kind, 1, SolverKind::Cholesky), { 1e-4, 100 });
    const double expected = factored.Report().Eigenvalues[0];
    for (const SolverKind solverKind : { SolverKind::ConjugateGradients, SolverKind::VCycles,
           SolverKind::NestedIterations, SolverKind::CoarseProlongation })
    {
      SolverOfUnknowns solver(mesh);
      solver.Solve({}, OptionsOf(kind, 1, solverKind), { 1e-4, 100 });
      EXPECT_TRUE(solver.Report().Converged);
      EXPECT_LE(solver.Report().Iterations.size(), 40u);
      EXPECT_NEAR(solver.Report().Eigenvalues[0], expected, 1e-9 * expected);
    }
  }
}

// What a coarse level knows need not be found on the finest one.
TEST(SmoothestField, StartsFromThatOfTheCoarseLevel)
{
  const TriangleMesh mesh =
    Union(IrregularTorus(96, 48, 4), Ellipsoid(4, { 1.0, 1.3, 2.0 }), Vector3(5.0, 0.0, 0.0)).Mesh();
  for (const DiscretisationKind kind : { DiscretisationKind::PowerField, DiscretisationKind::VertexPowerField })
  {
    SolverOfUnknowns solver(mesh);
    solver.Solve({}, OptionsOf(kind, 4, SolverKind::ConjugateGradients), { 1e-4, 100 });
    EXPECT_TRUE(solver.Report().Converged);
    EXPECT_EQ(solver.Report().Eigenvalues.size(), 2u);
    EXPECT_LT(solver.Report().Iterations.front().RelativeResidual, 0.5); // a random start has more than 1
  }
}

TEST(SmoothestField, TakesMoreIterationsForASmallerTolerance)
{
  SolverOfUnknowns solver(Ellipsoid(4, { 1.0, 1.3, 2.0 }).Mesh());
  const FieldOptions options = OptionsOf(DiscretisationKind::VertexPowerField, 4, SolverKind::ConjugateGradients);
  std::size_t former = 0;
  for (const double tolerance : { 1e-2, 1e-4, 1e-6 })
  {
    solver.Solve({}, options, { tolerance, 100 });
    EXPECT_TRUE(solver.Report().Converged);
    EXPECT_LE(solver.Report().Iterations.back().RelativeResidual, 1e-2 * tolerance);
    EXPECT_GT(solver.Report().Iterations.size(), former);
    former = solver.Report().Iterations.size();
  }
}

// The spheres' are those of Knoeppel et al. 2013, figures 1 and 4: 2 N singularities of index 1 / N.
TEST(SmoothestField, HasTheSingularitiesOfTheLiterature)
{
  const auto expectAll = [](const Surface& surface, int N, int number)
  {
    SolverOfUnknowns solver(surface.Mesh());
    solver.Solve({}, OptionsOf(DiscretisationKind::PowerField, N), { 1e-5, 300 });
    EXPECT_EQ(SingularitiesOf(solver), (std::map<int, int>{ { 1, number } })) << "N = " << N;
    FieldSolver atVertices(surface.Mesh());
    FieldProblem problem;
    problem.Options = OptionsOf(DiscretisationKind::VertexPowerField, N);
    problem.Stop = { 1e-5, 300 };
    const Vector<double> indices = atVertices.Solve(problem).Indices; // of faces
    EXPECT_EQ((indices.array() != 0.0).count(), number) << "N = " << N;
    EXPECT_NEAR(indices.sum(), 2.0, 1e-12) << "N = " << N;
  };
  for (const int N : { 1, 2, 4, 6 })
  {
    expectAll(IrregularSphere(4, 3), N, 2 * N);
    expectAll(Ellipsoid(4, { 1.0, 1.2, 1.5 }), N, 2 * N);
  }
  // At its corners.
  expectAll(Cube(4), 4, 8);
  SolverOfUnknowns cube(Cube(4).Mesh());
  cube.Solve({}, OptionsOf(DiscretisationKind::PowerField, 4));
  const Vector<double> indices = TopologyOf(cube).Indices;
  for (int v = 0; v < indices.size(); ++v)
  {
    if (indices[v] > 0.1)
    {
      EXPECT_GE(cube.Surface().Mesh.Position(v).norm(), 1.6) << v;
    }
  }
}

TEST(SmoothestField, HasIndicesThatSumToTheEulerCharacteristic)
{
  const std::map<std::string, int> characteristics{ { "sphere", 2 }, { "ellipsoid", 2 }, { "torus", 0 },
    { "double torus", -2 }, { "plane", 1 }, { "annulus", 0 }, { "genus 3", -4 }, { "genus 4", -6 } };
  for (const auto& [name, surface] : SmallSurfaces())
  {
    for (int N = 1; N <= 6; ++N)
    {
      SolverOfUnknowns solver(surface.Mesh());
      solver.Solve({}, OptionsOf(DiscretisationKind::PowerField, N));
      const FieldTopology topology = TopologyOf(solver);
      double sum = topology.Indices.sum();
      for (const BoundaryIndex& loop : topology.Loops)
      {
        sum += loop.Index;
      }
      EXPECT_NEAR(sum, characteristics.at(name), 1e-9) << name << ", N = " << N;
    }
  }
}

// Harmonic fields have no energy.
TEST(SmoothestField, IsHarmonicWhereTheSurfaceHasHandlesOrHoles)
{
  for (const Surface& surface : { IrregularTorus(48, 24, 4), Annulus(60, 12), DoubleTorus(3) })
  {
    for (const DiscretisationKind kind : { DiscretisationKind::FaceField, DiscretisationKind::OneForm })
    {
      for (const SolverKind solverKind : { SolverKind::ConjugateGradients, SolverKind::Cholesky })
      {
        SolverOfUnknowns solver(surface.Mesh());
        solver.Solve({}, OptionsOf(kind, 1, solverKind));
        EXPECT_TRUE(solver.Report().Converged);
        const double area = solver.Surface().Mesh.FaceAreas().sum();
        EXPECT_NEAR(solver.Report().Eigenvalues[0] * area, 0.0, 1e-6);
        // The masses of edges are areas on the average over directions.
        EXPECT_NEAR(
          solver.Directions(0).rowwise().squaredNorm().dot(solver.Surface().Mesh.FaceAreas()), area, 0.2 * area);
      }
    }
  }
}

// Each component has what it would have alone.
TEST(SmoothestField, StandsBesideGuidedComponents)
{
  const Surface guided = IrregularTorus(48, 24, 4);
  const Surface other = Ellipsoid(3, { 1.0, 1.3, 2.0 });
  for (const DiscretisationKind kind : { DiscretisationKind::PowerField, DiscretisationKind::VertexPowerField,
         DiscretisationKind::FaceField, DiscretisationKind::OneForm })
  {
    const StoppingCriteria stop{ 1e-7, 200 };
    FieldOptions options = OptionsOf(kind, 2, SolverKind::ConjugateGradients);
    options.Constraints = ConstraintKind::Hard; // the weights of soft ones know the whole surface
    const Constraints directions{ { { 5, Vector3(0.3, 0.2, 0.9), 1.0 }, { 700, Vector3(0.3, -0.2, 0.5), 1.0 } }, {},
      {} };
    SolverOfUnknowns both(Union(guided, other, Vector3(5.0, 0.0, 0.0)).Mesh());
    both.Solve(directions, options, stop);
    SolverOfUnknowns first(guided.Mesh());
    first.Solve(directions, options, stop);
    SolverOfUnknowns second(other.Mesh());
    second.Solve({}, options, stop);
    EXPECT_TRUE(both.Report().Converged);
    EXPECT_TRUE(both.Report().Warnings.empty());
    const Points directionsOfBoth = both.Directions(0);
    EXPECT_LE(
      (directionsOfBoth.topRows(guided.F.rows()) - first.Directions(0)).norm(), 1e-5 * first.Directions(0).norm());
    ASSERT_EQ(both.Report().Eigenvalues.size(), 1u);
    EXPECT_NEAR(both.Report().Eigenvalues[0], second.Report().Eigenvalues[0], 1e-8 * second.Report().Eigenvalues[0]);
  }
}

// Scans have such triangles. On one without area no field is smoother than another.
TEST(SmoothestField, IsZeroOnSplintersWithoutArea)
{
  Surface splinter;
  splinter.V.resize(3, 3);
  splinter.V << 3, 0, 0, 4, 0, 0, 5, 0, 0;
  splinter.F.resize(1, 3);
  splinter.F << 0, 1, 2;
  const Surface sphere = IrregularSphere(3, 5);
  const TriangleMesh mesh = Union(sphere, splinter, Vector3::Zero()).Mesh();
  const Constraints oneDirection{ { { 5, Vector3(0.3, 0.2, 0.9), 1.0 } }, {}, {} };
  for (const DiscretisationKind kind : { DiscretisationKind::PowerField, DiscretisationKind::FaceField })
  {
    for (const Constraints& directions : { Constraints(), oneDirection })
    {
      SolverOfUnknowns solver(mesh);
      solver.Solve(directions, OptionsOf(kind, 4), {});
      EXPECT_TRUE(solver.Report().Converged);
      ASSERT_EQ(solver.Report().Warnings.size(), 1u);
      EXPECT_NE(solver.Report().Warnings[0].find("have no area; the field is zero there"), std::string::npos);
      const Points field = solver.Directions(0);
      EXPECT_TRUE(field.allFinite());
      EXPECT_GT(field.topRows(sphere.F.rows()).rowwise().norm().minCoeff(), 0.0);
      EXPECT_EQ(field.row(sphere.F.rows()), Vector3::Zero().transpose());
    }
  }
}

TEST(SmoothestField, HasTheSameBitsForAnyNumberOfThreads)
{
  const TriangleMesh mesh = IrregularSphere(5, 3).Mesh();
  SolverOfUnknowns one(mesh);
  SolverOfUnknowns three(mesh);
  const FieldOptions options = OptionsOf(DiscretisationKind::PowerField, 4, SolverKind::ConjugateGradients);
  EXPECT_EQ(one.Solve({}, options), three.Solve({}, options, {}, TbbContext(3)));
}
