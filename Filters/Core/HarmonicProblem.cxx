#include "HarmonicProblem.h"

#include "Solvers/CholeskySolver.h"
#include "Solvers/MultigridSolver.h"
#include "Support/Errors.h"
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

/// The solver that runs, and why if that was left to us.
std::pair<SolverKind, std::string> ChooseSolver(
  SolverKind asked, int unknowns, bool hasProlongations)
{
  if (asked != SolverKind::Automatic)
  {
    return { asked, "" };
  }
  const std::string size = std::to_string(unknowns) + " unknowns";
  if (!hasProlongations)
  {
    return { SolverKind::Cholesky, ", chosen because there are no coarse levels" };
  }
  if (unknowns <= LargestSystemForCholesky)
  {
    return { SolverKind::Cholesky, ", chosen for " + size + ", few enough to factor at once" };
  }
  return { SolverKind::ConjugateGradients, ", chosen for " + size };
}

/// Back-substitution, reported as one iteration.
template <class Scalar>
void SolveDirectly(const SparseMatrix<Scalar>& A, CholeskySolver<Scalar>& solver,
  const Vector<Scalar>& b, Vector<Scalar>& x, SolveReport& report)
{
  const auto start = std::chrono::steady_clock::now();
  solver.Solve(b, x);
  const double norm = b.norm();
  const double residual = norm > 0.0 ? (b - A * x).norm() / norm : 0.0;
  report.SolveSeconds = SecondsSince(start);
  report.Iterations = { { 0, 0.0, 1.0 }, { 1, report.SolveSeconds, residual } };
  report.Converged = true;
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
  std::optional<MultigridSolver<Scalar>> Multigrid; // if not Cholesky
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
    if (!makeProlongations)
    {
      throw InvalidInput("multigrid needs the prolongation operators of the surface");
    }
    std::vector<SparseMatrix<Scalar>> prolongations = makeProlongations(context);
    if (!prolongations.empty() && system.NumberOfFree() < system.NumberOfUnknowns())
    {
      prolongations[0] = SelectRows(prolongations[0], system.FreeUnknowns(), context);
    }
    MultigridOptions multigrid;
    multigrid.Cycle.Smoothing.PreSweeps = options.Sweeps;
    multigrid.Cycle.Smoothing.PostSweeps = options.Sweeps;
    multigrid.Cycle.FinestFactor = options.FinestSweepsFactor;
    multigrid.Coarsening.FinestProlongationSteps = options.FinestProlongationSteps;
    internal.Multigrid.emplace(
      system.Matrix(), std::move(prolongations), multigrid, PartOfContext(context, 0.2, 1.0));
    report.Solver = std::string(solver == SolverKind::VCycles
        ? "V-cycles" : "conjugate gradients with a V-cycle") + " on " + coarseSpace + reason;
    report.Levels = internal.Multigrid->Levels();
    report.Bytes = internal.Multigrid->Bytes();
  }
  report.PrepareSeconds = SecondsSince(start);
  report.Warnings = internal.SystemWarnings;
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
  switch (internal.Solver)
  {
    case SolverKind::Cholesky:
      SolveDirectly(system.Matrix(), *internal.Cholesky, b, x, report);
      break;
    case SolverKind::VCycles:
      internal.Multigrid->SolveByCycles(b, stop, x, report, context);
      break;
    default:
      internal.Multigrid->SolveByConjugateGradients(b, stop, x, report, context);
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
