#ifndef dmgPreconditioner_h
#define dmgPreconditioner_h

#include "Support/ExecutionContext.h"
#include "Support/Types.h"

namespace dmg
{

/// A linear operator B that is close to the inverse of a matrix A.
template <class Scalar>
class Preconditioner
{
public:
  virtual ~Preconditioner() = default;

  /// z = B r. May use a workspace of the preconditioner: one application at a time.
  virtual void Apply(const Vector<Scalar>& r, Vector<Scalar>& z, const ExecutionContext& context) = 0;
};

}

#endif
