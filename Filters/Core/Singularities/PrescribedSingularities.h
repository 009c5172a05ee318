#ifndef dmgPrescribedSingularities_h
#define dmgPrescribedSingularities_h

#include "Mesh/TriangleMesh.h"

#include <string>
#include <vector>

namespace dmg
{

/// A singularity that a field of N directions shall have.
struct PrescribedSingularity
{
  int Vertex; ///< not on the boundary
  int Times;  ///< N times its index; what several prescribe at one vertex adds up
};

/// N times an index.
/// \param name of what has the index, for the message.
/// \throw InvalidInput the index is no multiple of 1 / N, to 1e-4 of it.
int TimesOfIndex(double index, int N, const std::string& name);

/// N times the index of every vertex.
/// \param names says how messages call vertices.
/// \throw InvalidInput a vertex is out of range, or on the boundary.
std::vector<int> TimesByVertex(
  const TriangleMesh& mesh, const std::vector<PrescribedSingularity>& singularities, const ElementNames& names);

}

#endif
