#include "Solvers/SolverChoice.h"

#include <cmath>

namespace dmg
{
namespace
{

/// Automatic makes no larger factors for the sake of many solves, in bytes; most computers hold one that is as large.
constexpr double LargestFactor = 4e9;

/// The number of expected solves from which a factor pays.
double SolvesForFactor(const SolverTuning& tuning, int numberOfUnknowns)
{
  return std::ceil(tuning.SolvesForFactor * std::sqrt(numberOfUnknowns));
}

bool FitsFactor(const SolverTuning& tuning, int numberOfUnknowns)
{
  return tuning.BytesOfFactor * numberOfUnknowns * std::log2(numberOfUnknowns) <= LargestFactor;
}

/// Why Automatic factors a system of this size, or empty.
std::string WhyToFactor(const SolverOptions& options, const SolverTuning& tuning, int numberOfUnknowns,
  const std::string& size, const std::string& whyFactor)
{
  if (numberOfUnknowns <= tuning.LargestForCholesky)
  {
    return size + ", few enough to factor at once (up to " + std::to_string(tuning.LargestForCholesky) + ")";
  }
  if (!whyFactor.empty())
  {
    return whyFactor;
  }
  const double least = SolvesForFactor(tuning, numberOfUnknowns);
  if (options.ExpectedSolves >= least && FitsFactor(tuning, numberOfUnknowns))
  {
    return size + " and " + std::to_string(options.ExpectedSolves) + " solves, enough for a factor to pay (" +
      std::to_string(std::lround(least)) + " or more)";
  }
  return "";
}

}

SolverChoice ChooseSolver(const SolverOptions& options, const SolverTuning& tuning, int numberOfUnknowns,
  bool hasLevels, const std::string& whyFactor)
{
  const SolverMethod& factor = MethodOf(SolverKind::Cholesky);
  const SolverMethod& asked = MethodOf(options.Kind);
  const bool isAutomatic = options.Kind == SolverKind::Automatic;
  const std::string size = ", chosen for " + std::to_string(numberOfUnknowns) + " unknowns";
  const std::string reason =
    isAutomatic ? WhyToFactor(options, tuning, numberOfUnknowns, size, whyFactor) : std::string();
  if (!reason.empty())
  {
    return { &factor, reason };
  }
  if (asked.NeedsLevels && !hasLevels)
  {
    // Multigrid on one level is its exact solver.
    const std::string instead = isAutomatic ? "chosen" : "in place of " + asked.Name;
    return { &factor, ", " + instead + " because there are no coarse levels" };
  }
  return { &asked,
    isAutomatic ? size + ", too many to factor at once (more than " + std::to_string(tuning.LargestForCholesky) + ")"
                : "" };
}

}
