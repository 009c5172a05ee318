#ifndef dmgReasonToGather_h
#define dmgReasonToGather_h

#include "FieldProblem.h"

#include <string>

namespace dmg
{

/// The reason why FieldSolverInPieces does not solve a problem, so that the surface has to be gathered on one rank: a clause for a
/// user, such as "flows are found on one process". Empty where it solves it. It depends on options alone, so all ranks get the same.
std::string ReasonToGather(const FieldProblem& problem);

}

#endif
