#include "Solvers/HarmonicProblem.h"

#include "Solvers/HarmonicFieldsOfSystem.h"
#include "Solvers/Krylov/ConjugateGradient.h"
#include "Solvers/Krylov/DeflatedPreconditioner.h"
#include "Solvers/PrescribedSystem.h"
#include "Support/AllIndices.h"
#include "Support/Errors.h"
#include "Support/FreedMemory.h"
#include "Support/Permutations.h"
#include "Support/SparseKernels.h"

#include <algorithm>
#include <cassert>
#include <chrono>
#include <cmath>
#include <optional>
#include <utility>

namespace dmg
{
namespace
{

// A lower limit means a time budget: do not fall back to a factor.
constexpr int FewestIterationsBeforeFactor = 100;

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

/// The solver on top of the equations; all vectors are in the order of the hierarchy.
class HarmonicProblem::Internals
{
public:
  Internals(std::shared_ptr<const MultigridSetup> setup, const SolverOptions& options, const SolverChoice& choice)
    : System(std::move(setup))
    , Options(options)
    , Method(*choice.Method)
    , Reason(choice.Reason)
  {
  }

  void Prescribe(Penalties prescribed, double smoothness, const ExecutionContext& context);
  /// Solves for the difference of x from \p held, and adds it to \p held.
  /// \param b of all. \param x a start, or empty.
  void SolveWithPrescriptions(const Vector<double>& b, const Vector<double>& held, const ReferenceSolution& reference,
    const StoppingCriteria& stop, Vector<double>& x, const ExecutionContext& context);
  /// Finds the smoothest fields on the components without prescriptions.
  void FindSmoothest(const StoppingCriteria& stop, Vector<double>& x, const ExecutionContext& context);

  PrescribedSystem System;
  const SolverOptions Options;
  const SolverMethod& Method;
  const std::string Reason; ///< why it is this
  SolveReport Report;
  std::vector<std::string> SystemWarnings;

  bool HoldsEverything() const
  {
    return static_cast<int>(this->System.Held().size()) == this->System.Setup().Hierarchy->NumberOfUnknowns();
  }
  /// The solution where hard constraints hold everything, without a solve.
  Vector<double> HeldSolution(const Vector<double>& values, const ExecutionContext& context);

private:
  void MakePreconditioner(const Vector<double>& D, const ExecutionContext& context);
  void MakeApproximation(const Vector<double>& D, const ExecutionContext& context);
  void Deflate(const Vector<double>& D, const ExecutionContext& context);
  void FindUndetermined(const Vector<double>& D, const ExecutionContext& context);
  void WarnOfUndetermined(int number);
  /// Solves by a factor, V-cycles or conjugate gradients.
  void Iterate(Vector<double>& b, const StoppingCriteria& stop, const ConvergenceMeasure<double>& measure,
    Vector<double>& x, const ExecutionContext& context);
  /// Continues by conjugate gradients with a factor from the last iterate of the cycles, which have not converged. If the
  /// factorisation fails, all stays as it was.
  void IterateWithFactor(const LinearOperator<double>& matrix, const Vector<double>& b, const StoppingCriteria& stop,
    const ConvergenceMeasure<double>& measure, Vector<double>& x, const ExecutionContext& context);

  std::unique_ptr<StiffnessCycle> Inverse;                 ///< the preconditioner
  std::optional<DeflatedPreconditioner> Deflated;          ///< the cycle or factor, where there are harmonic fields
  std::unique_ptr<Preconditioner<double>> Factor;          ///< as soon as cycles have stagnated
  std::unique_ptr<StiffnessNestedIteration> Approximation; ///< in place of an iteration
};

void HarmonicProblem::Internals::Prescribe(Penalties prescribed, double smoothness, const ExecutionContext& context)
{
  const auto start = std::chrono::steady_clock::now();
  this->Factor.reset();
  this->Deflated.reset();
  this->System.Prescribe(std::move(prescribed), smoothness, context);
  this->SystemWarnings = this->System.Warnings();
  if (this->HoldsEverything())
  {
    this->Report = {};
    this->Report.Solver = "none, as hard constraints hold everything";
    this->Report.Warnings = this->SystemWarnings;
    return;
  }
  const Vector<double> D = this->System.Diagonal();
  context.Checkpoint(0.1);
  const PartOfContext most(context, 0.1, 0.9);
  if (this->Method.IsApproximation())
  {
    this->FindUndetermined(D, context);
    this->MakeApproximation(D, most);
    if (!this->System.Unprescribed().Unknowns().empty())
    {
      this->MakePreconditioner(D, most);
    }
  }
  else
  {
    this->MakePreconditioner(D, most);
    this->Deflate(D, context);
  }
  this->Report.Solver = this->Method.Name + (this->Method.NeedsLevels ? " on " + this->System.Setup().Name : "") +
    this->Reason + this->System.Setup().KernelNote;
  this->Report.Warnings = this->SystemWarnings;
  this->Report.PrepareSeconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  context.Checkpoint(1.0);
}

void HarmonicProblem::Internals::MakePreconditioner(const Vector<double>& D, const ExecutionContext& context)
{
  if (this->Inverse)
  {
    this->Inverse->Update(D, context);
  }
  else
  {
    this->Inverse = this->Method.MakePreconditioner(this->System.Setup(), D, this->Options, context);
  }
  this->Report.Levels = this->Inverse->Levels();
  this->Report.Bytes = this->System.Setup().Bytes() + this->Inverse->Bytes();
}

void HarmonicProblem::Internals::MakeApproximation(const Vector<double>& D, const ExecutionContext& context)
{
  this->Approximation.reset(); // makes room
  this->Approximation = this->Method.MakeApproximation(this->System.Setup(), D, this->Options, context);
  this->Report.Levels = this->Approximation->Levels();
  this->Report.Bytes = this->System.Setup().Bytes() + this->Approximation->Bytes();
}

void HarmonicProblem::Internals::Deflate(const Vector<double>& D, const ExecutionContext& context)
{
  if (this->System.Setup().Kernel.cols() == 0)
  {
    return;
  }
  Eigen::MatrixXd kernel =
    AdjustKernelToPenalties(this->System.Setup().Kernel, *this->System.Setup().Hierarchy, D, context);
  const double largest = LargestEnergy(kernel, *this->System.Setup().Hierarchy, D, context);
  this->Deflated.emplace(*this->Inverse, this->System.Matrix(), std::move(kernel), largest, context);
  this->Report.Bytes += this->Deflated->Bytes();
  this->WarnOfUndetermined(this->Deflated->Kernel().Size());
}

void HarmonicProblem::Internals::FindUndetermined(const Vector<double>& D, const ExecutionContext& context)
{
  const MultigridSetup& setup = this->System.Setup();
  if (setup.Kernel.cols() == 0)
  {
    return;
  }
  const Eigen::MatrixXd undetermined =
    UndeterminedFields(AdjustKernelToPenalties(setup.Kernel, *setup.Hierarchy, D, context), this->System.Matrix(),
      *setup.Hierarchy, D, this->System.Held(), context);
  this->WarnOfUndetermined(static_cast<int>(undetermined.cols()));
}

void HarmonicProblem::Internals::WarnOfUndetermined(int number)
{
  if (const std::string warning =
        WarningAboutUndetermined(number, static_cast<int>(this->System.Setup().Kernel.cols()));
      !warning.empty())
  {
    this->SystemWarnings.push_back(warning);
  }
}

void HarmonicProblem::Internals::SolveWithPrescriptions(const Vector<double>& b, const Vector<double>& held,
  const ReferenceSolution& reference, const StoppingCriteria& stop, Vector<double>& x, const ExecutionContext& context)
{
  Vector<double> difference; // b - A held
  this->System.Matrix().Apply(held, difference, context);
  difference = b - difference;
  SetZero(difference, this->System.Held(), context);
  ConvergenceMeasure<double> measure;
  measure.Mass = &this->System.Setup().Mass;
  measure.EnergyScale = this->System.Smoothness();
  measure.Offset = &held;
  measure.RightHandSide = &b;
  measure.Reference = reference.Unknowns;
  measure.LeastImprovement = reference.LeastImprovement;
  if (x.size() > 0)
  {
    x -= held;
  }
  if (this->Approximation)
  {
    this->Approximation->Solve(
      difference, this->Method.HasSweeps ? this->Options.Nested : SweepOptions(), x, this->Report, context, measure);
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

void HarmonicProblem::Internals::Iterate(Vector<double>& b, const StoppingCriteria& stop,
  const ConvergenceMeasure<double>& measure, Vector<double>& x, const ExecutionContext& context)
{
  Preconditioner<double>* inverse = this->Inverse.get();
  const LinearOperator<double>* matrix = &this->System.Matrix();
  std::optional<OperatorOutsideKernel> outside;
  if (this->Deflated)
  {
    const KernelProjection& kernel = this->Deflated->Kernel();
    inverse = &*this->Deflated;
    matrix = &outside.emplace(this->System.Matrix(), kernel);
    kernel.Remove(b, context);
    if (x.size() > 0)
    {
      kernel.Remove(x, context);
    }
  }
  if (!this->Factor)
  {
    StoppingCriteria stopOfSolve = stop;
    stopOfSolve.MayEstimate = !this->Method.IsDirect; // one more cycle is a quarter of a usual solve
    this->Method.Iterate(*matrix, *inverse, b, stopOfSolve, x, this->Report, context, &measure);
  }
  const bool haveStagnated = this->Method.HasFallback && !this->Report.Converged && !this->Report.EndedByRounding &&
    stop.MaximumIterations >= FewestIterationsBeforeFactor;
  if (this->Factor || haveStagnated)
  {
    this->IterateWithFactor(*matrix, b, stop, measure, x, context);
  }
}

void HarmonicProblem::Internals::IterateWithFactor(const LinearOperator<double>& matrix, const Vector<double>& b,
  const StoppingCriteria& stop, const ConvergenceMeasure<double>& measure, Vector<double>& x,
  const ExecutionContext& context)
{
  try
  {
    if (!this->Factor)
    {
      this->Factor = this->System.Setup().Hierarchy->Factor(this->System.Diagonal(), context);
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

void HarmonicProblem::Internals::FindSmoothest(
  const StoppingCriteria& stop, Vector<double>& x, const ExecutionContext& context)
{
  const bool isAll = this->System.NumberOfPrescribed() == 0;
  if (isAll)
  {
    this->Report.SolveSeconds = 0.0;
    this->Report.Converged = true;
  }
  const Eigen::MatrixXd& kernel = this->System.Setup().Kernel;
  // Nothing is smoother than a harmonic field. The choice among several smoothest fields does not depend on former solves.
  Vector<double> start = kernel.cols() > 0 ? Vector<double>(kernel.rowwise().sum())
                                           : this->System.Unprescribed().StartFrom(*this->Inverse, context);
  Preconditioner<double>* inverse = this->Inverse.get();
  if (this->Deflated)
  {
    inverse = &*this->Deflated;
  }
  std::vector<IterationReport> iterations = this->System.Unprescribed().FindSmoothest(
    this->System.Matrix(), *inverse, std::move(start), stop, x, this->Report, context);
  if (isAll)
  {
    this->Report.Iterations = std::move(iterations);
    this->Report.Returned = this->Report.Iterations.back().Iteration;
  }
}

Vector<double> HarmonicProblem::Internals::HeldSolution(const Vector<double>& values, const ExecutionContext& context)
{
  const StiffnessHierarchy& hierarchy = *this->System.Setup().Hierarchy;
  Vector<double> x = Vector<double>::Zero(hierarchy.NumberOfUnknowns());
  this->System.InsertHeld(values, x);
  const auto R = hierarchy.Operator();
  R->SetDiagonal(Vector<double>::Zero(x.size()), context);
  Vector<double> Rx;
  R->Apply(x, Rx, context);
  IterationReport only;
  only.Energy = x.dot(Rx);
  only.MassResidual = 0.0;
  this->Report.Iterations = { only };
  this->Report.Returned = 0;
  this->Report.Converged = true;
  this->Report.EndedByRounding = false;
  this->Report.SolveSeconds = 0.0;
  return Scattered(x, hierarchy.Order, context);
}

HarmonicProblem::HarmonicProblem(std::shared_ptr<const MultigridSetup> setup, Penalties prescribed, double smoothness,
  const SolverOptions& options, const SolverChoice& choice, const ExecutionContext& context)
  : Internal(std::make_unique<Internals>(std::move(setup), options, choice))
{
  this->Internal->Prescribe(std::move(prescribed), smoothness, context);
  GiveBackFreedMemory(); // once; the vectors of a solve are large
}

HarmonicProblem::~HarmonicProblem() = default;

HarmonicProblem::HarmonicProblem(HarmonicProblem&&) noexcept = default;

void HarmonicProblem::Update(Penalties prescribed, double smoothness, const ExecutionContext& context)
{
  this->Internal->Prescribe(std::move(prescribed), smoothness, context);
}

LinearSystem HarmonicProblem::Equations(
  const Vector<double>& values, const ExecutionContext& context, const Vector<double>& source) const
{
  assert(values.size() == this->Internal->System.NumberOfPrescribed());
  return this->Internal->System.Equations(values, context, source);
}

const MultigridSetup& HarmonicProblem::Setup() const
{
  return this->Internal->System.Setup();
}

const SolveReport& HarmonicProblem::Report() const
{
  return this->Internal->Report;
}

Vector<double> HarmonicProblem::Solve(const Vector<double>& values, const Vector<double>& start,
  const ReferenceSolution& reference, const StoppingCriteria& stop, const ExecutionContext& context,
  const Vector<double>& source)
{
  Internals& of = *this->Internal;
  assert(values.size() == of.System.NumberOfPrescribed());
  of.Report.Warnings = of.SystemWarnings;
  of.Report.Eigenvalues.clear();
  if (of.HoldsEverything())
  {
    return of.HeldSolution(values, context);
  }
  const std::vector<int>& order = of.System.Setup().Hierarchy->Order;
  const std::vector<int>& unprescribed = of.System.Unprescribed().Unknowns();
  const auto inOrder = [&](const Vector<double>& vector)
  {
    Vector<double> gathered = Gathered(vector, order, context);
    if (gathered.size() > 0)
    {
      SetZero(gathered, of.System.Held(), context);
      SetZero(gathered, unprescribed, context);
    }
    return gathered;
  };
  Vector<double> b = of.System.RightHandSide(values, context);
  if (source.size() > 0)
  {
    b += inOrder(source) / of.System.Smoothness();
  }
  Vector<double> x = Vector<double>::Zero(order.size());
  if (of.System.NumberOfPrescribed() > 0)
  {
    // A factor needs no start: what it would improve is found at once.
    x = of.Method.IsDirect ? Vector<double>() : inOrder(start);
    of.SolveWithPrescriptions(b, of.System.HeldByPenalties(values),
      { inOrder(reference.Unknowns), reference.LeastImprovement }, stop, x, context);
  }
  if (!unprescribed.empty())
  {
    of.FindSmoothest(stop, x, context);
  }
  of.System.InsertHeld(values, x);
  return Scattered(x, order, context);
}

}
