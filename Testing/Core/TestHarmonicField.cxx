#include "Discretisations/MakeDiscretisation.h"
#include "Operators/PowerFieldOperators.h"
#include "PreparedSurface.h"
#include "Support/Errors.h"
#include "Support/FieldProblem.h"
#include "Support/FieldSystems.h"
#include "Support/Identities.h"
#include "Support/MeshFactory.h"
#include "Support/Random.h"
#include "Support/TbbContext.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

using namespace dmg;
using namespace dmg::test;

namespace
{

FieldConstraints Every(int step, int faces)
{
  FieldConstraints prescribed;
  for (int f = 0; f < faces; f += step)
  {
    prescribed.Elements.push_back(f);
    prescribed.Weights.push_back(1.0);
  }
  return prescribed;
}

Vector<Complex> Solve(const PreparedSurface& on, const FieldConstraints& prescribed, const Vector<Complex>& values,
  const FieldOptions& options, const ExecutionContext& context = SerialContext())
{
  PowerFieldProblem problem(on.Framed, &on.Operators, prescribed, options, context);
  const Vector<Complex> field = problem.Solve(values, {}, Tight(), context);
  EXPECT_TRUE(problem.Report().Converged);
  return field;
}

}

TEST(HarmonicField, SolversAgree)
{
  for (const Surface& surface :
    { IrregularSphere(4, 3), IrregularTorus(48, 20, 4), DoubleTorus(4), IrregularPlane(30, 24, 5) })
  {
    const PreparedSurface on(surface);
    const FieldConstraints prescribed = Every(97, on.Mesh.NumberOfFaces());
    Random random(71);
    const Vector<Complex> values = random.Numbers(static_cast<int>(prescribed.Elements.size()));
    for (int N : { 1, 2, 4, 6 })
    {
      for (ConstraintKind constraints : { ConstraintKind::Soft, ConstraintKind::Hard })
      {
        FieldOptions options = PowersOnFaces();
        options.Field.N = N;
        options.Constraints = constraints;
        options.Solver.Kind = SolverKind::Cholesky;
        const Vector<Complex> direct = Solve(on, prescribed, values, options);
        for (SolverKind solver : { SolverKind::ConjugateGradients, SolverKind::VCycles })
        {
          for (CoarseSpaceKind space : { CoarseSpaceKind::LinearInterpolation, CoarseSpaceKind::StructurePreserving })
          {
            options.Solver.Kind = solver;
            options.CoarseSpace = space;
            EXPECT_LT(RelativeDifference(Solve(on, prescribed, values, options), direct), 1e-8);
          }
        }
      }
    }
  }
}

// A constant field has no energy on a flat patch, so one prescribed direction spreads over all of it.
TEST(HarmonicField, OneDirectionFillsAFlatPatch)
{
  const PreparedSurface on(IrregularPlane(40, 30, 9));
  const Vector3 direction(0.28, 0.96, 0.0);
  for (int N = 1; N <= 8; ++N)
  {
    const FieldConstraints constraints = MakePowerConstraints(on.Mesh, on.Frames, N, { { 1234, direction, 1.0 } });
    for (SolverKind solver : { SolverKind::Cholesky, SolverKind::ConjugateGradients })
    {
      FieldOptions options = PowersOnFaces();
      options.Field.N = N;
      options.Solver.Kind = solver;
      const Vector<Complex> field = Solve(on, constraints, ComplexValues(constraints), options);
      EXPECT_LT(RelativeDifference(field, PowersOfDirection(on.Frames, direction, N)), 1e-8);
    }
  }
}

// The same without a plane: a torus whose angles sum to 2 pi at every vertex and whose holonomy is
// trivial carries a field without energy, and without singularities, of any N.
TEST(HarmonicField, AFlatTorusCarriesAParallelField)
{
  const PreparedSurface on(FlatTorus(12, 3));
  for (int N : { 1, 2, 4 })
  {
    FieldConstraints prescribed;
    prescribed.Elements = { 17 };
    prescribed.Weights = { 1.0 };
    Vector<Complex> values(1);
    values[0] = Complex(0.6, 0.8);
    FieldOptions options = PowersOnFaces();
    options.Field.N = N;
    const Vector<Complex> field = Solve(on, prescribed, values, options);
    EXPECT_LT((field.cwiseAbs().array() - 1.0).abs().maxCoeff(), 1e-7);
    const SparseMatrix<Complex> L = PowerLaplacian(on.Mesh, on.Frames, N);
    EXPECT_LT(std::real(field.dot(L * field)), 1e-9);
    EXPECT_EQ(IndicesOf(on.Mesh, on.Frames, field, N).cwiseAbs().maxCoeff(), 0.0);
  }
}

TEST(HarmonicField, SingularitiesOfSolutionsSumToTheEulerCharacteristic)
{
  for (const Surface& surface : { IrregularSphere(4, 3), IrregularTorus(48, 20, 4), DoubleTorus(4) })
  {
    const PreparedSurface on(surface);
    const FieldConstraints prescribed = Every(211, on.Mesh.NumberOfFaces());
    Random random(29);
    const Vector<Complex> values = random.Numbers(static_cast<int>(prescribed.Elements.size()));
    for (int N = 1; N <= 8; ++N)
    {
      FieldOptions options = PowersOnFaces();
      options.Field.N = N;
      options.Solver.Kind = SolverKind::ConjugateGradients;
      const Vector<Complex> field = Solve(on, prescribed, values, options);
      EXPECT_NEAR(IndicesOf(on.Mesh, on.Frames, field, N).sum(), on.Mesh.EulerCharacteristic(), 1e-9);
    }
  }
}

TEST(HarmonicField, HardConstraintsHoldExactly)
{
  const PreparedSurface on(IrregularSphere(4, 3));
  const FieldConstraints prescribed = Every(300, on.Mesh.NumberOfFaces());
  Random random(31);
  const Vector<Complex> values = random.Numbers(static_cast<int>(prescribed.Elements.size()));
  FieldOptions options = PowersOnFaces();
  options.Constraints = ConstraintKind::Hard;
  options.Solver.Kind = SolverKind::ConjugateGradients;
  const Vector<Complex> field = Solve(on, prescribed, values, options);
  for (std::size_t b = 0; b < prescribed.Elements.size(); ++b)
  {
    EXPECT_EQ(field[prescribed.Elements[b]], values[b]);
  }
}

// The field is that of the surface: numbering, position in space and size do not matter. Directions,
// not powers, are compared, since frames follow the numbering.
TEST(HarmonicField, DoesNotDependOnNumberingPlaceOrSize)
{
  const Surface surface = IrregularTorus(40, 16, 4);
  const TriangleMesh mesh = surface.Mesh();
  const int N = 4;
  std::vector<Constraint> directions;
  for (int f = 5; f < mesh.NumberOfFaces(); f += 131)
  {
    directions.push_back({ f, mesh.Position(mesh.Head(3 * f)) - mesh.Position(mesh.Tail(3 * f)), 1.0 });
    directions.back().Direction.normalize();
  }
  const auto powersInSpace = [&](const Surface& on, const std::vector<Constraint>& where)
  {
    const PreparedSurface prepared(on);
    const FieldConstraints constraints = MakePowerConstraints(prepared.Mesh, prepared.Frames, N, where);
    FieldOptions options = PowersOnFaces();
    options.Field.N = N;
    options.Solver.Kind = SolverKind::ConjugateGradients;
    const Vector<Complex> field = Solve(prepared, constraints, ComplexValues(constraints), options);
    // A power in space: against the power of the face's own first side, whose number is the same.
    return std::pair(field, prepared);
  };
  const auto [expected, original] = powersInSpace(surface, directions);

  Eigen::Matrix3d rotation;
  const Surface moved = RotatedAndScaled(surface, 0.7, 250.0, &rotation);
  std::vector<Constraint> movedDirections = directions;
  for (Constraint& direction : movedDirections)
  {
    direction.Direction = rotation * direction.Direction;
  }
  // First sides move along, so coordinates stay.
  EXPECT_LT(RelativeDifference(powersInSpace(moved, movedDirections).first, expected), 1e-8);

  const Relabelled relabelled = Relabel(surface, 77);
  std::vector<Constraint> relabelledDirections = directions;
  for (Constraint& direction : relabelledDirections)
  {
    direction.Element = relabelled.NewFaces[direction.Element];
  }
  const auto [field, other] = powersInSpace(relabelled.Result, relabelledDirections);
  double worst = 0.0;
  for (int f = 0; f < mesh.NumberOfFaces(); ++f)
  {
    const int g = relabelled.NewFaces[f];
    const Complex turn = other.Frames.ToComplex(g, original.Frames.X.row(f).transpose()); // X of f in the frame of g
    worst = std::max(worst, std::abs(expected[f] * std::pow(turn, N) - field[g]));
  }
  EXPECT_LT(worst / expected.cwiseAbs().maxCoeff(), 1e-8);
}

TEST(HarmonicField, HasTheSameBitsForAnyNumberOfThreads)
{
  const PreparedSurface on(IrregularTorus(96, 48, 21));
  const FieldConstraints prescribed = Every(97, on.Mesh.NumberOfFaces());
  Random random(13);
  const Vector<Complex> values = random.Numbers(static_cast<int>(prescribed.Elements.size()));
  FieldOptions options = PowersOnFaces();
  options.Solver.Kind = SolverKind::ConjugateGradients;
  const Vector<Complex> expected = Solve(on, prescribed, values, options);
  for (int threads : { 2, 3, 8 })
  {
    EXPECT_TRUE(Solve(on, prescribed, values, options, TbbContext(threads)) == expected);
  }
}

TEST(HarmonicField, SolvesAgainFromItsSolution)
{
  const PreparedSurface on(IrregularSphere(4, 3));
  const FieldConstraints prescribed = Every(300, on.Mesh.NumberOfFaces());
  Random random(37);
  Vector<Complex> values = random.Numbers(static_cast<int>(prescribed.Elements.size()));
  FieldOptions options = PowersOnFaces();
  options.Solver.Kind = SolverKind::ConjugateGradients;
  PowerFieldProblem problem(on.Framed, &on.Operators, prescribed, options, SerialContext());
  const Vector<Complex> field = problem.Solve(values, {}, StoppingCriteria(), SerialContext());
  const std::size_t cold = problem.Report().Iterations.size();
  problem.Solve(values, field, StoppingCriteria(), SerialContext());
  EXPECT_LE(problem.Report().Iterations.size(), 2u);
  values[0] *= std::polar(1.0, 0.01);
  problem.Solve(values, field, StoppingCriteria(), SerialContext());
  EXPECT_LT(problem.Report().Iterations.size(), cold);
}

TEST(HarmonicField, SurvivesDegenerateSurfaces)
{
  for (const Surface& surface :
    { SphereWithZeroAreaFaces(3, 12), Needle(3, 200.0), Union(Icosphere(2), Torus(24, 10), Vector3(4.0, 0.0, 0.0)) })
  {
    const PreparedSurface on(surface);
    FieldConstraints prescribed;
    prescribed.Elements = { 7 };
    prescribed.Weights = { 1.0 };
    Vector<Complex> values(1);
    values[0] = 1.0;
    FieldOptions options = PowersOnFaces();
    options.Solver.Kind = SolverKind::ConjugateGradients;
    PowerFieldProblem problem(on.Framed, &on.Operators, prescribed, options, SerialContext());
    const Vector<Complex> field = problem.Solve(values, {}, StoppingCriteria(), SerialContext());
    EXPECT_TRUE(field.allFinite());
    EXPECT_TRUE(problem.Report().Converged);
  }
}

TEST(HarmonicField, ChoosesASolverAndSaysWhy)
{
  const PreparedSurface small(IrregularSphere(3, 3));
  const FieldConstraints prescribed = Every(300, small.Mesh.NumberOfFaces());
  const FieldOptions options = PowersOnFaces();
  const PowerFieldProblem direct(small.Framed, &small.Operators, prescribed, options, SerialContext());
  EXPECT_NE(direct.Report().Solver.find("Cholesky, chosen for 1280 unknowns"), std::string::npos);
  // Whether there are levels or not.
  const PowerFieldProblem without(small.Framed, nullptr, prescribed, options, SerialContext());
  EXPECT_EQ(without.Report().Solver, direct.Report().Solver);

  const PreparedSurface large(Icosphere(6));
  ProlongationOperators oneLevel;
  oneLevel.NumbersOfFaces = { large.Mesh.NumberOfFaces() };
  const PowerFieldProblem flat(
    large.Framed, &oneLevel, Every(300, large.Mesh.NumberOfFaces()), options, SerialContext());
  EXPECT_NE(flat.Report().Solver.find("chosen because there are no coarse levels"), std::string::npos);
  const PowerFieldProblem iterative(
    large.Framed, &large.Operators, Every(300, large.Mesh.NumberOfFaces()), options, SerialContext());
  EXPECT_NE(iterative.Report().Solver.find("conjugate gradients"), std::string::npos);
  EXPECT_NE(iterative.Report().Solver.find("81920 unknowns, too many to factor at once"), std::string::npos);
  EXPECT_GE(iterative.Report().Levels.size(), 3u);
  EXPECT_LT(iterative.Report().OperatorComplexity(), 2.5);
}

TEST(HarmonicField, ManySolvesAreWorthAFactor)
{
  const FramedMesh surface(Icosphere(6).Mesh()); // above all limits of sizes but that of 1-forms
  for (const DiscretisationKind kind : { DiscretisationKind::PowerField, DiscretisationKind::FaceField })
  {
    FieldOptions options = PowersOnFaces();
    options.Field.Kind = kind;
    const auto needsLevels = [&]
    { return PlanSolver(*MakeDiscretisation(options.Field, surface), options, nullptr, {}).NeedsLevels(); };
    EXPECT_TRUE(needsLevels());
    options.Solver.ExpectedSolves = 1000;
    EXPECT_FALSE(needsLevels());
    options.Solver.Kind = SolverKind::ConjugateGradients;
    EXPECT_TRUE(needsLevels());
  }
  SolverOptions options;
  SolverTuning tuning;
  tuning.SolvesForFactor = 0.03; // times the root of a million
  options.ExpectedSolves = 29;
  EXPECT_EQ(ChooseSolver(options, tuning, 1000000, true).Method, &MethodOf(SolverKind::ConjugateGradients));
  options.ExpectedSolves = 30;
  const SolverChoice choice = ChooseSolver(options, tuning, 1000000, true);
  EXPECT_EQ(choice.Method, &MethodOf(SolverKind::Cholesky));
  EXPECT_NE(choice.Reason.find("1000000 unknowns and 30 solves"), std::string::npos);
  options.ExpectedSolves = 1000000;
  EXPECT_EQ(ChooseSolver(options, tuning, 100000000, true).Method, &MethodOf(SolverKind::ConjugateGradients))
    << "for a factor of a hundred gigabytes";
}

TEST(HarmonicField, AFactorisationSaysWhereItStops)
{
  const PreparedSurface on(IrregularSphere(3, 3));
  const FieldConstraints prescribed = Every(300, on.Mesh.NumberOfFaces());
  const Vector<Complex> values = Vector<Complex>::Ones(static_cast<int>(prescribed.Elements.size()));
  PowerFieldProblem problem(on.Framed, nullptr, prescribed, PowersOnFaces(), SerialContext());
  problem.Solve(values, {}, StoppingCriteria(), SerialContext());
  EXPECT_TRUE(problem.Report().Converged);
  EXPECT_TRUE(problem.Report().Warnings.empty());
  EXPECT_EQ(problem.Report().Iterations.size(), 2u);
  // Below what doubles can hold it refines, and gives up.
  problem.Solve(values, {}, StoppingCriteria{ 1e-30, 100 }, SerialContext());
  EXPECT_FALSE(problem.Report().Converged);
  ASSERT_EQ(problem.Report().Warnings.size(), 1u);
  EXPECT_NE(problem.Report().Warnings[0].find("instead of 1.0e-30"), std::string::npos);
  EXPECT_LE(problem.Report().Iterations.size(), 30u);
}

TEST(HarmonicField, RefusesWhatItCannotSolve)
{
  const PreparedSurface on(Icosphere(2));
  FieldOptions options = PowersOnFaces();
  options.Solver.Kind = SolverKind::NestedIterations;
  EXPECT_THROW(PowerFieldProblem(on.Framed, nullptr, Every(10, 320), options, SerialContext()), InvalidInput)
    << "it takes no samples";
}
