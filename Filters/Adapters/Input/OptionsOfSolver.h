#ifndef dmgOptionsOfSolver_h
#define dmgOptionsOfSolver_h

#include "Adapters/Input/ChosenArrays.h"
#include "FieldProblem.h"

#include <cstddef>
#include <string>

class vtkHarmonicFieldSolver;

namespace dmg
{

/// The properties of a filter as the core takes them, without what its inputs add.
/// \throw InvalidInput one of the filter's properties is out of its range. Weights are checked where they are used.
FieldProblem ProblemOf(vtkHarmonicFieldSolver* filter);

/// The things that the field follows, in words, such as "array 'Wind', 2 guides, boundary"; "nothing" where it is the smoothest one.
/// \param choices what ChoicesOnSurface gives.
std::string WhatIsFollowed(
  vtkHarmonicFieldSolver* filter, const ConstraintChoices& choices, vtkDataSet* surface, std::size_t guides);

/// The arrays of a surface that the filter's properties choose.
ConstraintChoices ChoicesOnSurface(vtkHarmonicFieldSolver* filter, vtkDataSet* surface);

}

#endif
