#ifndef dmgStoppingCriteria_h
#define dmgStoppingCriteria_h

#include <tuple>

namespace dmg
{

/// When an iterative solver may stop.
struct StoppingCriteria
{
  /// Of IterationReport::RelativeResidual; > 0.
  double RelativeTolerance = 1e-8;
  /// >= 1
  int MaximumIterations = 100;

  friend bool operator==(const StoppingCriteria& a, const StoppingCriteria& b)
  {
    const auto members = [](const StoppingCriteria& stop) {
      const auto& [tolerance, iterations] = stop; // all of them, or it does not compile
      return std::tie(tolerance, iterations);
    };
    return members(a) == members(b);
  }
};

}

#endif
