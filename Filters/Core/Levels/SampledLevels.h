#ifndef dmgSampledLevels_h
#define dmgSampledLevels_h

#include "Levels/ProlongationOperators.h"
#include "Mesh/TriangleMesh.h"
#include "Support/ExecutionContext.h"

namespace dmg
{

/// The default levels: samples of the faces of a surface, samples of those samples, and so on down to some 1,500 (Wiersma
/// et al. 2023). They have no surfaces, so only the nodal operators are there; all others stay empty. A surface with too
/// few faces has no coarse level.
/// \param distance how far apart samples of the first level are, in spacings of the faces around them, > 1.
/// \throw Cancelled
/// Checkpoints: a few for each level. Cost: linear.
ProlongationOperators SampledLevels(const TriangleMesh& mesh, double distance, const ExecutionContext& context);

}

#endif
