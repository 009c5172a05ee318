#ifndef dmgPrescriptions_h
#define dmgPrescriptions_h

#include "Mesh/FramedMesh.h"
#include "Mesh/TangentFrames.h"
#include "Mesh/TriangleMesh.h"
#include "Solvers/PrescribedUnknowns.h"

#include <vector>

namespace dmg
{

/// Weights of the two energies of a field.
struct FieldWeights
{
  double Smoothness = 1.0; ///< lambda_S, > 0
  double Alignment = 1.0;  ///< lambda_A, > 0; soft constraints only
  ConstraintKind Constraints = ConstraintKind::Soft;
};

/// Weights reach from 1e-20 to 1e20, and what is prescribed from 1e-40 to 1e40: what is computed of them then stays far
/// from the ends of what doubles hold.
constexpr double SmallestWeight = 1e-20;
constexpr double LargestWeight = 1e20;
constexpr double SmallestPrescribed = 1e-40;
constexpr double LargestPrescribed = 1e40;

/// \throw InvalidInput a weight is not positive and finite, or beyond SmallestWeight and LargestWeight.
void CheckWeights(const FieldWeights& weights);

/// Which faces are prescribed, and how strongly. Part of the system's key; values are not.
struct PrescribedFaces
{
  std::vector<int> Faces;      ///< ascending, each once
  std::vector<double> Weights; ///< per prescribed face, > 0, dimensionless
};

/// A direction prescribed somewhere on a face; several may share a face.
struct PrescribedDirection
{
  int Face;
  Vector3 Direction; ///< in space; its part in the plane of the face counts
  double Weight;     ///< > 0
};

/// \param kind for the message, as in "face".
/// \throw InvalidInput there are only \p size elements.
void CheckPrescribedElement(int element, int size, const std::string& kind);

/// The part of a prescribed direction in the tangent plane of its element.
/// \param name, kind for messages, as in "cell 7", "cell".
/// \throw InvalidInput the direction is not finite, has no part in the plane (less than 1e-6 of its
/// length), or its weight is not positive.
Complex TangentialPart(const TangentFrames& frames, int element, const Vector3& direction, double weight,
  const std::string& name, const std::string& kind);

/// A direction prescribed at a vertex; several may share it.
struct PrescribedVertexDirection
{
  int Vertex;
  Vector3 Direction; ///< in space; its part in the tangent plane of the vertex counts
  double Weight;     ///< > 0
};

/// A value prescribed at a vertex, for functions.
struct PrescribedValue
{
  int Vertex;
  double Value;
  double Weight; ///< > 0
};

/// What is prescribed on a surface: directions, or the values of a function.
struct PrescribedDirections
{
  std::vector<PrescribedDirection> OnFaces;
  std::vector<PrescribedVertexDirection> AtVertices;
  std::vector<PrescribedValue> Values = {};
};

/// \throw InvalidInput a length, an absolute value or a weight is too large to compute with, or all of them are too small.
/// Where some are large enough, the others may be as small as they like. The message names the element.
/// \pre The elements exist.
void CheckSizes(const PrescribedDirections& directions, const ElementNames& names = {});

/// Directions at vertices as directions on the faces around (CarriedIntoFaces), after those on faces.
std::vector<PrescribedDirection> DirectionsOnFaces(
  const FramedMesh& surface, const PrescribedDirections& directions, const ElementNames& names = {});

/// A direction at a vertex as a face beside it sees it.
struct CarriedDirection
{
  int Halfedge;      ///< of the face; leaves the vertex
  Vector3 Direction; ///< in the plane of the face, as long as the part in the tangent plane was
};

/// A direction at a vertex, carried from its tangent plane into each of the faces around by the
/// shortest rotation between the normals (TransportTurn).
/// \throw InvalidInput there is no such vertex, and as TangentialPart; \p names says how messages
/// call vertex i.
std::vector<CarriedDirection> CarriedIntoFaces(const TriangleMesh& mesh, const TangentFrames& faceFrames,
  const TangentFrames& vertexFrames, const PrescribedVertexDirection& prescribed, const ElementNames& names = {});

/// Leaves out the directions of faces on which several cancel: the mean of their N-th powers is less than a millionth of
/// them, as of opposite vectors where N is 1, and so says nothing but what rounding has left.
/// \return those faces, ascending.
/// Cost: n log n, linear where directions are sorted by face.
std::vector<int> LeaveOutCancelling(
  std::vector<PrescribedDirection>& directions, const TangentFrames& faceFrames, int N);

/// Prescribed faces with the values that N-power fields shall take there.
struct PowerConstraints
{
  PrescribedFaces Prescribed;
  /// Y_b = |v| e^{i N angle(v)}, v the tangential part in the frame of the face. The magnitude
  /// of a direction is kept, not raised to the N-th power.
  Vector<Complex> Values;
};

/// Brings directions into the frames of their faces. Directions on one face are averaged as powers
/// (so that 0 and 90 degrees agree at N = 4), by weight; the weights add up. Directions that
/// contradict each other shorten the value, down to 0 (see LeaveOutCancelling).
/// \throw InvalidInput a direction is not finite, has no part in the plane of its face (less than
/// 1e-6 of its length), or its weight is not positive; \p names says how messages call face i.
PowerConstraints MakePowerConstraints(const TriangleMesh& mesh, const TangentFrames& faceFrames, int N,
  const std::vector<PrescribedDirection>& directions, const ElementNames& names = {});

}

#endif
