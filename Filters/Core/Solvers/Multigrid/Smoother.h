#ifndef dmgSmoother_h
#define dmgSmoother_h

#include "Solvers/Kernels/TriangularParts.h"
#include "Support/ExecutionContext.h"
#include "Support/Types.h"

#include <memory>
#include <vector>

namespace dmg
{

struct SmootherOptions
{
  /// Sweeps before the coarse correction, >= 0.
  int PreSweeps = 2;
  /// Sweeps after it, >= 0; equal to PreSweeps inside conjugate gradients, which need symmetry.
  int PostSweeps = 2;
};

/// Damps the part of an error that a coarser level cannot represent, for a symmetric or Hermitian
/// positive semi-definite matrix A: Gauss-Seidel in a SweepOrder; sweeps go forward and backward in turn.
///
/// Value is double, float or their complex numbers. Same bits for any number of threads.
template <class Value>
class Smoother
{
public:
  using Real = typename Eigen::NumTraits<Value>::Real;

  /// A smoother for a matrix with unit diagonal.
  /// \param A borrowed.
  static std::unique_ptr<Smoother> New(const TriangularParts<Value>& A, const SmootherOptions& options);

  /// A smoother for a matrix with any other diagonal.
  /// \param inverseDiagonal 1 / A_ii, borrowed; or 0: the unknown is held at zero, and its residual has no
  ///   meaning.
  static std::unique_ptr<Smoother> NewWithDiagonal(
    const TriangularParts<Value>& A, const Vector<Real>& inverseDiagonal, const SmootherOptions& options);
  virtual ~Smoother() = default;

  /// Smooths A x = b from x = 0.
  /// \param x on exit the result.
  /// \return its residual b - A x, in room of the smoother that the next call uses again.
  virtual Vector<Value>& PreSmooth(const Vector<Value>& b, Vector<Value>& x, const ExecutionContext& context) = 0;

  /// Smooths A x = b from the given x by the adjoint of the iteration of PreSmooth.
  virtual void PostSmooth(const Vector<Value>& b, Vector<Value>& x, const ExecutionContext& context) = 0;

  /// Held by this object.
  virtual long long Bytes() const = 0;
};

}

#endif
