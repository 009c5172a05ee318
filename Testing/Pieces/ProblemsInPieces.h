#ifndef dmgTestProblemsInPieces_h
#define dmgTestProblemsInPieces_h

#include "Field.h"
#include "FieldProblem.h"
#include "Partitions.h"

namespace dmg::test
{

/// A problem on the whole surface as the rank of a piece has it. All ranks that have a point give what holds there.
dmg::FieldProblem OfPiece(const dmg::FieldProblem& whole, const CutPiece& cut, const Surface& surface);

/// The complex powers or real values that a field has at the vertices.
Vector<Complex> UnknownsOf(const dmg::Field& field);

}

#endif
