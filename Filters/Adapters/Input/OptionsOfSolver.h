#ifndef dmgOptionsOfSolver_h
#define dmgOptionsOfSolver_h

#include "Adapters/Input/ChosenArrays.h"
#include "FieldOptions.h"

class vtkHarmonicFieldSolver;

namespace dmg
{

/// The properties of a filter as the core takes them.
/// \throw InvalidInput one of the filter's properties is out of its range. Weights are checked where they are used.
FieldOptions OptionsOf(vtkHarmonicFieldSolver* filter);

/// The arrays of a surface that the filter's properties choose.
ConstraintChoices ChoicesOnSurface(vtkHarmonicFieldSolver* filter, vtkDataSet* surface);

}

#endif
