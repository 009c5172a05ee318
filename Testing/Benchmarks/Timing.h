#ifndef dmgBenchmarksTiming_h
#define dmgBenchmarksTiming_h

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <fstream>
#include <string>
#include <thread>
#include <vector>

#include <dlfcn.h>

namespace dmg::benchmarks
{

/// Wall-clock seconds of a call.
template <class Function>
double Seconds(Function function)
{
  const auto start = std::chrono::steady_clock::now();
  function();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

inline double Median(std::vector<double> values)
{
  std::nth_element(values.begin(), values.begin() + values.size() / 2, values.end());
  return values[values.size() / 2];
}

/// Of OpenBLAS, where it is what is linked.
inline void UseBlasThreads(int threads)
{
  using SetNumber = void (*)(int);
  if (const auto set = reinterpret_cast<SetNumber>(dlsym(RTLD_DEFAULT, "openblas_set_num_threads")))
  {
    set(threads);
  }
}

/// A line that says where the numbers below it come from.
inline void PrintMachine(int threads, int runs)
{
  std::string model = "unknown processor";
  std::ifstream info("/proc/cpuinfo");
  for (std::string line; std::getline(info, line);)
  {
    if (line.rfind("model name", 0) == 0)
    {
      model = line.substr(line.find(':') + 2);
      break;
    }
  }
  double load = 0.0;
  std::ifstream("/proc/loadavg") >> load;
  std::printf("%s, %u processors, load %.1f; %d threads, medians of %d runs\n", model.c_str(),
    std::thread::hardware_concurrency(), load, threads, runs);
}

/// A file's name without folder and ending.
inline std::string BaseName(const std::string& path)
{
  const std::size_t slash = path.find_last_of('/');
  const std::string name = slash == std::string::npos ? path : path.substr(slash + 1);
  return name.substr(0, name.find_last_of('.'));
}

}

#endif
