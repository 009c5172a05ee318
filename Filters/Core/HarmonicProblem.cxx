#include "HarmonicProblem.h"

#include "Solvers/ConjugateGradient.h"
#include "Solvers/MultigridSolver.h"
#include "Solvers/ShiftedFactor.h"
#include "Support/SparseAssembly.h"

#include <algorithm>
#include <chrono>
#include <optional>
#include <utility>

namespace dmg
{

namespace
{

double SecondsSince(std::chrono::steady_clock::time_point start)
{
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// Back-substitution is the first iteration, and nearly always the last. More undo what the shift and rounding errors
/// did to fields of hardly any energy, where the matrix is nearly singular.
template <class Scalar>
void SolveDirectly(const SparseMatrix<Scalar>& A, ShiftedFactor<Scalar>& factor,
  const Vector<Scalar>& b, const StoppingCriteria& stop, const ConvergenceMeasure<Scalar>& measure,
  Vector<Scalar>& x, SolveReport& report, const ExecutionContext& context)
{
  x.resize(0);
  ConjugateGradient<Scalar>(
    MatrixOperator<Scalar>(A), factor, b, stop, x, report, context, &measure);
}

template <class Scalar>
bool HaveSamePattern(const SparseMatrix<Scalar>& A, const SparseMatrix<Scalar>& B)
{
  return A.rows() == B.rows() && A.nonZeros() == B.nonZeros() &&
    std::equal(A.outerIndexPtr(), A.outerIndexPtr() + A.outerSize() + 1, B.outerIndexPtr()) &&
    std::equal(A.innerIndexPtr(), A.innerIndexPtr() + A.nonZeros(), B.innerIndexPtr());
}

template <class Scalar>
std::vector<std::string> WarningsAbout(const HarmonicSystem<Scalar>& system)
{
  std::vector<std::string> warnings;
  for (const std::string& warning :
    { WarningAboutUnreached(system.NumberOfUnreached(), system.NumberOfUnknowns()),
      WarningAboutUndetermined(system.NumberOfUndetermined(), system.SizeOfKernel()) })
  {
    if (!warning.empty())
    {
      warnings.push_back(warning);
    }
  }
  return warnings;
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

  void PrepareMultigrid(
    const CoarseSpaces& spaces, const SolverOptions& options, const ExecutionContext& context);
  /// By V-cycles or conjugate gradients.
  void SolveByMultigrid(const Vector<Scalar>& b, const StoppingCriteria& stop,
    const ConvergenceMeasure<Scalar>& measure, Vector<Scalar>& x, const ExecutionContext& context);

  HarmonicSystem<Scalar> System;
  std::optional<ShiftedFactor<Scalar>> Cholesky;
  std::optional<MultigridSolver<Scalar>> Multigrid;
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
  constexpr bool MayUpdate = true;
  this->Multigrid.emplace(this->System.Matrix(), std::move(prolongations),
    MultigridOptions{ coarsening, cycle, MayUpdate }, context);
  this->Report.Levels = this->Multigrid->Levels();
  this->Report.Bytes = this->Multigrid->Bytes();
}

template <class Scalar>
void HarmonicProblem<Scalar>::Internals::SolveByMultigrid(const Vector<Scalar>& b,
  const StoppingCriteria& stop, const ConvergenceMeasure<Scalar>& measure, Vector<Scalar>& x,
  const ExecutionContext& context)
{
  if (this->Solver == SolverKind::VCycles)
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
  this->Internal = std::make_unique<Internals>(makeSystem(PartOfContext(context, 0.0, 0.2)));
  Internals& internal = *this->Internal;
  const HarmonicSystem<Scalar>& system = internal.System;
  SolveReport& report = internal.Report;
  internal.SystemWarnings = WarningsAbout(system);

  context.Checkpoint(0.2);
  const auto [solver, reason] =
    ChooseSolver(options, system.NumberOfFree(), static_cast<bool>(coarseSpaces.Prolongations));
  internal.Solver = solver;
  if (solver == SolverKind::Cholesky)
  {
    internal.Cholesky.emplace(system.Matrix());
    report.Solver = NameOf(solver) + reason;
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
bool HarmonicProblem<Scalar>::Update(const MakeSystem& makeSystem, const ExecutionContext& context)
{
  Internals& internal = *this->Internal;
  const bool isCompared = internal.Cholesky && internal.Solver != SolverKind::Cholesky;
  if (internal.Nested || isCompared)
  {
    return false;
  }
  const auto start = std::chrono::steady_clock::now();
  context.Checkpoint(0.0);
  HarmonicSystem<Scalar> system = makeSystem(PartOfContext(context, 0.0, 0.4));
  if (system.FreeUnknowns() != internal.System.FreeUnknowns() ||
    !HaveSamePattern(system.Matrix(), internal.System.Matrix()))
  {
    return false;
  }
  internal.System = std::move(system);
  internal.SystemWarnings = WarningsAbout(internal.System);
  if (internal.Cholesky)
  {
    internal.Cholesky->Update(internal.System.Matrix());
  }
  else
  {
    internal.Multigrid->Update(internal.System.Matrix(), PartOfContext(context, 0.4, 1.0));
  }
  internal.Report.PrepareSeconds = SecondsSince(start);
  context.Checkpoint(1.0);
  return true;
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
  measure.Mass = &system.Mass();
  if (internal.Cholesky && internal.Solver != SolverKind::Cholesky)
  {
    constexpr StoppingCriteria AsFarAsItGoes = { 1e-13, 10 };
    SolveReport ofReference;
    ConjugateGradient<Scalar>(MatrixOperator<Scalar>(system.Matrix()), *internal.Cholesky, b,
      AsFarAsItGoes, measure.Reference, ofReference, context);
  }
  switch (internal.Solver)
  {
    case SolverKind::Cholesky:
      SolveDirectly(system.Matrix(), *internal.Cholesky, b, stop, measure, x, report, context);
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
