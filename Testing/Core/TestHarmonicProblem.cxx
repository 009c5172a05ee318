#include "Solvers/HarmonicProblem.h"

#include "Operators/ExteriorCalculus.h"
#include "PreparedField.h"
#include "Solvers/Krylov/ConjugateGradient.h"
#include "Support/Errors.h"
#include "Support/MeshFactory.h"
#include "Support/Random.h"
#include "Support/ReferenceOperators.h"
#include "Support/TbbContext.h"

#include <gtest/gtest.h>

#include <Eigen/SparseCholesky>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

using namespace dmg;
using namespace dmg::test;

namespace
{

/// A torus, then a sphere beside it.
struct TorusAndSphere
{
  const Surface Torus = IrregularTorus(28, 14, 4);
  const Surface Both = Union(this->Torus, IrregularSphere(3, 3), Vector3(4.0, 0.0, 0.0));
};

/// Unknowns of the faces from \p firstFace on.
std::vector<int> UnknownsOfFaces(const PreparedField& on, int firstFace)
{
  std::vector<int> unknowns;
  for (int h = 3 * firstFace; h < 3 * on.Mesh.NumberOfFaces(); ++h)
  {
    const int element = on.IsAtVertices() ? on.Mesh.Tail(h) : TriangleMesh::FaceOf(h);
    if (on.IsForm())
    {
      unknowns.push_back(on.Mesh.EdgeOf(h));
      continue;
    }
    unknowns.push_back(2 * element);
    unknowns.push_back(2 * element + 1);
  }
  std::sort(unknowns.begin(), unknowns.end());
  unknowns.erase(std::unique(unknowns.begin(), unknowns.end()), unknowns.end());
  return unknowns;
}

}

TEST(HarmonicProblem, AgreesWithCholesky)
{
  for (const Surface& surface : { IrregularTorus(28, 14, 4), IrregularPlane(20, 16, 5), TorusAndSphere().Both })
  {
    for (const DiscretisationKind kind : AllKinds)
    {
      const PreparedField on(surface, kind);
      for (const ConstraintKind constraints : BothConstraints)
      {
        SCOPED_TRACE(Describe(kind, constraints));
        const Elements elements = on.Every(47);
        const Vector<double> values = on.RandomValues(elements, 3701);
        for (const double smoothness : { 1.0, 0.05, 30.0 })
        {
          const FieldWeights weights = { smoothness, 1.5, constraints };
          FieldProblem factored = on.Factored(elements, weights);
          const Vector<double> expected = factored.Solve(values, {}, Tight(), SerialContext());
          const IterationReport& best = factored.Report().Iterations.back();
          for (const SolverKind solver : { SolverKind::ConjugateGradients, SolverKind::VCycles })
          {
            HarmonicProblem problem = on.Problem(elements, weights, solver);
            const Vector<double> field = problem.Solve(values, {}, { expected }, Tight(), SerialContext());
            const SolveReport& report = problem.Report();
            EXPECT_TRUE(report.Converged) << report.Solver;
            EXPECT_LE((field - expected).norm(), 1e-7 * expected.norm());
            // Both call energy what x minimises, in the same units.
            EXPECT_NEAR(report.Iterations.back().Energy, best.Energy, 1e-9 * std::abs(best.Energy));
            EXPECT_LE(report.Iterations.back().Error, 1e-7);
            // The start is zero, but for what penalties alone hold.
            EXPECT_EQ(report.Iterations.front().RelativeResidual, 1.0);
            if (constraints == ConstraintKind::Hard)
            {
              EXPECT_EQ(report.Iterations.front().Energy, 0.0);
              EXPECT_DOUBLE_EQ(report.Iterations.front().Error, 1.0);
              EXPECT_DOUBLE_EQ(report.Iterations.front().MassResidual, 1.0);
            }
            else
            {
              EXPECT_LT(report.Iterations.front().Energy, 0.0);
              EXPECT_GT(report.Iterations.front().Energy, best.Energy);
              EXPECT_LT(report.Iterations.front().MassResidual, 1.0);
            }
            EXPECT_EQ(report.Warnings, factored.Report().Warnings);
          }
        }
      }
    }
  }
}

// Where the sum of smoothness energy, penalties and -2 source^T x is least, its derivative is zero.
TEST(HarmonicProblem, SourcesActOnAllThatIsFree)
{
  const PreparedField on(IrregularSphere(3, 3), DiscretisationKind::OneForm);
  const SparseMatrix<double> R = OneFormLaplacian(on.Mesh, SerialContext());
  const Elements elements = on.Every(37);
  Random random(91);
  Vector<double> source(on.NumberOfUnknowns());
  for (double& value : source)
  {
    value = random.Uniform(-1.0, 1.0);
  }
  for (const ConstraintKind constraints : BothConstraints)
  {
    const FieldWeights weights{ 2.5, 0.7, constraints };
    const Penalties prescribed = on.Prescribed(elements, weights);
    const Vector<double> values = on.RandomValues(elements, 12);
    for (const SolverKind solver : { SolverKind::ConjugateGradients, SolverKind::VCycles })
    {
      HarmonicProblem problem = on.Problem(elements, weights, solver);
      const Vector<double> x = problem.Solve(values, {}, {}, Tight(), SerialContext(), source);
      const bool isHard = constraints == ConstraintKind::Hard;
      Vector<double> derivative = (isHard ? 1.0 : weights.Smoothness) * (R * x) - source;
      for (std::size_t b = 0; b < elements.Numbers.size(); ++b)
      {
        const int i = elements.Numbers[b];
        derivative[i] = isHard ? x[i] - values[b] : derivative[i] + prescribed.Alignment[b] * (x[i] - values[b]);
      }
      EXPECT_LT(derivative.norm(), 1e-9 * source.norm()) << Describe(on.Kind, constraints);
    }
  }
}

TEST(HarmonicProblem, HardConstraintsHoldExactly)
{
  for (const DiscretisationKind kind : AllKinds)
  {
    const PreparedField on(IrregularTorus(28, 14, 4), kind);
    const FieldWeights weights = { 1.0, 1.0, ConstraintKind::Hard };
    const Elements elements = on.Every(31, 2);
    const Vector<double> values = on.RandomValues(elements, 3702);
    HarmonicProblem problem = on.Problem(elements, weights);
    const Penalties prescribed = on.Prescribed(elements, weights);
    const Vector<double> field = problem.Solve(values, {}, {}, {}, SerialContext());
    EXPECT_EQ(Vector<double>(field(prescribed.Unknowns)), values);
    EXPECT_TRUE(std::isnan(problem.Report().Iterations.back().Error)) << "without a reference";
  }
}

// What no prescription reaches has a field of its own.
TEST(HarmonicProblem, UnreachedComponentsHoldTheSmoothestField)
{
  const TorusAndSphere surface;
  const int facesOfTorus = static_cast<int>(surface.Torus.F.rows());
  for (const DiscretisationKind kind : AllKinds)
  {
    const PreparedField on(surface.Both, kind);
    const std::vector<int> ofSphere = UnknownsOfFaces(on, facesOfTorus);
    const Elements all = on.Every(29);
    for (const ConstraintKind constraints : BothConstraints)
    {
      SCOPED_TRACE(Describe(kind, constraints));
      Elements elements;
      for (std::size_t k = 0; k < all.Numbers.size(); ++k)
      {
        const int unknown = on.UnknownsPerElement() * all.Numbers[k];
        if (!std::binary_search(ofSphere.begin(), ofSphere.end(), unknown))
        {
          elements.Numbers.push_back(all.Numbers[k]);
          elements.Weights.push_back(all.Weights[k]);
        }
      }
      ASSERT_GT(elements.Numbers.size(), 10u);
      const FieldWeights weights = { 1.0, 1.0, constraints };
      const Vector<double> values = on.RandomValues(elements, 3703);
      HarmonicProblem problem = on.Problem(elements, weights);
      EXPECT_TRUE(problem.Report().Warnings.empty());
      // Whatever stands there at the start.
      const Vector<double> start = Vector<double>::Ones(on.NumberOfUnknowns());
      Vector<double> field = problem.Solve(values, start, {}, Tight(), SerialContext());
      EXPECT_TRUE(problem.Report().Converged);
      EXPECT_TRUE(problem.Report().Warnings.empty());
      FieldProblem factored = on.Factored(elements, weights);
      Vector<double> reference = factored.Solve(values, {}, Tight(), SerialContext());
      ASSERT_EQ(problem.Report().Eigenvalues.size(), 1u);
      EXPECT_NEAR(
        problem.Report().Eigenvalues[0], factored.Report().Eigenvalues[0], 1e-8 * factored.Report().Eigenvalues[0]);
      EXPECT_GT(field(ofSphere).norm(), 0.0);
      // The eigenvalues of a sphere are multiple, so its fields may differ.
      field(ofSphere).setZero();
      reference(ofSphere).setZero();
      EXPECT_LE((field - reference).norm(), 1e-7 * reference.norm());
    }
  }
}

TEST(HarmonicProblem, WeightsCountByTheirRatio)
{
  for (const DiscretisationKind kind : AllKinds)
  {
    const PreparedField on(IrregularTorus(28, 14, 4), kind);
    const Elements elements = on.Every(31);
    const Vector<double> values = on.RandomValues(elements, 3704);
    const auto solve = [&](double factor)
    {
      HarmonicProblem problem = on.Problem(elements, { 0.5 * factor, 3.0 * factor, ConstraintKind::Soft });
      const Vector<double> field = problem.Solve(values, {}, {}, {}, SerialContext());
      return std::pair(field, problem.Report().Iterations.back().Energy);
    };
    const auto [field, energy] = solve(1.0);
    const auto [same, larger] = solve(8.0); // a power of two rounds nothing
    EXPECT_EQ(same, field);
    EXPECT_EQ(larger, 8.0 * energy);
    EXPECT_LT(energy, 0.0);
  }
}

// A problem that was updated is the problem that a new one would be, whatever it was before.
TEST(HarmonicProblem, UpdateIsANewProblem)
{
  const TorusAndSphere surface;
  for (const DiscretisationKind kind : AllKinds)
  {
    const PreparedField on(surface.Both, kind);
    struct Case
    {
      Elements Of;
      FieldWeights Weights;
    };
    const int few = on.NumberOfElements() / 3; // on the torus alone
    const std::vector<Case> cases = {
      { on.Every(31), { 1.0, 1.0, ConstraintKind::Soft } },
      { on.Every(31), { 0.1, 7.0, ConstraintKind::Soft } },
      { on.Every(17, 3), { 1.0, 1.0, ConstraintKind::Soft } },
      { on.Every(31), { 1.0, 1.0, ConstraintKind::Hard } },
      { on.Every(2), { 1.0, 1.0, ConstraintKind::Hard } },
      { on.Every(19, 1, few), { 1.0, 1.0, ConstraintKind::Soft } },
      { on.Every(23, 1, few), { 1.0, 1.0, ConstraintKind::Hard } },
      { on.Every(31), { 1.0, 1.0, ConstraintKind::Soft } },
    };
    HarmonicProblem updated = on.Problem(cases[1].Of, cases[1].Weights);
    for (std::size_t k = 0; k < cases.size(); ++k)
    {
      SCOPED_TRACE(Describe(kind, cases[k].Weights.Constraints) + ", case " + std::to_string(k));
      const auto& [elements, weights] = cases[k];
      updated.Update(on.Prescribed(elements, weights), weights.Smoothness, SerialContext());
      HarmonicProblem fresh = on.Problem(elements, weights);
      EXPECT_EQ(updated.Report().Warnings, fresh.Report().Warnings);
      EXPECT_EQ(updated.Report().Solver, fresh.Report().Solver);
      EXPECT_EQ(updated.Report().Bytes, fresh.Report().Bytes);
      ASSERT_EQ(updated.Report().Levels.size(), fresh.Report().Levels.size());
      const Vector<double> values = on.RandomValues(elements, 3705);
      const Vector<double> field = updated.Solve(values, {}, {}, {}, SerialContext());
      EXPECT_EQ(field, fresh.Solve(values, {}, {}, {}, SerialContext()));
      EXPECT_TRUE(fresh.Report().Converged);
      ASSERT_EQ(updated.Report().Iterations.size(), fresh.Report().Iterations.size());
      EXPECT_EQ(updated.Report().Iterations.back().Energy, fresh.Report().Iterations.back().Energy);
    }
  }
}

TEST(HarmonicProblem, StartsWhereItIsTold)
{
  for (const DiscretisationKind kind : AllKinds)
  {
    for (const ConstraintKind constraints : BothConstraints)
    {
      SCOPED_TRACE(Describe(kind, constraints));
      const PreparedField on(IrregularTorus(28, 14, 4), kind);
      const Elements elements = on.Every(31);
      const FieldWeights weights = { 1.0, 1.0, constraints };
      Vector<double> values = on.RandomValues(elements, 3706);
      HarmonicProblem problem = on.Problem(elements, weights);
      const Vector<double> field = problem.Solve(values, {}, {}, {}, SerialContext());
      const std::size_t cold = problem.Report().Iterations.size();
      problem.Solve(values, field, {}, {}, SerialContext());
      EXPECT_LE(problem.Report().Iterations.size(), 2u);
      // Other values need no other system. What stands where unknowns are held does not matter.
      values[0] += 0.01;
      Vector<double> start = field;
      const Vector<double> near = problem.Solve(values, start, {}, {}, SerialContext());
      EXPECT_LT(problem.Report().Iterations.size(), cold);
      if (constraints == ConstraintKind::Hard)
      {
        for (const int unknown : on.Prescribed(elements, weights).Unknowns)
        {
          start[unknown] = 1e3;
        }
        EXPECT_EQ(problem.Solve(values, start, {}, {}, SerialContext()), near);
      }
    }
  }
}

// The matrix is assembled in three ways, and another library factors it.
TEST(HarmonicProblem, ItsEquationsHaveTheSolution)
{
  for (const DiscretisationKind kind : AllKinds)
  {
    const PreparedField on(TorusAndSphere().Both, kind);
    const auto assembled = SetupOf(on.Framed, nullptr, OptionsOf(kind, SolverKind::Cholesky), SerialContext());
    for (const ConstraintKind constraints : BothConstraints)
    {
      SCOPED_TRACE(Describe(kind, constraints));
      const FieldWeights weights = { 0.3, 1.0, constraints };
      const Elements elements = on.Every(47);
      const Vector<double> values = on.RandomValues(elements, 3703);
      const auto solved = [&](const std::shared_ptr<const MultigridSetup>& setup, SolverKind solver)
      {
        HarmonicProblem problem(
          setup, on.Prescribed(elements, weights), weights.Smoothness, {}, { &MethodOf(solver), "" }, SerialContext());
        const Vector<double> x = problem.Solve(values, {}, {}, Tight(), SerialContext());
        const LinearSystem system = problem.Equations(values, SerialContext());
        EXPECT_LE(
          (system.Matrix - SparseMatrix<double>(system.Matrix.transpose())).norm(), 1e-14 * system.Matrix.norm());
        const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> other{ Eigen::SparseMatrix<double>(system.Matrix) };
        const Vector<double> expected = other.solve(system.RightHandSide);
        EXPECT_LE((x - expected).norm(), 1e-8 * expected.norm());
      };
      solved(on.Levels, SolverKind::ConjugateGradients);
      solved(assembled, SolverKind::Cholesky);
    }
  }
}

// Where nothing is prescribed the matrix is R alone, and the solution is its eigenvector.
TEST(HarmonicProblem, ItsEquationsAreThoseOfTheStiffnessWithoutPrescriptions)
{
  const PreparedField on(IrregularSphere(3, 3), DiscretisationKind::PowerField);
  HarmonicProblem problem = on.Problem({}, FieldWeights());
  const Vector<double> x = problem.Solve({}, {}, {}, StoppingCriteria(), SerialContext());
  const LinearSystem system = problem.Equations({}, SerialContext());
  EXPECT_EQ(system.RightHandSide.norm(), 0.0);
  ASSERT_EQ(problem.Report().Eigenvalues.size(), 1u);
  const double energy = x.dot(system.Matrix * x) / problem.Setup().Area;
  EXPECT_NEAR(energy, problem.Report().Eigenvalues[0], 1e-6 * energy);
}

namespace
{

/// The inverse of the diagonal.
class JacobiPreconditioner : public StiffnessCycle
{
public:
  JacobiPreconditioner(const StiffnessHierarchy& hierarchy, const Vector<double>& D)
    : Hierarchy(hierarchy)
  {
    this->Update(D, SerialContext());
  }
  void Update(const Vector<double>& D, const ExecutionContext&) override
  {
    this->Diagonal = D;
    for (Eigen::Index i = 0; i < D.size(); ++i)
    {
      this->Diagonal[i] += this->Hierarchy.DiagonalOf(static_cast<int>(i));
    }
  }
  void Apply(const Vector<double>& r, Vector<double>& z, const ExecutionContext&) override
  {
    z = r.cwiseQuotient(this->Diagonal);
  }
  std::vector<LevelReport> Levels() const override { return { { this->Diagonal.size(), this->Diagonal.size() } }; }
  long long Bytes() const override { return this->Diagonal.size() * static_cast<long long>(sizeof(double)); }

private:
  const StiffnessHierarchy& Hierarchy;
  Vector<double> Diagonal;
};

std::unique_ptr<StiffnessCycle> MakeJacobi(
  const MultigridSetup& setup, const Vector<double>& D, const SolverOptions&, const ExecutionContext&)
{
  return std::make_unique<JacobiPreconditioner>(*setup.Hierarchy, D);
}

}

// A problem knows roles, and no kinds of solvers.
TEST(HarmonicProblem, IsSolvedByAMethodOfTheCaller)
{
  SolverMethod jacobi;
  jacobi.Name = "conjugate gradients by Jacobi";
  jacobi.NeedsLevels = false;
  jacobi.MakePreconditioner = &MakeJacobi;
  jacobi.Iterate = &ConjugateGradient<double>;
  const FieldWeights weights;
  for (const DiscretisationKind kind : AllKinds)
  {
    const PreparedField on(IrregularPlane(20, 16, 5), kind);
    const Elements elements = on.Every(47);
    const Vector<double> values = on.RandomValues(elements, 3704);
    HarmonicProblem problem(
      on.Levels, on.Prescribed(elements, weights), 1.0, {}, { &jacobi, ", as asked" }, SerialContext());
    const Vector<double> x = problem.Solve(values, {}, {}, { 1e-11, 3000 }, SerialContext());
    EXPECT_TRUE(problem.Report().Converged);
    EXPECT_EQ(problem.Report().Solver, "conjugate gradients by Jacobi, as asked");
    FieldProblem factored = on.Factored(elements, weights);
    const Vector<double> expected = factored.Solve(values, {}, Tight(), SerialContext());
    EXPECT_LE((x - expected).norm(), 1e-8 * expected.norm());
  }
}

TEST(HarmonicProblem, ReportsProgressOnceAndStopsWhenAsked)
{
  const PreparedField on(IrregularTorus(28, 14, 4), DiscretisationKind::FaceField);
  const FieldWeights weights;
  const SolverOptions options;
  const SolverChoice choice = { &MethodOf(SolverKind::ConjugateGradients), "" };
  const Penalties prescribed = on.Prescribed(on.Every(31), weights);
  for (const bool isUpdate : { false, true })
  {
    const auto make = [&](const ExecutionContext& context)
    {
      const SerialContext serial;
      const ExecutionContext& first = isUpdate ? serial : context;
      HarmonicProblem problem(on.Levels, prescribed, 1.0, options, choice, first);
      if (isUpdate)
      {
        problem.Update(on.Prescribed(on.Every(7), weights), 2.0, context);
      }
    };
    const TbbContext all(2);
    make(all);
    ASSERT_FALSE(all.Progress().empty());
    EXPECT_TRUE(std::is_sorted(all.Progress().begin(), all.Progress().end()));
    EXPECT_EQ(all.Progress().back(), 1.0);
    for (std::size_t count = 1; count <= all.Progress().size(); ++count)
    {
      TbbContext context(2);
      context.CancelAfter(static_cast<int>(count));
      EXPECT_THROW(make(context), Cancelled);
    }
  }
}
