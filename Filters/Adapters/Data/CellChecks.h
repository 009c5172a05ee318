#ifndef dmgCellChecks_h
#define dmgCellChecks_h

#include <string>

class vtkDataSet;

namespace dmg
{

/// Checks what VTK trusts as it reads cells: files may be damaged, and scripts may be wrong.
/// \param whose of the dataset in messages, as in "the surface".
/// \throw InvalidInput a cell of any type uses a point that is not there; a cell of two dimensions, or any cell of a volume, has too few
/// points for its type; a polyhedron has no faces, or faces of points that are not there; the lists of points, types or coordinates are
/// shorter than the dataset says. The message names the cell.
/// Cost: linear, one pass over the points of cells.
void CheckCells(vtkDataSet* dataset, const std::string& whose);

}

#endif
