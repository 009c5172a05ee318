#include "Solvers/HarmonicProblem.h"

#include "Analysis/HarmonicForms.h"
#include "Discretisations/MakeDiscretisation.h"
#include "Levels/SurfaceHierarchy.h"
#include "Operators/ExteriorCalculus.h"
#include "Operators/FaceFieldOperators.h"
#include "Support/Errors.h"
#include "Support/FieldProblem.h"
#include "Support/FieldSystems.h"
#include "Support/MeshFactory.h"
#include "Support/Random.h"
#include "Support/TbbContext.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <utility>
#include <vector>

using namespace dmg;
using namespace dmg::test;

namespace
{

constexpr DiscretisationKind Squares[] = { DiscretisationKind::FaceField, DiscretisationKind::OneForm };
constexpr DiscretisationKind Kinds[] = { DiscretisationKind::FaceField, DiscretisationKind::OneForm,
  DiscretisationKind::PowerField };
constexpr ConstraintKind BothConstraints[] = { ConstraintKind::Soft, ConstraintKind::Hard };

FieldOptions OptionsOf(DiscretisationKind kind, SolverKind solver = SolverKind::ConjugateGradients)
{
  FieldOptions options;
  options.Field.Kind = kind;
  options.Solver.Kind = solver;
  return options;
}

StoppingCriteria Tight()
{
  return { 1e-12, 300 };
}

/// Prescribed faces or edges with their weights.
struct Elements
{
  std::vector<int> Numbers;
  std::vector<double> Weights;
};

/// A discretisation on a surface, for cycles and for a factorisation.
struct Prepared
{
  Prepared(const Surface& surface, DiscretisationKind kind)
    : Kind(kind)
    , Owned(std::make_shared<const FramedMesh>(surface.Mesh()))
  {
    HierarchyOptions options;
    options.MinimumNumberOfFaces = 100;
    this->Operators =
      BuildSurfaceHierarchy(this->Mesh, options, SerialContext(), { false, false, false })
        .Operators;
    this->Levels =
      SetupOf(this->Framed, &this->Operators, OptionsOf(kind), SerialContext());
  }

  bool IsForm() const { return this->Kind == DiscretisationKind::OneForm; }
  int NumberOfElements() const
  {
    return this->IsForm() ? this->Mesh.NumberOfEdges() : this->Mesh.NumberOfFaces();
  }
  int NumberOfUnknowns() const
  {
    return this->IsForm() ? this->Mesh.NumberOfEdges() : 2 * this->Mesh.NumberOfFaces();
  }
  int UnknownsPerElement() const { return this->IsForm() ? 1 : 2; }

  /// Elements first, first + step, ... below \p last, with random weights.
  Elements Every(int step, int first = 0, int last = 1 << 30) const
  {
    Random random(3700 + step);
    Elements elements;
    for (int i = first; i < std::min(last, this->NumberOfElements()); i += step)
    {
      elements.Numbers.push_back(i);
      elements.Weights.push_back(random.Uniform(0.5, 2.0));
    }
    return elements;
  }

  PrescribedUnknowns Prescribed(const Elements& elements, const FieldWeights& weights) const
  {
    // The areas of faces pull at powers as they do at vectors.
    return this->IsForm() ? PrescribedUnknownsOf(this->Mesh,
                              PrescribedEdges{ elements.Numbers, elements.Weights }, weights)
                          : PrescribedUnknownsOf(this->Mesh,
                              PrescribedFaces{ elements.Numbers, elements.Weights }, weights);
  }

  HarmonicProblem Problem(const Elements& elements, const FieldWeights& weights,
    SolverKind solver = SolverKind::ConjugateGradients) const
  {
    return HarmonicProblem(this->Levels, this->Prescribed(elements, weights), weights.Smoothness,
      {}, { solver, "" }, SerialContext());
  }

  /// The same by factoring the matrix of the system, which is assembled otherwise.
  FieldProblem Factored(const Elements& elements, const FieldWeights& weights) const
  {
    FieldOptions options = OptionsOf(this->Kind, SolverKind::Cholesky);
    options.Smoothness = weights.Smoothness;
    options.Alignment = weights.Alignment;
    options.Constraints = weights.Constraints;
    return FieldProblem(this->Framed, nullptr, { elements.Numbers, elements.Weights, {} },
      options, SerialContext());
  }

  Vector<double> RandomValues(const Elements& elements, unsigned seed) const
  {
    Random random(seed);
    Vector<double> values(this->UnknownsPerElement() * elements.Numbers.size());
    for (double& value : values)
    {
      value = random.Uniform(-1.0, 1.0);
    }
    return values;
  }

  FieldConstraints Constraints(const Elements& elements, unsigned seed) const
  {
    return { elements.Numbers, elements.Weights, this->RandomValues(elements, seed) };
  }

  const DiscretisationKind Kind;
  const std::shared_ptr<const FramedMesh> Owned;
  const FramedMesh& Framed = *this->Owned;
  const TriangleMesh& Mesh = this->Framed.Mesh;
  const TangentFrames& Frames = this->Framed.Faces;
  ProlongationOperators Operators;
  std::shared_ptr<const MultigridSetup> Levels;
};

std::string Describe(DiscretisationKind kind, ConstraintKind constraints)
{
  const bool isFace = kind == DiscretisationKind::FaceField;
  return std::string(kind == DiscretisationKind::OneForm ? "1-form" : isFace ? "face field" : "powers") +
    (constraints == ConstraintKind::Soft ? ", soft" : ", hard");
}

/// A torus, then a sphere beside it.
struct TorusAndSphere
{
  const Surface Torus = IrregularTorus(28, 14, 4);
  const Surface Both = Union(this->Torus, IrregularSphere(3, 3), Vector3(4.0, 0.0, 0.0));
};

/// Unknowns of the faces from \p firstFace on.
std::vector<int> UnknownsOfFaces(const Prepared& on, int firstFace)
{
  std::vector<int> unknowns;
  for (int h = 3 * firstFace; h < 3 * on.Mesh.NumberOfFaces(); ++h)
  {
    const int face = TriangleMesh::FaceOf(h);
    unknowns.push_back(on.IsForm() ? on.Mesh.EdgeOf(h) : 2 * face + (h == 3 * face ? 0 : 1));
  }
  std::sort(unknowns.begin(), unknowns.end());
  unknowns.erase(std::unique(unknowns.begin(), unknowns.end()), unknowns.end());
  return unknowns;
}

}

TEST(HarmonicProblem, AgreesWithCholesky)
{
  for (const Surface& surface :
    { IrregularTorus(28, 14, 4), IrregularPlane(20, 16, 5), TorusAndSphere().Both })
  {
    for (const DiscretisationKind kind : Kinds)
    {
      const Prepared on(surface, kind);
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
            const Vector<double> field =
              problem.Solve(values, {}, expected, Tight(), SerialContext());
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

// Cotangents of faces without area make matrices of 1-forms so uneven that rounding errors alone
// are 1e-9 or so of a right-hand side.
// Where the sum of roughness, penalties and -2 source^T x is least, its derivative is zero.
TEST(HarmonicProblem, SourcesActOnAllThatIsFree)
{
  const Prepared on(IrregularSphere(3, 3), DiscretisationKind::OneForm);
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
    const PrescribedUnknowns prescribed = on.Prescribed(elements, weights);
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
        derivative[i] =
          isHard ? x[i] - values[b] : derivative[i] + prescribed.Alignment[b] * (x[i] - values[b]);
      }
      EXPECT_LT(derivative.norm(), 1e-9 * source.norm()) << Describe(on.Kind, constraints);
    }
  }
}

TEST(HarmonicProblem, FacesWithoutArea)
{
  for (const DiscretisationKind kind : Kinds)
  {
    const Prepared on(SphereWithZeroAreaFaces(3, 12), kind);
    for (const ConstraintKind constraints : BothConstraints)
    {
      SCOPED_TRACE(Describe(kind, constraints));
      const Elements elements = on.Every(47);
      const Vector<double> values = on.RandomValues(elements, 3710);
      for (const double smoothness : { 1.0, 0.05, 30.0 })
      {
        const FieldWeights weights = { smoothness, 1.5, constraints };
        FieldProblem factored = on.Factored(elements, weights);
        const Vector<double> expected = factored.Solve(values, {}, {}, SerialContext());
        const double best = factored.Report().Iterations.back().Energy;
        HarmonicProblem problem = on.Problem(elements, weights);
        const Vector<double> field = problem.Solve(values, {}, {}, {}, SerialContext());
        EXPECT_TRUE(problem.Report().Converged);
        EXPECT_LE((field - expected).norm(), 1e-3 * expected.norm());
        EXPECT_NEAR(problem.Report().Iterations.back().Energy, best, 1e-7 * std::abs(best));
      }
    }
  }
}

TEST(HarmonicProblem, HardConstraintsHoldExactly)
{
  for (const DiscretisationKind kind : Kinds)
  {
    const Prepared on(IrregularTorus(28, 14, 4), kind);
    const FieldWeights weights = { 1.0, 1.0, ConstraintKind::Hard };
    const Elements elements = on.Every(31, 2);
    const Vector<double> values = on.RandomValues(elements, 3702);
    HarmonicProblem problem = on.Problem(elements, weights);
    const PrescribedUnknowns prescribed = on.Prescribed(elements, weights);
    EXPECT_EQ(
      problem.NumberOfFree(), on.NumberOfUnknowns() - static_cast<int>(prescribed.Unknowns.size()));
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
  for (const DiscretisationKind kind : Kinds)
  {
    const Prepared on(surface.Both, kind);
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
      const int held = constraints == ConstraintKind::Hard ? static_cast<int>(values.size()) : 0;
      EXPECT_EQ(problem.NumberOfFree(), on.NumberOfUnknowns() - held);
      // Whatever stands there at the start.
      const Vector<double> start = Vector<double>::Ones(on.NumberOfUnknowns());
      Vector<double> field = problem.Solve(values, start, {}, Tight(), SerialContext());
      EXPECT_TRUE(problem.Report().Converged);
      EXPECT_TRUE(problem.Report().Warnings.empty());
      FieldProblem factored = on.Factored(elements, weights);
      Vector<double> reference = factored.Solve(values, {}, Tight(), SerialContext());
      ASSERT_EQ(problem.Report().Eigenvalues.size(), 1u);
      EXPECT_NEAR(problem.Report().Eigenvalues[0], factored.Report().Eigenvalues[0],
        1e-8 * factored.Report().Eigenvalues[0]);
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
  for (const DiscretisationKind kind : Kinds)
  {
    const Prepared on(IrregularTorus(28, 14, 4), kind);
    const Elements elements = on.Every(31);
    const Vector<double> values = on.RandomValues(elements, 3704);
    const auto solve = [&](double factor)
    {
      HarmonicProblem problem =
        on.Problem(elements, { 0.5 * factor, 3.0 * factor, ConstraintKind::Soft });
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
  for (const DiscretisationKind kind : Kinds)
  {
    const Prepared on(surface.Both, kind);
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
      EXPECT_EQ(updated.NumberOfFree(), fresh.NumberOfFree());
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
  for (const DiscretisationKind kind : Kinds)
  {
    for (const ConstraintKind constraints : BothConstraints)
    {
      SCOPED_TRACE(Describe(kind, constraints));
      const Prepared on(IrregularTorus(28, 14, 4), kind);
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

// A torus has two harmonic fields, which a face or two hold weakly. Cycles know them.
TEST(HarmonicProblem, FewPrescriptionsOnATorus)
{
  for (const DiscretisationKind kind : Squares)
  {
    const Prepared on(IrregularTorus(56, 24, 4), kind);
    EXPECT_EQ(on.Levels->Kernel.cols(), 2);
    for (const ConstraintKind constraints : BothConstraints)
    {
      SCOPED_TRACE(Describe(kind, constraints));
      const Elements elements = { { 7, 200, 901 }, { 1.0, 0.01, 1.0 } };
      const FieldWeights weights = { 100.0, 0.01, constraints };
      const Vector<double> values = on.RandomValues(elements, 3707);
      HarmonicProblem problem = on.Problem(elements, weights);
      const Vector<double> field = problem.Solve(values, {}, {}, {}, SerialContext());
      EXPECT_TRUE(problem.Report().Converged);
      EXPECT_LE(problem.Report().Iterations.back().Iteration, 15);
      FieldProblem factored = on.Factored(elements, weights);
      const Vector<double> expected = factored.Solve(values, {}, Tight(), SerialContext());
      EXPECT_LE((field - expected).norm(), 1e-4 * expected.norm());
    }
  }
}

// One edge determines one of the two harmonic fields: their combination that is largest there, as the
// other vanishes there and is left out. It costs nothing and meets the prescription.
// One edge determines one harmonic field of a torus, the smoothest; by cycles and by factorisation.
TEST(HarmonicProblem, LeavesOutHarmonicFieldsThatNothingDetermines)
{
  const Prepared on(IrregularTorus(28, 14, 4), DiscretisationKind::OneForm);
  const int edge = 7;
  const double value = 2.5;
  const Vector<double> values = Vector<double>::Constant(1, value);
  const Eigen::MatrixXd basis = HarmonicForms(on.Mesh, SerialContext());
  const Vector<double> there = basis.row(edge).transpose();
  const Vector<double> expected = value / there.squaredNorm() * (basis * there);
  for (const ConstraintKind constraints : BothConstraints)
  {
    SCOPED_TRACE(Describe(on.Kind, constraints));
    const Elements elements = { { edge }, { 1.0 } };
    const FieldWeights weights = { 1.0, 1.0, constraints };
    const auto expectIt = [&](const Vector<double>& field, const SolveReport& report) {
      EXPECT_TRUE(report.Converged);
      ASSERT_EQ(report.Warnings.size(), 1u) << report.Solver;
      EXPECT_NE(report.Warnings[0].find("1 of the 2 harmonic fields"), std::string::npos);
      EXPECT_LE((field - expected).norm(), 1e-6 * expected.norm()) << report.Solver;
    };
    HarmonicProblem problem = on.Problem(elements, weights);
    expectIt(problem.Solve(values, {}, {}, {}, SerialContext()), problem.Report());
    FieldProblem factored = on.Factored(elements, weights);
    expectIt(factored.Solve(values, {}, {}, SerialContext()), factored.Report());
  }
}

// Below rounding cycles stagnate, and so does the factor that takes over, but that is where the solution is.
// Needles: a torus that is stretched a thousand times.
TEST(HarmonicProblem, AFactorTakesOverWhereCyclesDoNotConverge)
{
  Surface stretched = IrregularTorus(28, 14, 4);
  stretched.V.col(2) *= 1e3;
  const Prepared on(stretched, DiscretisationKind::FaceField);
  for (const ConstraintKind constraints : BothConstraints)
  {
    const Elements elements = on.Every(31);
    const FieldWeights weights = { 0.3, 2.0, constraints };
    const StoppingCriteria stop = { 1e-10, 100 };
    HarmonicProblem problem = on.Problem(elements, weights);
    for (const unsigned seed : { 3730U, 3731U })
    {
      const Vector<double> values = on.RandomValues(elements, seed);
      const Vector<double> field = problem.Solve(values, {}, {}, stop, SerialContext());
      EXPECT_TRUE(problem.Report().Converged);
      ASSERT_EQ(problem.Report().Warnings.size(), 1u);
      EXPECT_NE(problem.Report().Warnings[0].find("a factor of the system took over"),
        std::string::npos);
      const Vector<double> expected =
        on.Factored(elements, weights).Solve(values, {}, Tight(), SerialContext());
      // Energies of the smoothest fields are by the square of the stretch smaller than those of rough ones.
      EXPECT_LE((field - expected).norm(), 1e3 * stop.RelativeTolerance * expected.norm());
    }
    // Who allows few iterations gets no factor after them.
    problem.Update(on.Prescribed(elements, weights), weights.Smoothness, SerialContext());
    problem.Solve(on.RandomValues(elements, 3730), {}, {}, { 1e-8, 2 }, SerialContext());
    EXPECT_FALSE(problem.Report().Converged);
    ASSERT_EQ(problem.Report().Warnings.size(), 1u);
    // Where V-cycles are asked for, they are all that there is.
    HarmonicProblem cycles = on.Problem(elements, weights, SolverKind::VCycles);
    cycles.Solve(on.RandomValues(elements, 3730), {}, {}, stop, SerialContext());
    EXPECT_FALSE(cycles.Report().Converged);
    EXPECT_EQ(cycles.Report().Warnings.size(), 1u);
  }
}

TEST(HarmonicProblem, NoFactorTakesOverWhereRoundingEndsCycles)
{
  for (const DiscretisationKind kind : Kinds)
  {
    const Prepared on(IrregularTorus(28, 14, 4), kind);
    const Elements elements = on.Every(31);
    HarmonicProblem problem = on.Problem(elements, {});
    problem.Solve(on.RandomValues(elements, 3732), {}, {}, { 1e-18, 100 }, SerialContext());
    const SolveReport& report = problem.Report();
    EXPECT_FALSE(report.Converged);
    EXPECT_LE(report.Iterations[report.Returned].RelativeResidual, 1e-13);
    ASSERT_EQ(report.Warnings.size(), 1u);
    EXPECT_NE(report.Warnings[0].find("rounding errors forbid"), std::string::npos);
  }
}

TEST(HarmonicProblem, ReportsProgressOnceAndStopsWhenAsked)
{
  const Prepared on(IrregularTorus(28, 14, 4), DiscretisationKind::FaceField);
  const FieldWeights weights;
  const SolverOptions options;
  const SolverChoice choice = { SolverKind::ConjugateGradients, "" };
  const PrescribedUnknowns prescribed = on.Prescribed(on.Every(31), weights);
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

TEST(FieldProblem, TakesLevelsOrMakesThem)
{
  for (const DiscretisationKind kind : Kinds)
  {
    const Prepared on(IrregularTorus(28, 14, 4), kind);
    for (const ConstraintKind constraints : BothConstraints)
    {
      SCOPED_TRACE(Describe(kind, constraints));
      FieldOptions options = OptionsOf(kind);
      options.Constraints = constraints;
      options.Smoothness = 0.7;
      const FieldConstraints prescribed = on.Constraints(on.Every(31), 3708);
      const auto solve = [&](std::shared_ptr<const MultigridSetup> levels)
      {
        FieldProblem problem(on.Framed, &on.Operators, prescribed, options,
          SerialContext(), std::move(levels));
        const Vector<double> field =
          problem.Solve(prescribed.Values, {}, StoppingCriteria(), SerialContext());
        EXPECT_TRUE(problem.Report().Converged);
        EXPECT_EQ(problem.Report().Solver,
          std::string("conjugate gradients with a V-cycle on nodal levels"));
        return field;
      };
      const Vector<double> made = solve(nullptr);
      EXPECT_EQ(solve(on.Levels), made);
      EXPECT_EQ(solve(on.Levels), made) << "once more, since levels do not change";
      // Thread counts of levels and of problems do not matter either.
      const TbbContext threads(3);
      EXPECT_EQ(
        solve(SetupOf(on.Framed, &on.Operators, options, threads)), made);
    }
  }
}

TEST(FieldProblem, TakesSamplesWithoutOperators)
{
  for (const DiscretisationKind kind : Kinds)
  {
    const Prepared on(IrregularTorus(84, 42, 4), kind);
    const FieldOptions options = OptionsOf(kind);
    const FieldConstraints prescribed = on.Constraints(on.Every(31), 3708);
    const auto solve = [&](std::shared_ptr<const MultigridSetup> levels) {
      FieldProblem problem(
        on.Framed, nullptr, prescribed, options, SerialContext(), std::move(levels));
      EXPECT_EQ(problem.Report().Solver, "conjugate gradients with a V-cycle on nodal levels");
      return problem.Solve(prescribed.Values, {}, StoppingCriteria(), SerialContext());
    };
    const TbbContext threads(3);
    const auto field = MakeDiscretisation(options.Field, on.Framed);
    const ProlongationOperators samples =
      BuildSurfaceHierarchy(on.Mesh, PlanSolver(*field, options, nullptr, {}).Levels, SerialContext(),
        { false, false, false })
        .Operators;
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
      const Prepared on(surface, kind);
      const SparseMatrix<double> A = kind == DiscretisationKind::OneForm
        ? OneFormLaplacian(on.Mesh, SerialContext())
        : FaceFieldSmoothness(on.Mesh, on.Frames, SerialContext());
      for (const SolverKind solver : { SolverKind::ConjugateGradients, SolverKind::Cholesky })
      {
        SCOPED_TRACE(NameOf(solver));
        const FieldProblem problem(on.Framed, &on.Operators,
          on.Constraints(on.Every(31), 3721), OptionsOf(kind, solver), SerialContext());
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

TEST(FieldProblem, CyclesKeepRoughnessApartOnNodalLevels)
{
  for (const DiscretisationKind kind : Kinds)
  {
    const Prepared on(IrregularTorus(84, 42, 4), kind);
    const auto keepsApart = [&on](const FieldOptions& options, const ProlongationOperators* operators)
    { return KeepsApart(on.Framed, operators, options); };
    const ProlongationOperators none;
    EXPECT_FALSE(keepsApart(OptionsOf(kind), &none));
    const ProlongationOperators* const samples = nullptr;
    for (const ProlongationOperators* operators : { &on.Operators, samples })
    {
      EXPECT_TRUE(keepsApart(OptionsOf(kind), operators));
      EXPECT_TRUE(keepsApart(OptionsOf(kind, SolverKind::VCycles), operators));
      EXPECT_FALSE(keepsApart(OptionsOf(kind, SolverKind::Automatic), operators)) << "small";
      EXPECT_FALSE(keepsApart(OptionsOf(kind, SolverKind::Cholesky), operators));
      EXPECT_FALSE(keepsApart(OptionsOf(kind, SolverKind::NestedIterations), operators));
      FieldOptions options = OptionsOf(kind);
      options.CoarseSpace = CoarseSpaceKind::StructurePreserving;
      EXPECT_FALSE(keepsApart(options, operators));
      options = OptionsOf(kind);
      options.Solver.StartingLevel = 1;
      EXPECT_FALSE(keepsApart(options, operators));
    }
  }
}

TEST(FieldProblem, IsFactoredWhereThereAreTooFewFacesForSamples)
{
  for (const DiscretisationKind kind : Kinds)
  {
    const Prepared on(Icosphere(1), kind);
    const FieldOptions options = OptionsOf(kind);
    ASSERT_TRUE(KeepsApart(on.Framed, nullptr, options));
    ASSERT_FALSE(SetupOf(on.Framed, nullptr, options, SerialContext())->HasLevels);
    const Elements elements = on.Every(31);
    const FieldConstraints prescribed = on.Constraints(elements, 3720);
    const auto solve = [&](FieldProblem problem) {
      return problem.Solve(prescribed.Values, {}, StoppingCriteria(), SerialContext());
    };
    const Vector<double> field = solve(
      FieldProblem(on.Framed, nullptr, prescribed, options, SerialContext()));
    const Vector<double> expected = solve(on.Factored(elements, FieldWeights()));
    EXPECT_LE((field - expected).norm(), 1e-7 * expected.norm());
  }
}

// Too many unknowns to be factored for their number alone.
TEST(FieldProblem, IsFactoredWhereThereAreManyNeedles)
{
  const FramedMesh surface(Subdivide(Subdivide(Subdivide(PlaneWithNeedles(12, 32)))).Mesh());
  FieldConstraints prescribed;
  for (int face = 0; face < surface.Mesh.NumberOfFaces(); face += 5000)
  {
    prescribed.Elements.push_back(face);
    prescribed.Weights.push_back(1.0);
  }
  prescribed.Values = Vector<double>::Ones(2 * prescribed.Elements.size());
  const FieldOptions options = OptionsOf(DiscretisationKind::PowerField, SolverKind::Automatic);
  EXPECT_FALSE(KeepsApart(surface, nullptr, options));
  FieldProblem problem(surface, nullptr, prescribed, options, SerialContext());
  problem.Solve(prescribed.Values, {}, StoppingCriteria(), SerialContext());
  EXPECT_TRUE(problem.Report().Converged);
  EXPECT_NE(problem.Report().Solver.find("of the triangles are needles"), std::string::npos)
    << problem.Report().Solver;
}
