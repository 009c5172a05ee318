#include "Solvers/DeflatedPreconditioner.h"

#include <Eigen/Eigenvalues>

#include <utility>

namespace dmg
{

DeflatedPreconditioner::DeflatedPreconditioner(std::unique_ptr<Preconditioner<double>> inner,
  const SparseMatrix<double>& A, Eigen::MatrixXd space)
  : B(std::move(inner))
  , H(std::move(space))
  , AH(A * this->H)
{
  const Eigen::MatrixXd energies = this->H.transpose() * this->AH;
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(energies);
  // Fewer prescriptions than harmonic fields leave some of these without any energy but rounding
  // errors, which are those of A.
  const double rounding = 1e-13 * A.diagonal().cwiseAbs().maxCoeff();
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
  this->B->Apply(this->Remainder, z, context);
  const Vector<double> second = first - this->Inverse * (this->AH.transpose() * z);
  z.noalias() += this->H * second;
}

long long DeflatedPreconditioner::Bytes() const
{
  return (this->H.size() + this->AH.size()) * static_cast<long long>(sizeof(double));
}

}
