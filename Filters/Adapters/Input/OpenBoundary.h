#ifndef dmgOpenBoundary_h
#define dmgOpenBoundary_h

#include "Adapters/View/ChosenArrays.h"
#include "Adapters/View/SurfaceView.h"
#include "Flows/FlowBoundary.h"

#include <vector>

namespace dmg
{

/// The open edges of the boundary. Where an array is chosen, these are the edges of a cell, or between two points, for which its number is
/// neither zero nor NaN; else all or none of them.
/// \param choice an array of 1 component, or none. \param otherwise the kind of all edges where nothing is chosen.
/// \return by edge.
/// \throw InvalidInput as FindArray.
std::vector<char> OpenEdgesOf(const ChosenArray& choice, FlowBoundary otherwise, const SurfaceView& view);

}

#endif
