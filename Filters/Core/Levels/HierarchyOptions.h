#ifndef dmgHierarchyOptions_h
#define dmgHierarchyOptions_h

#include <tuple>

namespace dmg
{

/// The construction of the coarse levels.
enum class LevelConstruction
{
  /// The thesis's: the surface is decimated, and every operator can be had. The default.
  EdgeCollapses,
  /// Samples of the surface's faces, and samples of these. Much faster; linear interpolation only, and
  /// no coarse surfaces. Wiersma et al. 2023.
  Sampling,
};

/// The order in which edges are collapsed.
enum class CollapsePolicy
{
  /// Rounds of collapses whose stars share no face, cheapest first; parallel. The default.
  IndependentRounds,
  /// The thesis's queue: always the cheapest edge, and each collapse adds the largest initial cost to
  /// the edges around it. Sequential. Thesis, section 5.1.
  SequentialQueue,
};

/// The construction of the operators between two levels. Both keep the same structure; see
/// OverlayProlongation.h for what differs.
enum class ProlongationConstruction
{
  /// Fine points and paths carried through the collapses; few entries per row. The default.
  TrackedPaths,
  /// The thesis's: the overlay of each collapse in exact arithmetic, and the product of all local
  /// operators. Several times the entries and much slower; the reference. Thesis, chapters 4 and 5.
  ExactOverlay,
};

/// Defaults are the thesis's, section 5.4. All but the last two are those of edge collapses; sampling
/// goes on down to some hundred samples.
struct HierarchyOptions
{
  /// Faces of a level over faces of the next finer one, in (0, 1).
  double FaceRatio = 0.25;
  /// At most so many levels beside the finest, >= 0.
  int MaximumNumberOfCoarseLevels = 3;
  /// No level is decimated below this many faces, >= 4.
  int MinimumNumberOfFaces = 1000;
  CollapsePolicy Policy = CollapsePolicy::IndependentRounds;
  ProlongationConstruction Construction = ProlongationConstruction::TrackedPaths;
  LevelConstruction Levels = LevelConstruction::EdgeCollapses;
  /// Distance between samples of the first level, in spacings of the faces around them, > 1. There is
  /// about one sample for SampleDistance^2 / 1.5 faces, and more of them where the surface is curved.
  double SampleDistance = 3.6;

  friend bool operator==(const HierarchyOptions& a, const HierarchyOptions& b)
  {
    const auto members = [](const HierarchyOptions& options)
    {
      // A member that is forgotten here does not compile.
      const auto& [ratio, levels, faces, policy, construction, kind, distance] = options;
      return std::tie(ratio, levels, faces, policy, construction, kind, distance);
    };
    return members(a) == members(b);
  }
};

}

#endif
