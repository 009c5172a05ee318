#ifndef dmgCellChecks_h
#define dmgCellChecks_h

#include <string>

class vtkDataSet;

namespace dmg
{

/// Checks what VTK trusts as it reads cells: files may be damaged, and scripts may be wrong.
/// \param whose of the dataset in messages, as in "the surface".
/// \throw InvalidInput a cell of any type uses a point that is not there; a cell of two dimensions has too few points for its
/// type; the lists of points, types or coordinates are shorter than the dataset says. The message names the cell.
/// Cost: linear, one pass over the points of cells.
void CheckCells(vtkDataSet* dataset, const std::string& whose);

}

#endif
