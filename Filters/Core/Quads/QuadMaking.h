#ifndef dmgQuadMaking_h
#define dmgQuadMaking_h

#include "Mesh/FramedMesh.h"
#include "Quads/LengthsOfEdges.h"
#include "Quads/QuadMesh.h"
#include "Support/ExecutionContext.h"
#include "Support/Types.h"

namespace dmg
{

/// The quads of a surface whose edges are as short as they need be, for lengths that were found: MakeQuads without checks, and without cuts
/// of long edges.
QuadMesh MakeQuadsOfShortEdges(const FramedMesh& surface, const Vector<Complex>& powers, const LengthsOfEdges& lengths,
  const QuadOptions& options, const ExecutionContext& context, const ElementNames& names);

}

#endif
