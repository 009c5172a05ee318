#ifndef dmgStageCounts_h
#define dmgStageCounts_h

namespace dmg
{

/// The number of times that each stage of a solver has been completed. Given operators make no set-up, and neither does one that
/// is found again.
struct StageCounts
{
  int Setups = 0;
  int Systems = 0;
  int Solves = 0;
};

inline StageCounts operator+(const StageCounts& a, const StageCounts& b)
{
  return { a.Setups + b.Setups, a.Systems + b.Systems, a.Solves + b.Solves };
}

}

#endif
