#ifndef dmgChosenVectors_h
#define dmgChosenVectors_h

#include "Adapters/View/ChosenArrays.h"

#include <string>

namespace dmg
{

/// The array that a field is drawn from, vectors of 2 or 3 numbers or tensors: that which was chosen with SetInputArrayToProcess,
/// index 0, or else the default (see ReadField).
/// \throw WrongChoice a chosen array that is not there, holds neither vectors nor tensors, or holds the normals; a surface without
/// vectors. InvalidInput: it has not a tuple for every element.
ChosenArray ChooseVectors(vtkAlgorithm* algorithm, vtkDataSet* surface);

/// The number of directions that an array stands for. Of Direction0 it is what the solver has left in the field data, else the number
/// of arrays Direction0, Direction1, ... It is 2 of principal directions and tensors, and 1 of any other array.
int NumberOfDirections(vtkDataSet* surface, const ChosenArray& chosen);

/// Whether an array shows a power field at points, whose singularities stand on cells.
bool IsFieldAtPoints(vtkDataSet* surface, const ChosenArray& chosen);

std::string NameOf(vtkDataArray* array);

/// \throw InvalidInput there is not a tuple for every point or cell.
void CheckTuples(vtkDataArray* array, vtkDataSet* surface, int association);

}

#endif
