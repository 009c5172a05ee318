#ifndef dmgPenalisedUnknowns_h
#define dmgPenalisedUnknowns_h

#include "Support/CountingSort.h"
#include "Support/ExecutionContext.h"
#include "Support/Types.h"

#include <cmath>
#include <vector>

namespace dmg
{

/// The penalised unknowns of A = R + D, those with 0 < D_i < infinity, in a cycle for A.
///
/// A penalised unknown takes a share R_ii / (R_ii + D_i) of the coarse correction, and the same share of its
/// residual is restricted. The coarse matrix then has the penalty D_i R_ii / (R_ii + D_i) in place of D_i, the Schur complement
/// where the unknown itself is eliminated. With D_i itself and the whole correction, strong penalties cost iterations.
template <class Scalar>
class PenalisedUnknowns
{
public:
  /// None.
  PenalisedUnknowns() = default;
  /// \param penalty (i) is D_i, \param coupling (i) is R_ii, of unknowns 0 to \param size - 1. Unknowns
  ///   with infinite D_i are excluded.
  template <class Penalty, class Coupling>
  PenalisedUnknowns(int size, const Penalty& penalty, const Coupling& coupling, const ExecutionContext& context)
    : Indices(Choose(
        size, [&penalty](int i) { return penalty(i) > 0.0 && std::isfinite(penalty(i)); }, context))
    , CoarsePenalties(this->Indices.size())
    , Shares(this->Indices.size())
    , Smoothed(this->Indices.size())
  {
    this->ForEach(context,
      [&](int k, int i)
      {
        const double D = penalty(i);
        const double R = coupling(i);
        this->Shares[k] = static_cast<Real>(R / (R + D));
        this->CoarsePenalties[k] = D * (R / (R + D));
      });
  }

  /// Ascending.
  const std::vector<int>& Unknowns() const { return this->Indices; }

  /// Multiplies the rows of a prolongation to Unknowns by the roots of their coarse penalties: what the coarse matrix
  /// has of them is then the product of these rows and their adjoint.
  template <class Matrix>
  void ScaleRows(Matrix& rows, const ExecutionContext& context) const
  {
    using Factor = typename Eigen::NumTraits<typename Matrix::Scalar>::Real;
    this->ForEach(context,
      [this, &rows](int k, int)
      {
        const auto root = static_cast<Factor>(std::sqrt(this->CoarsePenalties[k]));
        for (int e = rows.outerIndexPtr()[k]; e < rows.outerIndexPtr()[k + 1]; ++e)
        {
          rows.valuePtr()[e] *= root;
        }
      });
  }

  /// Scales a residual that is to be restricted for the coarse correction of x.
  void ScaleResidual(Vector<Scalar>& residual, const Vector<Scalar>& x, const ExecutionContext& context)
  {
    this->ForEach(context,
      [this, &residual, &x](int k, int i)
      {
        residual[i] *= this->Shares[k];
        this->Smoothed[k] = x[i];
      });
  }

  /// Scales the coarse correction, which has been added to x.
  void ScaleCorrection(Vector<Scalar>& x, const ExecutionContext& context) const
  {
    this->ForEach(
      context, [this, &x](int k, int i) { x[i] = this->Smoothed[k] + this->Shares[k] * (x[i] - this->Smoothed[k]); });
  }

  long long Bytes() const
  {
    return static_cast<long long>(
      this->Indices.size() * (sizeof(int) + sizeof(double) + sizeof(Real) + sizeof(Scalar)));
  }

private:
  using Real = typename Eigen::NumTraits<Scalar>::Real;

  /// Calls visit (k, i) for unknown i = Indices [k].
  template <class Visit>
  void ForEach(const ExecutionContext& context, const Visit& visit) const
  {
    constexpr int Grain = 8192;
    context.ParallelFor(0, static_cast<int>(this->Indices.size()), Grain,
      [this, &visit](int first, int last)
      {
        for (int k = first; k < last; ++k)
        {
          visit(k, this->Indices[k]);
        }
      });
  }

  std::vector<int> Indices;
  Vector<double> CoarsePenalties; ///< D_i R_ii / (R_ii + D_i)
  Vector<Real> Shares;            ///< R_ii / (R_ii + D_i)
  Vector<Scalar> Smoothed;        ///< x before the coarse correction
};

}

#endif
