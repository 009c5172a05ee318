#ifndef dmgProblemFromInputs_h
#define dmgProblemFromInputs_h

#include "Adapters/Input/GuidesFromDataSets.h"
#include "Adapters/Input/SingularitiesOnSurface.h"
#include "Adapters/Surface/SolverOfSurface.h"
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

/// Adds to a problem what the inputs say: constraints and rotations by arrays of the surface, guides and singularities.
/// \param choices of ChoicesOnSurface.
/// \param surface made of the first input.
/// \return the directions that are left out.
/// \throw InvalidInput as ConstraintsFromArrays, RotationFromArray, GuidesFrom and BringToSurface; arrays or guides are chosen
/// that prescribe nothing; singularities of a field that has none.
UnusableDirections ReadInputs(vtkHarmonicFieldSolver* filter, const ConstraintChoices& choices,
  const FieldInputs& inputs, SolverOfSurface& surface, FieldProblem& problem);

}

#endif
