#ifndef dmgLinearOperator_h
#define dmgLinearOperator_h

#include "Support/ExecutionContext.h"
#include "Support/Types.h"

namespace dmg
{

/// A Hermitian positive semi-definite matrix, known by what it makes of a vector. Several processes may have some of its rows each, and the same
/// entries of vectors; then all functions but Size are collective.
template <class Scalar>
class LinearOperator
{
public:
  virtual ~LinearOperator() = default;

  /// Rows, and columns; those of this process.
  virtual int Size() const = 0;

  /// y = A x. May use a workspace of the operator: one application at a time.
  /// \return x^H A x, over all processes.
  virtual double Apply(const Vector<Scalar>& x, Vector<Scalar>& y, const ExecutionContext& context) const = 0;

  /// The sum of a number over the processes that have rows.
  virtual double Sum(double here) const { return here; }

  /// 1 / A_ii, one per row, 0 where it is not defined; null where it is not known.
  virtual const Vector<double>* InverseDiagonal() const { return nullptr; }
};

}

#endif
