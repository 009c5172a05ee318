#ifndef dmgSignsOfLines_h
#define dmgSignsOfLines_h

#include "Geodesics/SplitSurface.h"
#include "Mesh/TriangleMesh.h"
#include "Support/Types.h"

#include <optional>

namespace dmg
{

/// The sign of each face: -1 inside of the lines, 1 elsewhere; nothing where lines do not part the surface, or where there are none.
/// \param mesh what the split surface made.
std::optional<Vector<double>> SignsOf(const TriangleMesh& mesh, const SplitSurface& split);

}

#endif
