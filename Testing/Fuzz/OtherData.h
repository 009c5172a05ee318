#ifndef dmgOtherData_h
#define dmgOtherData_h

#include "Fuzz/Choices.h"

#include "vtkDataObject.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"
#include "vtkUnstructuredGrid.h"

namespace dmg::test
{

/// The same cells as an unstructured grid of any types, some with too few points or with points that are not there, beside lines
/// and arrays that are too short or not finite.
vtkSmartPointer<vtkUnstructuredGrid> DamagedGrid(Choices& choose, vtkPolyData* surface);

/// Cells of three dimensions of all types, polyhedra among them, beside curves and triangles; some with a wrong number of points or with
/// points that are not there, and arrays of any length.
vtkSmartPointer<vtkDataObject> VolumeOf(Choices& choose);

/// Up to four blocks: surfaces, volumes, lines, tables, groups of these, and none.
vtkSmartPointer<vtkDataObject> BlocksOf(Choices& choose, vtkPolyData* surface);

}

#endif
