#ifndef dmgOutputTable_h
#define dmgOutputTable_h

#include <string>
#include <vector>

class vtkDataSet;

namespace dmg
{

/// An array that a filter writes. The header of the filter tells its meaning, in a table with the same names, places and components.
struct OutputArray
{
  enum Place : unsigned
  {
    Cells = 1,
    Points = 2,
    FieldData = 4, ///< with any number of tuples
    Columns = 8    ///< of a vtkTable
  };

  const char* Filter; ///< its class
  int Port;
  const char* Name;
  unsigned Places; ///< the sum of them
  int Components;  ///< or the largest int, where the input says how many
  /// Names that end with a number have one from First to Last; others have Last < First.
  int First = 0, Last = -1;

  bool IsNamed(const std::string& name) const;
};

/// The arrays of all filters. What vtkOrientedSurfaceAlgorithm is said to write, all its subclasses write.
const std::vector<OutputArray>& OutputTable();

/// Takes away the arrays that a former execution of a filter may have left in its first output, and the next one may not write.
/// \param filter its class.
void RemoveOutputs(const std::string& filter, vtkDataSet* output);

}

#endif
