#ifndef dmgSumOverProcesses_h
#define dmgSumOverProcesses_h

#include <functional>

namespace dmg
{

/// Where vectors are spread over several processes, each of which has some of their entries: adds up numbers of all processes, in
/// place. It is collective. Empty: vectors are whole.
using SumOverProcesses = std::function<void(double* numbers, int size)>;

}

#endif
