#ifndef dmgSumOverProcesses_h
#define dmgSumOverProcesses_h

#include <functional>

namespace dmg
{

/// Adds up numbers of all processes, in place: a hook for vectors of which each process has some entries. It is collective. Empty:
/// vectors are whole.
using SumOverProcesses = std::function<void(double* numbers, int size)>;

}

#endif
