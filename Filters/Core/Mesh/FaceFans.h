#ifndef dmgFaceFans_h
#define dmgFaceFans_h

#include "Mesh/TriangleMesh.h"

#include <vector>

namespace dmg
{

/// Faces that follow each other around a vertex, fan by fan.
struct FaceFans
{
  std::vector<int> Offsets = { 0 }; ///< fan k holds Faces[Offsets[k]] to [Offsets[k + 1] - 1]
  std::vector<int> Faces;

  int Size() const { return static_cast<int>(this->Offsets.size()) - 1; }
};

/// Partitions a surface into fans. First come the whole stars of inner vertices, chosen greedily from near to far. Where
/// all valences are six and the vertices can be coloured with three colours, the stars of one colour leave no face over.
/// The longest fans of the remaining faces follow.
/// \param largest faces of a fan, >= 1.
/// Cost: linear in the number of faces, for bounded valence.
FaceFans PackFans(const TriangleMesh& mesh, int largest);

/// A set of faces no two of which share a side, chosen in the same way. Where the faces can be coloured with two colours,
/// these are the faces of one colour, which have all sides between them.
/// Cost: linear in the number of faces.
std::vector<int> PackFaces(const TriangleMesh& mesh);

}

#endif
