#ifndef dmgAlignedEdges_h
#define dmgAlignedEdges_h

#include "Mesh/FramedMesh.h"
#include "Quads/CrossField.h"
#include "Quads/QuadOptions.h"

#include <vector>

namespace dmg
{

/// The edges that shall become lines of edges of quads, as a flag per edge: those of the boundary and sharp ones, as the options say.
/// Lines of sharp edges that are shorter than QuadOptions::ShortestFeature are noise; so are sharp edges that no direction of the field
/// follows on both of their faces.
std::vector<char> FindAlignedEdges(
  const FramedMesh& surface, const SurfaceAngles& angles, const CrossField& field, const QuadOptions& options);

/// Whether an edge runs along directions 0 and 2 of the face of its halfedge, rather than along 1 and 3.
bool RunsAlongU(const SurfaceAngles& angles, const CrossField& field, int halfedge);

}

#endif
