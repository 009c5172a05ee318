#ifndef dmgBenchmarksPeakMemory_h
#define dmgBenchmarksPeakMemory_h

#include <algorithm>
#include <fstream>
#include <limits>
#include <string>

#include <malloc.h>

namespace dmg::benchmarks
{

/// Counts the memory that this process touches from now on, as Linux accounts for it: everything,
/// with the workspaces of a factorisation that nobody else tells of.
class PeakMemory
{
public:
  PeakMemory()
  {
    malloc_trim(0); // what was freed would be reused unseen
    this->Before = Megabytes("VmHWM:");
    this->IsReset = static_cast<bool>(std::ofstream("/proc/self/clear_refs") << "5" << std::flush);
    this->Base = Megabytes("VmRSS:");
  }

  /// Beyond what was held at the start; NaN where the system does not tell.
  double Growth() const
  {
    return this->IsReset ? Megabytes("VmHWM:") - this->Base : std::numeric_limits<double>::quiet_NaN();
  }

  /// Of the process since it began.
  double OfProcess() const { return std::max(this->Before, Megabytes("VmHWM:")); }

private:
  static double Megabytes(const std::string& name)
  {
    std::ifstream status("/proc/self/status");
    for (std::string word; status >> word;)
    {
      double kibibytes = 0.0;
      if (word == name && status >> kibibytes)
      {
        return 1024e-6 * kibibytes;
      }
    }
    return std::numeric_limits<double>::quiet_NaN();
  }

  double Before;
  bool IsReset;
  double Base;
};

}

#endif
