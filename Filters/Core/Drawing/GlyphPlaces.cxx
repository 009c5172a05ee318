#include "Drawing/GlyphPlaces.h"

#include "Drawing/SurfaceSamples.h"
#include "Support/Errors.h"
#include "Support/Remedy.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace dmg
{

namespace
{

/// The radius of the inscribed circle of an equilateral triangle.
double InscribedRadius(double area)
{
  return std::sqrt(area / (3.0 * std::sqrt(3.0)));
}

void CheckNumber(std::size_t number, const GlyphPlaceOptions& options)
{
  if (number > static_cast<std::size_t>(options.MostGlyphs))
  {
    throw InvalidInput(std::to_string(number) + " glyphs are more than the " + std::to_string(options.MostGlyphs) +
      " that are drawn; " +
      (options.Placement == GlyphPlacement::EvenlySpread ? "raise " + TextOf(Remedy::GlyphSeparation)
                                                         : TextOf(Remedy::SpreadGlyphs)));
  }
}

std::vector<SurfacePoint> PointsFor(
  const UnfoldedSurface& surface, const GlyphPlaceOptions& options, const ExecutionContext& context)
{
  if (options.Placement == GlyphPlacement::EvenlySpread)
  {
    std::vector<SurfacePoint> spread = EvenlySpreadPoints(surface, options.Distance, context);
    CheckNumber(spread.size(), options);
    return spread;
  }
  CheckNumber(surface.Mesh().NumberOfFaces(), options);
  std::vector<SurfacePoint> points;
  for (int face = 0; face < surface.Mesh().NumberOfFaces(); ++face)
  {
    points.push_back(surface.Centre(face));
  }
  return points;
}

}

std::vector<GlyphPlace> PlaceGlyphs(const UnfoldedSurface& surface, const DirectionsOnFaces& field,
  const GlyphPlaceOptions& options, const ExecutionContext& context)
{
  const Vector<double> areas = surface.Mesh().FaceAreas(context);
  double largest = 0.0;
  double sumOfRadii = 0.0;
  for (int face = 0; face < areas.size(); ++face)
  {
    largest = std::max(largest, field.Magnitude(face));
    sumOfRadii += InscribedRadius(areas[face]);
  }
  const double even = options.Placement == GlyphPlacement::EvenlySpread
    ? 0.5 * options.Distance
    : sumOfRadii / static_cast<double>(areas.size());

  std::vector<GlyphPlace> places;
  for (const SurfacePoint& point : PointsFor(surface, options, context))
  {
    const double magnitude = field.Magnitude(point.Face);
    const double size = options.Sizing == GlyphSizing::ByTriangle   ? InscribedRadius(areas[point.Face])
      : options.Sizing == GlyphSizing::ByMagnitude && largest > 0.0 ? even * (magnitude / largest)
                                                                    : even;
    places.push_back({ point, options.Scale * size });
  }
  return places;
}

}
