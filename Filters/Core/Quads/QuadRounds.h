#ifndef dmgQuadRounds_h
#define dmgQuadRounds_h

#include "Places/NearestPlaces.h"
#include "Quads/Crosses/CrossField.h"
#include "Quads/Crosses/CutSurface.h"
#include "Quads/Crosses/LinesOfEdges.h"
#include "Quads/Isolines/CellPlaces.h"
#include "Quads/Isolines/IndexedQuads.h"
#include "Quads/Isolines/IsolineCells.h"
#include "Quads/Isolines/QuadDefects.h"
#include "Quads/LengthsOfEdges.h"
#include "Quads/Map/SeamlessMap.h"
#include "Quads/QuadOptions.h"
#include "Support/ExecutionContext.h"
#include "Support/Types.h"

#include <optional>
#include <tuple>
#include <utility>
#include <vector>

namespace dmg
{

/// The quads of one map, with what they were made of.
struct QuadRound
{
  MapOfCorners Map;
  CellPlaces Places;
  IndexedQuads Quads;
  QuadDefects Defects;
  int Far =
    0; ///< vertices of the surface that are farther from quads than edges are long there; 0 where there are defects
  std::vector<std::pair<int, int>>
    Tips = {};           ///< vertices of quads with the vertices of the surface, far from quads, that they stand for
  Vector<double> Scales; ///< by face: of the lengths of edges; less than 1 where they were halved
  int Number = 0;        ///< of rounds before

  /// Less is better.
  std::tuple<int, int, int> Badness() const { return { this->Defects.Number, this->Defects.CutOff, this->Far }; }
  /// Whether it has no more defects and parts cut off, and about as few vertices far away, if there are some: of longer edges more are.
  bool IsAsGoodAs(const QuadRound& other) const
  {
    return this->Defects.Number <= other.Defects.Number && this->Defects.CutOff <= other.Defects.CutOff &&
      4 * this->Far <= 5 * other.Far;
  }
};

/// Edges are halved around a place that quads do not fit: as far as an edge is long there, which takes few quads, or as on the mean, which also helps where
/// sides meet at a small angle.
enum class Refinement
{
  Narrow,
  Wide
};

/// The map of a surface along a field, and quads from it for any lengths of edges.
class QuadRounds
{
public:
  /// \param surface and options are borrowed.
  QuadRounds(const FramedMesh& surface, const Vector<Complex>& powers, const LengthsOfEdges& lengths,
    const QuadOptions& options, const ExecutionContext& context);

  /// Makes quads, with shorter edges where they do not fit, until they do.
  /// \param scale of all lengths.
  QuadRound Refine(double scale, Refinement refinement, const ExecutionContext& context);
  /// The same, beginning with the lengths of a round before where edges were halved.
  QuadRound RefineAgain(const QuadRound& before, double scaleBefore, double scale, const ExecutionContext& context);

  const FramedMesh& Surface;
  const QuadOptions& Options;
  const SurfaceAngles Angles;
  CrossField Field;
  const std::vector<int> Components;
  const NearestPlaces Places;
  LengthsOfEdges Lengths; ///< scaled so that the real map gives the number of quads
  double Fit = 1.0;       ///< that scale
  int SplitSingularities = 0;
  CutSurface Cut;
  std::optional<LinesOfEdges> Lines; ///< of aligned edges

private:
  void FitLengths(const ExecutionContext& context);
  QuadRound Refine(double scale, Refinement refinement, Vector<double> scales, const ExecutionContext& context);
  QuadRound Make(const Vector<double>& lengths, const ExecutionContext& context);
  /// Marks faces whose corners are far from quads as bad, and finds the tips.
  void MarkFar(
    const Vector<double>& lengths, const IsolineCells& cells, QuadRound& round, const ExecutionContext& context) const;

  std::optional<SeamlessMap> Map;
};

}

#endif
