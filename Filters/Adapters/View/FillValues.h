#ifndef dmgFillValues_h
#define dmgFillValues_h

#include "vtkType.h"

#include <string>
#include <vector>

class vtkDataArray;

namespace dmg
{

/// Looks for the values that files have where nothing was measured. They are infinite, or known (1e20, 9.96921e36, -9999, -32767 and so on) and
/// far from the median of all that are not known. So a pulse in a calm is none, whose values are any.
/// \param isLeftOut by tuple of the arrays, which are as long: those that are not looked at.
/// \param what the name of the values in messages, as in "flow".
/// \return a sentence about values that may be fill values; empty where there are none.
/// \throw InvalidInput values can only be fill values: infinite, or known and 1e8 times the median of the others. Cost: linear.
std::string SuspectedFillValues(
  const std::vector<vtkDataArray*>& arrays, const std::vector<char>& isLeftOut, const std::string& what);

/// The same, where tuples with a number that is not finite are left out, as somebody counts them.
std::string SuspectedFillValues(const std::vector<vtkDataArray*>& arrays, vtkIdType tuples, const std::string& what);

/// Whether a number is not finite or has a size that files are known to have where nothing was measured. Then the values of the whole surface have to be
/// looked at together; else no piece has gaps.
bool MayHaveGaps(const std::vector<vtkDataArray*>& arrays, vtkIdType tuples);

/// Marks the tuples of which a number of an array is such: NaN, or not finite.
std::vector<char> TuplesWith(bool (*isSuch)(double), const std::vector<vtkDataArray*>& arrays, vtkIdType tuples);

}

#endif
