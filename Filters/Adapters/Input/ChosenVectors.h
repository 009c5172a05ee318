#ifndef dmgChosenVectors_h
#define dmgChosenVectors_h

#include <string>

class vtkAlgorithm;
class vtkDataArray;
class vtkDataSet;

namespace dmg
{

/// The array that a field is drawn from.
struct ChosenVectors
{
  vtkDataArray* Array = nullptr; ///< vectors of 2 or 3 numbers, or tensors
  bool OnPoints = false;
};

/// The array that was chosen with SetInputArrayToProcess, index 0, or else the default (see ReadField).
/// \throw WrongChoice a chosen array that is not there, holds neither vectors nor tensors, or holds the normals; a surface without
/// vectors. InvalidInput: it has not a tuple for every element.
ChosenVectors ChooseVectors(vtkAlgorithm* algorithm, vtkDataSet* surface);

/// The number of directions that an array stands for, by its name.
int NumberOfDirections(vtkDataSet* surface, const ChosenVectors& chosen);

/// Whether an array shows a power field at points, whose singularities stand on cells.
bool IsFieldAtPoints(vtkDataSet* surface, const ChosenVectors& chosen);

std::string NameOf(vtkDataArray* array);

/// \throw InvalidInput there is not a tuple for every element.
void CheckTuples(vtkDataArray* array, vtkDataSet* surface, bool isOnPoints);

}

#endif
