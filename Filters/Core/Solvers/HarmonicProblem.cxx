#include "Solvers/HarmonicProblem.h"

#include "Solvers/HarmonicFieldsOfSystem.h"
#include "Solvers/Krylov/ConjugateGradient.h"
#include "Solvers/Krylov/DeflatedPreconditioner.h"
#include "Solvers/Krylov/StationaryIteration.h"
#include "Solvers/PenaltiesOfSystem.h"
#include "Solvers/UnprescribedComponents.h"
#include "Support/AllIndices.h"
#include "Support/CountingSort.h"
#include "Support/Errors.h"
#include "Support/FreedMemory.h"
#include "Support/Permutations.h"
#include "Support/SparseKernels.h"

#include <algorithm>
#include <cassert>
#include <chrono>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

namespace dmg
{
namespace
{

constexpr double Infinity = std::numeric_limits<double>::infinity();
// Who allows fewer wants an answer in that time, and no factor after it.
constexpr int FewestIterationsBeforeFactor = 100;

RoughnessCycleOptions OptionsOfCycle(const SolverOptions& options, const SolverTuning& tuning)
{
  RoughnessCycleOptions cycle;
  cycle.Sweeps = options.Sweeps * tuning.FinestSweepsFactor;
  cycle.Coarse.Smoothing.PreSweeps = options.Sweeps;
  cycle.Coarse.Smoothing.PostSweeps = options.Sweeps;
  cycle.Coarse.Repetitions = tuning.CoarseCycles;
  cycle.LargestFactor = tuning.LargestCoarseFactor;
  cycle.CyclesInARow = tuning.CyclesInARow;
  cycle.Coarsening.FinestProlongationSteps = tuning.FinestProlongationSteps;
  if (options.StartingLevel >= 0)
  {
    cycle.Coarsening.CoarsestLevel = options.StartingLevel;
  }
  return cycle;
}

}

Eigen::MatrixXd MultigridSetup::HarmonicFields() const
{
  Eigen::MatrixXd fields(this->Kernel.rows(), this->Kernel.cols());
  if (this->Kernel.cols() > 0) // else it has no rows either
  {
    fields(this->Hierarchy->Order, All) = this->Kernel;
  }
  return fields;
}

/// All vectors are in the order of the hierarchy. The equations are divided by the smoothness weight.
class HarmonicProblem::Internals
{
public:
  Internals(std::shared_ptr<const MultigridSetup> setup, const SolverOptions& options,
    const SolverChoice& choice)
    : Setup(std::move(setup))
    , Options(options)
    , Kind(choice.Kind)
    , Reason(choice.Reason)
  {
  }

  void Prescribe(PrescribedUnknowns prescribed, double smoothness, const ExecutionContext& context);
  Vector<double> RightHandSide(const Vector<double>& values, const ExecutionContext& context) const;
  /// What penalties alone make of unknowns, D y / (R + D) with the diagonal of R. Solvers start from there: weak penalties
  /// are nothing to start from, and strong ones hold y but for rounding. Otherwise these would outweigh all the
  /// rest in residuals.
  Vector<double> HeldByPenalties(const Vector<double>& values) const;
  /// By a factor, V-cycles or conjugate gradients.
  void Iterate(Vector<double>& b, const StoppingCriteria& stop,
    const ConvergenceMeasure<double>& measure, Vector<double>& x, const ExecutionContext& context);
  /// Conjugate gradients with a factor instead of cycles, which have not converged, from where these are. Where there
  /// is none, all stays as it was.
  void IterateWithFactor(const LinearOperator<double>& matrix, const Vector<double>& b,
    const StoppingCriteria& stop, const ConvergenceMeasure<double>& measure, Vector<double>& x,
    const ExecutionContext& context);
  /// Solves for what x differs by from \p held, and adds that.
  /// \param b of all. \param x a start, or empty.
  void SolveWithPrescriptions(const Vector<double>& b, const Vector<double>& held,
    const Vector<double>& reference, const StoppingCriteria& stop, Vector<double>& x,
    const ExecutionContext& context);
  /// On the components without prescriptions.
  void FindSmoothest(Vector<double> start, const StoppingCriteria& stop, Vector<double>& x,
    const ExecutionContext& context);
  const std::shared_ptr<const MultigridSetup> Setup;
  const SolverOptions Options;
  const SolverKind Kind;
  const std::string Reason; ///< why it is this
  PrescribedUnknowns Prescribed;
  std::vector<int> Places; ///< of those
  Vector<double> Penalties; ///< D, of soft ones
  double Smoothness = 1.0;
  std::vector<int> Held; ///< unknowns that are not free, ascending
  UnprescribedComponents Unprescribed;
  std::unique_ptr<RoughnessOperator> A;
  std::unique_ptr<RoughnessCycle> Cycle;
  std::optional<DeflatedPreconditioner> Deflated; ///< the cycle or factor, where there are harmonic fields
  std::unique_ptr<Preconditioner<double>> Factor; ///< as soon as cycles have stagnated
  std::unique_ptr<RoughnessNestedIteration> Nested; ///< in place of a cycle
  SolveReport Report;
  std::vector<std::string> SystemWarnings;

private:
  /// D, infinite where an unknown is held.
  Vector<double> DiagonalOfPrescribed(const ExecutionContext& context);
  void MakeCycle(const Vector<double>& D, const ExecutionContext& context);
  void MakeNested(const Vector<double>& D, const ExecutionContext& context);
  void Deflate(const Vector<double>& D, const ExecutionContext& context);
  void FindUndetermined(const Vector<double>& D, const ExecutionContext& context);
  void WarnOfUndetermined(int number);
  void CheckAnyIsFree() const;
};

void HarmonicProblem::Internals::Prescribe(
  PrescribedUnknowns prescribed, double smoothness, const ExecutionContext& context)
{
  const auto start = std::chrono::steady_clock::now();
  const RoughnessHierarchy& hierarchy = *this->Setup->Hierarchy;
  this->Smoothness = prescribed.Kind == ConstraintKind::Hard ? 1.0 : smoothness;
  this->Prescribed = std::move(prescribed);
  this->Places = PlacesOf(this->Prescribed.Unknowns, hierarchy.Order, context);
  const Vector<double> D = this->DiagonalOfPrescribed(context);
  this->CheckAnyIsFree();
  context.Checkpoint(0.1);

  this->Factor.reset();
  this->Deflated.reset();
  if (!this->A)
  {
    this->A = hierarchy.Operator();
  }
  this->A->SetDiagonal(D, context);
  this->A->SetInverseDiagonal(InverseDiagonal(hierarchy, D, context));
  const PartOfContext most(context, 0.1, 0.9);
  if (IsNested(this->Kind))
  {
    this->FindUndetermined(D, context);
    this->MakeNested(D, most);
    if (!this->Unprescribed.Unknowns().empty())
    {
      this->MakeCycle(D, most);
    }
  }
  else
  {
    this->MakeCycle(D, most);
    this->Deflate(D, context);
  }
  const bool hasLevels = this->Kind != SolverKind::Cholesky;
  this->Report.Solver = NameOf(this->Kind) + (hasLevels ? " on " + this->Setup->Name : "") +
    this->Reason + this->Setup->KernelNote;
  this->Report.Warnings = this->SystemWarnings;
  this->Report.PrepareSeconds =
    std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  context.Checkpoint(1.0);
}

void HarmonicProblem::Internals::MakeCycle(
  const Vector<double>& D, const ExecutionContext& context)
{
  const RoughnessHierarchy& hierarchy = *this->Setup->Hierarchy;
  if (this->Cycle)
  {
    this->Cycle->Update(D, context);
  }
  else
  {
    this->Cycle =
      hierarchy.Cycle(D, OptionsOfCycle(this->Options, this->Setup->Tuning), context);
  }
  this->Report.Levels = this->Cycle->Levels();
  this->Report.Bytes = this->Setup->Bytes() + this->Cycle->Bytes();
}

void HarmonicProblem::Internals::MakeNested(
  const Vector<double>& D, const ExecutionContext& context)
{
  this->Nested.reset(); // makes room
  this->Nested = this->Setup->Hierarchy->NestedIterations(D,
    OptionsOfCycle(this->Options, this->Setup->Tuning), this->Kind == SolverKind::NestedIterations,
    context);
  this->Report.Levels = this->Nested->Levels();
  this->Report.Bytes = this->Setup->Bytes() + this->Nested->Bytes();
}

Vector<double> HarmonicProblem::Internals::DiagonalOfPrescribed(const ExecutionContext& context)
{
  const RoughnessHierarchy& hierarchy = *this->Setup->Hierarchy;
  const bool isHard = this->Prescribed.Kind == ConstraintKind::Hard;
  const int size = hierarchy.NumberOfUnknowns();
  Vector<double> D = Vector<double>::Zero(size);
  this->Penalties.setZero(isHard ? 0 : static_cast<Eigen::Index>(this->Places.size()));
  std::vector<char> isReached(hierarchy.NumberOfComponents(), 0);
  bool holdsAny = this->Places.empty();
  for (std::size_t k = 0; k < this->Places.size(); ++k)
  {
    const int place = this->Places[k];
    D[place] = isHard
      ? Infinity
      : this->Penalties[k] = LimitedPenalty(
          this->Prescribed.Alignment[k] / this->Smoothness, hierarchy.DiagonalOf(place));
    isReached[hierarchy.ComponentOf(place)] |= D[place] > 0.0;
    holdsAny |= D[place] > 0.0;
  }
  if (!holdsAny)
  {
    throw InvalidInput("all prescribed cells have zero area, so that they hold nothing; prescribe a "
                       "direction on another cell or make the constraints hard");
  }
  const std::vector<int> unreached = Choose(
    size, [&](int i) { return !isReached[hierarchy.ComponentOf(i)]; }, context);
  this->SystemWarnings.clear();
  this->Unprescribed = {};
  if (this->Setup->HasSmoothest)
  {
    this->Unprescribed = UnprescribedComponents(*this->Setup, unreached, D, context);
  }
  else if (!unreached.empty())
  {
    D(unreached).setConstant(Infinity); // zero, the least of equal minimisers
    this->SystemWarnings.push_back(
      WarningAboutUnreached(static_cast<int>(unreached.size()), size));
  }
  this->Held = Choose(size, [&D](int i) { return !std::isfinite(D[i]); }, context);
  return D;
}

Vector<double> HarmonicProblem::Internals::HeldByPenalties(const Vector<double>& values) const
{
  Vector<double> held = Vector<double>::Zero(this->Setup->Hierarchy->NumberOfUnknowns());
  const Vector<double>& inverse = *this->A->InverseDiagonal();
  for (Eigen::Index k = 0; k < this->Penalties.size(); ++k)
  {
    const int place = this->Places[k];
    held[place] = this->Penalties[k] * inverse[place] * values[k];
  }
  return held;
}

void HarmonicProblem::Internals::Deflate(const Vector<double>& D, const ExecutionContext& context)
{
  if (this->Setup->Kernel.cols() == 0)
  {
    return;
  }
  Eigen::MatrixXd kernel = AdjustKernelToPenalties(this->Setup->Kernel, *this->Setup->Hierarchy, D, context);
  const double largest = LargestEnergy(kernel, *this->Setup->Hierarchy, D, context);
  this->Deflated.emplace(*this->Cycle, *this->A, std::move(kernel), largest, context);
  this->Report.Bytes += this->Deflated->Bytes();
  this->WarnOfUndetermined(this->Deflated->Kernel().Size());
}

void HarmonicProblem::Internals::FindUndetermined(
  const Vector<double>& D, const ExecutionContext& context)
{
  const MultigridSetup& setup = *this->Setup;
  if (setup.Kernel.cols() == 0)
  {
    return;
  }
  const Eigen::MatrixXd undetermined =
    UndeterminedFields(AdjustKernelToPenalties(setup.Kernel, *setup.Hierarchy, D, context), *this->A,
      *setup.Hierarchy, D, this->Held, context);
  this->WarnOfUndetermined(static_cast<int>(undetermined.cols()));
}

void HarmonicProblem::Internals::CheckAnyIsFree() const
{
  if (static_cast<int>(this->Held.size()) < this->Setup->Hierarchy->NumberOfUnknowns())
  {
    return;
  }
  throw InvalidInput(
    "hard constraints leave nothing to solve for; prescribe fewer cells or points or make the constraints soft");
}

void HarmonicProblem::Internals::WarnOfUndetermined(int number)
{
  if (const std::string warning =
        WarningAboutUndetermined(number, static_cast<int>(this->Setup->Kernel.cols()));
      !warning.empty())
  {
    this->SystemWarnings.push_back(warning);
  }
}

Vector<double> HarmonicProblem::Internals::RightHandSide(
  const Vector<double>& values, const ExecutionContext& context) const
{
  const bool isHard = this->Prescribed.Kind == ConstraintKind::Hard;
  const int size = this->Setup->Hierarchy->NumberOfUnknowns();
  Vector<double> b = Vector<double>::Zero(size);
  for (std::size_t k = 0; k < this->Places.size(); ++k)
  {
    b[this->Places[k]] = (isHard ? 1.0 : this->Penalties[k]) * values[k];
  }
  if (isHard)
  {
    // - R_fb y, as D is zero on what is free
    Vector<double> product;
    this->A->Apply(b, product, context);
    b = -product;
  }
  SetZero(b, this->Held, context);
  return b;
}

void HarmonicProblem::Internals::Iterate(Vector<double>& b, const StoppingCriteria& stop,
  const ConvergenceMeasure<double>& measure, Vector<double>& x, const ExecutionContext& context)
{
  Preconditioner<double>* inverse = this->Cycle.get();
  const LinearOperator<double>* matrix = this->A.get();
  std::optional<OperatorOutsideKernel> outside;
  if (this->Deflated)
  {
    const KernelProjection& kernel = this->Deflated->Kernel();
    inverse = &*this->Deflated;
    matrix = &outside.emplace(*this->A, kernel);
    kernel.Remove(b, context);
    if (x.size() > 0)
    {
      kernel.Remove(x, context);
    }
  }
  if (!this->Factor)
  {
    const auto solve = this->Kind == SolverKind::VCycles ? &StationaryIteration<double>
                                                         : &ConjugateGradient<double>;
    solve(*matrix, *inverse, b, stop, x, this->Report, context, &measure);
  }
  const bool haveStagnated = this->Kind == SolverKind::ConjugateGradients &&
    !this->Report.Converged && !this->Report.EndedByRounding &&
    stop.MaximumIterations >= FewestIterationsBeforeFactor;
  if (this->Factor || haveStagnated)
  {
    this->IterateWithFactor(*matrix, b, stop, measure, x, context);
  }
}

void HarmonicProblem::Internals::IterateWithFactor(const LinearOperator<double>& matrix,
  const Vector<double>& b, const StoppingCriteria& stop, const ConvergenceMeasure<double>& measure,
  Vector<double>& x, const ExecutionContext& context)
{
  try
  {
    if (!this->Factor)
    {
      this->Factor =
        this->Setup->Hierarchy->Factor(this->DiagonalOfPrescribed(context), context);
    }
  }
  catch (const SolverFailure&)
  {
    return; // what the cycles have reached, and their warning, stand
  }
  this->Report.Warnings = this->SystemWarnings;
  const KernelProjection none;
  PreconditionerOutsideKernel inverse(*this->Factor, this->Deflated ? this->Deflated->Kernel() : none);
  ConjugateGradient<double>(matrix, inverse, b, stop, x, this->Report, context, &measure);
  this->Report.Warnings.push_back(
    "Cycles did not converge, so conjugate gradients with a factor of the system took over.");
}

HarmonicProblem::HarmonicProblem(std::shared_ptr<const MultigridSetup> setup,
  PrescribedUnknowns prescribed, double smoothness, const SolverOptions& options,
  const SolverChoice& choice, const ExecutionContext& context)
  : Internal(std::make_unique<Internals>(std::move(setup), options, choice))
{
  this->Internal->Prescribe(std::move(prescribed), smoothness, context);
  GiveBackFreedMemory(); // once; the vectors of a solve are large
}

HarmonicProblem::~HarmonicProblem() = default;

HarmonicProblem::HarmonicProblem(HarmonicProblem&&) noexcept = default;

void HarmonicProblem::Update(
  PrescribedUnknowns prescribed, double smoothness, const ExecutionContext& context)
{
  this->Internal->Prescribe(std::move(prescribed), smoothness, context);
}

int HarmonicProblem::NumberOfFree() const
{
  return this->Internal->Setup->Hierarchy->NumberOfUnknowns() -
    static_cast<int>(this->Internal->Held.size());
}

const MultigridSetup& HarmonicProblem::Setup() const
{
  return *this->Internal->Setup;
}

const SolveReport& HarmonicProblem::Report() const
{
  return this->Internal->Report;
}

void HarmonicProblem::Internals::SolveWithPrescriptions(const Vector<double>& b,
  const Vector<double>& held, const Vector<double>& reference, const StoppingCriteria& stop,
  Vector<double>& x, const ExecutionContext& context)
{
  Vector<double> difference; // b - A held
  this->A->Apply(held, difference, context);
  difference = b - difference;
  SetZero(difference, this->Held, context);
  ConvergenceMeasure<double> measure;
  measure.Mass = &this->Setup->Mass;
  measure.EnergyScale = this->Smoothness;
  measure.Offset = &held;
  measure.RightHandSide = &b;
  measure.Reference = reference;
  if (x.size() > 0)
  {
    x -= held;
  }
  if (this->Nested)
  {
    this->Nested->Solve(difference, this->Options.Nested, x, this->Report, context, measure);
    this->Report.Returned = this->Report.Iterations.back().Iteration;
    this->Report.Converged = this->Report.Iterations.back().RelativeResidual <= stop.RelativeTolerance;
  }
  else
  {
    this->Iterate(difference, stop, measure, x, context);
  }
  x += held;
  if (this->Deflated)
  {
    this->Deflated->Kernel().Remove(x, context);
  }
}

void HarmonicProblem::Internals::FindSmoothest(Vector<double> start, const StoppingCriteria& stop,
  Vector<double>& x, const ExecutionContext& context)
{
  const bool isAll = this->Prescribed.Unknowns.empty();
  if (isAll)
  {
    this->Report.SolveSeconds = 0.0;
    this->Report.Converged = true;
  }
  Preconditioner<double>* inverse = this->Cycle.get();
  if (this->Deflated)
  {
    inverse = &*this->Deflated;
  }
  std::vector<IterationReport> iterations = this->Unprescribed.FindSmoothest(
    *this->A, *inverse, std::move(start), stop, x, this->Report, context);
  if (isAll)
  {
    this->Report.Iterations = std::move(iterations);
    this->Report.Returned = this->Report.Iterations.back().Iteration;
  }
}

Vector<double> HarmonicProblem::Solve(const Vector<double>& values, const Vector<double>& start,
  const Vector<double>& reference, const StoppingCriteria& stop, const ExecutionContext& context,
  const Vector<double>& source)
{
  Internals& of = *this->Internal;
  assert(values.size() == static_cast<Eigen::Index>(of.Prescribed.Unknowns.size()));
  of.Report.Warnings = of.SystemWarnings;
  of.Report.Eigenvalues.clear();
  const std::vector<int>& order = of.Setup->Hierarchy->Order;
  const std::vector<int>& unprescribed = of.Unprescribed.Unknowns();
  const auto inOrder = [&](const Vector<double>& vector) {
    Vector<double> gathered = Gathered(vector, order, context);
    if (gathered.size() > 0)
    {
      SetZero(gathered, of.Held, context);
      SetZero(gathered, unprescribed, context);
    }
    return gathered;
  };
  Vector<double> b = of.RightHandSide(values, context);
  if (source.size() > 0)
  {
    b += inOrder(source) / of.Smoothness;
  }
  Vector<double> x = Vector<double>::Zero(order.size());
  if (!of.Prescribed.Unknowns.empty())
  {
    // A factor needs no start: what it would improve is found at once.
    x = of.Kind == SolverKind::Cholesky ? Vector<double>() : inOrder(start);
    of.SolveWithPrescriptions(b, of.HeldByPenalties(values), inOrder(reference), stop, x, context);
  }
  if (!unprescribed.empty())
  {
    of.FindSmoothest(Gathered(start, order, context), stop, x, context);
  }
  if (of.Prescribed.Kind == ConstraintKind::Hard)
  {
    for (std::size_t k = 0; k < of.Prescribed.Unknowns.size(); ++k)
    {
      x[of.Places[k]] = values[k];
    }
  }
  return Scattered(x, order, context);
}

}
