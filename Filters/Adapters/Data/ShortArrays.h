#ifndef dmgShortArrays_h
#define dmgShortArrays_h

#include "vtkType.h"

class vtkDataSetAttributes;

namespace dmg
{

/// Removes the arrays that are shorter than the elements of a dataset: VTK would copy tuples that are not there.
void RemoveShortArrays(vtkDataSetAttributes* data, vtkIdType elements);

}

#endif
