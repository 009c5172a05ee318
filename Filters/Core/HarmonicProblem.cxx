#include "HarmonicProblem.h"

#include "Solvers/CholeskySolver.h"
#include "Solvers/MultigridSolver.h"
#include "Support/SparseAssembly.h"

#include <chrono>
#include <optional>
#include <utility>

namespace dmg
{

namespace
{

// Below this many unknowns the factorisation is done before multigrid has its levels.
constexpr int LargestSystemForCholesky = 20000;

double SecondsSince(std::chrono::steady_clock::time_point start)
{
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

std::string NameOf(SolverKind solver)
{
  switch (solver)
  {
    case SolverKind::VCycles:
      return "V-cycles";
    case SolverKind::NestedIterations:
      return "nested iterations";
    case SolverKind::CoarseProlongation:
      return "coarse prolongation";
    default:
      return "conjugate gradients with a V-cycle";
  }
}

/// The solver that runs, and why if it is not the one asked for.
std::pair<SolverKind, std::string> ChooseSolver(
  SolverKind asked, int unknowns, bool hasProlongations)
{
  if (asked == SolverKind::Cholesky || (asked != SolverKind::Automatic && hasProlongations))
  {
    return { asked, "" };
  }
  if (!hasProlongations)
  {
    // Multigrid on one level is its exact solver.
    const std::string instead =
      asked == SolverKind::Automatic ? "chosen" : "in place of " + NameOf(asked);
    return { SolverKind::Cholesky, ", " + instead + " because there are no coarse levels" };
  }
  const std::string size = std::to_string(unknowns) + " unknowns";
  if (unknowns <= LargestSystemForCholesky)
  {
    return { SolverKind::Cholesky, ", chosen for " + size + ", few enough to factor at once" };
  }
  return { SolverKind::ConjugateGradients, ", chosen for " + size };
}

/// Back-substitution, reported as one iteration.
template <class Scalar>
void SolveDirectly(const SparseMatrix<Scalar>& A, CholeskySolver<Scalar>& solver,
  const Vector<Scalar>& b, const ConvergenceMeasure<Scalar>& measure, Vector<Scalar>& x,
  SolveReport& report, const ExecutionContext& context)
{
  const double norm = b.norm();
  const auto append = [&](double seconds) {
    const Vector<Scalar> r = b - A * x;
    IterationReport row;
    row.Iteration = static_cast<int>(report.Iterations.size());
    row.Seconds = seconds;
    row.RelativeResidual = norm > 0.0 ? r.norm() / norm : 0.0;
    measure.Fill(row, x, b, r, context);
    report.Iterations.push_back(row);
  };
  report.Iterations.clear();
  x = Vector<Scalar>::Zero(b.size());
  append(0.0);
  const auto start = std::chrono::steady_clock::now();
  solver.Solve(b, x);
  report.SolveSeconds = SecondsSince(start);
  append(report.SolveSeconds);
  report.Converged = true;
}

bool IsNested(SolverKind solver)
{
  return solver == SolverKind::NestedIterations || solver == SolverKind::CoarseProlongation;
}

}

template <class Scalar>
class HarmonicProblem<Scalar>::Internals
{
public:
  explicit Internals(HarmonicSystem<Scalar> system)
    : System(std::move(system))
  {
  }

  HarmonicSystem<Scalar> System;
  std::optional<CholeskySolver<Scalar>> Cholesky;
  std::optional<MultigridSolver<Scalar>> Multigrid;
  std::optional<NestedIteration<Scalar>> Nested;
  SweepOptions Sweeps; // of nested iterations
  SolverKind Solver = SolverKind::Cholesky;
  SolveReport Report;
  std::vector<std::string> SystemWarnings;
};

template <class Scalar>
HarmonicProblem<Scalar>::HarmonicProblem(const MakeSystem& makeSystem,
  const MakeProlongations& makeProlongations, const std::string& coarseSpace,
  const SolverOptions& options, const ExecutionContext& context)
{
  const auto start = std::chrono::steady_clock::now();
  context.Checkpoint(0.0);
  this->Internal = std::make_unique<Internals>(makeSystem(context));
  Internals& internal = *this->Internal;
  const HarmonicSystem<Scalar>& system = internal.System;
  SolveReport& report = internal.Report;
  if (const std::string warning = WarningAboutUnreached(system); !warning.empty())
  {
    internal.SystemWarnings.push_back(warning);
  }

  context.Checkpoint(0.2);
  const auto [solver, reason] =
    ChooseSolver(options.Kind, system.NumberOfFree(), static_cast<bool>(makeProlongations));
  internal.Solver = solver;
  if (solver == SolverKind::Cholesky)
  {
    internal.Cholesky.emplace(system.Matrix());
    report.Solver = "supernodal Cholesky" + reason;
    report.Levels = { { system.NumberOfFree(), internal.Cholesky->NonZeros() } };
    report.Bytes = internal.Cholesky->Bytes();
  }
  else
  {
    std::vector<SparseMatrix<Scalar>> prolongations = makeProlongations(context);
    if (!prolongations.empty() && system.NumberOfFree() < system.NumberOfUnknowns())
    {
      prolongations[0] = SelectRows(prolongations[0], system.FreeUnknowns(), context);
    }
    GalerkinOptions coarsening;
    coarsening.FinestProlongationSteps = options.FinestProlongationSteps;
    if (options.StartingLevel >= 0)
    {
      coarsening.CoarsestLevel = options.StartingLevel;
    }
    const PartOfContext part(context, 0.2, 1.0);
    if (IsNested(solver))
    {
      internal.Sweeps = options.Nested;
      internal.Nested.emplace(system.Matrix(), std::move(prolongations),
        NestedOptions{ coarsening, solver == SolverKind::NestedIterations }, part);
      report.Levels = internal.Nested->Levels();
      report.Bytes = internal.Nested->Bytes();
    }
    else
    {
      CycleOptions cycle;
      cycle.Smoothing.PreSweeps = options.Sweeps;
      cycle.Smoothing.PostSweeps = options.Sweeps;
      cycle.FinestFactor = options.FinestSweepsFactor;
      internal.Multigrid.emplace(
        system.Matrix(), std::move(prolongations), MultigridOptions{ coarsening, cycle }, part);
      report.Levels = internal.Multigrid->Levels();
      report.Bytes = internal.Multigrid->Bytes();
    }
    report.Solver = NameOf(solver) + " on " + coarseSpace + reason;
  }
  report.PrepareSeconds = SecondsSince(start);
  report.Warnings = internal.SystemWarnings;
  if (options.CompareWithCholesky && solver != SolverKind::Cholesky)
  {
    internal.Cholesky.emplace(system.Matrix());
  }
  context.Checkpoint(1.0);
}

template <class Scalar>
HarmonicProblem<Scalar>::~HarmonicProblem() = default;

template <class Scalar>
HarmonicProblem<Scalar>::HarmonicProblem(HarmonicProblem&&) noexcept = default;

template <class Scalar>
Vector<Scalar> HarmonicProblem<Scalar>::Solve(const Vector<Scalar>& values,
  const Vector<Scalar>& start, const StoppingCriteria& stop, const ExecutionContext& context)
{
  Internals& internal = *this->Internal;
  const HarmonicSystem<Scalar>& system = internal.System;
  SolveReport& report = internal.Report;
  report.Warnings = internal.SystemWarnings;
  const Vector<Scalar> b = system.RightHandSide(values);
  Vector<Scalar> x;
  if (start.size() > 0)
  {
    x = system.Restrict(start);
  }
  ConvergenceMeasure<Scalar> measure;
  measure.Mass = system.Mass();
  if (internal.Cholesky && internal.Solver != SolverKind::Cholesky)
  {
    internal.Cholesky->Solve(b, measure.Reference);
  }
  switch (internal.Solver)
  {
    case SolverKind::Cholesky:
      SolveDirectly(system.Matrix(), *internal.Cholesky, b, measure, x, report, context);
      break;
    case SolverKind::VCycles:
      internal.Multigrid->SolveByCycles(b, stop, x, report, context, &measure);
      break;
    case SolverKind::NestedIterations:
    case SolverKind::CoarseProlongation:
      internal.Nested->Solve(b, internal.Sweeps, x, report, context, &measure);
      break;
    default:
      internal.Multigrid->SolveByConjugateGradients(b, stop, x, report, context, &measure);
      break;
  }
  return system.Expand(x, values);
}

template <class Scalar>
const SolveReport& HarmonicProblem<Scalar>::Report() const
{
  return this->Internal->Report;
}

template class HarmonicProblem<double>;
template class HarmonicProblem<Complex>;

}
