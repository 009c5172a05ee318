#ifndef dmgProblemFromInputs_h
#define dmgProblemFromInputs_h

#include "Adapters/Input/GuidesFromDataSets.h"
#include "Adapters/Input/SingularitiesOnSurface.h"
#include "Adapters/Surface/MeshFromDataSet.h"
#include "FieldProblem.h"

class vtkDataSet;
class vtkHarmonicFieldSolver;

namespace dmg
{

/// The inputs of a filter.
struct FieldInputs
{
  vtkDataSet* Surface;
  GuideInput Guides;
  dmg::Singularities Singularities;
};

/// Adds to a problem what the inputs say but for singularities: constraints and rotations by arrays of the surface, and guides.
/// \param choices of ChoicesOnSurface.
/// \param surface made of the first input; null where a rank has no piece of it.
/// \return the directions that are left out.
/// \throw InvalidInput as ConstraintsFromArrays, RotationFromArray and GuidesFrom.
UnusableDirections ReadInputs(vtkHarmonicFieldSolver* filter, const ConstraintChoices& choices,
  const FieldInputs& inputs, const FramedSurface* surface, FieldProblem& problem);

/// \pre Nothing is prescribed. \throw InvalidInput arrays or guides are chosen all the same.
void CheckPrescribes(const ConstraintChoices& choices, const FieldInputs& inputs);

}

#endif
