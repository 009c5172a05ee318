#include "Solvers/Krylov/StationaryIteration.h"

#include "Solvers/Krylov/IterationMonitor.h"
#include "Support/SparseKernels.h"

namespace dmg
{

template <class Scalar>
void StationaryIteration(const LinearOperator<Scalar>& A, Preconditioner<Scalar>& B, const Vector<Scalar>& b,
  const StoppingCriteria& stop, Vector<Scalar>& x, SolveReport& report, const ExecutionContext& context,
  const ConvergenceMeasure<Scalar>* measure)
{
  IterationMonitor<Scalar> iteration(A, B, b, stop, x, report, context, measure);
  if (iteration.IsTrivial())
  {
    return;
  }
  constexpr int patience = 10;
  Vector<Scalar> r;
  iteration.Begin(r);
  Vector<Scalar> z;
  while (!iteration.HasConverged())
  {
    iteration.Precondition(r, z);
    if (iteration.HasConverged())
    {
      break;
    }
    iteration.KeepBest();
    if (iteration.IterationsSinceBest() >= patience)
    {
      iteration.StopShort("the last cycles did not reduce the residual");
      break;
    }
    if (!iteration.MayContinue())
    {
      break;
    }
    x += z;
    iteration.AppendResidual(r);
  }
  iteration.End();
}

template void StationaryIteration(const LinearOperator<double>&, Preconditioner<double>&, const Vector<double>&,
  const StoppingCriteria&, Vector<double>&, SolveReport&, const ExecutionContext&, const ConvergenceMeasure<double>*);
template void StationaryIteration(const LinearOperator<Complex>&, Preconditioner<Complex>&, const Vector<Complex>&,
  const StoppingCriteria&, Vector<Complex>&, SolveReport&, const ExecutionContext&, const ConvergenceMeasure<Complex>*);

}
