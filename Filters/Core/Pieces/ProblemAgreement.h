#ifndef dmgProblemAgreement_h
#define dmgProblemAgreement_h

#include "FieldProblem.h"
#include "Pieces/Surface/Ranks.h"

namespace dmg
{

/// Checks that all ranks ask for the same field, but for Constraints and the arrays of Rotation, which are those of their pieces.
/// Collective. \throw InvalidInput ranks differ; the message names in which options.
void CheckAgreement(const Ranks& ranks, const FieldProblem& problem);

}

#endif
