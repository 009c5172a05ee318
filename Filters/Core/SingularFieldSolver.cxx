#include "SingularFieldSolver.h"

#include "Analysis/HarmonicForms.h"
#include "Analysis/SurfaceHolonomy.h"
#include "Analysis/TrivialConnection.h"
#include "Constraints/Constraints.h"
#include "Discretisations/MakeDiscretisation.h"
#include "PoissonSolver.h"
#include "Support/ComplexPairs.h"
#include "Support/Errors.h"
#include "Support/ShortText.h"
#include "Support/Stopwatch.h"

#include <Eigen/Cholesky>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

namespace dmg
{
namespace
{

/// The share of the rotation that directions can show, so that rounding does not count.
constexpr double LargestRotation = 0.99;
/// The error of a sum around a vertex adds up along a path around many of them.
constexpr double LargestTolerance = 1e-6;

/// The solver of potentials, and harmonic forms.
struct SystemStage
{
  SolverOptions Options;
  std::optional<PoissonSolver> Functions;
  SparseMatrix<double> Divergences; ///< of the loops, #V x k
  Eigen::MatrixXd Potentials;       ///< u_k, #V x k
  Eigen::MatrixXd Inverse;          ///< of how much forms turn along loops, k x k
  std::vector<std::string> Warnings;
};

struct ConnectionStage
{
  std::vector<int> Times; ///< by vertex
  int N;
  StoppingCriteria Stop;
  Vector<double> Potential;
  Vector<double> Rotation;
  Vector<Complex> Powers; ///< not yet turned to what is prescribed
  bool IsTurned = false;  ///< whether Unknowns are these, turned
  SolveReport Report;
};

/// The residual of the iteration that is returned.
double ResidualOf(const SolveReport& report)
{
  const auto& rows = report.Iterations;
  const auto returned = std::find_if(
    rows.begin(), rows.end(), [&report](const IterationReport& row) { return row.Iteration == report.Returned; });
  return returned != rows.end() ? returned->RelativeResidual : 0.0;
}

/// The solver options for potentials, from those that users ask for: a connection has no smoothness energy.
SolverOptions OptionsOfPotentials(const SolverOptions& asked, int loops)
{
  SolverOptions options;
  options.Kind = asked.Kind;
  options.ExpectedSolves = asked.ExpectedSolves + loops;
  options.Sweeps = asked.Sweeps;
  return options;
}

/// Says where directions turn so far across edges that other ones look nearer.
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

class SingularFieldSolver::Internals
{
public:
  explicit Internals(const FramedMesh& surface)
    : On(surface)
    , Star(Star1(surface.Mesh))
  {
  }

  void SetUp(const SolverOptions& options, const ExecutionContext& context);
  void Connect(std::vector<int> times, int N, const StoppingCriteria& stop, const ElementNames& names,
    const ExecutionContext& context);
  void TurnTo(FieldConstraints constraints, const ExecutionContext& context);

  const FramedMesh& On;
  const Vector<double> Star; ///< of 1-forms
  DiscretisationOptions OptionsOfField;
  std::shared_ptr<const Discretisation> Field;
  std::optional<SurfaceHolonomy> Surface;
  std::unique_ptr<SystemStage> System;
  std::unique_ptr<ConnectionStage> Connection;
  FieldConstraints Constraints;
  Vector<double> Unknowns;
  StageCounts Counts;
  double SurfaceSeconds = 0.0;
  double SystemSeconds = 0.0;

private:
  void AddHarmonicForms(SystemStage& system, const ExecutionContext& context) const;
  Vector<double> RotationOf(const SystemStage& system, const Vector<double>& potential, int N) const;
};

void SingularFieldSolver::Internals::SetUp(const SolverOptions& asked, const ExecutionContext& context)
{
  const Stopwatch watch;
  const TriangleMesh& mesh = this->On.Mesh;
  const int loops = this->Surface->NumberOfGenerators();
  const SolverOptions options = OptionsOfPotentials(asked, loops);
  if (this->System && this->System->Options == options)
  {
    return;
  }
  if (AreTooManyToHold(loops, mesh))
  {
    throw InvalidInput("the surface has " + std::to_string(loops) +
      " loops around its handles and holes, and singularities need a harmonic form for each: too many to "
      "hold; close holes and remove small handles first");
  }
  auto system = std::make_unique<SystemStage>();
  system->Options = options;
  system->Functions.emplace(this->On, this->Surface->Grounded(mesh), options, PartOfContext(context, 0.0, 0.7));
  this->AddHarmonicForms(*system, PartOfContext(context, 0.7, 1.0));
  this->Connection.reset();
  this->System = std::move(system);
  this->SystemSeconds = watch.Seconds();
  ++this->Counts.Setups;
  ++this->Counts.Systems;
}

void SingularFieldSolver::Internals::AddHarmonicForms(SystemStage& system, const ExecutionContext& context) const
{
  const StoppingCriteria stop{ 1e-10, 100 }; // if rounding allows
  const SurfaceHolonomy& surface = *this->Surface;
  const int loops = surface.NumberOfGenerators();
  const SparseMatrix<double> transposed = SparseMatrix<double>(surface.Loops.transpose());
  const SparseMatrix<double> flux = this->Star.asDiagonal() * surface.Loops;
  system.Divergences = SparseMatrix<double>(D0(this->On.Mesh, context).transpose()) * flux;
  system.Potentials.resize(this->On.Mesh.NumberOfVertices(), loops);
  for (int k = 0; k < loops; ++k)
  {
    const double step = 1.0 / loops;
    system.Potentials.col(k) =
      system.Functions->Solve(system.Divergences.col(k), {}, stop, PartOfContext(context, step * k, step * (k + 1)));
    if (ResidualOf(system.Functions->Report()) > LargestTolerance)
    {
      system.Warnings = system.Functions->Report().Warnings;
    }
  }
  const Eigen::MatrixXd energies =
    Eigen::MatrixXd(transposed * flux) - Eigen::MatrixXd(system.Divergences.transpose() * system.Potentials);
  const Eigen::MatrixXd symmetric = 0.5 * (energies + energies.transpose());
  system.Inverse = symmetric.ldlt().solve(Eigen::MatrixXd::Identity(loops, loops));
}

Vector<double> SingularFieldSolver::Internals::RotationOf(
  const SystemStage& system, const Vector<double>& potential, int N) const
{
  const SurfaceHolonomy& surface = *this->Surface;
  Vector<double> form = Vector<double>::Zero(this->On.Mesh.NumberOfEdges());
  Vector<double> whole = potential;
  if (surface.NumberOfGenerators() > 0)
  {
    const double step = 2.0 * Pi / N;
    const Vector<double> along = surface.AlongGenerators + Vector<double>(system.Divergences.transpose() * potential);
    const Vector<double> steps = NearestIntegers(system.Inverse, along / step);
    const Vector<double> coefficients = system.Inverse * (step * steps - along);
    form = surface.Loops * coefficients;
    whole -= system.Potentials * coefficients;
  }
  for (int edge = 0; edge < form.size(); ++edge)
  {
    const auto [tail, head] = this->On.Mesh.EdgeVertices(edge);
    form[edge] = this->Star[edge] * (form[edge] + whole[head] - whole[tail]);
  }
  return form;
}

void SingularFieldSolver::Internals::Connect(std::vector<int> times, int N, const StoppingCriteria& stop,
  const ElementNames& names, const ExecutionContext& context)
{
  const Stopwatch watch;
  SystemStage& system = *this->System;
  const SurfaceHolonomy& surface = *this->Surface;
  const TriangleMesh& mesh = this->On.Mesh;
  auto connection = std::make_unique<ConnectionStage>();
  Vector<double> source = -surface.Defects;
  for (std::size_t vertex = 0; vertex < times.size(); ++vertex)
  {
    source[vertex] += 2.0 * Pi * times[vertex] / N;
  }
  connection->Potential = system.Functions->Solve(source, {}, stop, PartOfContext(context, 0.0, 0.8), NetSource::Refuse,
    this->Connection ? this->Connection->Potential : Vector<double>());
  connection->Rotation = this->RotationOf(system, connection->Potential, N);
  LimitRotation(mesh, LargestRotation * Pi / N, connection->Rotation);
  connection->Powers = PowersOfConnection(mesh, surface.Sides, surface.Trees, connection->Rotation, N);
  context.Checkpoint(0.9);
  SolveReport& report = connection->Report;
  report = system.Functions->Report();
  report.Solver = "trivial connection by " + report.Solver;
  report.Bytes += 8 * system.Potentials.size();
  report.Warnings.insert(report.Warnings.end(), system.Warnings.begin(), system.Warnings.end());
  if (const std::string warning = WarningOfLargeRotation(mesh, connection->Rotation, N, names); !warning.empty())
  {
    report.Warnings.push_back(warning);
  }
  report.SolveSeconds = watch.Seconds();
  connection->Times = std::move(times);
  connection->N = N;
  connection->Stop = stop;
  this->Connection = std::move(connection);
}

/// Turns the field on each component to where the mean of squares is least.
void SingularFieldSolver::Internals::TurnTo(FieldConstraints constraints, const ExecutionContext& context)
{
  const bool isSame = this->Constraints.Elements == constraints.Elements &&
    this->Constraints.Weights == constraints.Weights && this->Constraints.Values == constraints.Values;
  if (this->Connection->IsTurned && isSame)
  {
    return;
  }
  const SurfaceHolonomy& surface = *this->Surface;
  const auto componentOf = [&](int face) { return surface.Components[this->On.Mesh.FaceCorners()(face, 0)]; };
  Vector<Complex> powers = this->Connection->Powers;
  const auto values = AsComplex(constraints.Values);
  const Vector<double> weights = this->Field->PenaltiesOf(constraints, {}, context).Alignment;
  Vector<Complex> turns = Vector<Complex>::Zero(surface.NumberOfComponents());
  for (std::size_t b = 0; b < constraints.Elements.size(); ++b)
  {
    const int face = constraints.Elements[b];
    turns[componentOf(face)] += weights[2 * b] * std::conj(powers[face]) * values[b];
  }
  for (Complex& turn : turns)
  {
    const double length = std::abs(turn);
    turn = length > 0.0 ? turn / length : Complex(1.0);
  }
  for (int face = 0; face < powers.size(); ++face)
  {
    powers[face] *= turns[componentOf(face)];
  }
  this->Unknowns = AsPairs(powers);
  this->Constraints = std::move(constraints);
  this->Connection->IsTurned = true;
  ++this->Counts.Solves;
}

SingularFieldSolver::SingularFieldSolver(const FramedMesh& surface)
  : Internal(std::make_unique<Internals>(surface))
{
}

SingularFieldSolver::~SingularFieldSolver() = default;

void CheckTakesSingularities(const DiscretisationOptions& field)
{
  if (field.Kind != DiscretisationKind::PowerField && field.Kind != DiscretisationKind::VertexPowerField)
  {
    throw InvalidInput("singularities are prescribed, and only power fields can have them; choose Power Field at "
                       "Points as Discretisation, or take the input Singularities away");
  }
}

const Vector<double>& SingularFieldSolver::Solve(const std::vector<PrescribedSingularity>& singularities,
  const dmg::Constraints& directions, const FieldOptions& options, const StoppingCriteria& asked,
  const ExecutionContext& context, const ElementNames& names)
{
  CheckTakesSingularities(options.Field);
  Internals& of = *this->Internal;
  // A trivial connection is made of rotations across edges, whichever field its directions are shown as.
  DiscretisationOptions onFaces = options.Field;
  onFaces.Kind = DiscretisationKind::PowerField;
  if (!of.Field || !(of.OptionsOfField == onFaces))
  {
    of.Connection.reset();
    of.Field = MakeDiscretisation(onFaces, of.On);
    of.OptionsOfField = onFaces;
  }
  const StoppingCriteria stop{ std::min(asked.RelativeTolerance, LargestTolerance), asked.MaximumIterations };
  const int N = options.Field.N;
  std::vector<int> times = TimesByVertex(of.On.Mesh, singularities, names);
  FieldConstraints constraints = of.Field->Prescribe(directions, names);
  CheckSizes(directions, names);
  if (!of.Surface)
  {
    const Stopwatch watch;
    of.Surface.emplace(of.On, context);
    of.SurfaceSeconds = watch.Seconds();
  }
  of.Surface->CheckSums(times, N, names);
  of.SetUp(options.Solver, PartOfContext(context, 0.0, 0.7));
  const bool isKept =
    of.Connection && of.Connection->Times == times && of.Connection->N == N && of.Connection->Stop == stop;
  if (!isKept)
  {
    of.Connect(std::move(times), N, stop, names, PartOfContext(context, 0.7, 0.95));
  }
  of.TurnTo(std::move(constraints), context);
  context.Checkpoint(1.0);
  return of.Unknowns;
}

const FramedMesh& SingularFieldSolver::Surface() const
{
  return this->Internal->On;
}

const Discretisation& SingularFieldSolver::Field() const
{
  return *this->Internal->Field;
}

const FieldConstraints& SingularFieldSolver::Constraints() const
{
  return this->Internal->Constraints;
}

const Vector<double>& SingularFieldSolver::Unknowns() const
{
  return this->Internal->Unknowns;
}

const SolveReport& SingularFieldSolver::Report() const
{
  return this->Internal->Connection->Report;
}

Eigen::MatrixXd SingularFieldSolver::HarmonicFields() const
{
  return Eigen::MatrixXd(this->Unknowns().size(), 0);
}

const SolvedField::StageCounts& SingularFieldSolver::Counts() const
{
  return this->Internal->Counts;
}

double SingularFieldSolver::SetupSeconds() const
{
  return this->Internal->SurfaceSeconds + this->Internal->SystemSeconds;
}

const Vector<double>& SingularFieldSolver::Rotation() const
{
  return this->Internal->Connection->Rotation;
}

}
