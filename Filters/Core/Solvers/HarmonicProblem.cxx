#include "Solvers/HarmonicProblem.h"

#include "Solvers/HarmonicFieldsOfSystem.h"
#include "Solvers/Krylov/ConjugateGradient.h"
#include "Solvers/Krylov/DeflatedPreconditioner.h"
#include "Solvers/Krylov/LowestEigenvectors.h"
#include "Solvers/Krylov/StationaryIteration.h"
#include "Solvers/PenaltiesOfSystem.h"
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
    fields(this->Hierarchy->Order, Eigen::all) = this->Kernel;
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
  /// The smoothest field on the components without prescriptions. \param start of it.
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
  /// Unknowns by component, of those components that have no prescription: their field is an eigenvector.
  SortedItems Unprescribed;
  std::vector<double> Shifts; ///< of their matrices, by component
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
  void ShiftUnprescribed(Vector<double>& D);
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
    if (!this->Unprescribed.Items.empty())
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
    this->Unprescribed = SortByKey(unreached, hierarchy.NumberOfComponents(),
      [&hierarchy](int i) { return hierarchy.ComponentOf(i); }, context);
    this->ShiftUnprescribed(D);
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

/// Where nothing is prescribed, D is a small multiple of the mass, about the lowest eigenvalue: A is positive definite,
/// has the eigenvectors of R, and eigenvalues that are so much larger. A surface of size L has eigenvalues from
/// about 1 / L^2 to 1 / h^2, where the diagonal is, and n unknowns have the size (L / h)^2.
void HarmonicProblem::Internals::ShiftUnprescribed(Vector<double>& D)
{
  const std::vector<int>& begins = this->Unprescribed.Begins;
  this->Shifts.assign(begins.size() - 1, 0.0);
  std::vector<double> diagonal;
  for (std::size_t part = 0; part < this->Shifts.size(); ++part)
  {
    const int* const first = this->Unprescribed.Items.data() + begins[part];
    const int* const last = this->Unprescribed.Items.data() + begins[part + 1];
    if (first == last)
    {
      continue;
    }
    diagonal.clear();
    std::transform(first, last, std::back_inserter(diagonal), [this](int i) {
      return this->Setup->Hierarchy->DiagonalOf(i) / this->Setup->MassOf(i);
    });
    const auto median = diagonal.begin() + diagonal.size() / 2;
    std::nth_element(diagonal.begin(), median, diagonal.end());
    const double scale = *median > 0.0 ? *median : 1.0; // a triangle by itself has no roughness
    this->Shifts[part] = scale / static_cast<double>(diagonal.size());
    std::for_each(first, last,
      [&, this](int i) { D[i] = this->Shifts[part] * this->Setup->MassOf(i); });
  }
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

void HarmonicProblem::Internals::FindSmoothest(Vector<double> start, const StoppingCriteria& stop,
  Vector<double>& x, const ExecutionContext& context)
{
  const MultigridSetup& setup = *this->Setup;
  const std::vector<int>& begins = this->Unprescribed.Begins;
  if (start.size() == 0)
  {
    // Nothing is smoother than a harmonic field.
    start = setup.Kernel.cols() > 0 ? Vector<double>(setup.Kernel.rowwise().sum())
                                    : Vector<double>::Zero(x.size());
  }
  Preconditioner<double>* inverse = this->Cycle.get();
  if (this->Deflated)
  {
    inverse = &*this->Deflated;
  }
  // At 1e-6 the eigenvalue has twelve digits. Vectors of eigenvalues that are closer than that to each other are not told apart.
  constexpr double SmallestTolerance = 1e-6;
  const StoppingCriteria ofEigenvector{ std::max(stop.RelativeTolerance, SmallestTolerance), stop.MaximumIterations };
  SolveReport ofEigenvectors;
  const std::vector<double> theta = FindLowestEigenvectors(
    { *this->A, *inverse, setup.Mass, this->Unprescribed }, ofEigenvector, start, ofEigenvectors, context);
  this->Report.Eigenvalues.clear();
  for (std::size_t part = 0; part < theta.size(); ++part)
  {
    if (begins[part] == begins[part + 1])
    {
      continue;
    }
    double share = 0.0; // of the surface
    for (int item = begins[part]; item < begins[part + 1]; ++item)
    {
      share += setup.MassOf(this->Unprescribed.Items[item]);
    }
    share /= setup.Mass.sum() * (x.size() / setup.Mass.size());
    for (int item = begins[part]; item < begins[part + 1]; ++item)
    {
      const int i = this->Unprescribed.Items[item];
      x[i] = std::sqrt(share * setup.SquaredNormOfUnit) * start[i];
    }
    this->Report.Eigenvalues.push_back(
      std::max(theta[part] - this->Shifts[part], 0.0) * setup.SquaredNormOfUnit / setup.Area);
  }
  if (this->Prescribed.Unknowns.empty())
  {
    this->Report.Iterations = std::move(ofEigenvectors.Iterations);
    this->Report.Returned = this->Report.Iterations.back().Iteration;
    this->Report.Converged = true;
  }
  this->Report.SolveSeconds += ofEigenvectors.SolveSeconds;
  this->Report.Converged &= ofEigenvectors.Converged;
  this->Report.Warnings.insert(this->Report.Warnings.end(), ofEigenvectors.Warnings.begin(),
    ofEigenvectors.Warnings.end());
}

Vector<double> HarmonicProblem::Solve(const Vector<double>& values, const Vector<double>& start,
  const Vector<double>& reference, const StoppingCriteria& stop, const ExecutionContext& context,
  const Vector<double>& source)
{
  Internals& of = *this->Internal;
  assert(values.size() == static_cast<Eigen::Index>(of.Prescribed.Unknowns.size()));
  of.Report.Warnings = of.SystemWarnings;
  const std::vector<int>& order = of.Setup->Hierarchy->Order;
  const std::vector<int>& unprescribed = of.Unprescribed.Items;
  Vector<double> smoothest = unprescribed.empty() ? Vector<double>() : Gathered(start, order, context);
  Vector<double> b = of.RightHandSide(values, context);
  if (source.size() > 0)
  {
    b += Gathered(source, order, context) / of.Smoothness;
    SetZero(b, of.Held, context);
  }
  const Vector<double> held = of.HeldByPenalties(values);
  Vector<double> difference; // b - A held
  of.A->Apply(held, difference, context);
  difference = b - difference;
  SetZero(difference, of.Held, context);
  // A factor needs no start: what it would improve is found at once.
  Vector<double> x =
    of.Kind == SolverKind::Cholesky ? Vector<double>() : Gathered(start, order, context);
  if (x.size() > 0)
  {
    SetZero(x, of.Held, context);
    SetZero(x, unprescribed, context);
    x -= held;
  }
  ConvergenceMeasure<double> measure;
  measure.Mass = &of.Setup->Mass;
  measure.EnergyScale = of.Smoothness;
  measure.Offset = &held;
  measure.RightHandSide = &b;
  measure.Reference = Gathered(reference, order, context);
  if (measure.Reference.size() > 0)
  {
    SetZero(measure.Reference, of.Held, context);
    SetZero(measure.Reference, unprescribed, context);
  }
  if (of.Prescribed.Unknowns.empty())
  {
    x = Vector<double>::Zero(order.size());
    of.Report.SolveSeconds = 0.0;
  }
  else if (of.Nested)
  {
    of.Nested->Solve(difference, of.Options.Nested, x, of.Report, context, measure);
    of.Report.Returned = of.Report.Iterations.back().Iteration;
    of.Report.Converged = of.Report.Iterations.back().RelativeResidual <= stop.RelativeTolerance;
  }
  else
  {
    of.Iterate(difference, stop, measure, x, context);
  }
  x += held;
  if (of.Deflated)
  {
    of.Deflated->Kernel().Remove(x, context);
  }
  if (!unprescribed.empty())
  {
    of.FindSmoothest(std::move(smoothest), stop, x, context);
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
