#include "Solvers/Multigrid/NestedIteration.h"

#include "Solvers/Multigrid/VCycle.h"
#include "Support/Errors.h"
#include "Support/SparseKernels.h"

#include <chrono>
#include <cmath>
#include <string>

namespace dmg
{
namespace
{

using Clock = std::chrono::steady_clock;

/// b - A x.
template <class Value>
Vector<Value> Residual(
  const TriangularParts<Value>& A, const Vector<Value>& b, const Vector<Value>& x, const ExecutionContext& context)
{
  constexpr int Grain = 4096;
  Vector<Value> r(b.size());
  context.ParallelFor(0, static_cast<int>(b.size()), Grain,
    [&](int first, int last)
    {
      for (int i = first; i < last; ++i)
      {
        r[i] = b[i] - x[i] - RowTimes(A.Lower, i, x.data()) - RowTimes(A.Upper, i, x.data());
      }
    });
  return r;
}

}

/// One solve: the clock, the history, and the rule that ends a level.
template <class Scalar>
class NestedIteration<Scalar>::Run
{
public:
  Run(NestedIteration& nested, const Vector<Scalar>& rightHandSide, const SweepOptions& options,
    Vector<Scalar>& iterate, SolveReport& report, const ExecutionContext& context,
    const ConvergenceMeasure<Scalar>* measure)
    : Nested(nested)
    , b(rightHandSide)
    , Options(options)
    , x(iterate)
    , Report(report)
    , Context(context)
    , Measure(measure)
    , NormOfB(this->CheckedNorm())
  {
    this->Report.Iterations.clear();
    this->Report.Converged = true;
    this->x.setZero(this->b.size());
    this->AppendRow(0, 0.0);
    this->Start = Clock::now();
  }

  /// Records the measures of the iterate on this level, if a measure asks for it.
  void Observe(int level)
  {
    if (this->Measure)
    {
      const Clock::time_point begin = Clock::now();
      const double seconds = this->SecondsAt(begin); // bringing it to the finest level is measuring, too
      this->BringToFinest(level);
      this->AppendRow(level, seconds);
      this->Start += Clock::now() - begin;
    }
  }

  /// Conjugate gradients on this level, a V-cycle down from it as preconditioner.
  void Cycle(int level)
  {
    auto& levelOf = this->Nested.Scaled[level];
    const int coarsest = this->Nested.Scaled.NumberOfLevels() - 1;
    Vector<Scalar> solution = levelOf.x;
    Vector<Scalar> residual = Residual(levelOf.A, levelOf.b, solution, this->Context);
    Vector<Scalar> direction = Vector<Scalar>::Zero(solution.size());
    const Vector<Scalar> zero = direction;
    const Vector<Scalar> rightHandSide = levelOf.b;
    double former = 0.0;
    for (int cycle = 0; cycle < this->Options.Cycles; ++cycle)
    {
      this->Context.Checkpoint((coarsest - level - 1.0) / coarsest);
      levelOf.b = residual;
      VCycle(this->Nested.Scaled, this->Nested.Smoothers, level, this->Context);
      const double product = Eigen::numext::real(Dot(residual, levelOf.x, this->Context));
      direction = levelOf.x + (former > 0.0 ? product / former : 0.0) * direction;
      former = product;
      const Vector<Scalar> image = -Residual(levelOf.A, zero, direction, this->Context);
      const double energy = Eigen::numext::real(Dot(direction, image, this->Context));
      if (!(product > 0.0 && energy > 0.0))
      {
        break; // solved
      }
      solution += (product / energy) * direction;
      residual -= (product / energy) * image;
      levelOf.x = solution;
      if (level == 0)
      {
        this->Observe(level);
      }
    }
    levelOf.x = solution;
    levelOf.b = rightHandSide;
  }

  /// \return the number of sweeps.
  int Sweep(int level)
  {
    auto& levelOf = this->Nested.Scaled[level];
    const int coarsest = this->Nested.Scaled.NumberOfLevels() - 1;
    const int limit = this->Options.Limit();
    double former = this->StoppingQuantity(level);
    for (int sweep = 1; sweep <= limit; ++sweep)
    {
      this->Context.Checkpoint((coarsest - level - 1 + (sweep - 1.0) / limit) / coarsest);
      this->Nested.Smoothers[level]->PostSmooth(levelOf.b, levelOf.x, this->Context);
      if (level == 0)
      {
        this->Observe(level);
      }
      const double now = this->StoppingQuantity(level);
      if (this->Options.Rule != SweepRule::FixedNumber &&
        !(now <= (1.0 - this->Options.LeastImprovement) * former && now < former))
      {
        return sweep;
      }
      former = now;
    }
    if (this->Options.Rule != SweepRule::FixedNumber)
    {
      this->Report.Converged = false;
      this->Report.Warnings.push_back(
        "The sweeps on level " + std::to_string(level) + " ended at their limit of " + std::to_string(limit) + ".");
    }
    return limit;
  }

  void End()
  {
    this->Nested.Scaled.Store(this->x, this->Context);
    const double seconds = this->SecondsAt(Clock::now());
    if (!this->Measure)
    {
      this->AppendRow(0, seconds);
    }
    this->Report.Iterations.back().Seconds = seconds;
    this->Report.SolveSeconds = seconds;
  }

private:
  double CheckedNorm() const
  {
    if (this->b.size() != this->Nested.A->rows())
    {
      throw InvalidInput(
        "the right-hand side must have " + std::to_string(this->Nested.A->rows()) + " values, one per unknown");
    }
    if (this->Options.Sweeps < 0 || this->Options.MaximumSweeps < 0 || this->Options.Cycles < 0)
    {
      throw InvalidInput("the numbers of smoothing sweeps and of cycles must not be negative");
    }
    if (this->Measure)
    {
      this->Measure->Check(static_cast<int>(this->b.size()));
    }
    if (this->Options.Rule == SweepRule::WhileErrorFalls && (!this->Measure || this->Measure->Reference.size() == 0))
    {
      throw InvalidInput("sweeps while the error falls need a reference solution");
    }
    const double norm = std::sqrt(SquaredNorm(this->b, this->Context));
    if (!std::isfinite(norm))
    {
      throw InvalidInput("the right-hand side holds numbers that are not finite; "
                         "check the prescribed values");
    }
    return norm;
  }

  /// The quantity that must fall by each sweep: the error, the residual, or nothing.
  double StoppingQuantity(int level)
  {
    if (this->Options.Rule == SweepRule::WhileResidualFalls)
    {
      const auto& levelOf = this->Nested.Scaled[level];
      return std::sqrt(SquaredNorm(Residual(levelOf.A, levelOf.b, levelOf.x, this->Context), this->Context));
    }
    if (this->Options.Rule == SweepRule::WhileErrorFalls)
    {
      const Clock::time_point begin = Clock::now();
      this->BringToFinest(level);
      const double error = this->Measure->Error(this->x, this->Context);
      this->Start += Clock::now() - begin;
      return error;
    }
    return 0.0;
  }

  /// Iterates of finer levels are free until the iterations get there.
  void BringToFinest(int level)
  {
    this->Nested.Scaled.ProlongToFinest(level, this->Context);
    this->Nested.Scaled.Store(this->x, this->Context);
  }

  /// \pre x holds the iterate of this level.
  void AppendRow(int level, double seconds)
  {
    Multiply(*this->Nested.A, this->x, this->r, this->Context);
    this->r = this->b - this->r;
    const double norm = std::sqrt(SquaredNorm(this->r, this->Context));
    const int number = static_cast<int>(this->Report.Iterations.size());
    IterationReport row = { number, seconds, this->NormOfB > 0.0 ? norm / this->NormOfB : 0.0 };
    row.Level = level;
    if (this->Measure)
    {
      this->Measure->Fill(row, this->x, this->b, this->r, this->Context);
    }
    this->Report.Iterations.push_back(row);
  }

  double SecondsAt(Clock::time_point now) const
  {
    const std::chrono::duration<double> elapsed = now - this->Start;
    return elapsed.count();
  }

  NestedIteration& Nested;
  const Vector<Scalar>& b;
  const SweepOptions Options;
  Vector<Scalar>& x;
  SolveReport& Report;
  const ExecutionContext& Context;
  const ConvergenceMeasure<Scalar>* const Measure;
  const double NormOfB;
  Clock::time_point Start = Clock::now(); ///< later by what measuring has taken
  Vector<Scalar> r;
};

template <class Scalar>
NestedIteration<Scalar>::NestedIteration(const SparseMatrix<Scalar>& matrix,
  std::vector<SparseMatrix<Scalar>> prolongations, const NestedOptions& options, const ExecutionContext& context)
  : A(&matrix)
  , MaySweep(options.MaySweep)
  , Hierarchy(matrix, std::move(prolongations), options.Coarsening, PartOfContext(context, 0.0, 0.7))
  , Scaled(this->Hierarchy,
      options.MaySweep ? ScaledHierarchy<Scalar, Scalar>::Content::MatricesForSweeps
                       : ScaledHierarchy<Scalar, Scalar>::Content::Transfers,
      PartOfContext(context, 0.7, 1.0))
{
  this->Hierarchy.ForgetMatrices();
  this->Hierarchy.ForgetProlongations();
  SmootherOptions oneSweep;
  oneSweep.PreSweeps = 1;
  oneSweep.PostSweeps = 1;
  for (int level = 0; this->MaySweep && level + 1 < this->Scaled.NumberOfLevels(); ++level)
  {
    this->Smoothers.push_back(Smoother<Scalar>::New(this->Scaled[level].A, oneSweep));
  }
}

template <class Scalar>
std::vector<int> NestedIteration<Scalar>::Solve(const Vector<Scalar>& b, const SweepOptions& sweeps, Vector<Scalar>& x,
  SolveReport& report, const ExecutionContext& context, const ConvergenceMeasure<Scalar>* measure)
{
  Run run(*this, b, sweeps, x, report, context, measure);
  const int coarsest = this->Scaled.NumberOfLevels() - 1;
  context.Checkpoint(0.0);
  this->Scaled.Load(b, context);
  for (int level = 0; level < coarsest; ++level)
  {
    this->Scaled.Restrict(level, this->Scaled[level].b, context);
  }
  this->Scaled.SolveCoarsest();
  run.Observe(coarsest);

  std::vector<int> numbers(coarsest + 1, 0);
  for (int level = coarsest; level-- > 0;)
  {
    this->Scaled.Prolong(level, context);
    if (this->MaySweep)
    {
      run.Cycle(level);
      numbers[level] = run.Sweep(level);
      if (level > 0 && sweeps.Cycles + sweeps.Limit() > 0)
      {
        run.Observe(level);
      }
    }
  }
  run.End();
  context.Checkpoint(1.0);
  return numbers;
}

template class NestedIteration<double>;
template class NestedIteration<Complex>;

}
