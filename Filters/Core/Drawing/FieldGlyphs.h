#ifndef dmgFieldGlyphs_h
#define dmgFieldGlyphs_h

#include "Drawing/DirectionsOnFaces.h"
#include "Drawing/UnfoldedSurface.h"
#include "Support/ExecutionContext.h"

#include <vector>

namespace dmg
{

struct GlyphOptions
{
  enum class Shape
  {
    Strokes, ///< polylines
    Solid    ///< polygons of some width
  };
  Shape Form = Shape::Solid;
  /// Half width of a branch over its length (Solid), in (0, 0.5).
  double Width = 0.1;
  /// Off the surface along its normal, in the unit of the points.
  double Lift = 0.0;
};

/// The place of a glyph, and the length of its branches, in the unit of the points.
struct GlyphPlace
{
  SurfacePoint Centre;
  double Radius;
};

/// Polylines or polygons.
struct GlyphsOnSurface
{
  std::vector<Vector3> Positions;
  std::vector<Vector3> Normals; ///< of the surface, unit
  // per cell
  std::vector<int> Offsets;    ///< into Corners, and its end
  std::vector<int> Corners;    ///< rows of Positions
  std::vector<int> Directions; ///< k, 0 to N - 1
  std::vector<int> Glyphs;     ///< number of the place
  std::vector<double> Magnitudes;

  int NumberOfCells() const { return static_cast<int>(this->Directions.size()); }
};

/// One glyph per place: for N = 1 an arrow through it, else a star of N branches, which are a line for N = 2 and a
/// cross for N = 4. Glyphs are laid onto the surface: each of their points is reached from the centre on a straight
/// way over it (exponential map), so that large ones bend with it. At the boundary they end.
///
/// Places on faces without direction stay empty. Cost: linear in the glyphs' size in faces.
/// \throw Cancelled
GlyphsOnSurface FieldGlyphs(const UnfoldedSurface& surface, const DirectionsOnFaces& field,
  const std::vector<GlyphPlace>& places, const GlyphOptions& options,
  const ExecutionContext& context = SerialContext());

}

#endif
