#ifndef dmgSolveInUnits_h
#define dmgSolveInUnits_h

#include "Solvers/HarmonicProblem.h"

namespace dmg
{

struct Solution
{
  Vector<double> Unknowns;
  SolveReport Report;
};

/// HarmonicProblem::Solve for values and sources of any size: they are divided by a power of two, which makes the largest one about 1,
/// and the solution is multiplied by it. This loses no bit, and the cycles, which compute in single precision, do not
/// run out of its range.
/// \throw SolverFailure the solution is not finite.
Solution SolveInUnits(HarmonicProblem& problem, const Vector<double>& values, const Vector<double>& start,
  const StoppingCriteria& stop, const ExecutionContext& context, const Vector<double>& source = {});

}

#endif
