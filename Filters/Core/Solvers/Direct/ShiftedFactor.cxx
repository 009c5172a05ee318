#include "Solvers/Direct/ShiftedFactor.h"

#include "Support/Errors.h"

namespace dmg
{
namespace
{

/// A's lower triangle plus a share of its diagonal; ones where the diagonal is zero or not stored.
template <class Scalar>
SparseMatrix<Scalar> Shifted(const SparseMatrix<Scalar>& A, double share)
{
  const int size = static_cast<int>(A.rows());
  SparseMatrix<Scalar> shifted(size, size);
  shifted.reserve((A.nonZeros() + 3 * size) / 2);
  for (int i = 0; i < size; ++i)
  {
    shifted.startVec(i);
    Scalar diagonal = 0.0;
    for (typename SparseMatrix<Scalar>::InnerIterator entry(A, i); entry && entry.col() <= i; ++entry)
    {
      if (entry.col() == i)
      {
        diagonal = entry.value();
      }
      else
      {
        shifted.insertBack(i, entry.col()) = entry.value();
      }
    }
    shifted.insertBack(i, i) = diagonal == 0.0 ? Scalar(1.0) : (1.0 + share) * diagonal;
  }
  shifted.finalize();
  return shifted;
}

}

template <class Scalar>
ShiftedFactor<Scalar>::ShiftedFactor(const SparseMatrix<Scalar>& A, double leastShift)
{
  this->FactorFrom(leastShift, A,
    [this](const SparseMatrix<Scalar>& shifted) { this->Factor = std::make_unique<CholeskySolver<Scalar>>(shifted); });
}

template <class Scalar>
void ShiftedFactor<Scalar>::Update(const SparseMatrix<Scalar>& A, double leastShift)
{
  this->FactorFrom(leastShift, A, [this](const SparseMatrix<Scalar>& shifted) { this->Factor->Update(shifted); });
}

template <class Scalar>
template <class FactorMatrix>
void ShiftedFactor<Scalar>::FactorFrom(double leastShift, const SparseMatrix<Scalar>& A, const FactorMatrix& factor)
{
  for (this->Share = leastShift;; this->Share *= Growth)
  {
    try
    {
      factor(Shifted(A, this->Share));
      return;
    }
    catch (const NotPositiveDefinite&)
    {
      if (this->Share * Growth > 2.0 * LargestShift) // rounding errors aside
      {
        throw;
      }
    }
  }
}

template <class Scalar>
void ShiftedFactor<Scalar>::Apply(const Vector<Scalar>& r, Vector<Scalar>& z, const ExecutionContext& /*context*/)
{
  this->Factor->Solve(r, z);
}

template class ShiftedFactor<double>;
template class ShiftedFactor<Complex>;

}
