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
}

void DeflatedPreconditioner::Apply(
  const Vector<double>& r, Vector<double>& z, const ExecutionContext& context)
{
  const Vector<double> first = this->Inverse * (this->H.transpose() * r);
  this->Remainder = r;
  this->Remainder.noalias() -= this->AH * first;
  this->B.Apply(this->Remainder, z, context);
  const Vector<double> second = first - this->Inverse * (this->AH.transpose() * z);
  z.noalias() += this->H * second;
}

long long DeflatedPreconditioner::Bytes() const
{
  return (this->H.size() + this->AH.size()) * static_cast<long long>(sizeof(double));
}

}
