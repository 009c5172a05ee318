#ifndef dmgFieldConstraints_h
#define dmgFieldConstraints_h

#include "Constraints/Constraints.h"
#include "Mesh/FramedMesh.h"
#include "Solvers/Penalties.h"
#include "Support/Types.h"

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

/// \throw InvalidInput a weight is not positive and finite, or beyond SmallestWeight and LargestWeight.
void CheckWeights(const FieldWeights& weights);

/// Constraints as a discretisation takes them: on the elements that its unknowns stand on.
struct FieldConstraints
{
  // Key of the system.
  std::vector<int> Elements = {};   ///< ascending, each once
  std::vector<double> Weights = {}; ///< one per element, > 0, dimensionless
  // Key of the solution.
  Vector<double> Values = {}; ///< UnknownsPerElement for each element
  Vector<double> Source = {}; ///< of functions, integrated: what is minimised loses 2 Source^T x; empty for zero

  /// Elements that are pinned at zero because the solution is free by a constant; no user has asked for it.
  std::vector<int> Pinned = {};
};

/// Directions on faces and those at vertices, which are carried into the faces around (CarriedIntoFaces), in this order.
std::vector<Constraint> DirectionsOnFaces(
  const FramedMesh& surface, const Constraints& constraints, const ElementNames& names = {});

/// A direction at a vertex as a face beside it sees it.
struct CarriedDirection
{
  int Halfedge;      ///< of the face; leaves the vertex
  Vector3 Direction; ///< in the plane of the face, as long as the part in the tangent plane was
};

/// A direction at a vertex, carried from its tangent plane into each of the faces around by the shortest rotation between
/// the normals (TransportTurn).
/// \param names says how messages call vertices.
/// \throw InvalidInput there is no such vertex, and as TangentialPart.
std::vector<CarriedDirection> CarriedIntoFaces(const TriangleMesh& mesh, const TangentFrames& faceFrames,
  const TangentFrames& vertexFrames, const Constraint& prescribed, const ElementNames& names = {});

/// Faces with the values that N-power fields shall take there: pairs, Y_b = |v| e^{i N angle(v)}, v the tangential part of a
/// direction in the frame of the face. The magnitude of a direction is kept, not raised to the N-th power.
/// Directions on one face are averaged as powers by weight, so that 0 and 90 degrees agree at N = 4; the weights add up.
/// Directions that contradict each other shorten the value, down to 0 (see LeaveOutCancelling).
/// \param names says how messages call faces.
/// \throw InvalidInput as CheckElement and TangentialPart.
FieldConstraints MakePowerConstraints(const TriangleMesh& mesh, const TangentFrames& faceFrames, int N,
  const std::vector<Constraint>& directions, const ElementNames& names = {});

}

#endif
