#include "FieldSolver.h"

#include "Discretisations/MakeDiscretisation.h"
#include "Discretisations/OneFormConstraints.h"
#include "Levels/SurfaceHierarchy.h"
#include "Operators/PowerFieldOperators.h"
#include "Support/ComplexPairs.h"
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

using namespace dmg;
using namespace dmg::test;

namespace
{

HierarchyOptions Deep()
{
  HierarchyOptions options;
  options.MinimumNumberOfFaces = 100;
  return options;
}

/// A mesh with everything that a problem needs.
struct Prepared
{
  explicit Prepared(const Surface& surface)
    : Owned(std::make_shared<const FramedMesh>(surface.Mesh()))
    , Operators(BuildSurfaceHierarchy(this->Mesh, Deep(), SerialContext()).Operators)
  {
  }
  std::shared_ptr<const FramedMesh> Owned;
  const FramedMesh& Framed = *this->Owned;
  const TriangleMesh& Mesh = this->Framed.Mesh;
  const TangentFrames& Frames = this->Framed.Faces;
  ProlongationOperators Operators;
};

PrescribedFaces Every(int step, int faces)
{
  PrescribedFaces prescribed;
  for (int f = 0; f < faces; f += step)
  {
    prescribed.Faces.push_back(f);
    prescribed.Weights.push_back(1.0);
  }
  return prescribed;
}

StoppingCriteria Tight()
{
  StoppingCriteria stop;
  stop.RelativeTolerance = 1e-12;
  stop.MaximumIterations = 300;
  return stop;
}

Vector<Complex> Solve(const Prepared& on, const PrescribedFaces& prescribed,
  const Vector<Complex>& values, const FieldOptions& options,
  const ExecutionContext& context = SerialContext())
{
  PowerFieldProblem problem(on.Framed, &on.Operators, prescribed, options, context);
  const Vector<Complex> field = problem.Solve(values, {}, Tight(), context);
  EXPECT_TRUE(problem.Report().Converged);
  return field;
}

}

TEST(HarmonicField, SolversAgree)
{
  for (const Surface& surface : { IrregularSphere(4, 3), IrregularTorus(48, 20, 4),
         DoubleTorus(4), IrregularPlane(30, 24, 5) })
  {
    const Prepared on(surface);
    const PrescribedFaces prescribed = Every(97, on.Mesh.NumberOfFaces());
    Random random(71);
    const Vector<Complex> values = random.Numbers(static_cast<int>(prescribed.Faces.size()));
    for (int N : { 1, 2, 4, 6 })
    {
      for (ConstraintKind constraints : { ConstraintKind::Soft, ConstraintKind::Hard })
      {
        FieldOptions options;
        options.Field.N = N;
        options.Constraints = constraints;
        options.Solver.Kind = SolverKind::Cholesky;
        const Vector<Complex> direct = Solve(on, prescribed, values, options);
        for (SolverKind solver : { SolverKind::ConjugateGradients, SolverKind::VCycles })
        {
          for (CoarseSpaceKind space : { CoarseSpaceKind::Nodal, CoarseSpaceKind::StructurePreserving })
          {
            options.Solver.Kind = solver;
            options.CoarseSpace = space;
            EXPECT_LT(
              RelativeDifference(Solve(on, prescribed, values, options), direct), 1e-8);
          }
        }
      }
    }
  }
}

// A constant field has no energy on a flat patch, so one prescribed direction spreads over all of it.
TEST(HarmonicField, OneDirectionFillsAFlatPatch)
{
  const Prepared on(IrregularPlane(40, 30, 9));
  const Vector3 direction(0.28, 0.96, 0.0);
  for (int N = 1; N <= 8; ++N)
  {
    const PowerConstraints constraints =
      MakePowerConstraints(on.Mesh, on.Frames, N, { { 1234, direction, 1.0 } });
    for (SolverKind solver : { SolverKind::Cholesky, SolverKind::ConjugateGradients })
    {
      FieldOptions options;
      options.Field.N = N;
      options.Solver.Kind = solver;
      const Vector<Complex> field = Solve(on, constraints.Prescribed, constraints.Values, options);
      EXPECT_LT(RelativeDifference(field, PowersOfDirection(on.Frames, direction, N)), 1e-8);
    }
  }
}

// The same without a plane: a torus whose angles sum to 2 pi at every vertex and whose holonomy is
// trivial carries a field without energy, and without singularities, of any N.
TEST(HarmonicField, AFlatTorusCarriesAParallelField)
{
  const Prepared on(FlatTorus(12, 3));
  for (int N : { 1, 2, 4 })
  {
    PrescribedFaces prescribed;
    prescribed.Faces = { 17 };
    prescribed.Weights = { 1.0 };
    Vector<Complex> values(1);
    values[0] = Complex(0.6, 0.8);
    FieldOptions options;
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
  for (const Surface& surface :
    { IrregularSphere(4, 3), IrregularTorus(48, 20, 4), DoubleTorus(4) })
  {
    const Prepared on(surface);
    const PrescribedFaces prescribed = Every(211, on.Mesh.NumberOfFaces());
    Random random(29);
    const Vector<Complex> values = random.Numbers(static_cast<int>(prescribed.Faces.size()));
    for (int N = 1; N <= 8; ++N)
    {
      FieldOptions options;
      options.Field.N = N;
      options.Solver.Kind = SolverKind::ConjugateGradients;
      const Vector<Complex> field = Solve(on, prescribed, values, options);
      EXPECT_NEAR(IndicesOf(on.Mesh, on.Frames, field, N).sum(),
        on.Mesh.EulerCharacteristic(), 1e-9);
    }
  }
}

TEST(HarmonicField, HardConstraintsHoldExactly)
{
  const Prepared on(IrregularSphere(4, 3));
  const PrescribedFaces prescribed = Every(300, on.Mesh.NumberOfFaces());
  Random random(31);
  const Vector<Complex> values = random.Numbers(static_cast<int>(prescribed.Faces.size()));
  FieldOptions options;
  options.Constraints = ConstraintKind::Hard;
  options.Solver.Kind = SolverKind::ConjugateGradients;
  const Vector<Complex> field = Solve(on, prescribed, values, options);
  for (std::size_t b = 0; b < prescribed.Faces.size(); ++b)
  {
    EXPECT_EQ(field[prescribed.Faces[b]], values[b]);
  }
}

// The field is that of the surface: numbering, position in space and size do not matter. Directions,
// not powers, are compared, since frames follow the numbering.
TEST(HarmonicField, DoesNotDependOnNumberingPlaceOrSize)
{
  const Surface surface = IrregularTorus(40, 16, 4);
  const TriangleMesh mesh = surface.Mesh();
  const int N = 4;
  std::vector<PrescribedDirection> directions;
  for (int f = 5; f < mesh.NumberOfFaces(); f += 131)
  {
    directions.push_back({ f, mesh.Position(mesh.Head(3 * f)) - mesh.Position(mesh.Tail(3 * f)), 1.0 });
    directions.back().Direction.normalize();
  }
  const auto powersInSpace = [&](const Surface& on, const std::vector<PrescribedDirection>& where) {
    const Prepared prepared(on);
    const PowerConstraints constraints =
      MakePowerConstraints(prepared.Mesh, prepared.Frames, N, where);
    FieldOptions options;
    options.Field.N = N;
    options.Solver.Kind = SolverKind::ConjugateGradients;
    const Vector<Complex> field =
      Solve(prepared, constraints.Prescribed, constraints.Values, options);
    // A power in space: against the power of the face's own first side, whose number is the same.
    return std::pair(field, prepared);
  };
  const auto [expected, original] = powersInSpace(surface, directions);

  Eigen::Matrix3d rotation;
  const Surface moved = RotatedAndScaled(surface, 0.7, 250.0, &rotation);
  std::vector<PrescribedDirection> movedDirections = directions;
  for (PrescribedDirection& direction : movedDirections)
  {
    direction.Direction = rotation * direction.Direction;
  }
  // First sides move along, so coordinates stay.
  EXPECT_LT(RelativeDifference(powersInSpace(moved, movedDirections).first, expected), 1e-8);

  const Relabelled relabelled = Relabel(surface, 77);
  std::vector<PrescribedDirection> relabelledDirections = directions;
  for (PrescribedDirection& direction : relabelledDirections)
  {
    direction.Face = relabelled.NewFaces[direction.Face];
  }
  const auto [field, other] = powersInSpace(relabelled.Result, relabelledDirections);
  double worst = 0.0;
  for (int f = 0; f < mesh.NumberOfFaces(); ++f)
  {
    const int g = relabelled.NewFaces[f];
    const Complex turn =
      other.Frames.ToComplex(g, original.Frames.X.row(f).transpose()); // X of f in the frame of g
    worst = std::max(worst, std::abs(expected[f] * std::pow(turn, N) - field[g]));
  }
  EXPECT_LT(worst / expected.cwiseAbs().maxCoeff(), 1e-8);
}

TEST(HarmonicField, HasTheSameBitsForAnyNumberOfThreads)
{
  const Prepared on(IrregularTorus(96, 48, 21));
  const PrescribedFaces prescribed = Every(97, on.Mesh.NumberOfFaces());
  Random random(13);
  const Vector<Complex> values = random.Numbers(static_cast<int>(prescribed.Faces.size()));
  FieldOptions options;
  options.Solver.Kind = SolverKind::ConjugateGradients;
  const Vector<Complex> expected = Solve(on, prescribed, values, options);
  for (int threads : { 2, 3, 8 })
  {
    EXPECT_TRUE(Solve(on, prescribed, values, options, TbbContext(threads)) == expected);
  }
}

TEST(HarmonicField, SolvesAgainFromItsSolution)
{
  const Prepared on(IrregularSphere(4, 3));
  const PrescribedFaces prescribed = Every(300, on.Mesh.NumberOfFaces());
  Random random(37);
  Vector<Complex> values = random.Numbers(static_cast<int>(prescribed.Faces.size()));
  FieldOptions options;
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
  for (const Surface& surface : { SphereWithZeroAreaFaces(3, 12), Needle(3, 200.0),
         Union(Icosphere(2), Torus(24, 10), Vector3(4.0, 0.0, 0.0)) })
  {
    const Prepared on(surface);
    PrescribedFaces prescribed;
    prescribed.Faces = { 7 };
    prescribed.Weights = { 1.0 };
    Vector<Complex> values(1);
    values[0] = 1.0;
    FieldOptions options;
    options.Solver.Kind = SolverKind::ConjugateGradients;
    PowerFieldProblem problem(on.Framed, &on.Operators, prescribed, options, SerialContext());
    const Vector<Complex> field = problem.Solve(values, {}, StoppingCriteria(), SerialContext());
    EXPECT_TRUE(field.allFinite());
    EXPECT_TRUE(problem.Report().Converged);
  }
}

TEST(HarmonicField, ChoosesASolverAndSaysWhy)
{
  const Prepared small(IrregularSphere(3, 3));
  const PrescribedFaces prescribed = Every(300, small.Mesh.NumberOfFaces());
  const FieldOptions options;
  const PowerFieldProblem direct(small.Framed, &small.Operators, prescribed, options, SerialContext());
  EXPECT_NE(direct.Report().Solver.find("Cholesky, chosen for 1280 unknowns"), std::string::npos);
  // Whether there are levels or not.
  const PowerFieldProblem without(small.Framed, nullptr, prescribed, options, SerialContext());
  EXPECT_EQ(without.Report().Solver, direct.Report().Solver);

  const Prepared large(Icosphere(6));
  ProlongationOperators oneLevel;
  oneLevel.NumbersOfFaces = { large.Mesh.NumberOfFaces() };
  const PowerFieldProblem flat(large.Framed, &oneLevel,
    Every(300, large.Mesh.NumberOfFaces()), options, SerialContext());
  EXPECT_NE(
    flat.Report().Solver.find("chosen because there are no coarse levels"), std::string::npos);
  const PowerFieldProblem iterative(large.Framed, &large.Operators,
    Every(300, large.Mesh.NumberOfFaces()), options, SerialContext());
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
    FieldOptions options;
    options.Field.Kind = kind;
    const auto needsLevels = [&] {
      return PlanSolver(*MakeDiscretisation(options.Field, surface), options, nullptr, {}).NeedsLevels();
    };
    EXPECT_TRUE(needsLevels());
    options.Solver.ExpectedSolves = 1000;
    EXPECT_FALSE(needsLevels());
    options.Solver.Kind = SolverKind::ConjugateGradients;
    EXPECT_TRUE(needsLevels());
  }
  SolverOptions options;
  SolverTuning tuning;
  tuning.SolvesForCholesky = 30;
  options.ExpectedSolves = 29;
  EXPECT_EQ(ChooseSolver(options, tuning, 1000000, true).Kind, SolverKind::ConjugateGradients);
  options.ExpectedSolves = 30;
  const SolverChoice choice = ChooseSolver(options, tuning, 1000000, true);
  EXPECT_EQ(choice.Kind, SolverKind::Cholesky);
  EXPECT_NE(choice.Reason.find("1000000 unknowns and 30 solves"), std::string::npos);
}

TEST(HarmonicField, AFactorisationSaysWhereItStops)
{
  const Prepared on(IrregularSphere(3, 3));
  const PrescribedFaces prescribed = Every(300, on.Mesh.NumberOfFaces());
  const Vector<Complex> values = Vector<Complex>::Ones(static_cast<int>(prescribed.Faces.size()));
  PowerFieldProblem problem(on.Framed, nullptr, prescribed, FieldOptions(), SerialContext());
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
  const Prepared on(Icosphere(2));
  FieldOptions options;
  options.Solver.Kind = SolverKind::NestedIterations;
  EXPECT_THROW(PowerFieldProblem(on.Framed, nullptr, Every(10, 320), options,
                 SerialContext()),
    InvalidInput) << "it takes no samples";
}

namespace
{

/// A few directions along a wave over the surface.
std::vector<PrescribedDirection> Directions(const TriangleMesh& mesh, int step)
{
  std::vector<PrescribedDirection> directions;
  const TangentFrames frames = FaceFrames(mesh);
  for (int face = 0; face < mesh.NumberOfFaces(); face += step)
  {
    directions.push_back({ face, frames.ToVector(face, std::polar(1.0, 0.01 * face)), 1.0 });
  }
  return directions;
}

/// Those, for discretisations of directions, and values at some vertices, for functions.
PrescribedDirections Prescriptions(const FramedMesh& surface, int step)
{
  PrescribedDirections prescribed{ Directions(surface.Mesh, step), {} };
  for (int vertex = 0; vertex < surface.Mesh.NumberOfVertices(); vertex += step)
  {
    prescribed.Values.push_back({ vertex, std::sin(0.1 * vertex), 1.0 });
  }
  return prescribed;
}

constexpr DiscretisationKind AllKinds[] = { DiscretisationKind::PowerField, DiscretisationKind::FaceField,
  DiscretisationKind::OneForm };

}

TEST(FieldSolver, SolversAgreeOnEveryDiscretisation)
{
  for (const Surface& surface : { IrregularSphere(3, 3), IrregularTorus(28, 14, 4),
         IrregularPlane(20, 16, 5) })
  {
    const Prepared on(surface);
    FieldSolver fields(on.Mesh);
    for (DiscretisationKind kind : AllKinds)
    {
      for (ConstraintKind constraintKind : { ConstraintKind::Soft, ConstraintKind::Hard })
      {
        FieldOptions options;
        options.Field.Kind = kind;
        options.Constraints = constraintKind;
        const auto solve = [&](SolverKind solver, CoarseSpaceKind space) {
          options.Solver.Kind = solver;
          options.CoarseSpace = space;
          options.Solver.CompareWithCholesky = true;
          options.Solver.Nested.Cycles = 60;
          options.Solver.Nested.Sweeps = 0;
          fields.SetOperators(std::make_shared<const ProlongationOperators>(on.Operators));
          const Vector<double> field = fields.Solve(Prescriptions(on.Framed, 97), options, Tight());
          EXPECT_TRUE(fields.Report().Converged) << fields.Report().Solver;
          return field;
        };
        const Vector<double> direct = solve(SolverKind::Cholesky, CoarseSpaceKind::Nodal);
        for (SolverKind solver : { SolverKind::ConjugateGradients, SolverKind::NestedIterations })
        {
          for (CoarseSpaceKind space :
            { CoarseSpaceKind::Nodal, CoarseSpaceKind::StructurePreserving })
          {
            EXPECT_LT((solve(solver, space) - direct).norm(), 1e-7 * direct.norm())
              << static_cast<int>(kind) << static_cast<int>(solver) << static_cast<int>(space);
            EXPECT_LT(fields.Report().Iterations.back().Error, 1e-7);
          }
        }
      }
    }
  }
}

// The system that is factored is that of HarmonicSystem, which is assembled and reduced otherwise.
TEST(FieldSolver, AgreesWithTheTextbookSystem)
{
  const Prepared on(IrregularTorus(16, 10, 4));
  const PrescribedDirections directions = Prescriptions(on.Framed, 37);
  for (ConstraintKind constraints : { ConstraintKind::Soft, ConstraintKind::Hard })
  {
    FieldOptions options;
    options.Constraints = constraints;
    options.Alignment = 3.0;
    options.Smoothness = 0.5;
    const auto expectSame = [&](const auto& system, const auto& values, const auto& pairsOf) {
      const auto A = system.Matrix().toDense().eval();
      const auto x = system.Expand(A.partialPivLu().solve(system.RightHandSide(values)), values);
      FieldSolver fields(on.Mesh);
      const Vector<double> field = fields.Solve(directions, options, Tight());
      const Vector<double> expected = pairsOf(x);
      EXPECT_LE((field - expected).norm(), 1e-10 * expected.norm()) << fields.Field().Name();
    };
    const auto real = [](const Vector<double>& x) { return x; };
    options.Field.N = 3;
    const PowerConstraints powers =
      MakePowerConstraints(on.Mesh, on.Frames, 3, directions.OnFaces);
    expectSame(
      MakePowerFieldSystem(on.Mesh, on.Frames, 3, powers.Prescribed, options.Weights()),
      powers.Values, [](const Vector<Complex>& x) { return Vector<double>(AsPairs(x)); });
    options.Field.Kind = DiscretisationKind::FaceField;
    const PowerConstraints vectors =
      MakePowerConstraints(on.Mesh, on.Frames, 1, directions.OnFaces);
    expectSame(MakeFaceFieldSystem(on.Mesh, on.Frames, vectors.Prescribed, options.Weights()),
      Vector<double>(AsPairs(vectors.Values)), real);
    options.Field.Kind = DiscretisationKind::OneForm;
    const OneFormConstraints forms =
      OneFormConstraintsOnFaces(on.Mesh, on.Frames, directions.OnFaces);
    expectSame(
      MakeOneFormSystem(on.Mesh, forms.Prescribed, options.Weights()), forms.Values, real);
  }
}

TEST(FieldProblem, UpdateIsANewProblem)
{
  const Prepared on(IrregularTorus(48, 24, 4));
  for (DiscretisationKind kind : AllKinds)
  {
    for (SolverKind solver : { SolverKind::ConjugateGradients, SolverKind::Cholesky,
           SolverKind::NestedIterations })
    {
      SCOPED_TRACE(std::to_string(static_cast<int>(kind)) + " " + NameOf(solver));
      FieldOptions options;
      options.Field.Kind = kind;
      options.Solver.Kind = solver;
      options.Solver.Nested.Cycles = 40;
      options.Solver.Nested.Sweeps = 0;
      const auto constraintsOf = [&](int step) {
        return MakeFieldConstraints(on.Framed, Prescriptions(on.Framed, step), options);
      };
      const auto make = [&](const FieldConstraints& constraints) {
        return FieldProblem(on.Framed, &on.Operators, constraints, options, SerialContext());
      };
      const auto solve = [](FieldProblem& problem, const FieldConstraints& constraints) {
        const Vector<double> field =
          problem.Solve(constraints.Values, {}, { 1e-11, 200 }, SerialContext());
        EXPECT_TRUE(problem.Report().Converged);
        return field;
      };
      FieldProblem problem = make(constraintsOf(97));
      const auto expectUpdates = [&](const FieldConstraints& constraints) {
        problem.Update(constraints, options, SerialContext());
        FieldProblem fresh = make(constraints);
        const Vector<double> expected = solve(fresh, constraints);
        EXPECT_LE((solve(problem, constraints) - expected).norm(), 1e-8 * expected.norm());
      };
      const FieldConstraints others = constraintsOf(53);
      expectUpdates(others);
      options.Smoothness = 0.5;
      options.Alignment = 7.0;
      expectUpdates(others);
      // A matrix loses rows to hard constraints, and gets them back.
      options.Constraints = ConstraintKind::Hard;
      expectUpdates(others);
      options.Constraints = ConstraintKind::Soft;
      expectUpdates(constraintsOf(97));
    }
  }
}

// Set-up, system, what it is compared with and the solve share one way from 0 to 1. What was complete when a run was
// stopped is kept, and changes nothing.
TEST(FieldSolver, ReportsProgressOnceAndStopsWhenAsked)
{
  const Prepared on(IrregularTorus(48, 24, 4));
  for (DiscretisationKind kind : AllKinds)
  {
    for (bool isCompared : { false, true })
    {
      SCOPED_TRACE(static_cast<int>(kind));
      FieldOptions options;
      options.Field.Kind = kind;
      options.Solver.Kind = SolverKind::ConjugateGradients;
      options.Solver.CompareWithCholesky = isCompared;
      const PrescribedDirections directions = Prescriptions(on.Framed, 97);
      TbbContext all(2);
      FieldSolver fields(on.Mesh);
      const Vector<double> expected = fields.Solve(directions, options, Tight(), all);
      const std::vector<double>& progress = all.Progress();
      EXPECT_TRUE(std::is_sorted(progress.begin(), progress.end())) << isCompared;
      EXPECT_EQ(progress.front(), 0.0);
      EXPECT_EQ(progress.back(), 1.0);
      for (std::size_t count = 1; count <= progress.size(); ++count)
      {
        TbbContext context(2);
        context.CancelAfter(static_cast<int>(count));
        FieldSolver stopped(on.Mesh);
        EXPECT_THROW(stopped.Solve(directions, options, Tight(), context), Cancelled);
        EXPECT_EQ(context.Progress().size(), count);
        if (count % 7 == 0)
        {
          EXPECT_EQ(stopped.Solve(directions, options, Tight()), expected);
        }
      }
    }
  }
}

// A vertex constrains what is around it: the faces, or for 1-forms the edges; beside faces, too.
TEST(Discretisation, TakesDirectionsAtVertices)
{
  const FramedMesh surface(IrregularSphere(2, 3).Mesh());
  const auto& [mesh, faces, vertices] = surface;
  const int vertex = 50;
  const Vector3 direction = 2.0 * vertices.X.row(vertex).transpose();
  std::vector<int> facesAround;
  std::vector<int> edgesAround;
  for (int h = 0; h < 3 * mesh.NumberOfFaces(); ++h)
  {
    if (mesh.Tail(h) == vertex)
    {
      facesAround.push_back(TriangleMesh::FaceOf(h));
      edgesAround.push_back(mesh.EdgeOf(h));
    }
  }
  std::sort(edgesAround.begin(), edgesAround.end());
  for (DiscretisationKind kind : AllKinds)
  {
    FieldOptions options;
    options.Field.Kind = kind;
    const bool isOneForm = kind == DiscretisationKind::OneForm;
    const FieldConstraints alone =
      MakeFieldConstraints(surface, { {}, { { vertex, direction, 3.0 } } }, options);
    EXPECT_EQ(alone.Elements, isOneForm ? edgesAround : facesAround);
    EXPECT_EQ(alone.Weights,
      std::vector<double>(alone.Elements.size(), isOneForm ? 1.5 : 3.0)); // one end of two
    if (!isOneForm)
    {
      for (Eigen::Index b = 0; b < alone.Values.size(); b += 2)
      {
        EXPECT_NEAR(alone.Values.segment<2>(b).norm(), 2.0, 1e-14); // turned, not shortened
      }
    }
    const int other = facesAround.front() == 0 ? 1 : 0;
    const PrescribedDirection onFace = { other, faces.X.row(other).transpose(), 1.0 };
    const FieldConstraints both =
      MakeFieldConstraints(surface, { { onFace }, { { vertex, direction, 3.0 } } }, options);
    EXPECT_EQ(both.Elements.size(), alone.Elements.size() + (isOneForm ? 3 : 1));
  }
}

TEST(FieldProblem, OnASurfaceOfOneLevelIsFactored)
{
  const FramedMesh surface(IrregularSphere(2, 3).Mesh());
  const TriangleMesh& mesh = surface.Mesh;
  const ProlongationOperators operators =
    BuildSurfaceHierarchy(mesh, HierarchyOptions(), SerialContext()).Operators;
  ASSERT_EQ(operators.NumberOfLevels(), 1);
  for (DiscretisationKind kind : AllKinds)
  {
    FieldOptions options;
    options.Field.Kind = kind;
    options.Solver.Nested.Rule = SweepRule::WhileErrorFalls; // needs a reference on more levels
    const FieldConstraints constraints =
      MakeFieldConstraints(surface, { Directions(mesh, 50), {} }, options);
    const auto solve = [&](SolverKind solver) {
      options.Solver.Kind = solver;
      FieldProblem problem(surface, &operators, constraints, options, SerialContext());
      const Vector<double> field =
        problem.Solve(constraints.Values, {}, StoppingCriteria(), SerialContext());
      EXPECT_TRUE(problem.Report().Converged);
      EXPECT_EQ(problem.Report().Levels.size(), 1u);
      return std::pair(field, problem.Report().Solver);
    };
    const auto [direct, name] = solve(SolverKind::Cholesky);
    EXPECT_EQ(name, "supernodal Cholesky");
    const auto [automatic, reason] = solve(SolverKind::Automatic);
    EXPECT_EQ(automatic, direct);
    const int equations = MakeDiscretisation(options.Field, surface)->NumberOfEquations();
    EXPECT_EQ(reason.rfind(name + ", chosen for " + std::to_string(equations) +
                  " unknowns, few enough to factor at once", 0), 0u) << reason;
    for (const auto& [solver, instead] : std::vector<std::pair<SolverKind, std::string>>{
           { SolverKind::VCycles, "in place of V-cycles" },
           { SolverKind::ConjugateGradients, "in place of conjugate gradients with a V-cycle" },
           { SolverKind::NestedIterations, "in place of nested iterations" },
           { SolverKind::CoarseProlongation, "in place of coarse prolongation" } })
    {
      const auto [field, report] = solve(solver);
      EXPECT_EQ(field, direct);
      EXPECT_EQ(report, name + ", " + instead + " because there are no coarse levels");
    }
  }
}

TEST(FieldProblem, HasTheSameBitsForAnyNumberOfThreads)
{
  const Prepared on(IrregularTorus(96, 40, 8));
  for (DiscretisationKind kind : AllKinds)
  {
    FieldOptions options;
    options.Field.Kind = kind;
    options.Solver.Kind = SolverKind::ConjugateGradients;
    const FieldConstraints constraints =
      MakeFieldConstraints(on.Framed, { Directions(on.Mesh, 50), {} }, options);
    const auto solve = [&](const ExecutionContext& context) {
      const SurfaceHierarchy hierarchy = BuildSurfaceHierarchy(on.Mesh, Deep(), context);
      FieldProblem problem(on.Framed, &hierarchy.Operators, constraints, options, context);
      return problem.Solve(constraints.Values, {}, Tight(), context);
    };
    const Vector<double> expected = solve(SerialContext());
    EXPECT_EQ(solve(TbbContext(2)), expected);
    EXPECT_EQ(solve(TbbContext(5)), expected);
  }
}

TEST(FieldProblem, TakesHarmonicFieldsFromItsLevels)
{
  Prepared on(IrregularTorus(28, 14, 4));
  for (const int known : { 2, 1 })
  {
    // What the coarsest level lacks is missed, so it is this that was prolonged.
    on.Operators.ClosedForms = SparseMatrix<double>(on.Operators.ClosedForms.leftCols(known));
    for (DiscretisationKind kind : { DiscretisationKind::FaceField, DiscretisationKind::OneForm })
    {
      for (CoarseSpaceKind space : { CoarseSpaceKind::Nodal, CoarseSpaceKind::StructurePreserving })
      {
        FieldOptions options;
        options.Field.Kind = kind;
        options.CoarseSpace = space;
        options.Solver.Kind = SolverKind::ConjugateGradients;
        const FieldProblem problem(on.Framed, &on.Operators,
          MakeFieldConstraints(on.Framed, { Directions(on.Mesh, 50), {} }, options), options,
          SerialContext());
        EXPECT_EQ(problem.HarmonicFields().cols(), known);
      }
    }
  }
}

TEST(FieldProblem, NamesTheOperatorsThatAreMissing)
{
  const FramedMesh surface(IrregularSphere(3, 3).Mesh());
  const TriangleMesh& mesh = surface.Mesh;
  const SurfaceHierarchy hierarchy =
    BuildSurfaceHierarchy(mesh, Deep(), SerialContext(), { false, false, false });
  const char* const properties[] = { "Power Fields", "Face Fields", "One Forms" };
  for (DiscretisationKind kind : AllKinds)
  {
    FieldOptions options;
    options.Field.Kind = kind;
    options.Solver.Kind = SolverKind::ConjugateGradients;
    const FieldConstraints constraints =
      MakeFieldConstraints(surface, { Directions(mesh, 50), {} }, options);
    EXPECT_NO_THROW(
      FieldProblem(surface, &hierarchy.Operators, constraints, options, SerialContext()));
    options.CoarseSpace = CoarseSpaceKind::StructurePreserving;
    try
    {
      FieldProblem(surface, &hierarchy.Operators, constraints, options, SerialContext());
      FAIL();
    }
    catch (const InvalidInput& error)
    {
      EXPECT_NE(std::string(error.what()).find(properties[static_cast<int>(kind)]),
        std::string::npos)
        << error.what();
    }
  }
}

// The exact overlay takes the place of tracked paths, on every level and in the caller's numbering.
TEST(BuildSurfaceHierarchy, ExactOverlayKeepsTheSameStructure)
{
  const TriangleMesh mesh = IrregularTorus(24, 12, 4).Mesh();
  HierarchyOptions options = Deep();
  options.Construction = ProlongationConstruction::ExactOverlay;
  const SurfaceHierarchy hierarchy = BuildSurfaceHierarchy(mesh, options, SerialContext());
  const TriangleMesh* fine = &mesh;
  for (std::size_t level = 0; level < hierarchy.CoarseLevels.size(); ++level)
  {
    const TriangleMesh& coarse = hierarchy.CoarseLevels[level];
    EXPECT_LT(ExactnessResidual(
                *fine, coarse, hierarchy.Operators.S0[level], hierarchy.Operators.S1[level]),
      1e-12);
    fine = &coarse;
  }
  EXPECT_GE(hierarchy.CoarseLevels.size(), 1u);
}

// Decimation and overlays of all levels share one way from 0 to 1, and either can be stopped.
TEST(BuildSurfaceHierarchy, ReportsProgressOnceAndStopsWhenAsked)
{
  const TriangleMesh mesh = IrregularTorus(24, 12, 4).Mesh();
  for (ProlongationConstruction construction :
    { ProlongationConstruction::TrackedPaths, ProlongationConstruction::ExactOverlay })
  {
    const bool isExact = construction == ProlongationConstruction::ExactOverlay;
    HierarchyOptions options = Deep();
    options.Construction = construction;
    TbbContext all(2);
    const SurfaceHierarchy hierarchy = BuildSurfaceHierarchy(mesh, options, all);
    const std::vector<double>& progress = all.Progress();
    EXPECT_TRUE(std::is_sorted(progress.begin(), progress.end()));
    EXPECT_EQ(progress.front(), 0.0);
    EXPECT_EQ(progress.back(), 1.0);
    if (isExact)
    {
      // A collapse takes away two faces, so the first level has 216 of 576: steps of 64 are thirds.
      ASSERT_EQ(hierarchy.CoarseLevels.front().NumberOfFaces(), 144);
      double longest = 0.0;
      for (std::size_t i = 1; i < progress.size(); ++i)
      {
        longest = std::max(longest, progress[i] - progress[i - 1]);
      }
      EXPECT_LT(longest, 64.0 / 216.0);
    }
    for (std::size_t count = 1; count <= progress.size(); count += isExact ? 7 : 1)
    {
      TbbContext context(2);
      context.CancelAfter(static_cast<int>(count));
      EXPECT_THROW(BuildSurfaceHierarchy(mesh, options, context), Cancelled);
      EXPECT_EQ(context.Progress().size(), count);
    }
  }
}
