#include "SolverChoice.h"

namespace dmg
{
namespace
{

// Below this many unknowns the factorisation is done before multigrid has its levels.
constexpr int LargestSystemForCholesky = 20000;

}

std::string NameOf(SolverKind kind)
{
  switch (kind)
  {
    case SolverKind::Cholesky:
      return "supernodal Cholesky";
    case SolverKind::VCycles:
      return "V-cycles";
    case SolverKind::NestedIterations:
      return "nested iterations";
    case SolverKind::CoarseProlongation:
      return "coarse prolongation";
    default:
      return "conjugate gradients with a V-cycle";
  }
}

SolverChoice ChooseSolver(SolverKind asked, int numberOfUnknowns, bool hasLevels)
{
  if (asked == SolverKind::Cholesky || (asked != SolverKind::Automatic && hasLevels))
  {
    return { asked, "" };
  }
  if (!hasLevels)
  {
    // Multigrid on one level is its exact solver.
    const std::string instead =
      asked == SolverKind::Automatic ? "chosen" : "in place of " + NameOf(asked);
    return { SolverKind::Cholesky, ", " + instead + " because there are no coarse levels" };
  }
  const std::string size = std::to_string(numberOfUnknowns) + " unknowns";
  if (numberOfUnknowns <= LargestSystemForCholesky)
  {
    return { SolverKind::Cholesky, ", chosen for " + size + ", few enough to factor at once" };
  }
  return { SolverKind::ConjugateGradients, ", chosen for " + size };
}

}
