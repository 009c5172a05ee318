#ifndef dmgSurfaceFeatures_h
#define dmgSurfaceFeatures_h

#include "Constraints/Constraints.h"
#include "Constraints/WeightsOfFaces.h"
#include "Directions/PrincipalDirections.h"
#include "Mesh/FramedMesh.h"

#include <functional>
#include <string>
#include <vector>

namespace dmg
{

/// The features of the surface that a field follows, with weights. Weights are relative to the size L of the surface, the
/// root of its area, and mean the same at any size and resolution: where the smoothness energy is the Dirichlet energy of the
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
  double CurvatureScale = 3.0; ///< of principal directions, in mean edges; see FindPrincipalDirections
  bool FollowsMinimum = false; ///< the direction of the minimum curvature in place of the maximum
  bool WarnsOfMissing = true;  ///< a warning where the surface has no such feature, or the field cannot follow it
};

/// Weights that are not 0 are in this range, so that they stay in that of weights of faces.
constexpr double SmallestFeatureWeight = 1e-10;
constexpr double LargestFeatureWeight = 1e10;

/// \throw InvalidInput a weight is neither 0 nor in that range.
void CheckFeatures(const FeatureOptions& options);

/// Unit directions along the edges of the boundary, with the surface on the left. Edges without length, or of a face
/// without area, have none.
std::vector<Constraint> AlongBoundary(const TriangleMesh& mesh, const WeightsOfFaces& weights, double weight);

/// Unit directions along sharp edges, on both of their faces. Edges without length, or of a face without area, are not
/// sharp.
std::vector<Constraint> AlongSharpEdges(
  const FramedMesh& surface, const WeightsOfFaces& weights, double degrees, double weight);

/// Unit directions along principal directions, on all faces where there are some, with their confidence as weight.
std::vector<Constraint> AlongCurvature(const FramedMesh& surface, const WeightsOfFaces& weights,
  const PrincipalCurvatures& ofFaces, bool followsMinimum, double weight);

/// Whether the confidence of some principal direction is more than 1e-4. Below it, the curvatures differ by less than 1 %, as
/// rounding of coordinates makes them do.
bool AreClear(const PrincipalCurvatures& curvatures);

enum class SurfaceFeature
{
  Boundary,
  SharpEdges,
  PrincipalDirections,
};

/// The features that are followed, and those that the surface does not have.
struct FollowedFeatures
{
  std::vector<Constraint> Directions;
  std::vector<SurfaceFeature> Features; ///< that are followed, on any piece of the surface
  std::vector<std::string> Warnings;    ///< a sentence each; none without FeatureOptions::WarnsOfMissing
};

/// The directions along one feature of a surface, turned as the options say.
/// \param ofFaces the principal directions; may be null for other features.
std::vector<Constraint> AlongFeature(SurfaceFeature feature, const FramedMesh& surface, const WeightsOfFaces& weights,
  const FeatureOptions& options, const PrincipalCurvatures* ofFaces);

/// Follows the features that options ask for, as the function below, wherever these are.
/// \param find appends the directions along a feature, and says whether the surface has it.
FollowedFeatures FollowFeatures(int N, const FeatureOptions& options,
  const std::function<bool(SurfaceFeature feature, std::vector<Constraint>& directions)>& find);

/// The constraints that features of a surface make for a field of N directions. Sharp edges and principal directions are lines
/// without a sign: fields of an odd N do not follow them, which is a warning.
/// \param ofFaces the principal directions; may be null where CurvatureWeight is 0 or N odd.
/// \throw InvalidInput as CheckFeatures.
/// Cost: linear.
FollowedFeatures FollowFeatures(
  const FramedMesh& surface, int N, const FeatureOptions& options, const PrincipalCurvatures* ofFaces);

}

#endif
