#include "Singularities/SingularFieldSolver.h"

#include "Analysis/BoundaryLoops.h"
#include "Analysis/HarmonicForms.h"
#include "Singularities/TrivialConnection.h"
#include "Support/ComplexPairs.h"
#include "Support/Errors.h"
#include "Support/ShortText.h"
#include "Support/Stopwatch.h"

#include <Eigen/Cholesky>

#include <algorithm>
#include <cmath>

namespace dmg
{
namespace
{

/// The share of the rotation that directions can show, so that rounding does not count.
constexpr double LargestRotation = 0.99;
/// The error of a sum around a vertex adds up along a path around many of them.
constexpr double LargestTolerance = 1e-6;

/// The residual of the iteration that is returned.
double ResidualOf(const SolveReport& report)
{
  const auto& rows = report.Iterations;
  const auto returned = std::find_if(
    rows.begin(), rows.end(), [&report](const IterationReport& row) { return row.Iteration == report.Returned; });
  return returned != rows.end() ? returned->RelativeResidual : 0.0;
}

/// The solver options for potentials, from those that users ask for: a connection has no smoothness energy.
SolverOptions OptionsOfPotentials(const SolverOptions& asked, int generators)
{
  SolverOptions options;
  options.Kind = asked.Kind;
  options.ExpectedSolves = asked.ExpectedSolves + generators;
  options.Sweeps = asked.Sweeps;
  return options;
}

/// \throw InvalidInput the harmonic forms of the generators do not fit into memory.
void CheckNumberOfGenerators(const TriangleMesh& mesh, int generators)
{
  if (AreTooManyToHold(generators, mesh))
  {
    throw InvalidInput("the surface has " + std::to_string(generators) +
      " loops around its handles and holes, and singularities need a harmonic form for each: too many to "
      "hold; close holes and remove small handles first");
  }
}

/// A warning that names an edge across which the field rotates so far that other directions look nearer; empty if there is none.
std::string WarningOfLargeRotation(
  const TriangleMesh& mesh, const Vector<double>& rotation, int N, const ElementNames& names)
{
  constexpr double Rounding = 1e-6; // a half turn either way looks the same
  int number = 0;
  int first = -1;
  for (int edge = 0; edge < mesh.NumberOfEdges(); ++edge)
  {
    if (std::abs(rotation[edge]) > (1.0 - Rounding) * Pi / N)
    {
      first = number++ == 0 ? edge : first;
    }
  }
  if (number == 0)
  {
    return {};
  }
  const auto [tail, head] = mesh.EdgeVertices(first);
  return "The field turns by " + ShortText(180.0 / N) + " degrees or more across " + std::to_string(number) +
    (number == 1 ? " edge" : " edges") + ", as between " + names.Vertex(tail) + " and " + names.Vertex(head) +
    ", so that other singularities are seen there than those prescribed; prescribe several of smaller index instead, "
    "farther apart, choose fewer directions, or smooth the surface there.";
}

}

SingularFieldSolver::SingularFieldSolver(
  SetupCache& setups, const SurfaceHolonomy& holonomy, const SolverOptions& asked, const ExecutionContext& context)
  : Mesh(setups.Surface.Mesh)
  , Holonomy(holonomy)
  , Options(OptionsOfPotentials(asked, holonomy.NumberOfGenerators()))
  , Functions(setups, BoundaryVertices(this->Mesh), this->Options, PartOfContext(context, 0.0, 0.7))
  , Star(Star1(this->Mesh))
{
  CheckNumberOfGenerators(this->Mesh, holonomy.NumberOfGenerators());
  this->MakeHarmonicForms(PartOfContext(context, 0.7, 1.0));
}

bool SingularFieldSolver::HasOptions(const SolverOptions& asked) const
{
  return this->Options == OptionsOfPotentials(asked, this->Holonomy.NumberOfGenerators());
}

void SingularFieldSolver::MakeHarmonicForms(const ExecutionContext& context)
{
  const StoppingCriteria stop{ 1e-10, 100 }; // if rounding allows
  const SparseMatrix<double>& generators = this->Holonomy.Loops;
  const int number = this->Holonomy.NumberOfGenerators();
  const SparseMatrix<double> transposed = SparseMatrix<double>(generators.transpose());
  const SparseMatrix<double> flux = this->Star.asDiagonal() * generators;
  this->Divergences = SparseMatrix<double>(D0(this->Mesh, context).transpose()) * flux;
  this->Potentials.resize(this->Mesh.NumberOfVertices(), number);
  for (int k = 0; k < number; ++k)
  {
    const double step = 1.0 / number;
    this->Potentials.col(k) =
      this->Functions.Solve(this->Divergences.col(k), {}, stop, PartOfContext(context, step * k, step * (k + 1)));
    if (ResidualOf(this->Functions.Report()) > LargestTolerance)
    {
      this->Warnings = this->Functions.Report().Warnings;
    }
  }
  const Eigen::MatrixXd energies =
    Eigen::MatrixXd(transposed * flux) - Eigen::MatrixXd(this->Divergences.transpose() * this->Potentials);
  const Eigen::MatrixXd symmetric = 0.5 * (energies + energies.transpose());
  this->Inverse = symmetric.ldlt().solve(Eigen::MatrixXd::Identity(number, number));
}

Vector<double> SingularFieldSolver::RotationOf(const Vector<double>& potential, int N) const
{
  Vector<double> form = Vector<double>::Zero(this->Mesh.NumberOfEdges());
  Vector<double> whole = potential;
  if (this->Holonomy.NumberOfGenerators() > 0)
  {
    const double step = 2.0 * Pi / N;
    const Vector<double> along =
      this->Holonomy.AlongGenerators + Vector<double>(this->Divergences.transpose() * potential);
    const Vector<double> steps = NearestIntegers(this->Inverse, along / step);
    const Vector<double> coefficients = this->Inverse * (step * steps - along);
    form = this->Holonomy.Loops * coefficients;
    whole -= this->Potentials * coefficients;
  }
  for (int edge = 0; edge < form.size(); ++edge)
  {
    const auto [tail, head] = this->Mesh.EdgeVertices(edge);
    form[edge] = this->Star[edge] * (form[edge] + whole[head] - whole[tail]);
  }
  LimitRotation(this->Mesh, LargestRotation * Pi / N, form);
  return form;
}

SingularField SingularFieldSolver::Solve(const std::vector<int>& times, int N, const StoppingCriteria& asked,
  const SingularField* former, const ExecutionContext& context, const ElementNames& names)
{
  const Stopwatch watch;
  Vector<double> source = -this->Holonomy.Defects;
  for (std::size_t vertex = 0; vertex < times.size(); ++vertex)
  {
    source[vertex] += 2.0 * Pi * times[vertex] / N;
  }
  const StoppingCriteria stop{ std::min(asked.RelativeTolerance, LargestTolerance), asked.MaximumIterations };
  SingularField field;
  // The sum is zero but for rounding (SurfaceHolonomy::CheckSums).
  field.Potential = this->Functions.Solve(source, {}, stop, PartOfContext(context, 0.0, 0.8), NetSource::TakeOut,
    former ? former->Potential : Vector<double>());
  field.Rotation = this->RotationOf(field.Potential, N);
  field.Powers = PowersOfConnection(this->Mesh, this->Holonomy.Sides, this->Holonomy.Trees, field.Rotation, N);
  context.Checkpoint(0.9);
  SolveReport& report = field.Report;
  report = this->Functions.Report();
  report.Solver = "trivial connection by " + report.Solver;
  report.Bytes += 8 * this->Potentials.size();
  report.Warnings.insert(report.Warnings.end(), this->Warnings.begin(), this->Warnings.end());
  if (const std::string warning = WarningOfLargeRotation(this->Mesh, field.Rotation, N, names); !warning.empty())
  {
    report.Warnings.push_back(warning);
  }
  report.SolveSeconds = watch.Seconds();
  return field;
}

Vector<Complex> SingularFieldSolver::RotatedTo(
  const FieldConstraints& constraints, const Vector<double>& weights, const SingularField& field) const
{
  const auto componentOf = [&](int face) { return this->Holonomy.Components[this->Mesh.FaceCorners()(face, 0)]; };
  const auto values = AsComplex(constraints.Values);
  Vector<Complex> powers = field.Powers;
  Vector<Complex> rotations = Vector<Complex>::Zero(this->Holonomy.NumberOfComponents());
  for (std::size_t b = 0; b < constraints.Elements.size(); ++b)
  {
    const int face = constraints.Elements[b];
    rotations[componentOf(face)] += weights[2 * b] * std::conj(powers[face]) * values[b];
  }
  for (Complex& rotation : rotations)
  {
    const double length = std::abs(rotation);
    rotation = length > 0.0 ? rotation / length : Complex(1.0);
  }
  for (int face = 0; face < powers.size(); ++face)
  {
    powers[face] *= rotations[componentOf(face)];
  }
  return powers;
}

}
