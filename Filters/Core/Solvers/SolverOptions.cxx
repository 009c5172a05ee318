#include "Solvers/SolverOptions.h"

namespace dmg
{
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

bool IsNested(SolverKind kind)
{
  return kind == SolverKind::NestedIterations || kind == SolverKind::CoarseProlongation;
}

SolverChoice ChooseSolver(const SolverOptions& options, const SolverTuning& tuning, int numberOfUnknowns,
  bool hasLevels, const std::string& whyFactor)
{
  const SolverKind asked = options.Kind;
  const std::string size = ", chosen for " + std::to_string(numberOfUnknowns) + " unknowns";
  const std::string largest = std::to_string(tuning.LargestForCholesky);
  if (asked == SolverKind::Automatic && numberOfUnknowns <= tuning.LargestForCholesky)
  {
    return { SolverKind::Cholesky, size + ", few enough to factor at once (up to " + largest + ")" };
  }
  if (asked == SolverKind::Automatic && !whyFactor.empty())
  {
    return { SolverKind::Cholesky, whyFactor };
  }
  if (asked == SolverKind::Automatic && options.ExpectedSolves >= tuning.SolvesForCholesky)
  {
    return { SolverKind::Cholesky,
      size + " and " + std::to_string(options.ExpectedSolves) + " solves, enough for a factor to pay (" +
        std::to_string(tuning.SolvesForCholesky) + " or more)" };
  }
  if (asked == SolverKind::Cholesky)
  {
    return { asked, "" };
  }
  if (!hasLevels)
  {
    // Multigrid on one level is its exact solver.
    const std::string instead = asked == SolverKind::Automatic ? "chosen" : "in place of " + NameOf(asked);
    return { SolverKind::Cholesky, ", " + instead + " because there are no coarse levels" };
  }
  return asked == SolverKind::Automatic
    ? SolverChoice{ SolverKind::ConjugateGradients, size + ", too many to factor at once (more than " + largest + ")" }
    : SolverChoice{ asked, "" };
}

}
