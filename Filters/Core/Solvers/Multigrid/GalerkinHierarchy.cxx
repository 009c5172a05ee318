#include "Solvers/Multigrid/GalerkinHierarchy.h"

#include "Solvers/Multigrid/HierarchicalOrder.h"
#include "Solvers/Multigrid/SmoothedProlongation.h"
#include "Support/Errors.h"
#include "Support/Permutations.h"
#include "Support/SparseKernels.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <string>

namespace dmg
{
namespace
{

constexpr int RowGrain = 4096;

template <class Scalar>
double RealDiagonalEntry(const SparseMatrix<Scalar>& A, int i)
{
  for (typename SparseMatrix<Scalar>::InnerIterator entry(A, i); entry; ++entry)
  {
    if (entry.col() == i)
    {
      return Eigen::numext::real(entry.value());
    }
  }
  return 0.0;
}

/// The number p^H D p for each column p of a prolongation, of adjoint R, and D = diag(scales).
template <class Scalar>
Vector<double> CoarseScales(
  const SparseMatrix<Scalar>& R, const Vector<double>& scales, const ExecutionContext& context)
{
  Vector<double> coarse(R.rows());
  context.ParallelFor(0, static_cast<int>(R.rows()), RowGrain,
    [&R, &scales, &coarse](int first, int last)
    {
      for (int i = first; i < last; ++i)
      {
        coarse[i] = 0.0;
        for (typename SparseMatrix<Scalar>::InnerIterator entry(R, i); entry; ++entry)
        {
          coarse[i] += Eigen::numext::abs2(entry.value()) * scales[entry.col()];
        }
      }
    });
  return coarse;
}

/// An assignment of an empty matrix would keep the memory.
template <class Scalar>
void Free(SparseMatrix<Scalar>& A)
{
  SparseMatrix<Scalar> empty;
  A.swap(empty);
}

}

template <class Scalar>
GalerkinHierarchy<Scalar>::GalerkinHierarchy(const SparseMatrix<Scalar>& A,
  std::vector<SparseMatrix<Scalar>> prolongations, const GalerkinOptions& options, const ExecutionContext& context)
{
  this->SetOrder(A, std::move(prolongations), options, context);
  this->SetFinest(A, context);
  this->SmoothProlongation(options, context);
  this->ComputeCoarser(context);
}

template <class Scalar>
GalerkinHierarchy<Scalar>::GalerkinHierarchy(SparseMatrix<Scalar>&& A, std::vector<SparseMatrix<Scalar>> prolongations,
  const GalerkinOptions& options, const ExecutionContext& context)
{
  this->SetOrder(A, std::move(prolongations), options, context);
  this->SetFinest(A, context);
  Free(A);
  this->SmoothProlongation(options, context);
  this->ComputeCoarser(context);
}

template <class Scalar>
void GalerkinHierarchy<Scalar>::Update(const SparseMatrix<Scalar>& A, const ExecutionContext& context)
{
  this->SetFinest(A, context);
  this->ComputeCoarser(context);
}

template <class Scalar>
void GalerkinHierarchy<Scalar>::Update(SparseMatrix<Scalar>&& A, const ExecutionContext& context)
{
  this->SetFinest(A, context);
  Free(A);
  this->ComputeCoarser(context);
}

template <class Scalar>
void GalerkinHierarchy<Scalar>::SetOrder(const SparseMatrix<Scalar>& A, std::vector<SparseMatrix<Scalar>> prolongations,
  const GalerkinOptions& options, const ExecutionContext& context)
{
  if (options.CoarsestLevel < 0)
  {
    throw InvalidInput("the coarsest level must be 0, the finest, or more");
  }
  prolongations.resize(std::min(prolongations.size(), static_cast<std::size_t>(options.CoarsestLevel)));
  CheckChain(A.rows(), prolongations);
  if (A.rows() != A.cols())
  {
    throw InvalidInput("the matrix of a linear system must be square");
  }
  this->Order = RenumberHierarchically(prolongations, static_cast<int>(A.rows()), context);
  this->Prolongations = std::move(prolongations);
}

template <class Scalar>
void GalerkinHierarchy<Scalar>::SmoothProlongation(const GalerkinOptions& options, const ExecutionContext& context)
{
  if (!this->Prolongations.empty())
  {
    context.Checkpoint(0.0);
    dmg::SmoothProlongation(this->Matrices[0], this->Prolongations[0], options.FinestProlongationSteps, context);
  }
}

template <class Scalar>
void GalerkinHierarchy<Scalar>::SetFinest(const SparseMatrix<Scalar>& A, const ExecutionContext& context)
{
  assert(this->Prolongations.empty() || this->Prolongations[0].rows() == A.rows());
  this->Matrices.resize(this->Prolongations.size() + 1);
  this->Diagonals.resize(this->Matrices.size());
  SparseMatrix<Scalar> permuted = Permuted(A, this->Order, Inverse(this->Order), context);
  this->Matrices[0].swap(permuted);
}

template <class Scalar>
void GalerkinHierarchy<Scalar>::ComputeCoarser(const ExecutionContext& context)
{
  const int coarsest = static_cast<int>(this->Prolongations.size());
  Vector<double> scales = Vector<double>::Zero(this->Matrices[0].rows());
  this->FindDiagonal(0, scales, context);
  for (int level = 0; level < coarsest; ++level)
  {
    context.Checkpoint(level / (coarsest + 1.0));
    const SparseMatrix<Scalar>& P = this->Prolongations[level];
    const SparseMatrix<Scalar> R = Adjoint(P, context);
    SparseMatrix<Scalar> product = TripleProduct(R, this->Matrices[level], P, context);
    this->Matrices[level + 1].swap(product);
    scales = CoarseScales(R, scales, context);
    this->FindDiagonal(level + 1, scales, context);
  }
  context.Checkpoint(coarsest / (coarsest + 1.0));
  this->FactorCoarsest();
  this->Reports.clear();
  for (const SparseMatrix<Scalar>& A : this->Matrices)
  {
    this->Reports.push_back({ static_cast<long long>(A.rows()), static_cast<long long>(A.nonZeros()) });
  }
  context.Checkpoint(1.0);
}

template <class Scalar>
void GalerkinHierarchy<Scalar>::ForgetMatrices()
{
  for (SparseMatrix<Scalar>& A : this->Matrices)
  {
    Free(A);
  }
  this->Diagonals.clear();
}

template <class Scalar>
void GalerkinHierarchy<Scalar>::ForgetProlongations()
{
  for (SparseMatrix<Scalar>& P : this->Prolongations)
  {
    Free(P);
  }
}

template <class Scalar>
void GalerkinHierarchy<Scalar>::FindDiagonal(int level, Vector<double>& scales, const ExecutionContext& context)
{
  const SparseMatrix<Scalar>& A = this->Matrices[level];
  const int size = static_cast<int>(A.rows());
  Vector<double>& diagonal = this->Diagonals[level];
  diagonal.resize(size);
  context.ParallelFor(0, size, RowGrain,
    [&A, &scales, &diagonal](int first, int last)
    {
      for (int i = first; i < last; ++i)
      {
        // Cancellation in p^H A p leaves rounding errors of the size of p^H diag(A) p. Those of an
        // inactive unknown are what it hands on: its scale stays.
        diagonal[i] = RealDiagonalEntry(A, i);
        if (std::abs(diagonal[i]) <= 1e-13 * scales[i])
        {
          diagonal[i] = 0.0;
        }
        else
        {
          scales[i] = diagonal[i];
        }
      }
    });
  for (int i = 0; i < size; ++i)
  {
    if (!(diagonal[i] >= 0.0 && diagonal[i] <= std::numeric_limits<double>::max()))
    {
      const int unknown = level == 0 ? this->Order[i] : i;
      throw SolverFailure("the matrix is not positive semi-definite: diagonal entry " + std::to_string(unknown) +
        " on level " + std::to_string(level) + " is " + std::to_string(diagonal[i]));
    }
  }
}

template <class Scalar>
void GalerkinHierarchy<Scalar>::FactorCoarsest()
{
  SparseMatrix<Scalar> scaled = this->Matrices.back();
  const Vector<double>& diagonal = this->Diagonals.back();
  const int size = static_cast<int>(scaled.rows());
  for (int i = 0; i < size; ++i)
  {
    for (typename SparseMatrix<Scalar>::InnerIterator entry(scaled, i); entry; ++entry)
    {
      const double product = diagonal[i] * diagonal[entry.col()];
      entry.valueRef() *= product > 0.0 ? 1.0 / std::sqrt(product) : 0.0;
    }
  }
  for (int i = 0; i < size; ++i)
  {
    scaled.coeffRef(i, i) = 1.0 + 1e-12; // rows of unknowns that nothing sees may be empty
  }
  scaled.makeCompressed();
  if (this->CoarsestFactor)
  {
    this->CoarsestFactor->Update(scaled);
  }
  else
  {
    this->CoarsestFactor.emplace(scaled);
  }
}

template <class Scalar>
long long GalerkinHierarchy<Scalar>::Bytes() const
{
  long long bytes = this->CoarsestFactor->Bytes() + static_cast<long long>(this->Order.size() * sizeof(int));
  for (const auto* matrices : { &this->Prolongations, &this->Matrices })
  {
    for (const SparseMatrix<Scalar>& matrix : *matrices)
    {
      bytes += BytesOf(matrix);
    }
  }
  for (const Vector<double>& diagonal : this->Diagonals)
  {
    bytes += diagonal.size() * static_cast<long long>(sizeof(double));
  }
  return bytes;
}

template class GalerkinHierarchy<double>;
template class GalerkinHierarchy<Complex>;

}
