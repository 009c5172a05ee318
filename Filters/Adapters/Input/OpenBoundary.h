#ifndef dmgOpenBoundary_h
#define dmgOpenBoundary_h

#include "Adapters/Input/ChosenArrays.h"
#include "Adapters/Surface/MeshFromDataSet.h"

#include <vector>

class vtkDataSet;

namespace dmg
{

/// The boundary edges that an array says to be open: those of a cell, or between two points, for which its number is neither zero nor
/// NaN.
/// \param choice an array of 1 component, or none.
/// \return by edge; empty where nothing is chosen.
/// \throw InvalidInput as FindArray.
std::vector<char> OpenEdgesOf(const ChosenArray& choice, vtkDataSet* input, const FramedSurface& surface);

}

#endif
