#ifndef dmgVertexFieldTopology_h
#define dmgVertexFieldTopology_h

#include "Mesh/VertexConnection.h"
#include "Operators/FieldTopology.h"
#include "Support/ExecutionContext.h"
#include "Support/Types.h"

#include <vector>

/// The topology of fields whose N-th powers stand at vertices, in VertexFrames, and are carried along edges by a
/// VertexConnection. Singularities stand on triangles. All cost O(#F).
namespace dmg
{

/// The rotation of directions along each edge, from the tail to the head of its HalfedgeOf, against transport: to the nearest
/// direction there, in [-pi / N, pi / N]; #E.
Vector<double> RotationAlongEdges(const TriangleMesh& mesh, const VertexConnection& connection,
  const Vector<Complex>& powers, int N, const ExecutionContext& context = SerialContext());

/// Index of the singularity on each face, a multiple of 1 / N: (the rotation along its sides, counter-clockwise, + its
/// curvature) / 2 pi. On a closed surface they sum to the Euler characteristic. Beside a zero power any multiple may
/// result; the sum still holds.
Vector<double> IndicesOfFaces(const TriangleMesh& mesh, const VertexConnection& connection,
  const Vector<double>& rotation, int N, const ExecutionContext& context = SerialContext());

/// The same as TopologyOfField, with Indices per face. The indices of all faces and of all loops sum to the Euler characteristic. Cuts are the
/// edges along which direction 0 of HalfedgeOf's tail does not go on as direction 0 of its head, but as that of Jumps.
/// \param first direction 0 of each vertex in its frame; 0 where there is none.
FieldTopology TopologyOfVertexField(const TriangleMesh& mesh, const VertexConnection& connection,
  const Vector<Complex>& first, int N, const ExecutionContext& context = SerialContext());

}

#endif
