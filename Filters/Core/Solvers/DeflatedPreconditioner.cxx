#include "Solvers/DeflatedPreconditioner.h"

#include <Eigen/Eigenvalues>

#include <utility>

namespace dmg
{

DeflatedPreconditioner::DeflatedPreconditioner(Preconditioner<double>& inner,
  const LinearOperator<double>& A, Eigen::MatrixXd space, double largest,
  const ExecutionContext& context)
  : B(inner)
  , H(std::move(space))
  , AH(H.rows(), H.cols())
{
  Vector<double> product;
  for (Eigen::Index k = 0; k < this->H.cols(); ++k)
  {
    A.Apply(this->H.col(k), product, context);
    this->AH.col(k) = product;
  }
  const Eigen::MatrixXd energies = this->H.transpose() * this->AH;
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(energies);
  // Fewer prescriptions than harmonic fields leave some of these without any energy but rounding
  // errors.
  const double rounding = 1e-13 * largest;
  const Vector<double> inverses = solver.eigenvalues().unaryExpr(
    [rounding](double energy) { return energy > rounding ? 1.0 / energy : 0.0; });
  this->Inverse =
    solver.eigenvectors() * inverses.asDiagonal() * solver.eigenvectors().transpose();
  const Eigen::Index free = (solver.eigenvalues().array() <= rounding).count(); // ascending
  if (free > 0)
  {
    // Where unknowns are held, vectors of H have lost length, or vanished.
    const Eigen::MatrixXd spanned = this->H * solver.eigenvectors().leftCols(free);
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> lengths(spanned.transpose() * spanned);
    const Eigen::Index rank = (lengths.eigenvalues().array() > 1e-8).count();
    const Vector<double> inverseRoots =
      lengths.eigenvalues().tail(rank).cwiseSqrt().cwiseInverse();
    this->Kernel = spanned * lengths.eigenvectors().rightCols(rank) * inverseRoots.asDiagonal();
  }
}

void DeflatedPreconditioner::RemoveKernel(Vector<double>& x) const
{
  if (this->Kernel.cols() > 0)
  {
    const Vector<double> parts = this->Kernel.transpose() * x;
    x.noalias() -= this->Kernel * parts;
  }
}

void DeflatedPreconditioner::Apply(
  const Vector<double>& r, Vector<double>& z, const ExecutionContext& context)
{
  this->Remainder = r;
  this->RemoveKernel(this->Remainder);
  const Vector<double> first = this->Inverse * (this->H.transpose() * this->Remainder);
  this->Remainder.noalias() -= this->AH * first;
  this->B.Apply(this->Remainder, z, context);
  const Vector<double> second = first - this->Inverse * (this->AH.transpose() * z);
  z.noalias() += this->H * second;
  this->RemoveKernel(z);
}

long long DeflatedPreconditioner::Bytes() const
{
  return (this->H.size() + this->AH.size() + this->Kernel.size()) * static_cast<long long>(sizeof(double));
}

}
