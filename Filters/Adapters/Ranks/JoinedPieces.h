#ifndef dmgJoinedPieces_h
#define dmgJoinedPieces_h

#include "vtkSmartPointer.h"

#include <vector>

class vtkDataObject;
class vtkDataSet;

namespace dmg
{

/// The dataset without its ghosts: cells that are duplicates or hidden, and cells with hidden points, are left out, and so are the
/// arrays that say so. The dataset itself where it has none of these arrays.
/// \pre it is a vtkPolyData or a vtkUnstructuredGrid; any other object is returned as it is.
vtkSmartPointer<vtkDataObject> WithoutGhosts(vtkDataObject* piece);

/// The dataset that the pieces are parts of: all their cells one after the other, with the arrays that all of them have, and the field
/// data of the first one. Points are one where they have the same global id. Without global ids, points of different pieces are one
/// where they are at the same place, but for some roundings of the largest coordinate, and no piece has two of them there.
/// \param pieces at least one, all vtkPolyData or all vtkUnstructuredGrid. Pieces of other or different types become the blocks of a
/// vtkMultiBlockDataSet.
/// Cost: linear, besides sorting the points.
vtkSmartPointer<vtkDataObject> JoinedPieces(const std::vector<vtkSmartPointer<vtkDataObject>>& pieces);

}

#endif
