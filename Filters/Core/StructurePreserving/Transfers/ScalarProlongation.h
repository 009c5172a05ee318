#ifndef dmgScalarProlongation_h
#define dmgScalarProlongation_h

#include "StructurePreserving/Decimation/MeshHierarchy.h"
#include "Support/Types.h"

namespace dmg
{

/// Prolongation of 0-forms, S0: the value at a fine vertex is the coarse function at the place
/// where the vertex lies, linear on coarse triangles.
/// \return #V_l x #V_{l+1}, rows non-negative with sum 1, at most three entries each.
/// Cost: O(#V_l). Thesis, section 3.5; Liu et al. 2021.
SparseMatrix<double> ScalarProlongation(const LevelTransition& transition, const ExecutionContext& context);

}

#endif
