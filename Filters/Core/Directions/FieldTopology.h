#ifndef dmgFieldTopology_h
#define dmgFieldTopology_h

#include "Mesh/TangentFrames.h"
#include "Mesh/TriangleMesh.h"
#include "Mesh/VertexConnection.h"
#include "Support/ExecutionContext.h"
#include "Support/Types.h"

#include <vector>

/// The topology of fields of N directions on faces, with singularities at vertices, and at vertices, with singularities on faces. Directions
/// on faces are compared across edges, those at vertices along edges. The indices of all elements and of all loops of the boundary sum to
/// the Euler characteristic, on every surface (Poincare and Hopf). All functions cost O(#F).
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
  Vector<double> Indices;           ///< per vertex (SingularityIndices) or per face (IndicesOfFaces)
  std::vector<BoundaryIndex> Loops; ///< in ascending order of their smallest vertex, with which each begins
  std::vector<int> Cuts;            ///< the edges beyond which direction 0 does not go on as direction 0, ascending
  /// The direction as which it goes on there, of 1 to N - 1, from the face of HalfedgeOf to its twin's, or from its tail to its head.
  std::vector<int> Jumps;
  Vector<double> Rotation; ///< per edge; PrincipalMatching or RotationAlongEdges
};

/// Directions on faces. They are matched as in MatchDirections. Faces without direction count as if they had direction 0, and have no
/// cuts.
/// \param first direction 0 of each face in its frame (FaceFrames); 0 where there is none.
FieldTopology TopologyOfField(const TriangleMesh& mesh, const TangentFrames& faceFrames, const Vector<Complex>& first,
  int N, const ExecutionContext& context = SerialContext());

/// Directions at vertices.
/// \param first direction 0 of each vertex in its frame (VertexFrames); 0 where there is none.
FieldTopology TopologyOfVertexField(const TriangleMesh& mesh, const VertexConnection& connection,
  const Vector<Complex>& first, int N, const ExecutionContext& context = SerialContext());

/// The rotation of directions along each edge, from the tail to the head of its HalfedgeOf, against transport: to the nearest
/// direction there, in [-pi / N, pi / N]; #E.
/// \param powers N-th powers at vertices, in VertexFrames.
Vector<double> RotationAlongEdges(const TriangleMesh& mesh, const VertexConnection& connection,
  const Vector<Complex>& powers, int N, const ExecutionContext& context = SerialContext());

/// Index of the singularity on each face, a multiple of 1 / N: (the rotation along its sides, counter-clockwise, + its
/// curvature) / 2 pi. Beside a zero power any multiple may result; the sum still holds.
Vector<double> IndicesOfFaces(const TriangleMesh& mesh, const VertexConnection& connection,
  const Vector<double>& rotation, int N, const ExecutionContext& context = SerialContext());

}

#endif
