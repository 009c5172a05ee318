#ifndef dmgFieldTopology_h
#define dmgFieldTopology_h

#include "Mesh/TangentFrames.h"
#include "Mesh/TriangleMesh.h"
#include "Support/ExecutionContext.h"
#include "Support/Types.h"

#include <vector>

namespace dmg
{

/// A loop of the boundary, with the surface on its left.
struct BoundaryIndex
{
  std::vector<int> Vertices; ///< in order; the last one goes on to the first
  /// How many turns the boundary's tangent makes against the field along the loop, a multiple of 1 / N: 1 for a
  /// parallel field on a disc, 0 where the field follows the boundary, -1 for a parallel field around a hole.
  double Index;
};

/// Singularities of a field and where its first direction jumps.
struct FieldTopology
{
  Vector<double> Indices;           ///< per vertex; SingularityIndices
  std::vector<BoundaryIndex> Loops; ///< in ascending order of their smallest vertex, with which each begins
  std::vector<int> Cuts;            ///< the edges across which direction 0 does not go on as direction 0, ascending
  std::vector<int>
    Jumps; ///< of these: it goes on as this one, of 1 to N - 1, from the face of HalfedgeOf to its twin's
  Vector<double> Rotation; ///< per edge; PrincipalMatching
};

/// The indices of all vertices and of all loops sum to the Euler characteristic, on every surface (Poincare and Hopf):
/// an inner vertex is 2 pi less the angles around it, one of the boundary pi less these, and each edge turns the field
/// by as much around one of its ends as it turns it back around the other one.
///
/// Directions are matched as in MatchDirections. Faces without direction count as if they had direction 0, and have no
/// cuts. Cost: O(#F).
/// \param first direction 0 of each face in its frame (FaceFrames); 0 where there is none.
FieldTopology TopologyOfField(const TriangleMesh& mesh, const TangentFrames& faceFrames, const Vector<Complex>& first,
  int N, const ExecutionContext& context = SerialContext());

}

#endif
