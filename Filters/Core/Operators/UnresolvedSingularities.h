#ifndef dmgUnresolvedSingularities_h
#define dmgUnresolvedSingularities_h

#include "Mesh/TriangleMesh.h"
#include "Support/Types.h"

#include <vector>

namespace dmg
{

/// Singularities that the surface is too coarse for. Around a singularity of index k / N the field rotates by k pi / N or more across some
/// edges, and the nearest direction there is another one: the element then reads as a singularity of the wrong sign, and its
/// neighbours share the rest.
///
/// An element is listed where its index and those of its neighbours sum to at least 2 / N, or at most -2 / N, and its own index has
/// the other sign. Two neighbours of indices 1 / N and -1 / N, as in noise, are not.
/// \param indices of FieldTopology: per vertex, whose neighbours share an edge, or per face, whose neighbours share a vertex.
/// \param areAtVertices says which.
/// \return the elements, ascending. Cost: linear.
std::vector<int> UnresolvedSingularities(
  const TriangleMesh& mesh, const Vector<double>& indices, int N, bool areAtVertices);

}

#endif
