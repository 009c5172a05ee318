#ifndef dmgGlyphPlaces_h
#define dmgGlyphPlaces_h

#include "Drawing/FieldGlyphs.h"

#include <vector>

namespace dmg
{

enum class GlyphPlacement
{
  EvenlySpread, ///< at a distance from each other (EvenlySpreadPoints)
  EveryTriangle ///< in the centre of each face
};

enum class GlyphSizing
{
  Even,       ///< all alike: half the distance between glyphs, or the mean size of the faces where each has one
  ByTriangle, ///< as large as the face is: the radius of the inscribed circle of an equilateral one of its area
  ByMagnitude ///< as Even, times the magnitude of the field over the largest one
};

struct GlyphPlaceOptions
{
  GlyphPlacement Placement = GlyphPlacement::EvenlySpread;
  double Distance = 1.0; ///< between glyphs that are evenly spread, in the unit of the points; > 0
  GlyphSizing Sizing = GlyphSizing::Even;
  double Scale = 1.0;       ///< of all sizes
  int MostGlyphs = 1000000; ///< more are refused: no picture shows them
};

/// Places and sizes of glyphs. Cost: that of EvenlySpreadPoints, or linear.
/// \throw InvalidInput there would be more than MostGlyphs.
/// \throw Cancelled
std::vector<GlyphPlace> PlaceGlyphs(const UnfoldedSurface& surface, const DirectionsOnFaces& field,
  const GlyphPlaceOptions& options, const ExecutionContext& context = SerialContext());

}

#endif
