#include "FieldSolver.h"

#include "Discretisations/Constraints/OneFormConstraints.h"
#include "PreparedSurface.h"
#include "StructurePreserving/SurfaceHierarchy.h"
#include "Support/ComplexPairs.h"
#include "Support/DenseAlgebra.h"
#include "Support/Errors.h"
#include "Support/FieldSystems.h"
#include "Support/MeshFactory.h"
#include "Support/SolverOfUnknowns.h"
#include "Support/TbbContext.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <memory>
#include <string>
#include <vector>

using namespace dmg;
using namespace dmg::test;

namespace
{

Constraints Directions(const TriangleMesh& mesh, double turn = 0.0, double weight = 1.0)
{
  Constraints directions;
  const TangentFrames frames = FaceFrames(mesh);
  for (int face = 0; face < mesh.NumberOfFaces(); face += 101)
  {
    directions.OnFaces.push_back({ face, frames.ToVector(face, std::polar(1.0, 0.01 * face + turn)), weight });
  }
  return directions;
}

/// How often each stage ran.
struct Stages
{
  int Setups;
  int Systems;
  int Solves;
};

/// A change, and what it costs a solver that has solved before.
struct Change
{
  std::string Name;
  std::function<void(FieldOptions&)> Apply;
  Stages Costs;
};

}

// Every member of the options, one after the other. What a member changes is redone, and not more.
TEST(FieldSolver, EachOptionRepeatsItsStages)
{
  const Stages everything{ 1, 1, 1 };
  const Stages system{ 0, 1, 1 };
  const std::vector<Change> changes = {
    { "nothing", [](FieldOptions&) {}, { 0, 0, 0 } },
    { "Kind", [](FieldOptions& o) { o.Field.Kind = DiscretisationKind::FaceField; }, everything },
    { "N", [](FieldOptions& o) { o.Field.N = 3; }, everything },
    { "Areas of power fields", [](FieldOptions& o) { o.Field.Areas = VertexAreas::Barycentric; }, system },
    { "Smoothness", [](FieldOptions& o) { o.Smoothness = 2.0; }, system },
    { "Alignment", [](FieldOptions& o) { o.Alignment = 2.0; }, system },
    { "Constraints", [](FieldOptions& o) { o.Constraints = ConstraintKind::Hard; }, system },
    { "CoarseSpace", [](FieldOptions& o) { o.CoarseSpace = CoarseSpaceKind::StructurePreserving; }, everything },
    { "V-cycles", [](FieldOptions& o) { o.Solver.Kind = SolverKind::VCycles; }, system },
    { "Cholesky", [](FieldOptions& o) { o.Solver.Kind = SolverKind::Cholesky; }, system },
    { "nested iterations", [](FieldOptions& o) { o.Solver.Kind = SolverKind::NestedIterations; }, everything },
    { "ExpectedSolves", [](FieldOptions& o) { o.Solver.ExpectedSolves = 2; }, system },
    { "Sweeps", [](FieldOptions& o) { o.Solver.Sweeps = 3; }, system },
    { "Nested.Sweeps", [](FieldOptions& o) { o.Solver.Nested.Sweeps = 7; }, system },
    { "Nested.Cycles", [](FieldOptions& o) { o.Solver.Nested.Cycles = 1; }, system },
    { "StartingLevel", [](FieldOptions& o) { o.Solver.StartingLevel = 1; }, everything },
  };
  const TriangleMesh mesh = IrregularTorus(64, 32, 4).Mesh();
  for (const Change& change : changes)
  {
    FieldOptions options;
    options.Solver.Kind = SolverKind::ConjugateGradients;
    SolverOfUnknowns solver(mesh);
    solver.Solve(Directions(mesh), options);
    const StageCounts before = solver.Counts();
    EXPECT_EQ(before.Setups, 1);
    EXPECT_EQ(before.Systems, 1);
    EXPECT_EQ(before.Solves, 1);
    change.Apply(options);
    solver.Solve(Directions(mesh), options);
    EXPECT_EQ(solver.Counts().Setups - before.Setups, change.Costs.Setups) << change.Name;
    EXPECT_EQ(solver.Counts().Systems - before.Systems, change.Costs.Systems) << change.Name;
    EXPECT_EQ(solver.Counts().Solves - before.Solves, change.Costs.Solves) << change.Name;
    // Whatever was kept, the field is that of a new solver.
    SolverOfUnknowns fresh(mesh);
    fresh.Solve(Directions(mesh), options, { 1e-12, 200 });
    solver.Solve(Directions(mesh), options, { 1e-12, 200 });
    EXPECT_LE((solver.Unknowns() - fresh.Unknowns()).norm(), 1e-8 * fresh.Unknowns().norm()) << change.Name;
  }
}

TEST(FieldSolver, PrescriptionsRepeatTheirStages)
{
  const TriangleMesh mesh = IrregularTorus(64, 32, 4).Mesh();
  SolverOfUnknowns solver(mesh);
  FieldOptions options;
  options.Solver.Kind = SolverKind::ConjugateGradients;
  const auto expectCosts = [&](const Constraints& directions, const StoppingCriteria& stop, const Stages& costs)
  {
    const StageCounts before = solver.Counts();
    solver.Solve(directions, options, stop);
    EXPECT_EQ(solver.Counts().Setups - before.Setups, costs.Setups);
    EXPECT_EQ(solver.Counts().Systems - before.Systems, costs.Systems);
    EXPECT_EQ(solver.Counts().Solves - before.Solves, costs.Solves);
  };
  expectCosts(Directions(mesh), {}, { 1, 1, 1 });
  expectCosts(Directions(mesh), {}, { 0, 0, 0 });
  expectCosts(Directions(mesh, 0.1), {}, { 0, 0, 1 });      // a moved guide
  expectCosts(Directions(mesh, 0.1, 2.0), {}, { 0, 1, 1 }); // its weight
  Constraints more = Directions(mesh, 0.1, 2.0);
  more.OnFaces.push_back({ 7, mesh.Position(mesh.Head(21)) - mesh.Position(mesh.Tail(21)), 1.0 });
  expectCosts(more, {}, { 0, 1, 1 });
  expectCosts(more, { 1e-10, 100 }, { 0, 0, 1 });
  expectCosts(more, { 1e-10, 101 }, { 0, 0, 1 });
}

// Given operators make other levels, but no other field; they took no set-up here.
TEST(FieldSolver, TakesOperatorsThatAreGiven)
{
  const TriangleMesh mesh = IrregularTorus(48, 24, 4).Mesh();
  HierarchyOptions levels;
  levels.MinimumNumberOfFaces = 100;
  const auto operators = std::make_shared<const ProlongationOperators>(
    BuildSurfaceHierarchy(mesh, levels, SerialContext(), { true, false, false }).Operators);
  SolverOfUnknowns solver(mesh);
  FieldOptions options;
  options.Solver.Kind = SolverKind::ConjugateGradients;
  const Vector<double> own = solver.Solve(Directions(mesh), options, { 1e-12, 200 });
  solver.SetOperators(operators);
  const Vector<double> given = solver.Solve(Directions(mesh), options, { 1e-12, 200 });
  EXPECT_EQ(solver.Counts().Setups, 1);
  EXPECT_LE((given - own).norm(), 1e-8 * own.norm());
  solver.SetOperators(operators);
  solver.Solve(Directions(mesh), options, { 1e-12, 200 });
  EXPECT_EQ(solver.Counts().Solves, 2);
  options.Field.N = 2; // no other levels, so no set-up
  solver.Solve(Directions(mesh), options);
  EXPECT_EQ(solver.Counts().Setups, 1);
}

// What was made for one N is found again, while there is room.
TEST(FieldSolver, KeepsSetupsUpToALimitOfMemory)
{
  const TriangleMesh mesh = IrregularTorus(64, 32, 4).Mesh();
  FieldOptions options;
  options.Solver.Kind = SolverKind::ConjugateGradients;
  const auto setups = [&](SolverOfUnknowns& solver, const std::vector<int>& Ns)
  {
    for (const int N : Ns)
    {
      options.Field.N = N;
      solver.Solve(Directions(mesh), options);
    }
    return solver.Counts().Setups;
  };
  SolverOfUnknowns roomy(mesh);
  EXPECT_EQ(setups(roomy, { 4, 2, 1, 4, 2, 1 }), 3);
  const Vector<double> kept = roomy.Unknowns();
  SolverOfUnknowns narrow(mesh);
  narrow.SetMemoryLimit(0);
  EXPECT_EQ(setups(narrow, { 4, 2, 4, 4, 2 }), 4);
  narrow.SetMemoryLimit(1LL << 40);
  EXPECT_EQ(setups(narrow, { 4, 2, 4, 2 }), 5);
  EXPECT_EQ(setups(narrow, { 1 }), 6);
  EXPECT_EQ(narrow.Unknowns(), kept);
  narrow.SetMemoryLimit(0); // what is in use stays
  EXPECT_EQ(setups(narrow, { 1 }), 6);
  EXPECT_EQ(setups(narrow, { 4 }), 7);
}

TEST(FieldSolver, AnErrorLeavesWhatStands)
{
  const TriangleMesh mesh = IrregularTorus(48, 24, 4).Mesh();
  SolverOfUnknowns solver(mesh);
  const Vector<double> field = solver.Solve(Directions(mesh), {});
  FieldOptions wrong;
  wrong.Alignment = -1.0;
  EXPECT_THROW(solver.Solve(Directions(mesh), wrong), InvalidInput);
  wrong = {};
  wrong.Field.N = 9;
  EXPECT_THROW(solver.Solve(Directions(mesh), wrong), InvalidInput);
  wrong = {};
  wrong.Field.Kind = DiscretisationKind::ScalarFunction;
  EXPECT_THROW(solver.Solve({}, wrong), InvalidInput);
  EXPECT_EQ(solver.Solve(Directions(mesh), {}), field);
  EXPECT_EQ(solver.Counts().Solves, 1);
}

// The first direction is one of the N, 2 pi / N apart, in the plane of its face, and follows what is prescribed.
TEST(FieldSolver, DirectionsFollowWhatIsPrescribed)
{
  const TriangleMesh mesh = IrregularSphere(3, 3).Mesh();
  FieldOptions options;
  options.Constraints = ConstraintKind::Hard;
  const Constraints directions = Directions(mesh);
  for (const int N : { 1, 2, 4 })
  {
    options.Field.N = N;
    SolverOfUnknowns solver(mesh);
    solver.Solve(directions, options);
    for (const auto& [face, direction, weight, side] : directions.OnFaces)
    {
      double nearest = 10.0;
      for (int k = 0; k < N; ++k)
      {
        nearest = std::min(nearest, (Vector3(solver.Directions(k).row(face)) - direction).norm());
      }
      EXPECT_LE(nearest, 1e-12);
    }
  }
}

TEST(FieldSolver, SolversAgreeOnEveryDiscretisation)
{
  for (const Surface& surface : { IrregularSphere(3, 3), IrregularTorus(28, 14, 4), IrregularPlane(20, 16, 5) })
  {
    const PreparedSurface on(surface);
    SolverOfUnknowns fields(on.Mesh);
    for (DiscretisationKind kind : AllKinds)
    {
      for (ConstraintKind constraintKind : { ConstraintKind::Soft, ConstraintKind::Hard })
      {
        FieldOptions options;
        options.Field.Kind = kind;
        options.Constraints = constraintKind;
        const auto solve = [&](SolverKind solver, CoarseSpaceKind space)
        {
          options.Solver.Kind = solver;
          options.CoarseSpace = space;
          options.Solver.Nested.Cycles = 60;
          options.Solver.Nested.Sweeps = 0;
          fields.SetOperators(std::make_shared<const ProlongationOperators>(on.Operators));
          const Vector<double> field = fields.Solve(Prescriptions(on.Framed, 97), options, Tight());
          EXPECT_TRUE(fields.Report().Converged) << fields.Report().Solver;
          return field;
        };
        const Vector<double> direct = solve(SolverKind::Cholesky, CoarseSpaceKind::LinearInterpolation);
        for (SolverKind solver : { SolverKind::ConjugateGradients, SolverKind::NestedIterations })
        {
          for (CoarseSpaceKind space : { CoarseSpaceKind::LinearInterpolation, CoarseSpaceKind::StructurePreserving })
          {
            EXPECT_LT((solve(solver, space) - direct).norm(), 1e-7 * direct.norm())
              << static_cast<int>(kind) << static_cast<int>(solver) << static_cast<int>(space);
          }
        }
      }
    }
  }
}

// The system that is factored is that of HarmonicSystem, which is assembled and reduced otherwise.
TEST(FieldSolver, AgreesWithTheTextbookSystem)
{
  const PreparedSurface on(IrregularTorus(16, 10, 4));
  const Constraints directions = Prescriptions(on.Framed, 37);
  for (ConstraintKind constraints : { ConstraintKind::Soft, ConstraintKind::Hard })
  {
    FieldOptions options;
    options.Constraints = constraints;
    options.Alignment = 3.0;
    options.Smoothness = 0.5;
    const auto expectSame = [&](const auto& system, const auto& values, const auto& pairsOf)
    {
      const auto x = system.Expand(Solved(Densified(system.Matrix()), system.RightHandSide(values)), values);
      SolverOfUnknowns fields(on.Mesh);
      const Vector<double> field = fields.Solve(directions, options, Tight());
      const Vector<double> expected = pairsOf(x);
      EXPECT_LE((field - expected).norm(), 1e-10 * expected.norm()) << fields.Field().Name();
    };
    const auto real = [](const Vector<double>& x) { return x; };
    options.Field.Kind = DiscretisationKind::PowerField;
    options.Field.N = 3;
    const FieldConstraints powers = MakePowerConstraints(on.Mesh, on.Frames, 3, directions.OnFaces);
    expectSame(MakePowerFieldSystem(on.Mesh, on.Frames, 3, powers, options.Weights()), ComplexValues(powers),
      [](const Vector<Complex>& x) { return Vector<double>(AsPairs(x)); });
    options.Field.Kind = DiscretisationKind::FaceField;
    const FieldConstraints vectors = MakePowerConstraints(on.Mesh, on.Frames, 1, directions.OnFaces);
    expectSame(MakeFaceFieldSystem(on.Mesh, on.Frames, vectors, options.Weights()), vectors.Values, real);
    options.Field.Kind = DiscretisationKind::OneForm;
    const FieldConstraints forms = OneFormConstraintsOnFaces(on.Mesh, on.Frames, directions.OnFaces);
    expectSame(MakeOneFormSystem(on.Mesh, forms, options.Weights()), forms.Values, real);
  }
}

// Set-up, system and solve share one way from 0 to 1. What was complete when a run was
// stopped is kept, and changes nothing.
TEST(FieldSolver, ReportsProgressOnceAndStopsWhenAsked)
{
  const PreparedSurface on(IrregularTorus(48, 24, 4));
  for (DiscretisationKind kind : AllKinds)
  {
    SCOPED_TRACE(static_cast<int>(kind));
    FieldOptions options;
    options.Field.Kind = kind;
    options.Solver.Kind = SolverKind::ConjugateGradients;
    const Constraints directions = Prescriptions(on.Framed, 97);
    TbbContext all(2);
    SolverOfUnknowns fields(on.Mesh);
    const Vector<double> expected = fields.Solve(directions, options, Tight(), all);
    const std::vector<double>& progress = all.Progress();
    EXPECT_TRUE(std::is_sorted(progress.begin(), progress.end()));
    EXPECT_EQ(progress.front(), 0.0);
    EXPECT_EQ(progress.back(), 1.0);
    for (std::size_t count = 1; count <= progress.size(); ++count)
    {
      TbbContext context(2);
      context.CancelAfter(static_cast<int>(count));
      SolverOfUnknowns stopped(on.Mesh);
      EXPECT_THROW(stopped.Solve(directions, options, Tight(), context), Cancelled);
      EXPECT_EQ(context.Progress().size(), count);
      if (count % 7 == 0)
      {
        EXPECT_EQ(stopped.Solve(directions, options, Tight()), expected);
      }
    }
  }
}

namespace
{

constexpr DiscretisationKind KindsWithDirections[] = { DiscretisationKind::VertexPowerField,
  DiscretisationKind::FaceField, DiscretisationKind::OneForm };

FieldOptions OptionsWith(DiscretisationKind kind, SolverKind solver)
{
  FieldOptions options;
  options.Field.Kind = kind;
  options.Solver.Kind = solver;
  return options;
}

/// A surface of three levels from edge collapses, and its fields by Cholesky.
class OnStoredLevels
{
public:
  OnStoredLevels()
    : Mesh(IrregularTorus(48, 24, 4).Mesh())
    , Solver(this->Mesh)
  {
    HierarchyOptions levels;
    levels.MinimumNumberOfFaces = 100;
    this->Solver.SetOperators(std::make_shared<const ProlongationOperators>(
      BuildSurfaceHierarchy(this->Mesh, levels, SerialContext()).Operators));
  }

  Vector<double> Solve(const FieldOptions& options)
  {
    return this->Solver.Solve(Directions(this->Mesh), options, { 1e-12, 2000 });
  }
  /// The distance from the solution, relative to its norm.
  double Error(const FieldOptions& options)
  {
    const Vector<double> exact = this->Solve(OptionsWith(options.Field.Kind, SolverKind::Cholesky));
    return (this->Solve(options) - exact).norm() / exact.norm();
  }

private:
  const TriangleMesh Mesh;
  SolverOfUnknowns Solver;
};

}

// The level that is solved exactly is the finest one.
TEST(FieldSolver, StartedOnTheFinestLevelIsExact)
{
  OnStoredLevels on;
  for (const DiscretisationKind kind : KindsWithDirections)
  {
    FieldOptions options = OptionsWith(kind, SolverKind::CoarseProlongation);
    EXPECT_GT(on.Error(options), 1e-3);
    options.Solver.StartingLevel = 0;
    EXPECT_LT(on.Error(options), 1e-7);
  }
}

TEST(FieldSolver, NestedIterationsComeCloserThanTheirStart)
{
  OnStoredLevels on;
  for (const DiscretisationKind kind : KindsWithDirections)
  {
    const double sketch = on.Error(OptionsWith(kind, SolverKind::CoarseProlongation));
    FieldOptions options = OptionsWith(kind, SolverKind::NestedIterations);
    options.Solver.Nested.Cycles = 0;
    EXPECT_LT(on.Error(options), sketch);
  }
}

// With another start, linear levels are those that were stored, not samples.
TEST(FieldSolver, SolvesOnStoredLinearLevels)
{
  OnStoredLevels on;
  for (const DiscretisationKind kind : KindsWithDirections)
  {
    for (const SolverKind solver : { SolverKind::ConjugateGradients, SolverKind::VCycles })
    {
      FieldOptions options = OptionsWith(kind, solver);
      options.Solver.StartingLevel = 1;
      EXPECT_LT(on.Error(options), 1e-7);
    }
  }
}
