#ifndef dmgOperatorsFromOtherSide_h
#define dmgOperatorsFromOtherSide_h

#include "Levels/ProlongationOperators.h"

#include <vector>

namespace dmg
{

/// Operators of a surface for the same surface with some components turned, as SurfaceRelation::IsTurned: the frames of their faces have the
/// first axis reversed. So z becomes minus its conjugate on all levels, and entries between such numbers become their conjugates.
/// \param isTurned for each face of the finest level, alike in each component; empty: none.
/// Cost: linear.
ProlongationOperators SeenFromOtherSide(ProlongationOperators&& operators, const std::vector<char>& isTurned);

}

#endif
