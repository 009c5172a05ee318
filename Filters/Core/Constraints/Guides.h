#ifndef dmgGuides_h
#define dmgGuides_h

#include "Constraints/Constraints.h"
#include "Places/NearestPlaces.h"
#include "Support/ExecutionContext.h"

#include <optional>
#include <string>
#include <vector>

namespace dmg
{

/// A line in space that a field follows where it is near to the surface: a polyline.
struct GuideLine
{
  std::vector<Vector3> Points;
  /// Weights: one for each segment, or one for all of them, >= 0; none: 1. Their unit is that of features (FeatureOptions).
  std::vector<double> Weights = {};
  /// The direction that it prescribes, without a part along the normal, as that of a GuideVector; none: its own, of unit length.
  std::optional<Vector3> Direction = {};
};

/// A vector in space that a field follows on the nearest face. A part along the normal of the surface does not count, if the vector is farther than 5
/// degrees from the normal.
struct GuideVector
{
  Vector3 Position;
  Vector3 Direction;
  double Weight = 1.0; ///< > 0
};

/// Lines and vectors in space that a field follows.
struct Guides
{
  std::vector<GuideLine> Lines = {};
  std::vector<GuideVector> Vectors = {};
  double MaximumDistance = 0.1; ///< from the surface, relative to the diagonal of its bounding box
  bool MayMiss = false;         ///< no error if none is taken, as they may belong to other parts of a model

  bool AreEmpty() const { return this->Lines.empty() && this->Vectors.empty(); }
};

/// Polylines on a surface.
struct GuidePaths
{
  std::vector<Vector3> Positions;
  std::vector<int> Ends; ///< of each polyline: the number of positions up to its last one
};

/// The numbers of guides that were taken, and of those that were not. Vectors and segments of lines count; a segment counts in each
/// category that one of its parts falls into.
struct GuidesReport
{
  long long Taken = 0;          ///< prescribes some face
  long long TooFar = 0;         ///< farther from the surface than MaximumDistance
  long long OnFarSide = 0;      ///< SegmentPart::OnFarSide
  long long Perpendicular = 0;  ///< within 5 degrees of the normal of the surface
  double Farthest = 0.0;        ///< largest distance of what is taken, in the unit of the points
  double MaximumDistance = 0.0; ///< in the unit of the points
  GuidePaths Paths;             ///< where lines were taken, on this rank: one or more for each segment

  bool IsAllTaken() const { return this->TooFar == 0 && this->OnFarSide == 0 && this->Perpendicular == 0; }
  /// One sentence: what was left out, why, and what helps; empty where all was taken.
  std::string LeftOut() const;
};

/// Directions on faces, and the report on the guides.
struct FollowedGuides
{
  std::vector<Constraint> Directions;
  std::vector<Vector3> Places; ///< of these directions, near to their faces
  GuidesReport Report;
};

/// \throw InvalidInput a number is not finite, a weight is negative, or a vector is zero.
void CheckGuides(const Guides& guides);

/// Brings guides to a surface: a vector to the nearest face, a segment to all faces that it passes (SegmentOnSurface).
/// \throw InvalidInput as CheckGuides.
/// \throw Cancelled
/// Cost: logarithmic time for each vector, for each face that a line touches, and for each mean edge of its length.
FollowedGuides FollowGuides(
  const Guides& guides, const NearestPlaces& surface, const ExecutionContext& context = SerialContext());

/// Takes parts along normals out of directions that do not lie in their faces (WithoutNormalPartAt). A face alone knows its normal in first order: such a
/// part would turn the direction by its size times the length of a side.
/// \param mesh on which all vertices of the faces have all their faces. \param firstFace face of the mesh that is element 0.
/// Cost: linear in the directions.
void TakeOutNormalParts(FollowedGuides& guides, const TriangleMesh& mesh, int firstFace = 0);

}

#endif
