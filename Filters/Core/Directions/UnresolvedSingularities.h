#ifndef dmgUnresolvedSingularities_h
#define dmgUnresolvedSingularities_h

#include "Mesh/TriangleMesh.h"
#include "Support/Types.h"

#include <vector>

namespace dmg
{

/// Vertices at which the surface is too coarse for a singularity. Around a singularity of index k / N at a vertex of n triangles, the
/// field rotates by 2 pi k / (N n) across each edge. Where that is more than pi / N, thus n < 2 k, the nearest direction across the
/// edge is another one: the vertex then reads as a singularity of the opposite sign, and the ring around it has the rest.
///
/// Directions at vertices that are brought to the faces read as singularities over several rings.
///
/// A vertex is listed where its index, or those of its triangles, has another sign than the sum k / N with the singular vertices that it is
/// connected to by steps of at most two edges, or with the triangles across the edges of its own, and n < 2 k. Pairs of opposite singularities, as noise
/// and coarse surfaces have them, are not.
/// \param indices FieldTopology::Indices, per vertex or per face.
/// \param areAtVertices whether they are per vertex.
/// \return the vertices, ascending. Cost: linear.
std::vector<int> UnresolvedSingularities(
  const TriangleMesh& mesh, const Vector<double>& indices, int N, bool areAtVertices);

}

#endif
