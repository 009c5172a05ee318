#ifndef dmgTangentFrames_h
#define dmgTangentFrames_h

#include "Mesh/TriangleMesh.h"
#include "Support/ExecutionContext.h"
#include "Support/Unfilled.h"

#include <array>

namespace dmg
{

/// An orthonormal frame (X, Y, N) per element, N = X x Y the normal; in it a tangent vector v is the complex number whose
/// real and imaginary part are the dot products of v with X and Y.
struct TangentFrames
{
  Points X; ///< # x 3, unit
  Points Y; ///< # x 3, unit

  /// The outward normal, unit.
  Vector3 Normal(int element) const { return Vector3(this->X.row(element)).cross(Vector3(this->Y.row(element))); }

  Complex ToComplex(int element, const Vector3& v) const
  {
    return { this->X.row(element).dot(v.transpose()), this->Y.row(element).dot(v.transpose()) };
  }
  Vector3 ToVector(int element, Complex z) const
  {
    return (z.real() * this->X.row(element) + z.imag() * this->Y.row(element)).transpose();
  }
};

/// Per face: X along its first side, N its normal. A degenerate face, with an area below 1e-10
/// times the square of its longest side, has X along that side and takes N from its neighbours.
/// Cost: O(#F).
TangentFrames FaceFrames(const TriangleMesh& mesh, const ExecutionContext& context = SerialContext());

/// The sides of a face as unit vectors in its frame, in the direction of their halfedges: the
/// angles between them are the angles of the face and always sum to pi. A degenerate face is taken
/// as the limit of a slim one: a side without length is perpendicular to the two others.
std::array<Complex, 3> SideDirections(const TriangleMesh& mesh, const TangentFrames& faceFrames, int face);

/// The sides of all faces, per halfedge.
Unfilled<Complex> SideDirections(
  const TriangleMesh& mesh, const TangentFrames& faceFrames, const ExecutionContext& context = SerialContext());

/// The sides of one face in FaceFrames, which need not be computed for it.
std::array<Complex, 3> SideDirections(const TriangleMesh& mesh, int face);

/// Per vertex: N the normalised sum of the area vectors of the faces around it (where that
/// vanishes, the normal of one of them), X its outgoing halfedge projected to the tangent plane
/// (where that vanishes, any direction there).
/// Cost: O(#F).
TangentFrames VertexFrames(const TriangleMesh& mesh, const ExecutionContext& context = SerialContext());

/// The rotation of a direction that is carried from one tangent plane to another by the shortest rotation between their normals:
/// z becomes turn * z, |turn| = 1.
/// Between opposite normals, any shortest rotation will do.
Complex TransportTurn(const TangentFrames& from, int a, const TangentFrames& to, int b);

/// A corner of a face, for those who gather from the faces around a vertex.
struct Corner
{
  Complex Turn; ///< TransportTurn from the face to the vertex
  double Angle; ///< between its sides; those of a triangle sum to pi
};

/// All corners: [h] is that of the face of halfedge h at the tail of h.
/// \param sides SideDirections of all faces.
Unfilled<Corner> Corners(const TriangleMesh& mesh, const Unfilled<Complex>& sides, const TangentFrames& faceFrames,
  const TangentFrames& vertexFrames, const ExecutionContext& context = SerialContext());

}

#endif
