#ifndef dmgStoppingCriteria_h
#define dmgStoppingCriteria_h

namespace dmg
{

/// When an iterative solver may stop.
struct StoppingCriteria
{
  /// Of the residual's norm, relative to the right-hand side's; > 0.
  double RelativeTolerance = 1e-8;
  /// >= 1
  int MaximumIterations = 100;
};

}

#endif
