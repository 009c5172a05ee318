#ifndef dmgFeaturesOfSurface_h
#define dmgFeaturesOfSurface_h

#include "Adapters/Output/SolvedSurface.h"
#include "Constraints/Constraints.h"
#include "Support/ExecutionContext.h"

#include <string>
#include <vector>

class vtkHarmonicFieldSolver;
class vtkPolyData;

namespace dmg
{

/// Adds what the features of a surface prescribe, as a filter's properties say, to what arrays and guides do, and turns
/// all by the filter's rotation; the rules are those of vtkHarmonicFieldSolver.h.
/// \param input that \p surface was made from.
/// \return warnings: features that the surface does not have, or the field cannot follow.
/// \throw InvalidInput as FollowFeatures, Turn and FindArray; curvature as a hard constraint.
/// \throw Cancelled
std::vector<std::string> FollowFeatures(vtkHarmonicFieldSolver* filter, vtkPolyData* input, SolvedSurface& surface,
  Constraints& directions, const ExecutionContext& context);

}

#endif
