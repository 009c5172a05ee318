#ifndef dmgHierarchyOptions_h
#define dmgHierarchyOptions_h

#include <tuple>

namespace dmg
{

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

/// Decimation of a surface into levels. Defaults are those of the thesis, section 5.4.
struct HierarchyOptions
{
  /// Faces of a level over faces of the next finer one, in (0, 1).
  double FaceRatio = 0.25;
  /// The largest number of levels beside the finest, >= 0.
  int MaximumNumberOfCoarseLevels = 3;
  /// No level is decimated below this many faces, >= 4.
  int MinimumNumberOfFaces = 1000;
  CollapsePolicy Policy = CollapsePolicy::IndependentRounds;
  ProlongationConstruction Construction = ProlongationConstruction::TrackedPaths;

  friend bool operator==(const HierarchyOptions& a, const HierarchyOptions& b)
  {
    const auto members = [](const HierarchyOptions& options)
    {
      // A member that is forgotten here does not compile.
      const auto& [ratio, levels, faces, policy, construction] = options;
      return std::tie(ratio, levels, faces, policy, construction);
    };
    return members(a) == members(b);
  }
};

}

#endif
