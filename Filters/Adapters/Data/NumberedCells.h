#ifndef dmgNumberedCells_h
#define dmgNumberedCells_h

#include "vtkSmartPointer.h"

class vtkDataSet;

namespace dmg
{

/// A dataset whose cells have numbers. VTK numbers the cells of a vtkPolyData when the first is read, and gives up where one has too
/// few points for its list, as a line of one point; VTK 9.1 then reads through a null pointer.
/// \return such a vtkPolyData as a vtkUnstructuredGrid of the same points, cells and arrays; any other dataset itself.
/// Cost: linear, one pass over the sizes of cells.
vtkSmartPointer<vtkDataSet> WithNumberedCells(vtkDataSet* dataset);

}

#endif
