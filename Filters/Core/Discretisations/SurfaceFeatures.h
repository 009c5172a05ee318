#ifndef dmgSurfaceFeatures_h
#define dmgSurfaceFeatures_h

#include "Discretisations/Prescriptions.h"
#include "Mesh/FramedMesh.h"
#include "Operators/PrincipalDirections.h"

#include <string>
#include <vector>

namespace dmg
{

/// What turns integrals over a surface, or along lines on it, into the weights of its faces. They are relative to the size
/// L of the surface, the root of its area, so that what follows an integral means the same at any size and resolution; see
/// FeatureOptions. A discretisation multiplies the weight of a face by its area over the mean one.
class WeightsOfFaces
{
public:
  /// Cost: linear.
  explicit WeightsOfFaces(const TriangleMesh& mesh);

  /// Of (30 / L)^2, integrated over a face.
  double OfFace() const;
  /// Of 30 / L, integrated along a line on the face, if that is no sliver.
  double OfLine(int face, double length) const;
  bool IsFlat(int face) const { return this->Areas[face] == 0.0; }

private:
  const Vector<double> Areas;
  const double Mean;
  const double Length; ///< L / 30
};

/// What a field follows of the surface itself, and how strongly. Weights are relative to the size L of the surface, the
/// root of its area, and mean the same at any size and resolution: where the roughness is the Dirichlet energy of the
/// field X (for power fields, half of theirs) and Alignment is 1, soft constraints add
///
///   30 weight / L times the integral of |X - Y|^2 along a line, on each side of it,
///   (30 / L)^2 weight confidence |X - Y|^2, integrated, for curvature,
///
/// Y the unit direction that is followed. So at weight 1 what is smaller than about L / 30 is smoothed away. A weight of 0
/// is off. A rotation is the angle by which the field turns against that feature, in degrees, counter-clockwise seen from
/// outside.
struct FeatureOptions
{
  double BoundaryWeight = 0.0;
  double BoundaryRotation = 0.0;
  double SharpEdgesWeight = 0.0;
  double SharpEdgesRotation = 0.0;
  double FeatureAngle = 30.0; ///< degrees between the normals of two faces; edges with more are sharp
  double CurvatureWeight = 0.0;
  double CurvatureRotation = 0.0;
  bool FollowsMinimum = false; ///< the direction of the minimum curvature in place of the maximum
};

/// Weights that are not 0 are in this range, so that they stay in that of weights of faces.
constexpr double SmallestFeatureWeight = 1e-10;
constexpr double LargestFeatureWeight = 1e10;

/// \throw InvalidInput a weight is neither 0 nor in that range.
void CheckFeatures(const FeatureOptions& options);

/// Unit directions along the edges of the boundary, with the surface on the left. Edges without length, or of a face
/// without area, have none.
std::vector<PrescribedDirection> AlongBoundary(const TriangleMesh& mesh, double weight);

/// Unit directions along sharp edges, on both of their faces. Edges without length, or of a face without area, are not
/// sharp.
std::vector<PrescribedDirection> AlongSharpEdges(const FramedMesh& surface, double degrees, double weight);

/// Unit directions along principal directions, on all faces where there are some, with their confidence as weight. None where
/// no confidence is more than 1e-4: where the curvatures differ by less than 1 % everywhere.
std::vector<PrescribedDirection> AlongCurvature(
  const FramedMesh& surface, const PrincipalCurvatures& ofFaces, bool followsMinimum, double weight);

/// What is followed, and what is not there to be followed.
struct FollowedFeatures
{
  std::vector<PrescribedDirection> Directions;
  std::vector<std::string> Warnings; ///< a sentence each
};

/// What the features of a surface prescribe to a field of N directions. Sharp edges and principal directions are lines
/// without a sign: fields of an odd N do not follow them, which is a warning.
/// \param ofFaces the principal directions; may be null where CurvatureWeight is 0 or N odd.
/// \throw InvalidInput as CheckFeatures.
/// Cost: linear.
FollowedFeatures FollowFeatures(
  const FramedMesh& surface, int N, const FeatureOptions& options, const PrincipalCurvatures* ofFaces);

/// By how much a field turns against what it follows, in radians, counter-clockwise seen from outside.
struct RotationAngles
{
  double Everywhere = 0.0;
  Vector<double> Faces;    ///< added to that on each face; empty for zeros
  Vector<double> Vertices; ///< added to that at each vertex; empty for zeros
};

/// Turns all directions about the normals of their elements.
/// \throw InvalidInput an angle is not finite where something is prescribed; an element is out of range. \p names says
/// how messages call it.
void Turn(PrescribedDirections& directions, const FramedMesh& surface, const RotationAngles& angles,
  const ElementNames& names = {});

}

#endif
