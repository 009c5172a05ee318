#include "Discretisations/MakeDiscretisation.h"
#include "Mesh/VertexConnection.h"
#include "Operators/ConnectionLaplacian.h"
#include "Operators/ExteriorCalculus.h"
#include "Operators/FaceFieldOperators.h"
#include "Operators/PowerFieldOperators.h"
#include "StructurePreserving/SurfaceHierarchy.h"
#include "Support/FieldProblem.h"
#include "Support/MeshFactory.h"
#include "Support/Random.h"
#include "Support/ReferenceOperators.h"

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

// Whatever the weights: Converged means that the error is below ten times the tolerance. The reference is a dense factor in
// long double.
using namespace dmg;
using namespace dmg::test;

namespace
{

using Extended = Eigen::Matrix<long double, -1, -1>;
using ExtendedVector = Eigen::Matrix<long double, -1, 1>;

constexpr DiscretisationKind Kinds[] = { DiscretisationKind::PowerField, DiscretisationKind::VertexPowerField,
  DiscretisationKind::FaceField, DiscretisationKind::OneForm, DiscretisationKind::ScalarFunction };

FieldOptions OptionsOf(DiscretisationKind kind, SolverKind solver)
{
  FieldOptions options;
  options.Field.Kind = kind;
  options.Field.N = 1;
  options.Solver.Kind = solver;
  return options;
}

/// A complex matrix with its numbers as pairs.
Extended AsPairs(const Eigen::MatrixXcd& L)
{
  Extended pairs(2 * L.rows(), 2 * L.cols());
  for (Eigen::Index j = 0; j < L.cols(); ++j)
  {
    for (Eigen::Index i = 0; i < L.rows(); ++i)
    {
      const Complex z = L(i, j);
      pairs.block<2, 2>(2 * i, 2 * j) << z.real(), -z.imag(), z.imag(), z.real();
    }
  }
  return pairs;
}

/// R.
Extended Stiffness(const FramedMesh& surface, DiscretisationKind kind)
{
  switch (kind)
  {
    case DiscretisationKind::FaceField:
      return Eigen::MatrixXd(FaceFieldSmoothness(surface.Mesh, surface.Faces, SerialContext())).cast<long double>();
    case DiscretisationKind::OneForm:
      return Eigen::MatrixXd(OneFormLaplacian(surface.Mesh, SerialContext())).cast<long double>();
    case DiscretisationKind::ScalarFunction:
    {
      const Eigen::MatrixXd d0(D0(surface.Mesh, SerialContext()));
      return (d0.transpose() * Star1(surface.Mesh).asDiagonal() * d0).cast<long double>();
    }
    case DiscretisationKind::VertexPowerField:
      return AsPairs(
        Eigen::MatrixXcd(ConnectionLaplacian(surface.Mesh, VertexConnection(surface, SerialContext()), 1)));
    default:
      return AsPairs(Eigen::MatrixXcd(PowerLaplacian(surface.Mesh, surface.Faces, 1, SerialContext())));
  }
}

/// Twenty elements; every other one has the weight, the others too or 1.
FieldConstraints Twenty(const Discretisation& field, double weight, bool areMixed)
{
  Random random(3901);
  FieldConstraints constraints;
  for (int k = 0; k < 20; ++k)
  {
    constraints.Elements.push_back(k * (field.NumberOfElements() / 20));
    constraints.Weights.push_back(areMixed && k % 2 == 0 ? 1.0 : weight);
  }
  constraints.Values.resize(20 * field.UnknownsPerElement());
  for (double& value : constraints.Values)
  {
    value = random.Uniform(-1.0, 1.0);
  }
  return constraints;
}

Vector<double> Reference(const Extended& R, const Penalties& penalties, const Vector<double>& values)
{
  Extended A = R;
  ExtendedVector b = ExtendedVector::Zero(A.rows());
  for (std::size_t k = 0; k < penalties.Unknowns.size(); ++k)
  {
    const int i = penalties.Unknowns[k];
    A(i, i) += penalties.Alignment[k];
    b[i] = static_cast<long double>(penalties.Alignment[k]) * values[k];
  }
  return A.llt().solve(b).cast<double>();
}

/// A grid of 36 x 36 squares with 4 x 4 of them cut out at 16 places.
Surface PlaneWithHoles()
{
  Surface plane = IrregularPlane(36, 36, 5);
  std::vector<int> kept;
  for (int face = 0; face < plane.F.rows(); ++face)
  {
    const int square = face / 2;
    const auto isWithin = [](int place) { return place % 9 >= 3 && place % 9 < 7; };
    if (!(isWithin(square % 36) && isWithin(square / 36)))
    {
      kept.push_back(face);
    }
  }
  Surface cut{ Points(plane.V.rows(), 3), Triangles(kept.size(), 3) };
  std::vector<int> numbers(plane.V.rows(), -1);
  int points = 0;
  for (int k = 0; k < cut.F.size(); ++k)
  {
    int& number = numbers[plane.F(kept[k / 3], k % 3)];
    if (number < 0)
    {
      number = points++;
      cut.V.row(number) = plane.V.row(plane.F(kept[k / 3], k % 3));
    }
    cut.F(k / 3, k % 3) = number;
  }
  cut.V.conservativeResize(points, 3);
  return cut;
}

ProlongationOperators LinearLevels(const FramedMesh& surface)
{
  HierarchyOptions options;
  options.MinimumNumberOfFaces = 100;
  return BuildSurfaceHierarchy(surface.Mesh, options, SerialContext(), { false, false, false }).Operators;
}

std::string Name(SolverKind solver, double weight, bool areMixed)
{
  return MethodOf(solver).Name + ", weight " + std::to_string(weight) + (areMixed ? " and 1" : "");
}

}

TEST(ErrorOfSolution, IsBelowTenTolerancesForAnyWeight)
{
  const FramedMesh surface(IrregularSphere(2, 3).Mesh());
  const ProlongationOperators operators = LinearLevels(surface);
  for (const DiscretisationKind kind : Kinds)
  {
    const auto field = MakeDiscretisation(OptionsOf(kind, SolverKind::Cholesky).Field, surface);
    const Extended R = Stiffness(surface, kind);
    const Vector<double> masses = field->Mass(SerialContext());
    Vector<double> mass(field->NumberOfUnknowns());
    for (Eigen::Index i = 0; i < mass.size(); ++i)
    {
      mass[i] = masses[i / (mass.size() / masses.size())];
    }
    for (const double weight : { 1e-6, 1e-3, 1.0, 1e3, 1e6, 1e9, 1e12 })
    {
      for (const bool areMixed : { false, true })
      {
        const FieldConstraints constraints = Twenty(*field, weight, areMixed);
        const Vector<double> expected =
          Reference(R, field->PenaltiesOf(constraints, {}, SerialContext()), constraints.Values);
        for (const SolverKind solver : { SolverKind::Cholesky, SolverKind::ConjugateGradients, SolverKind::VCycles })
        {
          SCOPED_TRACE(field->Name() + ", " + Name(solver, weight, areMixed));
          FieldProblem problem(surface, &operators, constraints, OptionsOf(kind, solver), SerialContext());
          EXPECT_EQ(problem.Report().Solver.find("because"), std::string::npos);
          for (const double tolerance : { 1e-4, 1e-8 })
          {
            const Vector<double> x = problem.Solve(constraints.Values, {}, { tolerance, 100 }, SerialContext());
            EXPECT_TRUE(problem.Report().Converged);
            const Vector<double> error = (x - expected).cwiseAbs2().cwiseProduct(mass);
            EXPECT_LE(std::sqrt(error.sum()), 10.0 * tolerance * std::sqrt(expected.cwiseAbs2().dot(mass)));
          }
        }
      }
    }
  }
}

TEST(ErrorOfSolution, SolversAgreeWhereHarmonicFieldsAreWeaklyDetermined)
{
  const FramedMesh surface(PlaneWithHoles().Mesh());
  const ProlongationOperators operators = LinearLevels(surface);
  for (const DiscretisationKind kind : { DiscretisationKind::FaceField, DiscretisationKind::OneForm })
  {
    for (const double weight : { 1e-3, 1.0, 1e3 })
    {
      const auto field = MakeDiscretisation(OptionsOf(kind, SolverKind::Cholesky).Field, surface);
      const FieldConstraints constraints = Twenty(*field, weight, false);
      const auto solve = [&](SolverKind solver)
      {
        FieldProblem problem(surface, &operators, constraints, OptionsOf(kind, solver), SerialContext());
        EXPECT_EQ(problem.Report().Solver.find("because"), std::string::npos);
        const Vector<double> x = problem.Solve(constraints.Values, {}, {}, SerialContext());
        EXPECT_TRUE(problem.Report().Converged);
        return std::make_pair(x, problem.Report().Warnings);
      };
      SCOPED_TRACE(field->Name() + ", " + Name(SolverKind::Cholesky, weight, false));
      const auto [factored, ofFactor] = solve(SolverKind::Cholesky);
      const auto [cycled, ofCycles] = solve(SolverKind::ConjugateGradients);
      EXPECT_LE((factored - cycled).norm(), 1e-6 * factored.norm());
      EXPECT_EQ(ofFactor, ofCycles);
    }
  }
}

TEST(ErrorOfSolution, ApproximationsHaveNotConverged)
{
  const FramedMesh surface(IrregularSphere(3, 3).Mesh());
  const ProlongationOperators operators = LinearLevels(surface);
  for (const DiscretisationKind kind : Kinds)
  {
    const auto field = MakeDiscretisation(OptionsOf(kind, SolverKind::Cholesky).Field, surface);
    const FieldConstraints constraints = Twenty(*field, 1.0, false);
    for (const SolverKind solver : { SolverKind::NestedIterations, SolverKind::CoarseProlongation })
    {
      FieldProblem problem(surface, &operators, constraints, OptionsOf(kind, solver), SerialContext());
      problem.Solve(constraints.Values, {}, {}, SerialContext());
      const SolveReport& report = problem.Report();
      EXPECT_FALSE(report.Converged) << report.Solver;
      EXPECT_TRUE(report.Warnings.empty()); // it is what was asked for
      EXPECT_EQ(report.Returned, report.Iterations.back().Iteration);
      EXPECT_GT(report.Iterations.back().RelativeResidual, 1e-8);
      problem.Solve(constraints.Values, {}, { 1.0, 100 }, SerialContext());
      EXPECT_EQ(problem.Report().Converged, report.Iterations.back().RelativeResidual <= 1.0);
    }
  }
}
