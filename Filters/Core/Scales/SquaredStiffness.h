#ifndef dmgSquaredStiffness_h
#define dmgSquaredStiffness_h

#include "Solvers/Krylov/LinearOperator.h"
#include "Solvers/Krylov/Preconditioner.h"
#include "Support/ExecutionContext.h"
#include "Support/SparseKernels.h"
#include "Support/Types.h"

namespace dmg
{

/// R M^-1 R + s^2 M with a stiffness matrix R, a diagonal mass M and a shift s: the equations of scale filters of order 2.
class SquaredStiffness : public LinearOperator<double>
{
public:
  /// \param stiffness R, with a diagonal of zero, infinite where unknowns are fixed at zero; borrowed.
  /// \param mass > 0, one per unknown; borrowed.
  SquaredStiffness(const LinearOperator<double>& stiffness, const Vector<double>& mass)
    : R(stiffness)
    , Mass(mass)
  {
  }

  void SetShift(double shift) { this->Shift = shift; }

  int Size() const override { return this->R.Size(); }

  /// y = R M^-1 R x.
  void ApplySquare(const Vector<double>& x, Vector<double>& y, const ExecutionContext& context) const
  {
    constexpr int Grain = 8192;
    this->R.Apply(x, this->Laplacian, context);
    context.ParallelFor(0, this->Size(), Grain,
      [this](int first, int last)
      {
        const int count = last - first;
        this->Laplacian.segment(first, count).array() /= this->Mass.segment(first, count).array();
      });
    this->R.Apply(this->Laplacian, y, context);
  }

  double Apply(const Vector<double>& x, Vector<double>& y, const ExecutionContext& context) const override
  {
    this->ApplySquare(x, y, context);
    const double square = this->Shift * this->Shift;
    return this->R.Sum(SumOverBlocks<double>(this->Size(), context,
      [this, square, &x, &y](int first, int last)
      {
        const int count = last - first;
        y.segment(first, count).array() +=
          square * this->Mass.segment(first, count).array() * x.segment(first, count).array();
        return x.segment(first, count).dot(y.segment(first, count));
      }));
  }

  double Sum(double here) const override { return this->R.Sum(here); }

private:
  const LinearOperator<double>& R;
  const Vector<double>& Mass;
  double Shift = 0.0;
  mutable Vector<double> Laplacian; ///< M^-1 R x
};

/// B M B, where B is close to the inverse of R + s M: close to the inverse of R M^-1 R + s^2 M. With an exact B, the eigenvalues of the
/// product of the two are (t^2 + 1) / (t + 1)^2 for those s t of M^-1 R: they lie between 1/2 and 1.
class SquaredInverse : public Preconditioner<double>
{
public:
  /// \param inverse symmetric; borrowed, as \p mass is.
  SquaredInverse(Preconditioner<double>& inverse, const Vector<double>& mass)
    : Inverse(inverse)
    , Mass(mass)
  {
  }

  void Apply(const Vector<double>& r, Vector<double>& z, const ExecutionContext& context) override
  {
    constexpr int Grain = 8192;
    this->Inverse.Apply(r, this->Half, context);
    context.ParallelFor(0, static_cast<int>(this->Half.size()), Grain,
      [this](int first, int last)
      {
        const int count = last - first;
        this->Half.segment(first, count).array() *= this->Mass.segment(first, count).array();
      });
    this->Inverse.Apply(this->Half, z, context);
  }

private:
  Preconditioner<double>& Inverse;
  const Vector<double>& Mass;
  Vector<double> Half; ///< B r, times M
};

}

#endif
