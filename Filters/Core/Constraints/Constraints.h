#ifndef dmgConstraints_h
#define dmgConstraints_h

#include "Mesh/FramedMesh.h"
#include "Mesh/TangentFrames.h"
#include "Mesh/TriangleMesh.h"
#include "Operators/FunctionSource.h"
#include "Support/Types.h"

#include <array>
#include <string>
#include <vector>

namespace dmg
{

/// A direction that a field shall have on a face or at a vertex; several may share an element.
struct Constraint
{
  int Element;       ///< a face or a vertex: the list that holds the constraint says which
  Vector3 Direction; ///< in space; its part in the tangent plane of the element counts
  double Weight;     ///< > 0
  /// The side of a face, 0 to 2, that is followed alone; fields at vertices count it at both of its ends. -1 is the whole face, and -2 a line
  /// that runs somewhere over it.
  int Side = -1;
};

/// A value that a function shall have at a vertex.
struct ValueConstraint
{
  int Vertex;
  double Value;
  double Weight; ///< > 0
};

/// All that a field follows on a surface, whatever its unknowns are: arrays, guides and features become constraints, and a
/// discretisation alone makes penalties of its unknowns of them.
struct Constraints
{
  std::vector<Constraint> OnFaces;
  /// Parts along the normals of vertices (NormalOfVertex) do not count, however large they are.
  std::vector<Constraint> AtVertices;
  std::vector<ValueConstraint> Values = {}; ///< of functions
  Vector<double> Source = {};               ///< of functions, f in -Laplace u = f; one per vertex, or empty for zero
  NetSource Net = NetSource::Refuse;        ///< of the source, on components without values

  bool AreEmpty() const
  {
    return this->OnFaces.empty() && this->AtVertices.empty() && this->Values.empty() && this->Source.size() == 0;
  }
};

/// The range of weights, and that of lengths and values. All that is computed of them then stays far from the largest and
/// smallest doubles.
constexpr double SmallestWeight = 1e-20;
constexpr double LargestWeight = 1e20;
constexpr double SmallestPrescribed = 1e-40;
constexpr double LargestPrescribed = 1e40;

/// \throw InvalidInput a length, an absolute value or a weight is too large to compute with, or all of them are too small.
/// Where some are large enough, the others may be as small as they like. The message names the element.
/// \pre The elements exist.
void CheckSizes(const Constraints& constraints, const ElementNames& names = {});

/// \param kind for the message, as in "face".
/// \throw InvalidInput there are only \p size elements.
void CheckElement(int element, int size, const std::string& kind);

/// The part of a direction in the tangent plane of its element.
/// \param name, kind for messages, as in "cell 7", "cell".
/// \throw InvalidInput the direction is not finite, has no part in the plane (less than 1e-6 of its length), or its weight is
/// not positive.
Complex TangentialPart(const TangentFrames& frames, int element, const Vector3& direction, double weight,
  const std::string& name, const std::string& kind);

/// The numbers of directions that are left out or changed, by reason, for a message.
struct UnusableDirections
{
  long long NotFinite = 0;
  long long Zero = 0;
  long long Perpendicular = 0; ///< to the surface: less than 1e-6 of the length is along it
  long long NotSymmetric = 0;  ///< tensors, whose symmetric part is used
  std::string
    FillValues = {}; ///< a sentence about numbers that may stand where nothing was measured; such directions are not left out

  bool AreLeftOut() const { return this->NotFinite > 0 || this->Zero > 0 || this->Perpendicular > 0; }
  bool AreNone() const { return !this->AreLeftOut() && this->NotSymmetric == 0 && this->FillValues.empty(); }
};

/// Leaves out directions that are not finite, zero, or perpendicular to the surface, as measured data have some.
/// Cost: linear.
/// \return the numbers of those that are left out.
UnusableDirections LeaveOutUnusable(Constraints& constraints, const FramedMesh& surface);

/// Whether a tensor is symmetric, up to 1e-5 of its largest number.
bool IsSymmetric(const Eigen::Matrix3d& tensor);

/// The direction of the largest eigenvalue of a tensor's symmetric part in the tangent plane of an element, a unit vector of either sign.
/// \param tensor in space; its part in the plane counts.
/// \return zero where both eigenvalues in the plane are equal up to 1e-9 of the tensor, or where it is not finite.
Vector3 PrincipalDirection(const Eigen::Matrix3d& tensor, const TangentFrames& frames, int element);

/// Both eigenvalues of a tensor's symmetric part in the tangent plane of an element, with their signs: that of PrincipalDirection, the larger one,
/// and that across.
std::array<double, 2> PrincipalValues(const Eigen::Matrix3d& tensor, const TangentFrames& frames, int element);

/// The difference of both eigenvalues of a tensor in the tangent plane of an element: how clear its principal direction is.
double DifferenceOfPrincipalValues(const Eigen::Matrix3d& tensor, const TangentFrames& frames, int element);

/// The N-th power of a direction in a frame, as long as the direction.
Complex PowerOfDirection(const Complex& direction, int N);

/// The numbers of some constraints in the order of their elements. Constraints of one element keep their order.
std::vector<int> ByElement(const std::vector<Constraint>& constraints);

/// Leaves out the directions of faces on which several cancel, as opposite vectors do where N is 1: the mean of their N-th powers is
/// less than a millionth of them, and so is rounding noise.
/// \return those faces, ascending.
/// Cost: n log n, linear where directions are sorted by face.
std::vector<int> LeaveOutCancelling(std::vector<Constraint>& onFaces, const TangentFrames& faceFrames, int N);

/// The angles by which a field turns against all that it follows, in radians, counter-clockwise seen from outside.
struct RotationAngles
{
  double Everywhere = 0.0;
  Vector<double> Faces = {};    ///< added to that on each face; empty for zeros
  Vector<double> Vertices = {}; ///< added to that at each vertex; empty for zeros

  bool AreZero() const { return this->Everywhere == 0.0 && this->Faces.size() == 0 && this->Vertices.size() == 0; }
};

/// Turns all directions about the normals of their elements.
/// \param names says how messages call elements.
/// \throw InvalidInput an angle is not finite where something is prescribed; an element is out of range.
void Turn(
  Constraints& constraints, const FramedMesh& surface, const RotationAngles& angles, const ElementNames& names = {});

/// \throw InvalidInput it is not finite at an element, whose name this is, and a direction is prescribed there.
[[noreturn]] void RefuseRotation(const std::string& element);

/// A direction, turned about the normal of its element by an angle in radians.
Vector3 Turned(const Vector3& direction, const TangentFrames& frames, int element, double angle);

}

#endif
