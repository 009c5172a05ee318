#ifndef dmgYieldingUnknowns_h
#define dmgYieldingUnknowns_h

#include "Support/CountingSort.h"
#include "Support/ExecutionContext.h"
#include "Support/Types.h"

#include <cmath>
#include <vector>

namespace dmg
{

/// The unknowns of A = R + D that D pulls, in a cycle for A.
///
/// An unknown that is pulled does not follow its neighbours, but yields to them by R_ii / (R_ii + D_i): so much of
/// the coarse correction it takes, and of its residual it gives. To a coarse function it is a spring behind a
/// spring, D_i R_ii / (R_ii + D_i), which the coarse matrix has in place of D_i. With D_i itself and a
/// correction that it follows, pulls of a hundred times R_ii took up to five iterations more; usual ones take
/// one more at most, and no time to speak of.
template <class Scalar>
class YieldingUnknowns
{
public:
  /// None.
  YieldingUnknowns() = default;
  /// \param pull (i) is D_i, \param coupling (i) is R_ii, of unknowns 0 to \param size - 1. Those with an
  ///   infinite D_i are held and none of ours.
  template <class Pull, class Coupling>
  YieldingUnknowns(
    int size, const Pull& pull, const Coupling& coupling, const ExecutionContext& context)
    : Indices(Choose(
        size, [&pull](int i) { return pull(i) > 0.0 && std::isfinite(pull(i)); }, context))
    , Springs(this->Indices.size())
    , Shares(this->Indices.size())
    , Smoothed(this->Indices.size())
  {
    this->ForEach(context, [&](int k, int i) {
      const double D = pull(i);
      const double R = coupling(i);
      this->Shares[k] = static_cast<Real>(R / (R + D));
      this->Springs[k] = D * (R / (R + D));
    });
  }

  /// Ascending.
  const std::vector<int>& Unknowns() const { return this->Indices; }

  /// Multiplies the rows of a prolongation to Unknowns by the roots of their springs: what the coarse matrix
  /// has of them is then the product of these rows and their adjoint.
  template <class Matrix>
  void ScaleRows(Matrix& rows, const ExecutionContext& context) const
  {
    using Factor = typename Eigen::NumTraits<typename Matrix::Scalar>::Real;
    this->ForEach(context, [this, &rows](int k, int) {
      const auto root = static_cast<Factor>(std::sqrt(this->Springs[k]));
      for (int e = rows.outerIndexPtr()[k]; e < rows.outerIndexPtr()[k + 1]; ++e)
      {
        rows.valuePtr()[e] *= root;
      }
    });
  }

  /// Before the coarse correction of x, for which residual is restricted.
  void Yield(Vector<Scalar>& residual, const Vector<Scalar>& x, const ExecutionContext& context)
  {
    this->ForEach(context, [this, &residual, &x](int k, int i) {
      residual[i] *= this->Shares[k];
      this->Smoothed[k] = x[i];
    });
  }

  /// After it.
  void Resist(Vector<Scalar>& x, const ExecutionContext& context) const
  {
    this->ForEach(context, [this, &x](int k, int i) {
      x[i] = this->Smoothed[k] + this->Shares[k] * (x[i] - this->Smoothed[k]);
    });
  }

  long long Bytes() const
  {
    return static_cast<long long>(this->Indices.size() *
      (sizeof(int) + sizeof(double) + sizeof(Real) + sizeof(Scalar)));
  }

private:
  using Real = typename Eigen::NumTraits<Scalar>::Real;

  /// Calls visit (k, i) for unknown i = Indices [k].
  template <class Visit>
  void ForEach(const ExecutionContext& context, const Visit& visit) const
  {
    constexpr int Grain = 8192;
    context.ParallelFor(
      0, static_cast<int>(this->Indices.size()), Grain, [this, &visit](int first, int last) {
        for (int k = first; k < last; ++k)
        {
          visit(k, this->Indices[k]);
        }
      });
  }

  std::vector<int> Indices;
  Vector<double> Springs;  ///< D_i R_ii / (R_ii + D_i)
  Vector<Real> Shares;     ///< R_ii / (R_ii + D_i)
  Vector<Scalar> Smoothed; ///< x before the coarse correction
};

}

#endif
