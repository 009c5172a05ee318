#ifndef dmgFillValues_h
#define dmgFillValues_h

#include <string>
#include <vector>

class vtkDataArray;

namespace dmg
{

/// Looks for the values that files have where nothing was measured. They are infinite, or known (1e20, 9.96921e36, -9999, -32767 and so on) and
/// far from the median of the others, or several of one size that is far from all others. The values of a pulse in a calm are not: these
/// have all sizes.
/// \param isLeftOut by tuple of the arrays, which are as long: those that are not looked at.
/// \param what the name of the numbers in messages, as in "flow".
/// \return a sentence about numbers that may be fill values; empty where there are none.
/// \throw InvalidInput numbers can only be fill values: infinite, or known and 1e8 times the median of the others. Cost: linear.
std::string SuspectedFillValues(
  const std::vector<vtkDataArray*>& arrays, const std::vector<char>& isLeftOut, const std::string& what);

}

#endif
