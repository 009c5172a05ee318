#ifndef dmgPowerFieldDirections_h
#define dmgPowerFieldDirections_h

#include "Mesh/TangentFrames.h"
#include "Mesh/TriangleMesh.h"
#include "Support/ExecutionContext.h"
#include "Support/Types.h"

#include <complex>
#include <functional>
#include <vector>

/// The directions of a power field, their matching across edges, and the singularities, around which no matching
/// closes. There is one power per face or per vertex, in its frame. Direction k of an element is at the angle
/// (arg(power) + 2 pi k) / N there; arg(0) counts as zero. All functions cost
/// O(#F).
namespace dmg
{

/// The arguments of powers; arg(0) counts as zero.
Vector<double> Arguments(const Vector<Complex>& powers, const ExecutionContext& context = SerialContext());

/// Matches each direction of a face with the nearest one beyond an edge.
struct PrincipalMatching
{
  /// Angle from carried to matched directions, from the face of HalfedgeOf(edge) to that of its twin, in
  /// [-pi / N, pi / N]; #E, 0 on the boundary. N times this is also called the effort of the edge.
  Vector<double> Rotation;
  /// Direction k of the face of halfedge h is matched with k + Offsets[h], modulo N, of the face of its
  /// twin; 3 #F, each in [0, N).
  std::vector<signed char> Offsets;
};

/// \param sides SideDirections of all faces.
PrincipalMatching MatchDirections(const TriangleMesh& mesh, const Unfilled<Complex>& sides,
  const Vector<Complex>& powers, int N, const ExecutionContext& context = SerialContext());

/// The first direction of each face (combing), along a tree over the faces that crosses the edges of least rotation
/// first: each continues as the first of the next face except across a cut, which is empty on a disc without
/// singularities.
/// \param matching of these powers.
std::vector<int> CombingLabels(const TriangleMesh& mesh, const Vector<Complex>& powers,
  const PrincipalMatching& matching, int N, const ExecutionContext& context = SerialContext());

/// The direction of each face that is nearest to its former first direction, so that labels hold still while the field
/// rotates. A face without a former direction gets direction 0.
/// \return empty where the field is another one: half of the faces have rotated by more than pi / (2 N), half of the
///   angle that would make another direction the nearest.
/// \param former first directions of the faces in the same frames, of any length.
std::vector<int> LabelsNearTo(const Vector<Complex>& former, const Vector<Complex>& powers, int N,
  const ExecutionContext& context = SerialContext());

/// The first direction of each element in its frame, of the power's magnitude.
/// \param labels which comes first, per element; empty for direction 0.
Vector<Complex> FirstDirections(const Vector<Complex>& powers, int N, const std::vector<int>& labels = {},
  const ExecutionContext& context = SerialContext());

/// The first of the N directions of an element, or all, as vectors in space, 2 pi / N apart and counter-clockwise.
class DirectionVectors
{
public:
  /// \param unitLength whether they have unit length, rather than that of the first; zero where that is zero.
  /// \param visited number of directions that are visited.
  DirectionVectors(int N, bool unitLength, int visited)
    : N(N)
    , Visited(visited)
    , UnitLength(unitLength)
    , Step(std::polar(1.0, 2.0 * Pi / N))
  {
  }

  /// Calls visit(k, vector) for directions of an element, the first for k = 0.
  template <class Visit>
  void VisitAt(const TangentFrames& frames, int element, Complex first, const Visit& visit) const
  {
    this->VisitIn(frames.X.row(element).transpose(), frames.Y.row(element).transpose(), first, visit);
  }

  /// The same in a tangent plane of unit vectors \p x and \p y.
  template <class Visit>
  void VisitIn(const Vector3& x, const Vector3& y, Complex first, const Visit& visit) const
  {
    Complex direction = this->UnitLength && first != 0.0 ? first / std::abs(first) : first;
    for (int k = 0; k < this->Visited; ++k)
    {
      visit(k, Vector3(direction.real() * x + direction.imag() * y));
      direction *= this->Step;
    }
  }

  const int N;
  const int Visited;

private:
  const bool UnitLength;
  const Complex Step;
};

/// Powers at the vertices: the mean of the faces around, by corner angle, each carried into the
/// tangent plane of the vertex by the shortest rotation between the normals.
Vector<Complex> PowersAtVertices(const TriangleMesh& mesh, const Unfilled<Corner>& corners,
  const Vector<Complex>& powers, int N, const ExecutionContext& context = SerialContext());

/// First directions of vertices: the nearest to those of the faces around.
/// \param turnFromFace the rotation, for a halfedge, of directions from its face into the frame of its tail.
Vector<Complex> FirstDirectionsAtVertices(const TriangleMesh& mesh, const std::function<Complex(int)>& turnFromFace,
  const Vector<Complex>& ofFaces, const Vector<Complex>& vertexPowers, int N,
  const ExecutionContext& context = SerialContext());

/// Index of the singularity at each vertex, a multiple of 1/N, 0 at regular and at boundary
/// vertices: (angle defect + rotation of the field around the vertex) / 2 pi. On a closed surface they
/// sum to the Euler characteristic. A vertex beside a zero power has no well-defined index; any
/// multiple may result, the sum still holds.
/// \param rotation of the principal matching.
Vector<double> SingularityIndices(const TriangleMesh& mesh, const Unfilled<Corner>& corners,
  const Vector<double>& rotation, int N, const ExecutionContext& context = SerialContext());

}

#endif
