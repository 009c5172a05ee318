#ifndef dmgStoppingCriteria_h
#define dmgStoppingCriteria_h

#include <tuple>

namespace dmg
{

/// Criteria by which an iterative solver stops.
struct StoppingCriteria
{
  /// The bound of IterationReport::RelativeResidual; > 0.
  double RelativeTolerance = 1e-8;
  /// >= 1
  int MaximumIterations = 100;
  /// Whether the residual that ends the iteration may be an estimate; see IterationMonitor.
  bool MayEstimate = false;

  friend bool operator==(const StoppingCriteria& a, const StoppingCriteria& b)
  {
    const auto members = [](const StoppingCriteria& stop)
    {
      const auto& [tolerance, iterations, mayEstimate] = stop; // all of them, or it does not compile
      return std::tie(tolerance, iterations, mayEstimate);
    };
    return members(a) == members(b);
  }
};

}

#endif
