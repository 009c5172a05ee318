#ifndef dmgStopwatch_h
#define dmgStopwatch_h

#include <chrono>

namespace dmg
{

/// Measures the time since it was made.
class Stopwatch
{
public:
  double Seconds() const { return std::chrono::duration<double>(Clock::now() - this->Start).count(); }

private:
  using Clock = std::chrono::steady_clock;
  const Clock::time_point Start = Clock::now();
};

}

#endif
