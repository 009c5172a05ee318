#ifndef dmgWithoutStrips_h
#define dmgWithoutStrips_h

#include "vtkSmartPointer.h"

class vtkDataSet;

namespace dmg
{

/// The dataset itself or, where it is a vtkPolyData with triangle strips, a copy with a triangle for each of theirs, after
/// the polygons; these have the arrays of their strip. Arrays that are shorter than the cells end where they ended.
/// \pre CheckCells.
vtkSmartPointer<vtkDataSet> WithoutStrips(vtkDataSet* surface);

}

#endif
