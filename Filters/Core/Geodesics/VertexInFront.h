#ifndef dmgVertexInFront_h
#define dmgVertexInFront_h

#include "Mesh/TriangleMesh.h"

namespace dmg
{

/// The vertex at which a logarithmic map starts where nobody has chosen one: on the component of the largest area, the vertex that is
/// nearest to the middle of the front of its bounds, where z is largest. So nothing of that component hides it from whoever looks along
/// -z, as ParaView does at first.
///
/// The choice depends on positions, not on the order of faces and vertices. Several components of the same area, up to 1e-9 of it, count
/// as one. Of several vertices that are equally near, the one with the smallest coordinates is taken, x before y before z.
/// Cost: linear in the number of vertices.
/// \param mesh has a face.
int VertexInFront(const TriangleMesh& mesh);

}

#endif
