#include "Solvers/Multigrid/GalerkinCycle.h"

#include "Support/Errors.h"
#include "Support/SparseKernels.h"

#include <cmath>
#include <utility>

namespace dmg
{
namespace
{

constexpr int RowGrain = 256; // rows are long on the levels that cycles are repeated on
// A bound of the eigenvalues of B A for most errors; iterations depend on it little.
constexpr double LeastEigenvalue = 0.5;

/// The step of a cycle among the repetitions: they damp errors of eigenvalues of B A from LeastEigenvalue to 1 evenly,
/// and others by some (Chebyshev's semi-iteration; Saad 2003, section 12.3).
double StepOf(int repetition, int repetitions)
{
  const double root = std::cos(EIGEN_PI * (2 * repetition + 1) / (2.0 * repetitions)); // in [-1, 1]
  return 2.0 / (1.0 + LeastEigenvalue + (1.0 - LeastEigenvalue) * root);
}

/// x_0 += step B (b_0 - A x_0).
template <class Scalar, class Value>
void Repeat(LevelStack<Scalar, Value>& levels, double step, const ExecutionContext& context)
{
  const TriangularParts<Value>& A = levels[0].A;
  Vector<Value>& b = levels[0].b;
  Vector<Value>& x = levels[0].x;
  const Vector<Value> former = x;
  const Vector<Value> rightHandSide = b;
  context.ParallelFor(0, static_cast<int>(b.size()), RowGrain,
    [&](int first, int last)
    {
      for (int i = first; i < last; ++i)
      {
        b[i] -= former[i] + A.LowerTimes(i, former.data()) + A.UpperTimes(i, former.data());
      }
    });
  levels.Cycle(0, context);
  x = former + static_cast<typename Eigen::NumTraits<Value>::Real>(step) * x;
  b = rightHandSide;
}

/// z = B r.
template <class Scalar, class Value>
void ApplyCycles(LevelStack<Scalar, Value>& levels, int repetitions, const Vector<Scalar>& r, Vector<Scalar>& z,
  const ExecutionContext& context)
{
  levels.Load(r, context);
  levels.Cycle(0, context);
  if (levels.NumberOfLevels() > 1 && repetitions > 1)
  {
    levels[0].x *= static_cast<typename Eigen::NumTraits<Value>::Real>(StepOf(0, repetitions));
    for (int k = 1; k < repetitions; ++k)
    {
      Repeat(levels, StepOf(k, repetitions), context);
    }
  }
  levels.Store(z, context);
}

const CycleOptions& Checked(const CycleOptions& options)
{
  if (options.Smoothing.PreSweeps < 0 || options.Smoothing.PostSweeps < 0)
  {
    throw InvalidInput("the number of smoothing sweeps must not be negative");
  }
  return options;
}

}

template <class Scalar>
GalerkinCycle<Scalar>::GalerkinCycle(SparseMatrix<Scalar>&& matrix, std::vector<SparseMatrix<Scalar>> prolongations,
  const GalerkinOptions& coarsening, const CycleOptions& cycle, const ExecutionContext& context)
  : Options(Checked(cycle))
  , Hierarchy(std::move(matrix), std::move(prolongations), coarsening, PartOfContext(context, 0.0, 0.7))
{
  this->TakeMatrix(PartOfContext(context, 0.7, 1.0));
}

template <class Scalar>
void GalerkinCycle<Scalar>::Update(SparseMatrix<Scalar>&& matrix, const ExecutionContext& context)
{
  this->Hierarchy.Update(std::move(matrix), PartOfContext(context, 0.0, 0.7));
  this->TakeMatrix(PartOfContext(context, 0.7, 1.0));
}

template <class Scalar>
bool GalerkinCycle<Scalar>::NeedsDoublePrecision() const
{
  if (this->Options.Precision != CyclePrecision::Automatic)
  {
    return this->Options.Precision == CyclePrecision::Double;
  }
  // Diagonals are as large on all levels, so that the least eigenvalue falls with the share of unknowns. Cycles in a
  // row subtract A x from b, and these nearly agree for its error.
  double smallest = this->Hierarchy.CoarsestSolver().ReciprocalCondition();
  if (this->Options.Repetitions > 1)
  {
    const int coarsest = this->Hierarchy.NumberOfLevels() - 1;
    smallest *= static_cast<double>(this->Hierarchy.NumberOfUnknowns(coarsest)) / this->Hierarchy.NumberOfUnknowns(0);
  }
  return smallest < 2e-5;
}

template <class Scalar>
template <class Value>
void GalerkinCycle<Scalar>::TakeMatrix(
  std::optional<LevelStack<Scalar, Value>>& levels, const ExecutionContext& context)
{
  if (levels)
  {
    levels->Update(context);
    return;
  }
  levels.emplace(this->Hierarchy, this->Options.Smoothing, this->Options.FinestFactor, context);
}

template <class Scalar>
void GalerkinCycle<Scalar>::TakeMatrix(const ExecutionContext& context)
{
  if (this->NeedsDoublePrecision())
  {
    this->InSingle.reset();
    this->TakeMatrix(this->InDouble, context);
  }
  else
  {
    this->InDouble.reset();
    this->TakeMatrix(this->InSingle, context);
  }
  this->Hierarchy.ForgetMatrices();
}

template <class Scalar>
void GalerkinCycle<Scalar>::Apply(const Vector<Scalar>& r, Vector<Scalar>& z, const ExecutionContext& context)
{
  this->InDouble ? ApplyCycles(*this->InDouble, this->Options.Repetitions, r, z, context)
                 : ApplyCycles(*this->InSingle, this->Options.Repetitions, r, z, context);
}

template <class Scalar>
long long GalerkinCycle<Scalar>::Bytes() const
{
  return this->Hierarchy.Bytes() + (this->InDouble ? this->InDouble->Bytes() : this->InSingle->Bytes());
}

template class GalerkinCycle<double>;
template class GalerkinCycle<Complex>;

}
