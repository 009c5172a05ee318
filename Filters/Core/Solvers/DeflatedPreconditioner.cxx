#include "Solvers/DeflatedPreconditioner.h"

#include "Support/EnergiesOfSpace.h"

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
  const EnergiesOfSpace ofSpace(this->H, energies, largest);
  this->Inverse = ofSpace.Inverse();
  this->Kernel = ofSpace.Undetermined();
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
