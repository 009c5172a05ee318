#include "Solvers/Multigrid/NestedIteration.h"

#include "Solvers/Krylov/ConjugateGradient.h"
#include "Support/Errors.h"
#include "Support/SparseKernels.h"

#include <chrono>
#include <cmath>
#include <limits>
#include <optional>
#include <string>

namespace dmg
{
namespace
{

using Clock = std::chrono::steady_clock;

/// The matrix of a level, whose diagonal is one.
template <class Scalar>
class LevelOperator : public LinearOperator<Scalar>
{
public:
  explicit LevelOperator(const TriangularParts<Scalar>& matrix)
    : A(matrix)
  {
  }

  int Size() const override { return static_cast<int>(this->A.Lower.rows()); }

  double Apply(const Vector<Scalar>& x, Vector<Scalar>& y, const ExecutionContext& context) const override
  {
    y.resize(x.size());
    return SumOverBlocks<double>(this->Size(), context,
      [this, &x, &y](int first, int last)
      {
        for (int i = first; i < last; ++i)
        {
          y[i] = x[i] + RowTimes(this->A.Lower, i, x.data()) + RowTimes(this->A.Upper, i, x.data());
        }
        const int count = last - first;
        return Eigen::numext::real(x.segment(first, count).dot(y.segment(first, count)));
      });
  }

private:
  const TriangularParts<Scalar>& A;
};

/// The V-cycle from a level down. It overwrites b and x of these levels.
template <class Scalar>
class LevelCycle : public Preconditioner<Scalar>
{
public:
  LevelCycle(LevelStack<Scalar, Scalar>& levels, int level)
    : Levels(levels)
    , Level(level)
  {
  }

  void Apply(const Vector<Scalar>& r, Vector<Scalar>& z, const ExecutionContext& context) override
  {
    this->Levels[this->Level].b = r;
    this->Levels.Cycle(this->Level, context);
    z = this->Levels[this->Level].x;
  }

private:
  LevelStack<Scalar, Scalar>& Levels;
  const int Level;
};

}

/// One solve: the clock, the history, and the work on each level.
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

  /// Conjugate gradients on this level, as far as rounding allows.
  void Cycle(int level)
  {
    if (this->Options.Cycles > 0)
    {
      auto& levelOf = this->Nested.Stack[level];
      const Vector<Scalar> rightHandSide = levelOf.b;
      Vector<Scalar> solution = levelOf.x;
      LevelCycle<Scalar> cycle(this->Nested.Stack, level);
      SolveReport ofLevel;
      ConjugateGradient<Scalar>(LevelOperator<Scalar>(levelOf.A), cycle, rightHandSide,
        { std::numeric_limits<double>::epsilon(), this->Options.Cycles }, solution, ofLevel,
        this->PartOf(level, 0.0, 0.5));
      levelOf.x = solution;
      levelOf.b = rightHandSide;
    }
  }

  /// \return the number of sweeps.
  int Sweep(int level)
  {
    const PartOfContext context = this->PartOf(level, this->Options.Cycles > 0 ? 0.5 : 0.0, 1.0);
    const bool isCompared = this->Measure && this->Measure->LeastImprovement > 0.0;
    double former = isCompared ? this->Error(level) : 0.0;
    for (int sweep = 1; sweep <= this->Options.Sweeps; ++sweep)
    {
      context.Checkpoint((sweep - 1.0) / this->Options.Sweeps);
      this->Nested.Stack.Sweep(level, this->Context);
      if (level == 0)
      {
        this->Observe(level);
      }
      if (isCompared)
      {
        const double now = this->Error(level);
        if (!(now <= (1.0 - this->Measure->LeastImprovement) * former && now < former))
        {
          return sweep;
        }
        former = now;
      }
    }
    return this->Options.Sweeps;
  }

  void End()
  {
    this->Nested.Stack.Store(this->x, this->Context);
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
    if (this->Options.Sweeps < 0 || this->Options.Cycles < 0)
    {
      throw InvalidInput("the numbers of smoothing sweeps and of cycles must not be negative");
    }
    if (this->Measure)
    {
      this->Measure->Check(static_cast<int>(this->b.size()));
    }
    const double norm = std::sqrt(SquaredNorm(this->b, this->Context));
    if (!std::isfinite(norm))
    {
      throw InvalidInput("the right-hand side holds numbers that are not finite; "
                         "check the prescribed values");
    }
    return norm;
  }

  /// A share of the progress of this level.
  PartOfContext PartOf(int level, double begin, double end) const
  {
    const int coarsest = this->Nested.Stack.NumberOfLevels() - 1;
    const double done = coarsest - level - 1.0;
    return PartOfContext(this->Context, (done + begin) / coarsest, (done + end) / coarsest);
  }

  /// The error of the iterate on this level, prolonged to the finest one. It does not count in the time.
  double Error(int level)
  {
    const Clock::time_point begin = Clock::now();
    this->BringToFinest(level);
    const double error = this->Measure->Error(this->x, this->Context);
    this->Start += Clock::now() - begin;
    return error;
  }

  /// Iterates of finer levels are free until the iterations get there.
  void BringToFinest(int level)
  {
    this->Nested.Stack.ProlongToFinest(level, this->Context);
    this->Nested.Stack.Store(this->x, this->Context);
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
  , Stack(this->Hierarchy, options.MaySweep ? std::optional(SmootherOptions{ 1, 1 }) : std::nullopt, 1,
      PartOfContext(context, 0.7, 1.0))
{
  this->Hierarchy.ForgetMatrices();
  this->Hierarchy.ForgetProlongations();
}

template <class Scalar>
std::vector<int> NestedIteration<Scalar>::Solve(const Vector<Scalar>& b, const SweepOptions& sweeps, Vector<Scalar>& x,
  SolveReport& report, const ExecutionContext& context, const ConvergenceMeasure<Scalar>* measure)
{
  Run run(*this, b, sweeps, x, report, context, measure);
  const int coarsest = this->Stack.NumberOfLevels() - 1;
  context.Checkpoint(0.0);
  this->Stack.Load(b, context);
  for (int level = 0; level < coarsest; ++level)
  {
    this->Stack.Restrict(level, this->Stack[level].b, context);
  }
  this->Stack.SolveCoarsest();
  run.Observe(coarsest);

  std::vector<int> numbers(coarsest + 1, 0);
  for (int level = coarsest; level-- > 0;)
  {
    this->Stack.Prolong(level, context);
    if (this->MaySweep)
    {
      run.Cycle(level);
      if (level == 0 && sweeps.Cycles > 0)
      {
        run.Observe(level);
      }
      numbers[level] = run.Sweep(level);
      if (level > 0 && sweeps.Cycles + sweeps.Sweeps > 0)
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
