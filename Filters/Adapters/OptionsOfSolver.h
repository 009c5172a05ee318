#ifndef dmgOptionsOfSolver_h
#define dmgOptionsOfSolver_h

#include "FieldOptions.h"

class vtkHarmonicFieldSolver;

namespace dmg
{

/// The properties of a filter as the core takes them.
FieldOptions OptionsOf(vtkHarmonicFieldSolver* filter);

}

#endif
