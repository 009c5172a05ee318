#ifndef dmgPropertiesOfSolver_h
#define dmgPropertiesOfSolver_h

#include "Adapters/Input/ProblemFromInputs.h"

class vtkHarmonicFieldSolver;

namespace dmg
{

/// \throw InvalidInput a property is out of its range. Weights are checked where they are used.
FieldProperties PropertiesOf(vtkHarmonicFieldSolver* filter, const ConstraintArrays& guideChoices = {});

}

#endif
