#ifndef dmgSolverOfDataSet_h
#define dmgSolverOfDataSet_h

#include "Adapters/Surface/MeshFromDataSet.h"
#include "Field.h"

namespace dmg
{

/// A solver for the surface of a dataset, which a filter keeps from one execution to the next. Subclasses have the whole surface or the
/// piece of a rank. Keys are contents, not modification times.
class SolverOfDataSet
{
public:
  virtual ~SolverOfDataSet() = default;

  /// The surface that fields are on.
  virtual FramedSurface Surface() const = 0;
  /// The changes that made the surface a mesh.
  virtual const PreparationReport& Preparation() const = 0;
  /// The sum over the surface, its operators, and the set-up of a field on it.
  virtual double SetupSeconds(const Field& field) const = 0;
};

}

#endif
