#include "Solvers/Krylov/DeflatedPreconditioner.h"

#include "Solvers/Krylov/EnergiesOfSpace.h"

#include <algorithm>
#include <utility>

namespace dmg
{
namespace
{

constexpr int BlockSize = 4096;

/// Calls visit(block, first row, number of rows).
template <class Visit>
void ForBlocks(Eigen::Index rows, const ExecutionContext& context, const Visit& visit)
{
  const int size = static_cast<int>(rows);
  context.ParallelFor(0, (size + BlockSize - 1) / BlockSize, 2,
    [&](int begin, int end)
    {
      for (int block = begin; block < end; ++block)
      {
        visit(block, block * BlockSize, std::min(BlockSize, size - block * BlockSize));
      }
    });
}

/// H^T x, added up in the same order for any number of threads.
Vector<double> Coefficients(const Eigen::MatrixXd& H, const Vector<double>& x, const ExecutionContext& context)
{
  Eigen::MatrixXd parts(H.cols(), (H.rows() + BlockSize - 1) / BlockSize);
  ForBlocks(H.rows(), context,
    [&](int block, int first, int count)
    { parts.col(block).noalias() = H.middleRows(first, count).transpose() * x.segment(first, count); });
  return parts.rowwise().sum();
}

/// x += H c.
void AddCombination(
  const Eigen::MatrixXd& H, const Vector<double>& c, Vector<double>& x, const ExecutionContext& context)
{
  ForBlocks(H.rows(), context,
    [&](int, int first, int count) { x.segment(first, count).noalias() += H.middleRows(first, count) * c; });
}

}

DeflatedPreconditioner::DeflatedPreconditioner(Preconditioner<double>& inner, const LinearOperator<double>& A,
  Eigen::MatrixXd space, double largest, const ExecutionContext& context)
  : B(inner)
  , H(std::move(space))
  , AH(H.rows(), H.cols())
{
  Eigen::MatrixXd energies(this->H.cols(), this->H.cols());
  Vector<double> product;
  for (Eigen::Index k = 0; k < this->H.cols(); ++k)
  {
    A.Apply(this->H.col(k), product, context);
    this->AH.col(k) = product;
    energies.col(k) = Coefficients(this->H, product, context);
  }
  const EnergiesOfSpace ofSpace(this->H, energies, largest);
  this->Inverse = ofSpace.Inverse();
  this->OfA = KernelProjection(ofSpace.Undetermined());
}

void KernelProjection::Remove(Vector<double>& x, const ExecutionContext& context) const
{
  if (this->Kernel.cols() > 0)
  {
    AddCombination(this->Kernel, -Coefficients(this->Kernel, x, context), x, context);
  }
}

void DeflatedPreconditioner::Apply(const Vector<double>& r, Vector<double>& z, const ExecutionContext& context)
{
  this->Remainder = r;
  this->OfA.Remove(this->Remainder, context);
  const Vector<double> first = this->Inverse * Coefficients(this->H, this->Remainder, context);
  AddCombination(this->AH, -first, this->Remainder, context);
  this->B.Apply(this->Remainder, z, context);
  const Vector<double> second = first - this->Inverse * Coefficients(this->AH, z, context);
  AddCombination(this->H, second, z, context);
  this->OfA.Remove(z, context);
}

long long DeflatedPreconditioner::Bytes() const
{
  return (this->H.size() + this->AH.size()) * static_cast<long long>(sizeof(double)) + this->OfA.Bytes();
}

}
