#include "Solvers/Krylov/ConjugateGradient.h"

#include "Solvers/Krylov/IterationMonitor.h"
#include "Support/SparseKernels.h"

#include <cmath>

namespace dmg
{
namespace
{

constexpr int ElementGrain = 8192;

/// p = z + beta p.
template <class Scalar>
void ContinueDirection(const Vector<Scalar>& z, double beta, Vector<Scalar>& p, const ExecutionContext& context)
{
  context.ParallelFor(0, static_cast<int>(p.size()), ElementGrain,
    [&z, beta, &p](int first, int last)
    {
      const int count = last - first;
      p.segment(first, count) = z.segment(first, count) + beta * p.segment(first, count);
    });
}

/// x += alpha p and r -= alpha q. \return the square of the norm of r that the monitor wants, as this process has it.
template <class Scalar>
double Step(double alpha, const Vector<Scalar>& p, const Vector<Scalar>& q, Vector<Scalar>& x, Vector<Scalar>& r,
  const IterationMonitor<Scalar>& monitor, const ExecutionContext& context)
{
  return SumOverBlocks<double>(static_cast<int>(p.size()), context,
    [&, alpha](int first, int last)
    {
      double sum = 0.0;
      for (int i = first; i < last; ++i)
      {
        x[i] += alpha * p[i];
        r[i] -= alpha * q[i];
        sum += monitor.SquareOf(i, r[i]);
      }
      return sum;
    });
}

}

template <class Scalar>
void ConjugateGradient(const LinearOperator<Scalar>& A, Preconditioner<Scalar>& B, const Vector<Scalar>& b,
  const StoppingCriteria& stop, Vector<Scalar>& x, SolveReport& report, const ExecutionContext& context,
  const ConvergenceMeasure<Scalar>* measure)
{
  IterationMonitor<Scalar> iteration(A, B, b, stop, x, report, context, measure);
  if (iteration.IsTrivial())
  {
    return;
  }
  Vector<Scalar> r;
  iteration.Begin(r);

  Vector<Scalar> p = Vector<Scalar>::Zero(b.size());
  Vector<Scalar> image(b.size()); // B r; then, where that has become a direction, A p
  double oldProduct = 0.0;        // r^H z of the iteration before; zero: no direction to continue
  double normAtRestart = 0.0;
  // The recurrence drifts away from b - A x by rounding errors; the latter counts.
  bool isComputed = true; // r, as b - A x
  bool hasDrifted = false;
  while (!(isComputed && iteration.HasConverged()))
  {
    const double product = iteration.Precondition(r, image);
    if (iteration.HasConverged())
    {
      if (!isComputed)
      {
        iteration.ComputeResidual(r);
        isComputed = true;
        hasDrifted = true; // unless it has converged by this one, too
      }
      continue;
    }
    iteration.KeepBest();
    if (hasDrifted)
    {
      if (iteration.ResidualNorm() > 0.5 * normAtRestart)
      {
        iteration.StopAtRounding();
        break;
      }
      normAtRestart = iteration.ResidualNorm();
      oldProduct = 0.0;
    }
    if (!iteration.MayContinue())
    {
      break;
    }
    normAtRestart = normAtRestart > 0.0 ? normAtRestart : iteration.ResidualNorm();
    ContinueDirection(image, oldProduct > 0.0 ? product / oldProduct : 0.0, p, context);
    const double energy = A.Apply(p, image, context);
    if (!(product > 0.0 && energy > 0.0))
    {
      iteration.StopShort(
        product > 0.0 ? "the matrix is not positive definite" : "the preconditioner is not positive definite");
      break;
    }
    oldProduct = product;
    const double alpha = product / energy;
    iteration.Append(std::sqrt(A.Sum(Step(alpha, p, image, x, r, iteration, context))));
    isComputed = iteration.SeemsConverged();
    if (isComputed)
    {
      iteration.ComputeResidual(r);
    }
    hasDrifted = isComputed && !iteration.SeemsConverged();
  }
  iteration.End();
}

template void ConjugateGradient(const LinearOperator<double>&, Preconditioner<double>&, const Vector<double>&,
  const StoppingCriteria&, Vector<double>&, SolveReport&, const ExecutionContext&, const ConvergenceMeasure<double>*);
template void ConjugateGradient(const LinearOperator<Complex>&, Preconditioner<Complex>&, const Vector<Complex>&,
  const StoppingCriteria&, Vector<Complex>&, SolveReport&, const ExecutionContext&, const ConvergenceMeasure<Complex>*);

}
