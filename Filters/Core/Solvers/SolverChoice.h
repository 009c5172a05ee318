#ifndef dmgSolverChoice_h
#define dmgSolverChoice_h

#include "Solvers/SolverMethod.h"
#include "Solvers/SolverOptions.h"

#include <string>

namespace dmg
{

/// The method that runs, and why if it is not the one asked for.
struct SolverChoice
{
  const SolverMethod* Method = &MethodOf(SolverKind::Cholesky);
  std::string Reason; ///< the rest of a sentence, or empty
};

/// \param hasLevels whether there are coarse levels. Methods that need them give way to a factor where there are none.
/// \param whyFactor Automatic factors where this is not empty; the rest of a sentence for the report.
SolverChoice ChooseSolver(const SolverOptions& options, const SolverTuning& tuning, int numberOfUnknowns,
  bool hasLevels, const std::string& whyFactor = {});

}

#endif
