#include "Support/FieldProblem.h"

#include "Discretisations/MakeDiscretisation.h"
#include "Operators/ExteriorCalculus.h"
#include "Operators/FaceFieldOperators.h"
#include "PreparedField.h"
#include "PreparedSurface.h"
#include "StructurePreserving/SurfaceHierarchy.h"
#include "Support/Errors.h"
#include "Support/MeshFactory.h"
#include "Support/ReferenceOperators.h"
#include "Support/TbbContext.h"

#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <utility>
#include <vector>

using namespace dmg;
using namespace dmg::test;

TEST(FieldProblem, UpdateIsANewProblem)
{
  const PreparedSurface on(IrregularTorus(48, 24, 4));
  for (DiscretisationKind kind : AllKinds)
  {
    for (SolverKind solver : { SolverKind::ConjugateGradients, SolverKind::Cholesky, SolverKind::NestedIterations })
    {
      SCOPED_TRACE(std::to_string(static_cast<int>(kind)) + " " + MethodOf(solver).Name);
      FieldOptions options;
      options.Field.Kind = kind;
      options.Solver.Kind = solver;
      options.Solver.Nested.Cycles = 40;
      options.Solver.Nested.Sweeps = 0;
      const auto constraintsOf = [&](int step)
      { return MakeFieldConstraints(on.Framed, Prescriptions(on.Framed, step), options); };
      const auto make = [&](const FieldConstraints& constraints)
      { return FieldProblem(on.Framed, &on.Operators, constraints, options, SerialContext()); };
      const auto solve = [](FieldProblem& problem, const FieldConstraints& constraints)
      {
        const Vector<double> field = problem.Solve(constraints.Values, {}, { 1e-11, 200 }, SerialContext());
        EXPECT_TRUE(problem.Report().Converged);
        return field;
      };
      FieldProblem problem = make(constraintsOf(97));
      const auto expectUpdates = [&](const FieldConstraints& constraints)
      {
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

TEST(FieldProblem, OnASurfaceOfOneLevelIsFactored)
{
  const FramedMesh surface(IrregularSphere(2, 3).Mesh());
  const TriangleMesh& mesh = surface.Mesh;
  const ProlongationOperators operators = BuildSurfaceHierarchy(mesh, HierarchyOptions(), SerialContext()).Operators;
  ASSERT_EQ(operators.NumberOfLevels(), 1);
  for (DiscretisationKind kind : AllKinds)
  {
    FieldOptions options;
    options.Field.Kind = kind;
    const FieldConstraints constraints = MakeFieldConstraints(surface, { WaveOfDirections(mesh, 50), {} }, options);
    const auto solve = [&](SolverKind solver)
    {
      options.Solver.Kind = solver;
      FieldProblem problem(surface, &operators, constraints, options, SerialContext());
      const Vector<double> field = problem.Solve(constraints.Values, {}, StoppingCriteria(), SerialContext());
      EXPECT_TRUE(problem.Report().Converged);
      EXPECT_EQ(problem.Report().Levels.size(), 1u);
      return std::pair(field, problem.Report().Solver);
    };
    const auto [direct, name] = solve(SolverKind::Cholesky);
    EXPECT_EQ(name, "supernodal Cholesky");
    const auto [automatic, reason] = solve(SolverKind::Automatic);
    EXPECT_EQ(automatic, direct);
    const int equations = MakeDiscretisation(options.Field, surface)->NumberOfEquations();
    EXPECT_EQ(
      reason.rfind(name + ", chosen for " + std::to_string(equations) + " unknowns, few enough to factor at once", 0),
      0u)
      << reason;
    for (const auto& [solver, instead] :
      std::vector<std::pair<SolverKind, std::string>>{ { SolverKind::VCycles, "in place of V-cycles" },
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
  const PreparedSurface on(IrregularTorus(96, 40, 8));
  for (DiscretisationKind kind : AllKinds)
  {
    FieldOptions options;
    options.Field.Kind = kind;
    options.Solver.Kind = SolverKind::ConjugateGradients;
    const FieldConstraints constraints =
      MakeFieldConstraints(on.Framed, { WaveOfDirections(on.Mesh, 50), {} }, options);
    const auto solve = [&](const ExecutionContext& context)
    {
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
  PreparedSurface on(IrregularTorus(28, 14, 4));
  for (const int known : { 2, 1 })
  {
    // What the coarsest level lacks is missed, so it is this that was prolonged.
    on.Operators.ClosedForms = SparseMatrix<double>(on.Operators.ClosedForms.leftCols(known));
    for (DiscretisationKind kind : { DiscretisationKind::FaceField, DiscretisationKind::OneForm })
    {
      for (CoarseSpaceKind space : { CoarseSpaceKind::LinearInterpolation, CoarseSpaceKind::StructurePreserving })
      {
        FieldOptions options;
        options.Field.Kind = kind;
        options.CoarseSpace = space;
        options.Solver.Kind = SolverKind::ConjugateGradients;
        const FieldProblem problem(on.Framed, &on.Operators,
          MakeFieldConstraints(on.Framed, { WaveOfDirections(on.Mesh, 50), {} }, options), options, SerialContext());
        EXPECT_EQ(problem.HarmonicFields().cols(), known);
      }
    }
  }
}

TEST(FieldProblem, NamesTheOperatorsThatAreMissing)
{
  const FramedMesh surface(IrregularSphere(3, 3).Mesh());
  const TriangleMesh& mesh = surface.Mesh;
  const SurfaceHierarchy hierarchy = BuildSurfaceHierarchy(mesh, Deep(), SerialContext(), { false, false, false });
  const char* const properties[] = { "::PowerFields", "::FaceFields", "::OneForms" };
  for (DiscretisationKind kind : AllKinds)
  {
    FieldOptions options;
    options.Field.Kind = kind;
    options.Solver.Kind = SolverKind::ConjugateGradients;
    const FieldConstraints constraints = MakeFieldConstraints(surface, { WaveOfDirections(mesh, 50), {} }, options);
    EXPECT_NO_THROW(FieldProblem(surface, &hierarchy.Operators, constraints, options, SerialContext()));
    options.CoarseSpace = CoarseSpaceKind::StructurePreserving;
    if (kind == DiscretisationKind::VertexPowerField)
    {
      EXPECT_NO_THROW(FieldProblem(surface, &hierarchy.Operators, constraints, options, SerialContext())); // S0
      continue;
    }
    try
    {
      FieldProblem(surface, &hierarchy.Operators, constraints, options, SerialContext());
      FAIL();
    }
    catch (const InvalidInput& error)
    {
      EXPECT_NE(std::string(error.what()).find(properties[static_cast<int>(kind)]), std::string::npos) << error.what();
    }
  }
}

TEST(FieldProblem, TakesLevelsOrMakesThem)
{
  for (const DiscretisationKind kind : AllKinds)
  {
    const PreparedField on(IrregularTorus(28, 14, 4), kind);
    for (const ConstraintKind constraints : BothConstraints)
    {
      SCOPED_TRACE(Describe(kind, constraints));
      FieldOptions options = OptionsOf(kind);
      options.Constraints = constraints;
      options.Smoothness = 0.7;
      const FieldConstraints prescribed = on.Constraints(on.Every(31), 3708);
      const auto solve = [&](std::shared_ptr<const MultigridSetup> levels)
      {
        FieldProblem problem(on.Framed, &on.Operators, prescribed, options, SerialContext(), std::move(levels));
        const Vector<double> field = problem.Solve(prescribed.Values, {}, StoppingCriteria(), SerialContext());
        EXPECT_TRUE(problem.Report().Converged);
        EXPECT_EQ(problem.Report().Solver, std::string("conjugate gradients with a V-cycle on linear levels"));
        return field;
      };
      const Vector<double> made = solve(nullptr);
      EXPECT_EQ(solve(on.Levels), made);
      EXPECT_EQ(solve(on.Levels), made) << "once more, since levels do not change";
      // Thread counts of levels and of problems do not matter either.
      const TbbContext threads(3);
      EXPECT_EQ(solve(SetupOf(on.Framed, &on.Operators, options, threads)), made);
    }
  }
}

TEST(FieldProblem, TakesSamplesWithoutOperators)
{
  for (const DiscretisationKind kind : AllKinds)
  {
    const PreparedField on(IrregularTorus(84, 42, 4), kind);
    const FieldOptions options = OptionsOf(kind);
    const FieldConstraints prescribed = on.Constraints(on.Every(31), 3708);
    const auto solve = [&](std::shared_ptr<const MultigridSetup> levels)
    {
      FieldProblem problem(on.Framed, nullptr, prescribed, options, SerialContext(), std::move(levels));
      EXPECT_EQ(problem.Report().Solver, "conjugate gradients with a V-cycle on linear levels");
      return problem.Solve(prescribed.Values, {}, StoppingCriteria(), SerialContext());
    };
    const TbbContext threads(3);
    const auto field = MakeDiscretisation(options.Field, on.Framed);
    const ProlongationOperators samples = field->SampledLevels(field->SampleDistance(), SerialContext());
    EXPECT_EQ(solve(SetupOf(on.Framed, nullptr, options, threads)),
      solve(SetupOf(on.Framed, &samples, options, SerialContext())));
  }
}

TEST(FieldProblem, KnowsTheHarmonicFieldsInTheCallersOrder)
{
  for (const DiscretisationKind kind : Squares)
  {
    for (const auto& [surface, loops] :
      { std::pair(IrregularTorus(28, 14, 4), 2), std::pair(IrregularSphere(3, 3), 0) })
    {
      const PreparedField on(surface, kind);
      const SparseMatrix<double> A = kind == DiscretisationKind::OneForm
        ? OneFormLaplacian(on.Mesh, SerialContext())
        : FaceFieldSmoothness(on.Mesh, on.Frames, SerialContext());
      for (const SolverKind solver : { SolverKind::ConjugateGradients, SolverKind::Cholesky })
      {
        SCOPED_TRACE(MethodOf(solver).Name);
        const FieldProblem problem(
          on.Framed, &on.Operators, on.Constraints(on.Every(31), 3721), OptionsOf(kind, solver), SerialContext());
        const Eigen::MatrixXd fields = problem.HarmonicFields();
        ASSERT_EQ(fields.cols(), loops);
        for (int k = 0; k < loops; ++k)
        {
          EXPECT_NEAR(fields.col(k).norm(), 1.0, 1e-12);
          EXPECT_LT((A * fields.col(k)).norm(), 1e-9 * A.norm());
        }
      }
    }
  }
}

TEST(FieldProblem, CyclesKeepStiffnessApartOnLinearLevels)
{
  for (const DiscretisationKind kind : AllKinds)
  {
    const PreparedField on(IrregularTorus(84, 42, 4), kind);
    const auto splitsOperator = [&on](const FieldOptions& options, const ProlongationOperators* operators)
    { return SplitsOperator(on.Framed, operators, options); };
    const ProlongationOperators none;
    EXPECT_FALSE(splitsOperator(OptionsOf(kind), &none));
    const ProlongationOperators* const samples = nullptr;
    for (const ProlongationOperators* operators : { &on.Operators, samples })
    {
      EXPECT_TRUE(splitsOperator(OptionsOf(kind), operators));
      EXPECT_TRUE(splitsOperator(OptionsOf(kind, SolverKind::VCycles), operators));
      EXPECT_FALSE(splitsOperator(OptionsOf(kind, SolverKind::Automatic), operators)) << "small";
      EXPECT_FALSE(splitsOperator(OptionsOf(kind, SolverKind::Cholesky), operators));
      EXPECT_FALSE(splitsOperator(OptionsOf(kind, SolverKind::NestedIterations), operators));
      FieldOptions options = OptionsOf(kind);
      options.CoarseSpace = CoarseSpaceKind::StructurePreserving;
      EXPECT_FALSE(splitsOperator(options, operators));
      options = OptionsOf(kind);
      options.Solver.StartingLevel = 1;
      EXPECT_FALSE(splitsOperator(options, operators));
    }
  }
}

TEST(FieldProblem, IsFactoredWhereThereAreTooFewFacesForSamples)
{
  for (const DiscretisationKind kind : AllKinds)
  {
    const PreparedField on(Icosphere(1), kind);
    const FieldOptions options = OptionsOf(kind);
    ASSERT_TRUE(SplitsOperator(on.Framed, nullptr, options));
    ASSERT_FALSE(SetupOf(on.Framed, nullptr, options, SerialContext())->HasLevels);
    const Elements elements = on.Every(31);
    const FieldConstraints prescribed = on.Constraints(elements, 3720);
    const auto solve = [&](FieldProblem problem)
    { return problem.Solve(prescribed.Values, {}, StoppingCriteria(), SerialContext()); };
    const Vector<double> field = solve(FieldProblem(on.Framed, nullptr, prescribed, options, SerialContext()));
    const Vector<double> expected = solve(on.Factored(elements, FieldWeights()));
    EXPECT_LE((field - expected).norm(), 1e-7 * expected.norm());
  }
}

// Too many unknowns to be factored for their number alone.
TEST(FieldProblem, IsFactoredWhereThereAreManyThinTriangles)
{
  const FramedMesh surface(Subdivide(Subdivide(Subdivide(PlaneWithThinTriangles(12, 32)))).Mesh());
  FieldConstraints prescribed;
  for (int face = 0; face < surface.Mesh.NumberOfFaces(); face += 5000)
  {
    prescribed.Elements.push_back(face);
    prescribed.Weights.push_back(1.0);
  }
  prescribed.Values = Vector<double>::Ones(2 * prescribed.Elements.size());
  const FieldOptions options = OptionsOf(DiscretisationKind::PowerField, SolverKind::Automatic);
  EXPECT_FALSE(SplitsOperator(surface, nullptr, options));
  FieldProblem problem(surface, nullptr, prescribed, options, SerialContext());
  problem.Solve(prescribed.Values, {}, StoppingCriteria(), SerialContext());
  EXPECT_TRUE(problem.Report().Converged);
  EXPECT_NE(problem.Report().Solver.find("of the triangles are thin"), std::string::npos) << problem.Report().Solver;
}
