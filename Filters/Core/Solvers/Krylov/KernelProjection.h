#ifndef dmgKernelProjection_h
#define dmgKernelProjection_h

#include "Solvers/Krylov/LinearOperator.h"
#include "Solvers/Krylov/Preconditioner.h"
#include "Support/ExecutionContext.h"
#include "Support/Types.h"

#include <utility>

namespace dmg
{

/// The orthogonal projector onto the complement of the kernel of a matrix.
class KernelProjection
{
public:
  /// The identity: the kernel is zero.
  KernelProjection() = default;
  /// \param kernel n x k, orthogonal columns of length 1.
  explicit KernelProjection(Eigen::MatrixXd kernel)
    : Kernel(std::move(kernel))
  {
  }

  int Size() const { return static_cast<int>(this->Kernel.cols()); }
  long long Bytes() const { return this->Kernel.size() * static_cast<long long>(sizeof(double)); }
  void Remove(Vector<double>& x, const ExecutionContext& context) const;

private:
  Eigen::MatrixXd Kernel;
};

/// P A with the projector P. Without P, rounding errors in the kernel bound the residual from below.
class OperatorOutsideKernel : public LinearOperator<double>
{
public:
  /// Both are borrowed.
  OperatorOutsideKernel(const LinearOperator<double>& A, const KernelProjection& projection)
    : A(A)
    , Projection(projection)
  {
  }

  int Size() const override { return this->A.Size(); }
  double Apply(const Vector<double>& x, Vector<double>& y, const ExecutionContext& context) const override
  {
    const double product = this->A.Apply(x, y, context);
    this->Projection.Remove(y, context);
    return product;
  }
  const Vector<double>* InverseDiagonal() const override { return this->A.InverseDiagonal(); }

private:
  const LinearOperator<double>& A;
  const KernelProjection& Projection;
};

/// A preconditioner whose results have no part in the kernel.
class PreconditionerOutsideKernel : public Preconditioner<double>
{
public:
  /// Both are borrowed.
  PreconditionerOutsideKernel(Preconditioner<double>& inner, const KernelProjection& projection)
    : Inner(inner)
    , Projection(projection)
  {
  }

  void Apply(const Vector<double>& r, Vector<double>& z, const ExecutionContext& context) override
  {
    this->Inner.Apply(r, z, context);
    this->Projection.Remove(z, context);
  }

private:
  Preconditioner<double>& Inner;
  const KernelProjection& Projection;
};

}

#endif
