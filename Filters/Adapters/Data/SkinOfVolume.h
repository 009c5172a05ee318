#ifndef dmgSkinOfVolume_h
#define dmgSkinOfVolume_h

#include "vtkSmartPointer.h"

class vtkDataSet;
class vtkInformation;

namespace dmg
{

/// Whether the input of a pipeline is an image or another grid of rows with cells of three dimensions, whose skin is no grid of rows.
/// Asks the source for its extent, which may have changed.
bool IsStructuredVolume(vtkInformation* input);

/// Whether some cell has three dimensions.
bool IsVolume(vtkDataSet* dataset);

/// Whether some cell has two or three dimensions. \pre CheckCells.
bool HasSurface(vtkDataSet* dataset);

/// The skin of a dataset with cells of three dimensions, as vtkGeometryFilter makes it, with its arrays: the sides of these cells that
/// belong to one alone, and all cells of fewer dimensions. A vtkPolyData, and a vtkUnstructuredGrid where the dataset is one.
/// \pre CheckCells; IsVolume.
vtkSmartPointer<vtkDataSet> SkinOfVolume(vtkDataSet* dataset);

}

#endif
