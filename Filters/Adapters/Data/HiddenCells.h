#ifndef dmgHiddenCells_h
#define dmgHiddenCells_h

#include "vtkSmartPointer.h"

#include <vector>

class vtkDataSet;

namespace dmg
{

/// A copy of a dataset in which these cells are hidden, besides those that are (vtkDataSetAttributes::HIDDENCELL), so that they take no
/// part. \param isHidden by cell.
vtkSmartPointer<vtkDataSet> WithHidden(vtkDataSet* dataset, const std::vector<char>& isHidden);

}

#endif
