// Conjugate gradients with the cycle for sums of squares take a number of iterations that does not
// grow with the surface, for 1-forms and face fields: generated families at several sizes.

#include "Discretisations/MakeDiscretisation.h"
#include "Support/FieldProblem.h"
#include "Support/LinearLevels.h"
#include "Support/MeshFactory.h"
#include "Support/Random.h"
#include "Support/TbbContext.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <string>
#include <tuple>
#include <vector>

using namespace dmg;
using namespace dmg::test;

namespace
{

constexpr double Infinity = std::numeric_limits<double>::infinity();

/// How many faces or edges are prescribed, of so many.
using Count = int (*)(int);

struct Prescription
{
  std::string Name;
  Count Of;
};

const std::vector<Prescription>& Prescriptions()
{
  static const std::vector<Prescription> all = { { "one", [](int) { return 1; } }, { "twenty", [](int) { return 20; } },
    { "hundred", [](int) { return 100; } }, { "5 percent", [](int size) { return size / 20; } } };
  return all;
}

class LeastSquaresConvergence : public ::testing::TestWithParam<std::tuple<DiscretisationKind, LevelKind>>
{
protected:
  /// Iterations to 1e-8 for each prescription; hard ones, if the alignment is infinite.
  static std::vector<int> Iterations(const Surface& shape, double alignment = 1.0)
  {
    const TbbContext context(2);
    FieldOptions options;
    options.Field.Kind = std::get<0>(GetParam());
    options.Constraints = std::isfinite(alignment) ? ConstraintKind::Soft : ConstraintKind::Hard;
    options.Alignment = std::isfinite(alignment) ? alignment : 1.0;
    options.Solver.Kind = SolverKind::ConjugateGradients;
    const FramedMesh surface(shape.Mesh(), context);
    const auto field = MakeDiscretisation(options.Field, surface);
    HierarchyOptions decimation;
    decimation.MinimumNumberOfFaces = 100; // edge collapses go on with small surfaces, too
    const ProlongationOperators operators =
      LinearLevels(std::get<1>(GetParam()), surface.Mesh, decimation, field->SampleDistance(), context);
    const int elements = field->NumberOfElements();
    std::vector<int> iterations;
    for (const Prescription& prescription : Prescriptions())
    {
      Random random(20261121);
      std::set<int> chosen;
      while (static_cast<int>(chosen.size()) < prescription.Of(elements))
      {
        chosen.insert(random.Index(elements));
      }
      FieldConstraints constraints;
      constraints.Elements.assign(chosen.begin(), chosen.end());
      constraints.Weights.assign(chosen.size(), 1.0);
      constraints.Values = Vector<double>(field->UnknownsPerElement() * chosen.size());
      for (double& value : constraints.Values)
      {
        value = random.Uniform(-1.0, 1.0);
      }
      FieldProblem problem(surface, &operators, constraints, options, context);
      problem.Solve(constraints.Values, {}, StoppingCriteria(), context);
      EXPECT_TRUE(problem.Report().Converged) << prescription.Name;
      iterations.push_back(static_cast<int>(problem.Report().Iterations.size()) - 1);
    }
    return iterations;
  }

  /// \param family smallest first.
  static void ExpectBounded(const std::vector<Surface>& family, int limit = 12)
  {
    std::vector<std::vector<int>> iterations;
    for (const Surface& surface : family)
    {
      iterations.push_back(Iterations(surface));
    }
    for (std::size_t p = 0; p < Prescriptions().size(); ++p)
    {
      SCOPED_TRACE(Prescriptions()[p].Name);
      for (std::size_t size = 0; size < family.size(); ++size)
      {
        EXPECT_LE(iterations[size][p], limit) << family[size].F.rows() << " faces";
      }
      EXPECT_LE(iterations.back()[p], iterations.front()[p] + 2);
    }
  }
};

}

TEST_P(LeastSquaresConvergence, IsFastOnIrregularSpheres)
{
  std::vector<Surface> family = { IrregularSphere(4, 3), IrregularSphere(5, 3) };
  if (std::get<1>(GetParam()) == LevelKind::EdgeCollapses)
  {
    family.insert(family.begin(), IrregularSphere(3, 3)); // too small for levels of samples
  }
  ExpectBounded(family);
}

TEST_P(LeastSquaresConvergence, IsFastOnIrregularTori)
{
  ExpectBounded({ IrregularTorus(80, 32, 4), IrregularTorus(112, 44, 4), IrregularTorus(160, 64, 4) });
}

TEST_P(LeastSquaresConvergence, IsFastWithBoundaries)
{
  ExpectBounded({ IrregularPlane(40, 30, 5), IrregularPlane(80, 60, 5), IrregularPlane(160, 120, 5) }, 20);
}

TEST_P(LeastSquaresConvergence, IsFastOnThinSurfaces)
{
  ExpectBounded({ Flattened(DoubleTorus(8), 0.1), Flattened(DoubleTorus(16), 0.1) }, 20);
}

/// Cut into 64, a thin triangle is 64 of them, and no patch holds them all: cycles take more iterations, and reach the
/// tolerance.
TEST_P(LeastSquaresConvergence, IsFastOnThinTrianglesThatAreCut)
{
  Iterations(Subdivide(Subdivide(Subdivide(PlaneWithThinTriangles(24, 16)))));
}

TEST_P(LeastSquaresConvergence, IsFastForAnyAlignment)
{
  for (const double alignment : { 1e-6, 1e-3, 1e-1, 1e1, 1e2, 1e3, 1e6, Infinity })
  {
    SCOPED_TRACE(alignment);
    for (const int iterations : Iterations(IrregularSphere(4, 3), alignment))
    {
      EXPECT_LE(iterations, 12);
    }
  }
}

/// Harmonic fields cost nothing, but must yield where they are pulled. The norm that decides bounds the error, whatever the
/// weights, and takes one iteration more than the residual relative to the right-hand side did.
TEST_P(LeastSquaresConvergence, IsFastOnManyHandlesForAnyAlignment)
{
  for (const double alignment : { 1e-2, 1.0, 1e1, 1e2, 1e4, 1e6, 1e8, 1e10 })
  {
    SCOPED_TRACE(alignment);
    for (const int iterations : Iterations(PerforatedSlab(4, 3, 5), alignment))
    {
      EXPECT_LE(iterations, 13);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Fields, LeastSquaresConvergence,
  ::testing::Combine(::testing::Values(DiscretisationKind::OneForm, DiscretisationKind::FaceField),
    ::testing::Values(LevelKind::EdgeCollapses, LevelKind::Sampling)),
  [](const auto& info)
  {
    const bool isForm = std::get<0>(info.param) == DiscretisationKind::OneForm;
    const bool isSampled = std::get<1>(info.param) == LevelKind::Sampling;
    return std::string(isForm ? "OneForms" : "FaceFields") + (isSampled ? "Sampling" : "EdgeCollapses");
  });
