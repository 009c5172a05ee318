#ifndef dmgSolvedField_h
#define dmgSolvedField_h

#include "Discretisations/Discretisation.h"
#include "Mesh/FramedMesh.h"
#include "Solvers/Krylov/SolveReport.h"
#include "Support/ExecutionContext.h"
#include "Support/Types.h"

namespace dmg
{

/// A field on a surface that some solver has found, and what it took: all that is asked of it to show it.
class SolvedField
{
public:
  virtual ~SolvedField() = default;

  virtual const FramedMesh& Surface() const = 0;

  // Results of the last solve. \pre there was one.

  virtual const Discretisation& Field() const = 0;
  virtual const FieldConstraints& Constraints() const = 0;
  virtual const Vector<double>& Unknowns() const = 0;
  virtual const SolveReport& Report() const = 0;
  /// Direction k of each face as a vector in space, of the field's magnitude; #F x 3.
  Points Directions(int k, const ExecutionContext& context = SerialContext()) const;
  /// The harmonic fields that the solver knows of: any basis, a column each. None where it has not needed them, or there are
  /// too many to hold.
  virtual Eigen::MatrixXd HarmonicFields() const = 0;

  /// The number of times that each stage has been completed. Given operators make no set-up, and neither does one that is found
  /// again.
  struct StageCounts
  {
    int Setups = 0;
    int Systems = 0;
    int Solves = 0;
  };
  virtual const StageCounts& Counts() const = 0;
  /// The seconds that the set-up of the last solve has taken.
  virtual double SetupSeconds() const = 0;
};

}

#endif
