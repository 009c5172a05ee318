#include "Solvers/Krylov/IterationMonitor.h"

#include "Support/Errors.h"
#include "Support/Remedy.h"
#include "Support/SparseKernels.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace dmg
{
namespace
{

/// Two digits are enough for a message.
std::string Rounded(double number)
{
  char text[32];
  std::snprintf(text, sizeof text, "%.1e", number);
  return text;
}

}

template <class Scalar>
IterationMonitor<Scalar>::IterationMonitor(const LinearOperator<Scalar>& matrix, Preconditioner<Scalar>& inverse,
  const Vector<Scalar>& rightHandSide, const StoppingCriteria& stop, Vector<Scalar>& iterate, SolveReport& report,
  const ExecutionContext& context, const ConvergenceMeasure<Scalar>* measure)
  : A(matrix)
  , B(inverse)
  , b(rightHandSide)
  , Stop(stop)
  , x(iterate)
  , Report(report)
  , Context(context)
  , AskedMeasure(measure)
  , Start(std::chrono::steady_clock::now())
  , InverseDiagonal(matrix.InverseDiagonal())
{
  if (this->b.size() != this->A.Size() || (this->x.size() != 0 && this->x.size() != this->b.size()))
  {
    throw InvalidInput(
      "the right-hand side and the start must have " + std::to_string(this->A.Size()) + " values, one per unknown");
  }
  if (measure)
  {
    measure->Check(static_cast<int>(this->b.size()));
  }
  this->NormOfB = std::sqrt(this->A.Sum(SquaredNorm(this->b, context)));
  if (!std::isfinite(this->NormOfB) || !std::isfinite(this->A.Sum(SquaredNorm(this->x, context))))
  {
    throw InvalidInput("the right-hand side or the start holds numbers that are not finite; "
                       "check the prescribed values");
  }
  this->Report.Iterations.clear();
  this->Report.Converged = false;
  this->Report.EndedByRounding = false;
  this->Report.SolveSeconds = 0.0;
  if (this->IsTrivial())
  {
    this->x.setZero(this->b.size());
    this->Residual = &this->b;
    this->Append(0.0);
    this->End();
  }
}

template <class Scalar>
void IterationMonitor<Scalar>::Begin(Vector<Scalar>& r)
{
  this->Residual = &r;
  const bool isFromZero = this->x.size() == 0;
  if (isFromZero)
  {
    this->x.setZero(this->b.size());
    r = this->b;
  }
  this->Append(isFromZero ? this->NormOf(r) : this->SubtractFromB(r));
}

template <class Scalar>
double IterationMonitor<Scalar>::Precondition(const Vector<Scalar>& r, Vector<Scalar>& z)
{
  const double product = this->MeasureRatio(r, z);
  this->Report.Iterations.back().RelativeResidual = this->RelativeResidual();
  return product;
}

template <class Scalar>
double IterationMonitor<Scalar>::MeasureRatio(const Vector<Scalar>& r, Vector<Scalar>& z)
{
  this->B.Apply(r, z, this->Context);
  const double product = this->A.Sum(Eigen::numext::real(Dot(r, z, this->Context)));
  this->IsMeasured = product > 0.0 || this->Norm == 0.0;
  if (product > 0.0 && this->Norm > 0.0)
  {
    const double before = this->Ratio;
    this->Ratio = std::sqrt(product) / this->Norm;
    this->IsSteady = this->LastRow().Iteration > 0 && this->Ratio < 2.0 * before && before < 2.0 * this->Ratio;
  }
  return product;
}

template <class Scalar>
double IterationMonitor<Scalar>::RelativeResidual() const
{
  const double otherwise = this->Norm > 0.0 ? 1.0 : 0.0;
  return this->Energy > 0.0 ? this->ResidualNorm() / this->Energy : otherwise;
}

template <class Scalar>
void IterationMonitor<Scalar>::KeepBest()
{
  const int iteration = this->LastRow().Iteration;
  if (iteration == 0 || (this->IsMeasured && this->ResidualNorm() < this->BestNorm))
  {
    this->BestNorm = this->ResidualNorm();
    this->BestRatio = this->Ratio;
    this->BestIteration = iteration;
    this->Best = this->x;
  }
}

template <class Scalar>
bool IterationMonitor<Scalar>::MayContinue()
{
  // Digits gained over digits wanted: residuals fall geometrically.
  const double start = this->Report.Iterations.front().RelativeResidual;
  const double best = this->Report.Iterations[this->BestIteration].RelativeResidual;
  const double wanted = std::log(start / this->Stop.RelativeTolerance);
  const double gained = std::log(start / best);
  if (wanted > 0.0 && gained > 0.0)
  {
    this->Progress = std::max(this->Progress, std::min(1.0, gained / wanted));
  }
  this->Context.Checkpoint(this->Progress);
  if (this->Stop.MaximumIterations > this->LastRow().Iteration)
  {
    return true;
  }
  this->Reason = "the limit of " + std::to_string(this->Stop.MaximumIterations) + " iterations is reached; ";
  constexpr double NearRounding = 1e-7;
  constexpr int LongEnough = 10;
  const int since = this->IterationsSinceBest();
  const bool haveEnded = since >= LongEnough && 2 * since > this->Stop.MaximumIterations && best <= NearRounding;
  this->Reason += haveEnded
    ? "rounding errors have forbidden a smaller one since then, so that more iterations do not help"
    : "raise " + TextOf(Remedy::Iterations);
  return false;
}

template <class Scalar>
void IterationMonitor<Scalar>::StopAtRounding()
{
  this->StopShort("rounding errors forbid a smaller residual");
  this->Report.EndedByRounding = true;
}

template <class Scalar>
void IterationMonitor<Scalar>::ComputeResidual(Vector<Scalar>& r)
{
  this->Norm = this->SubtractFromB(r);
  this->IsMeasured = false;
  this->Energy = this->EnergyNorm(r);
  this->Report.Iterations.back().RelativeResidual = this->RelativeResidual();
  this->Report.Iterations.back().Seconds = this->Seconds();
  this->Measure();
}

template <class Scalar>
void IterationMonitor<Scalar>::End()
{
  this->Report.Returned = this->LastRow().Iteration;
  this->Report.Converged = this->IsTrivial() || this->HasConverged();
  if (!this->Report.Converged)
  {
    this->x.swap(this->Best);
    Vector<Scalar> r;
    this->Norm = this->SubtractFromB(r);
    this->Energy = this->EnergyNorm(r);
    this->Ratio = this->BestRatio;
    this->MeasureRatio(r, this->Best); // whose place is free
    const double reached = this->RelativeResidual();
    this->Report.Returned = this->BestIteration;
    this->Report.Iterations[this->BestIteration].RelativeResidual = reached;
    this->Report.Warnings.push_back("The solver stopped at a relative residual of " + Rounded(reached) +
      " (iteration " + std::to_string(this->BestIteration) + ", the best) instead of " +
      Rounded(this->Stop.RelativeTolerance) + ": " + this->Reason + ".");
  }
  this->Report.SolveSeconds = this->Seconds();
}

template <class Scalar>
void IterationMonitor<Scalar>::Append(double norm)
{
  this->Norm = norm;
  this->IsMeasured = false;
  this->Energy = this->EnergyNorm(*this->Residual);
  const int number = static_cast<int>(this->Report.Iterations.size());
  this->Report.Iterations.push_back({ number, this->Seconds(), this->RelativeResidual() });
  this->Measure();
}

template <class Scalar>
double IterationMonitor<Scalar>::EnergyNorm(const Vector<Scalar>& r) const
{
  const double square = SumOverBlocks<double>(static_cast<int>(r.size()), this->Context,
    [this, &r](int first, int last)
    {
      const int count = last - first;
      return Eigen::numext::real(
        this->x.segment(first, count).dot(this->b.segment(first, count) - r.segment(first, count)));
    });
  return std::sqrt(std::max(0.0, this->A.Sum(square)));
}

template <class Scalar>
void IterationMonitor<Scalar>::Measure()
{
  if (this->AskedMeasure)
  {
    const auto begin = std::chrono::steady_clock::now();
    this->AskedMeasure->Fill(this->Report.Iterations.back(), this->x, this->b, *this->Residual, this->Context);
    this->Start += std::chrono::steady_clock::now() - begin;
  }
}

template <class Scalar>
double IterationMonitor<Scalar>::SubtractFromB(Vector<Scalar>& r) const
{
  this->A.Apply(this->x, r, this->Context);
  constexpr int Grain = 8192;
  this->Context.ParallelFor(0, static_cast<int>(r.size()), Grain,
    [this, &r](int first, int last)
    {
      const int count = last - first;
      r.segment(first, count) = this->b.segment(first, count) - r.segment(first, count);
    });
  return this->NormOf(r);
}

template <class Scalar>
double IterationMonitor<Scalar>::NormOf(const Vector<Scalar>& r) const
{
  const double square = SumOverBlocks<double>(static_cast<int>(r.size()), this->Context,
    [this, &r](int first, int last)
    {
      double sum = 0.0;
      for (int i = first; i < last; ++i)
      {
        sum += this->SquareOf(i, r[i]);
      }
      return sum;
    });
  return std::sqrt(this->A.Sum(square));
}

template <class Scalar>
double IterationMonitor<Scalar>::Seconds() const
{
  const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - this->Start;
  return elapsed.count();
}

template class IterationMonitor<double>;
template class IterationMonitor<Complex>;

}
