#ifndef dmgPropertiesOfSolver_h
#define dmgPropertiesOfSolver_h

#include "Adapters/Input/ProblemFromInputs.h"
#include "Adapters/Pipeline/PropertyTable.h"

class vtkHarmonicFieldSolver;

namespace dmg
{

/// The properties of a filter, and the members of a problem that they are.
/// \param filter, problem are borrowed by the rows.
PropertyTable PropertyTableOf(vtkHarmonicFieldSolver* filter, FieldProblem& problem);

/// \throw InvalidInput a property is out of its range. Weights are checked where they are used.
FieldProperties PropertiesOf(vtkHarmonicFieldSolver* filter, const ConstraintArrays& guideChoices = {});

}

#endif
