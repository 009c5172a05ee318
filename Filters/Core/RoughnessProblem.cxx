#include "RoughnessProblem.h"

#include "Solvers/ConjugateGradient.h"
#include "Solvers/DeflatedPreconditioner.h"
#include "Solvers/StationaryIteration.h"
#include "Support/CountingSort.h"
#include "Support/Errors.h"
#include "Support/FreedMemory.h"
#include "Support/Permutations.h"
#include "Support/SparseKernels.h"

#include <Eigen/QR>

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
constexpr int Grain = 8192;

RoughnessCycleOptions OptionsOfCycle(const SolverOptions& options)
{
  RoughnessCycleOptions cycle;
  cycle.Sweeps = options.Sweeps * options.FinestSweepsFactor;
  cycle.Coarse.Smoothing.PreSweeps = options.Sweeps;
  cycle.Coarse.Smoothing.PostSweeps = options.Sweeps;
  cycle.Coarse.Repetitions = options.CoarseCycles;
  cycle.LargestFactor = options.LargestCoarseFactor;
  return cycle;
}

/// A where its kernel has no part. What counts as kernel has energies of rounding errors rather than none,
/// and a residual could not fall below their roots.
class OutsideKernel : public LinearOperator<double>
{
public:
  OutsideKernel(const LinearOperator<double>& A, const DeflatedPreconditioner& deflated)
    : A(A)
    , Deflated(deflated)
  {
  }

  int Size() const override { return this->A.Size(); }
  double Apply(
    const Vector<double>& x, Vector<double>& y, const ExecutionContext& context) const override
  {
    const double product = this->A.Apply(x, y, context);
    this->Deflated.RemoveKernel(y, context);
    return product;
  }

private:
  const LinearOperator<double>& A;
  const DeflatedPreconditioner& Deflated;
};

/// What deflation takes of harmonic fields: they are zero where unknowns are held, and yield where D pulls
/// (YieldingUnknowns). Strong pulls would otherwise cost them so much energy that they helped nothing: 46
/// iterations were seen instead of 13. But where there is a harmonic field with any values that may be prescribed,
/// it is the solution, and they do not yield.
Eigen::MatrixXd UnderPulls(Eigen::MatrixXd fields, const RoughnessHierarchy& hierarchy,
  const Vector<double>& D, const ExecutionContext& context)
{
  const int size = hierarchy.NumberOfUnknowns();
  const std::vector<int> pulled =
    Choose(size, [&D](int i) { return D[i] > 0.0 && std::isfinite(D[i]); }, context);
  const auto count = static_cast<Eigen::Index>(pulled.size());
  const bool areMet = count == 0 ||
    (count <= fields.cols() &&
      Eigen::ColPivHouseholderQR<Eigen::MatrixXd>(fields(pulled, Eigen::all)).rank() == count);
  context.ParallelFor(0, size, Grain, [&](int first, int last) {
    for (int i = first; i < last; ++i)
    {
      if (!std::isfinite(D[i]))
      {
        fields.row(i).setZero();
      }
      else if (D[i] > 0.0 && !areMet)
      {
        const double R = hierarchy.DiagonalOf(i);
        fields.row(i) *= R / (R + D[i]);
      }
    }
  });
  return fields;
}

/// What the energies of some vectors would be if nothing cancelled. Slivers have large scales, and hardly count.
double LargestEnergy(const Eigen::MatrixXd& vectors, const RoughnessHierarchy& hierarchy,
  const Vector<double>& D, const ExecutionContext& context)
{
  double largest = 0.0;
  for (Eigen::Index k = 0; k < vectors.cols(); ++k)
  {
    largest = std::max(largest,
      SumOverBlocks<double>(hierarchy.NumberOfUnknowns(), context, [&](int first, int last) {
        double energy = 0.0;
        for (int i = first; i < last; ++i)
        {
          energy += std::isfinite(D[i])
            ? (hierarchy.DiagonalOf(i) + D[i]) * vectors(i, k) * vectors(i, k)
            : 0.0;
        }
        return energy;
      }));
  }
  return largest;
}

/// Where some items stand in an order.
std::vector<int> PlacesOf(
  const std::vector<int>& items, const std::vector<int>& order, const ExecutionContext& context)
{
  const std::vector<int> all = Inverse(order, context);
  std::vector<int> places;
  places.reserve(items.size());
  for (const int item : items)
  {
    places.push_back(all[item]);
  }
  return places;
}

}

Eigen::MatrixXd RoughnessSurface::HarmonicFields() const
{
  Eigen::MatrixXd fields(this->Kernel.rows(), this->Kernel.cols());
  if (this->Kernel.cols() > 0) // else it has no rows either
  {
    fields(this->Hierarchy->Order, Eigen::all) = this->Kernel;
  }
  return fields;
}

/// All vectors are in the order of the hierarchy. The equations are divided by the smoothness weight.
class RoughnessProblem::Internals
{
public:
  Internals(std::shared_ptr<const RoughnessSurface> surface, const SolverOptions& options,
    const SolverChoice& choice)
    : Surface(std::move(surface))
    , Options(options)
    , Choice(choice)
  {
  }

  void Prescribe(PrescribedUnknowns prescribed, double smoothness, const ExecutionContext& context);
  Vector<double> RightHandSide(const Vector<double>& values, const ExecutionContext& context) const;
  /// \param all in the caller's order, or empty.
  Vector<double> InOrder(const Vector<double>& all, const ExecutionContext& context) const;
  Vector<double> InCallersOrder(const Vector<double>& x, const ExecutionContext& context) const;

  const std::shared_ptr<const RoughnessSurface> Surface;
  const SolverOptions Options;
  const SolverChoice Choice;
  PrescribedUnknowns Prescribed;
  std::vector<int> Places; ///< of those
  double Smoothness = 1.0;
  std::vector<int> Held; ///< unknowns that are not free, ascending
  std::unique_ptr<RoughnessOperator> A;
  std::unique_ptr<RoughnessCycle> Cycle;
  std::unique_ptr<Preconditioner<double>> Factor; ///< as soon as cycles have not converged
  std::optional<DeflatedPreconditioner> Deflated;
  SolveReport Report;
  std::vector<std::string> SystemWarnings;

  /// Conjugate gradients with a factor instead of cycles, which have not converged. Where that fails, all stays as
  /// it was.
  /// \param x in and out.
  void SolveByFactor(const LinearOperator<double>& A, const Vector<double>& b,
    const StoppingCriteria& stop, const ConvergenceMeasure<double>& measure, Vector<double>& x,
    const ExecutionContext& context);

private:
  /// Infinite where an unknown is held.
  Vector<double> DiagonalOfPrescribed(const ExecutionContext& context);
  void Deflate(const Vector<double>& D, const ExecutionContext& context);
};

void RoughnessProblem::Internals::Prescribe(
  PrescribedUnknowns prescribed, double smoothness, const ExecutionContext& context)
{
  const auto start = std::chrono::steady_clock::now();
  const RoughnessHierarchy& hierarchy = *this->Surface->Hierarchy;
  this->Smoothness = prescribed.Kind == ConstraintKind::Hard ? 1.0 : smoothness;
  this->Prescribed = std::move(prescribed);
  this->Places = PlacesOf(this->Prescribed.Unknowns, hierarchy.Order, context);
  const Vector<double> D = this->DiagonalOfPrescribed(context);
  context.Checkpoint(0.1);

  this->Factor.reset();
  this->Deflated.reset();
  if (!this->A)
  {
    this->A = hierarchy.Operator();
  }
  this->A->SetDiagonal(D, context);
  if (this->Cycle)
  {
    this->Cycle->Update(D, PartOfContext(context, 0.1, 0.9));
  }
  else
  {
    this->Cycle =
      hierarchy.Cycle(D, OptionsOfCycle(this->Options), PartOfContext(context, 0.1, 0.9));
  }
  this->Report.Levels = this->Cycle->Levels();
  this->Report.Bytes = hierarchy.Bytes() + this->Cycle->Bytes() +
    this->Surface->Kernel.size() * static_cast<long long>(sizeof(double));
  this->Deflate(D, context);
  this->Report.Solver =
    NameOf(this->Choice.Kind) + " on " + this->Surface->Name + this->Choice.Reason + this->Surface->KernelNote;
  this->Report.Warnings = this->SystemWarnings;
  this->Report.PrepareSeconds =
    std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  context.Checkpoint(1.0);
}

Vector<double> RoughnessProblem::Internals::DiagonalOfPrescribed(const ExecutionContext& context)
{
  const RoughnessHierarchy& hierarchy = *this->Surface->Hierarchy;
  const bool isHard = this->Prescribed.Kind == ConstraintKind::Hard;
  const int size = hierarchy.NumberOfUnknowns();
  Vector<double> D = Vector<double>::Zero(size);
  std::vector<char> isReached(hierarchy.Components.empty() ? 1 : size, 0); // by component
  for (std::size_t k = 0; k < this->Places.size(); ++k)
  {
    const int place = this->Places[k];
    D[place] = isHard ? Infinity : this->Prescribed.Alignment[k] / this->Smoothness;
    isReached[hierarchy.ComponentOf(place)] |= D[place] > 0.0;
  }
  const std::vector<int> unreached = Choose(
    size, [&](int i) { return !isReached[hierarchy.ComponentOf(i)]; }, context);
  D(unreached).setConstant(Infinity); // zero, the least of equal minimisers
  this->Held = Choose(size, [&D](int i) { return !std::isfinite(D[i]); }, context);
  this->SystemWarnings.clear();
  if (const std::string warning =
        WarningAboutUnreached(static_cast<int>(unreached.size()), size);
      !warning.empty())
  {
    this->SystemWarnings.push_back(warning);
  }
  return D;
}

Vector<double> RoughnessProblem::Internals::InOrder(
  const Vector<double>& all, const ExecutionContext& context) const
{
  const std::vector<int>& order = this->Surface->Hierarchy->Order;
  Vector<double> x(all.size());
  context.ParallelFor(0, static_cast<int>(all.size()), Grain, [&](int first, int last) {
    for (int k = first; k < last; ++k)
    {
      x[k] = all[order[k]];
    }
  });
  return x;
}

Vector<double> RoughnessProblem::Internals::InCallersOrder(
  const Vector<double>& x, const ExecutionContext& context) const
{
  const std::vector<int>& order = this->Surface->Hierarchy->Order;
  Vector<double> all(x.size());
  context.ParallelFor(0, static_cast<int>(x.size()), Grain, [&](int first, int last) {
    for (int k = first; k < last; ++k)
    {
      all[order[k]] = x[k];
    }
  });
  return all;
}

void RoughnessProblem::Internals::Deflate(const Vector<double>& D, const ExecutionContext& context)
{
  if (this->Surface->Kernel.cols() == 0)
  {
    return;
  }
  Eigen::MatrixXd kernel = UnderPulls(this->Surface->Kernel, *this->Surface->Hierarchy, D, context);
  const double largest = LargestEnergy(kernel, *this->Surface->Hierarchy, D, context);
  this->Deflated.emplace(*this->Cycle, *this->A, std::move(kernel), largest, context);
  this->Report.Bytes += this->Deflated->Bytes();
  if (const std::string warning = WarningAboutUndetermined(
        this->Deflated->SizeOfKernel(), static_cast<int>(this->Surface->Kernel.cols()));
      !warning.empty())
  {
    this->SystemWarnings.push_back(warning);
  }
}

Vector<double> RoughnessProblem::Internals::RightHandSide(
  const Vector<double>& values, const ExecutionContext& context) const
{
  const bool isHard = this->Prescribed.Kind == ConstraintKind::Hard;
  const int size = this->Surface->Hierarchy->NumberOfUnknowns();
  Vector<double> b = Vector<double>::Zero(size);
  for (std::size_t k = 0; k < this->Places.size(); ++k)
  {
    const double weight = isHard ? 1.0 : this->Prescribed.Alignment[k] / this->Smoothness;
    b[this->Places[k]] = weight * values[k];
  }
  if (isHard)
  {
    // - R_fb y, as D is zero on what is free
    Vector<double> pull;
    this->A->Apply(b, pull, context);
    b = -pull;
  }
  SetZero(b, this->Held, context);
  return b;
}

void RoughnessProblem::Internals::SolveByFactor(const LinearOperator<double>& A,
  const Vector<double>& b, const StoppingCriteria& stop, const ConvergenceMeasure<double>& measure,
  Vector<double>& x, const ExecutionContext& context)
{
  try
  {
    if (!this->Factor)
    {
      const Vector<double> D = this->DiagonalOfPrescribed(context);
      this->Factor = this->Surface->Hierarchy->Factor(D, context);
    }
  }
  catch (const SolverFailure&)
  {
    return;
  }
  this->Report.Warnings = this->SystemWarnings;
  ConjugateGradient<double>(A, *this->Factor, b, stop, x, this->Report, context, &measure);
  this->Report.Warnings.push_back(
    "Cycles did not converge, so conjugate gradients with a factor of the system took over.");
}

RoughnessProblem::RoughnessProblem(std::shared_ptr<const RoughnessSurface> surface,
  PrescribedUnknowns prescribed, double smoothness, const SolverOptions& options,
  const SolverChoice& choice, const ExecutionContext& context)
  : Internal(std::make_unique<Internals>(std::move(surface), options, choice))
{
  this->Internal->Prescribe(std::move(prescribed), smoothness, context);
  GiveBackFreedMemory(); // once; the vectors of a solve are large
}

RoughnessProblem::~RoughnessProblem() = default;

RoughnessProblem::RoughnessProblem(RoughnessProblem&&) noexcept = default;

void RoughnessProblem::Update(
  PrescribedUnknowns prescribed, double smoothness, const ExecutionContext& context)
{
  this->Internal->Prescribe(std::move(prescribed), smoothness, context);
}

int RoughnessProblem::NumberOfFree() const
{
  return this->Internal->Surface->Hierarchy->NumberOfUnknowns() -
    static_cast<int>(this->Internal->Held.size());
}

const RoughnessSurface& RoughnessProblem::Surface() const
{
  return *this->Internal->Surface;
}

const SolveReport& RoughnessProblem::Report() const
{
  return this->Internal->Report;
}

Vector<double> RoughnessProblem::Solve(const Vector<double>& values,
  const Vector<double>& start, const Vector<double>& reference, const StoppingCriteria& stop,
  const ExecutionContext& context)
{
  Internals& of = *this->Internal;
  assert(values.size() == static_cast<Eigen::Index>(of.Prescribed.Unknowns.size()));
  of.Report.Warnings = of.SystemWarnings;
  Vector<double> b = of.RightHandSide(values, context);
  Vector<double> x = of.InOrder(start, context);
  ConvergenceMeasure<double> measure;
  measure.Mass = &of.Surface->Mass;
  measure.Reference = of.InOrder(reference, context);
  measure.EnergyScale = of.Smoothness;
  for (Vector<double>* const vector : { &x, &measure.Reference })
  {
    if (vector->size() > 0)
    {
      SetZero(*vector, of.Held, context);
    }
  }
  const LinearOperator<double>* A = &*of.A;
  Preconditioner<double>* cycle = &*of.Cycle;
  std::optional<OutsideKernel> outside;
  if (of.Deflated)
  {
    cycle = &*of.Deflated;
    A = &outside.emplace(*of.A, *of.Deflated);
    of.Deflated->RemoveKernel(b, context);
    if (x.size() > 0)
    {
      of.Deflated->RemoveKernel(x, context);
    }
  }
  const auto solve = of.Choice.Kind == SolverKind::VCycles ? &StationaryIteration<double>
                                                            : &ConjugateGradient<double>;
  if (!of.Factor)
  {
    solve(*A, *cycle, b, stop, x, of.Report, context, &measure);
  }
  if (of.Factor || (!of.Report.Converged && of.Choice.Kind == SolverKind::ConjugateGradients))
  {
    of.SolveByFactor(*A, b, stop, measure, x, context);
  }
  if (of.Prescribed.Kind == ConstraintKind::Hard)
  {
    for (std::size_t k = 0; k < of.Prescribed.Unknowns.size(); ++k)
    {
      x[of.Places[k]] = values[k];
    }
  }
  return of.InCallersOrder(x, context);
}

}
