#ifndef dmgSmoother_h
#define dmgSmoother_h

#include "Support/ExecutionContext.h"
#include "Support/Types.h"

#include <memory>
#include <vector>

namespace dmg
{

enum class SmootherKind
{
  /// Gauss-Seidel by colours; sweeps go forward and backward in turn. The fastest.
  GaussSeidel,
  /// Jacobi accelerated by Chebyshev polynomials of the fourth kind: one parallel loop per degree.
  Chebyshev,
};

struct SmootherOptions
{
  SmootherKind Kind = SmootherKind::GaussSeidel;
  /// Before the coarse correction, >= 0: Gauss-Seidel sweeps or the degree of the polynomial.
  int PreSweeps = 2;
  /// After it, >= 0; equal to PreSweeps inside conjugate gradients, which need symmetry.
  int PostSweeps = 2;
};

/// The unknowns of a matrix colour by colour: no two of one colour are coupled.
struct ColourOrder
{
  std::vector<int> Unknowns; ///< a permutation
  std::vector<int> Begins;   ///< where each colour begins; one more than colours
};

/// Greedy: each unknown, in ascending order, takes the smallest colour free among its neighbours.
/// Within a colour, unknowns with as many neighbours of earlier and of later colours follow each
/// other, so that loops over their rows repeat their lengths and run a sixth faster; then ascending.
template <class Scalar>
ColourOrder Colouring(const SparseMatrix<Scalar>& A);

/// One colour only, the order of the matrix: what a smoother without colours needs.
ColourOrder SingleColour(int size);

/// A matrix but for its diagonal as smoothers read it: the parts left and right of it, so that half a
/// product touches half the memory. Columns of a row are in any order.
template <class Value>
struct TriangularParts
{
  std::vector<int> Begins; ///< of its colours
  SparseMatrix<Value> Lower;
  SparseMatrix<Value> Upper;
};

/// Damps the part of an error that a coarser level cannot represent, for a symmetric or Hermitian
/// positive semi-definite matrix A.
///
/// Value is double, float or their complex numbers. Same bits for any number of threads.
template <class Value>
class Smoother
{
public:
  using Real = typename Eigen::NumTraits<Value>::Real;

  /// For a unit diagonal.
  /// \param A borrowed.
  static std::unique_ptr<Smoother> New(const TriangularParts<Value>& A,
    const SmootherOptions& options, const ExecutionContext& context);

  /// For any other diagonal, by Gauss-Seidel.
  /// \param inverseDiagonal 1 / A_ii, borrowed; or 0: the unknown is held at zero, and its residual has no
  ///   meaning.
  static std::unique_ptr<Smoother> NewWithDiagonal(const TriangularParts<Value>& A,
    const Vector<Real>& inverseDiagonal, const SmootherOptions& options);
  virtual ~Smoother() = default;

  /// Smooths A x = b from x = 0.
  /// \param x on exit the result.
  /// \return its residual b - A x, in room of the smoother that the next call uses again.
  virtual Vector<Value>& PreSmooth(
    const Vector<Value>& b, Vector<Value>& x, const ExecutionContext& context) = 0;

  /// Smooths A x = b from the given x by the adjoint of the iteration of PreSmooth.
  virtual void PostSmooth(
    const Vector<Value>& b, Vector<Value>& x, const ExecutionContext& context) = 0;

  /// Held by this object.
  virtual long long Bytes() const = 0;
};

}

#endif
