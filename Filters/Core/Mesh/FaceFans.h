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

/// Parts a surface into fans: each face is in one. First come all faces around an inner vertex, packed
/// as closely as comes of going outwards: where all valences are six and the surface lets vertices have three
/// colours, the stars of one colour leave nothing over. Then the longest fans of what is left.
/// \param largest faces of a fan, >= 1.
/// Cost: linear in the number of faces, for bounded valence.
FaceFans PackFans(const TriangleMesh& mesh, int largest);

/// Faces no two of which have a common side, packed in the same way: where faces have two colours, those of
/// one colour, which have all sides between them.
/// Cost: linear in the number of faces.
std::vector<int> PackFaces(const TriangleMesh& mesh);

}

#endif
