#include "HarmonicProblem.h"

#include "Solvers/CholeskySolver.h"
#include "Solvers/ConjugateGradient.h"
#include "Solvers/DeflatedPreconditioner.h"
#include "Solvers/MultigridSolver.h"
#include "Solvers/StationaryIteration.h"
#include "Support/SparseAssembly.h"

#include <chrono>
#include <optional>
#include <type_traits>
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

/// Levels on the free unknowns.
template <class Scalar>
LeastSquaresLevels Restrict(LeastSquaresLevels levels, const HarmonicSystem<Scalar>& system,
  const ExecutionContext& context)
{
  if (system.NumberOfFree() == system.NumberOfUnknowns())
  {
    return levels;
  }
  levels.Prolongation = SelectRows(levels.Prolongation, system.FreeUnknowns(), context);
  UnknownBlocks blocks;
  for (int k = 0; k < levels.Blocks.Size(); ++k)
  {
    for (int s = levels.Blocks.Offsets[k]; s < levels.Blocks.Offsets[k + 1]; ++s)
    {
      const int row = system.RowsOfUnknowns()[levels.Blocks.Unknowns[s]];
      if (row >= 0)
      {
        blocks.Unknowns.push_back(row);
      }
    }
    if (static_cast<int>(blocks.Unknowns.size()) > blocks.Offsets.back())
    {
      blocks.EndBlock();
    }
  }
  levels.Blocks = std::move(blocks);
  return levels;
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

  void PrepareMultigrid(
    const CoarseSpaces& spaces, const SolverOptions& options, const ExecutionContext& context);
  void DeflateKernel(const CoarseSpaces& spaces, const ExecutionContext& context);
  /// By V-cycles or conjugate gradients.
  void SolveByMultigrid(const Vector<Scalar>& b, const StoppingCriteria& stop,
    const ConvergenceMeasure<Scalar>& measure, Vector<Scalar>& x, const ExecutionContext& context);

  HarmonicSystem<Scalar> System;
  std::optional<CholeskySolver<Scalar>> Cholesky;
  std::optional<MultigridSolver<Scalar>> Multigrid;
  std::unique_ptr<Preconditioner<double>> LeastSquares; // in place of Multigrid
  std::optional<NestedIteration<Scalar>> Nested;
  SweepOptions Sweeps; // of nested iterations
  SolverKind Solver = SolverKind::Cholesky;
  SolveReport Report;
  std::vector<std::string> SystemWarnings;
};

template <class Scalar>
void HarmonicProblem<Scalar>::Internals::PrepareMultigrid(
  const CoarseSpaces& spaces, const SolverOptions& options, const ExecutionContext& context)
{
  CycleOptions cycle;
  cycle.Smoothing.PreSweeps = options.Sweeps;
  cycle.Smoothing.PostSweeps = options.Sweeps;
  if constexpr (std::is_same_v<Scalar, double>)
  {
    if (spaces.LeastSquares && !IsNested(this->Solver) && options.StartingLevel < 0)
    {
      LeastSquaresCycleOptions ofCycle;
      ofCycle.Sweeps = options.Sweeps * options.FinestSweepsFactor;
      ofCycle.Coarse = cycle;
      const PartOfContext ofLevels(context, 0.0, 0.1);
      auto leastSquares = std::make_unique<LeastSquaresCycle>(this->System.Factor(),
        Restrict(spaces.LeastSquares(ofLevels), this->System, ofLevels), ofCycle,
        PartOfContext(context, 0.1, 0.7));
      this->Report.Levels = leastSquares->Levels();
      this->Report.Bytes = leastSquares->Bytes();
      this->LeastSquares = std::move(leastSquares);
      this->DeflateKernel(spaces, PartOfContext(context, 0.7, 1.0));
      return;
    }
  }
  std::vector<SparseMatrix<Scalar>> prolongations = spaces.Prolongations(context);
  if (!prolongations.empty() && this->System.NumberOfFree() < this->System.NumberOfUnknowns())
  {
    prolongations[0] = SelectRows(prolongations[0], this->System.FreeUnknowns(), context);
  }
  GalerkinOptions coarsening;
  coarsening.FinestProlongationSteps = options.FinestProlongationSteps;
  if (options.StartingLevel >= 0)
  {
    coarsening.CoarsestLevel = options.StartingLevel;
  }
  if (IsNested(this->Solver))
  {
    this->Sweeps = options.Nested;
    this->Nested.emplace(this->System.Matrix(), std::move(prolongations),
      NestedOptions{ coarsening, this->Solver == SolverKind::NestedIterations }, context);
    this->Report.Levels = this->Nested->Levels();
    this->Report.Bytes = this->Nested->Bytes();
    return;
  }
  cycle.FinestFactor = options.FinestSweepsFactor;
  this->Multigrid.emplace(this->System.Matrix(), std::move(prolongations),
    MultigridOptions{ coarsening, cycle }, context);
  this->Report.Levels = this->Multigrid->Levels();
  this->Report.Bytes = this->Multigrid->Bytes();
}

template <class Scalar>
void HarmonicProblem<Scalar>::Internals::DeflateKernel(
  const CoarseSpaces& spaces, const ExecutionContext& context)
{
  Eigen::MatrixXd kernel;
  if (spaces.Kernel)
  {
    kernel = spaces.Kernel(context);
  }
  if (kernel.cols() == 0)
  {
    return;
  }
  if constexpr (std::is_same_v<Scalar, double>)
  {
    if (this->System.NumberOfFree() < this->System.NumberOfUnknowns())
    {
      const std::vector<int>& free = this->System.FreeUnknowns();
      for (std::size_t row = 0; row < free.size(); ++row)
      {
        kernel.row(row) = kernel.row(free[row]); // free unknowns ascend
      }
      kernel.conservativeResize(free.size(), Eigen::NoChange);
    }
    auto deflated = std::make_unique<DeflatedPreconditioner>(
      std::move(this->LeastSquares), this->System.Matrix(), std::move(kernel));
    this->Report.Bytes += deflated->Bytes();
    this->LeastSquares = std::move(deflated);
  }
}

template <class Scalar>
void HarmonicProblem<Scalar>::Internals::SolveByMultigrid(const Vector<Scalar>& b,
  const StoppingCriteria& stop, const ConvergenceMeasure<Scalar>& measure, Vector<Scalar>& x,
  const ExecutionContext& context)
{
  const bool byCycles = this->Solver == SolverKind::VCycles;
  if constexpr (std::is_same_v<Scalar, double>)
  {
    if (this->LeastSquares)
    {
      const auto solve = byCycles ? &StationaryIteration<double> : &ConjugateGradient<double>;
      solve(this->System.Matrix(), *this->LeastSquares, b, stop, x, this->Report, context, &measure);
      return;
    }
  }
  if (byCycles)
  {
    this->Multigrid->SolveByCycles(b, stop, x, this->Report, context, &measure);
  }
  else
  {
    this->Multigrid->SolveByConjugateGradients(b, stop, x, this->Report, context, &measure);
  }
}

template <class Scalar>
HarmonicProblem<Scalar>::HarmonicProblem(const MakeSystem& makeSystem,
  const CoarseSpaces& coarseSpaces, const SolverOptions& options, const ExecutionContext& context)
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
    ChooseSolver(options.Kind, system.NumberOfFree(), static_cast<bool>(coarseSpaces.Prolongations));
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
    internal.PrepareMultigrid(coarseSpaces, options, PartOfContext(context, 0.2, 1.0));
    report.Solver = NameOf(solver) + " on " + coarseSpaces.Name + reason;
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
    case SolverKind::NestedIterations:
    case SolverKind::CoarseProlongation:
      internal.Nested->Solve(b, internal.Sweeps, x, report, context, &measure);
      break;
    default:
      internal.SolveByMultigrid(b, stop, measure, x, context);
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
