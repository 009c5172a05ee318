#include "Drawing/FieldGlyphs.h"

#include "Drawing/GlyphPlaces.h"
#include "Fields.h"
#include "Support/Errors.h"
#include "Support/NamedSurfaces.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace
{

using namespace dmg;
using namespace dmg::test;

constexpr auto Strokes = GlyphOptions::Shape::Strokes;
constexpr auto Solid = GlyphOptions::Shape::Solid;

TEST(FieldGlyphs, HaveABranchAlongEachDirection)
{
  const Vector3 direction = Vector3(2.0, 1.0, 0.0);
  for (int N = 2; N <= 8; ++N)
  {
    const DrawnField field(IrregularPlane(10, 10, 1), N, [&](const Vector3&) { return direction; });
    const SurfacePoint centre = field.Unfolded.Centre(90);
    const GlyphsOnSurface glyphs = FieldGlyphs(field.Unfolded, field.Field, { { centre, 2.0 } }, { Strokes, 0.1, 0.5 });
    ASSERT_EQ(glyphs.NumberOfCells(), N);
    for (int k = 0; k < N; ++k)
    {
      EXPECT_EQ(glyphs.Directions[k], k);
      EXPECT_NEAR(glyphs.Magnitudes[k], std::sqrt(5.0), 1e-14);
      const Vector3 root = glyphs.Positions[glyphs.Corners[glyphs.Offsets[k]]];
      const Vector3 tip = glyphs.Positions[glyphs.Corners[glyphs.Offsets[k + 1] - 1]];
      const Vector3 lifted = field.Unfolded.Position(centre.Face, centre.Point) + Vector3(0.0, 0.0, 0.5);
      EXPECT_LT((root - lifted).norm(), 1e-13);
      const Vector3 expected = 2.0 * (Eigen::AngleAxisd(2.0 * Pi * k / N, Vector3::UnitZ()) * direction.normalized());
      EXPECT_LT((tip - root - expected).norm(), 1e-12) << "N " << N << ", k " << k;
    }
  }
}

TEST(FieldGlyphs, OfVectorsAreArrows)
{
  const DrawnField field(PlaneGrid(10, 10), 1, [](const Vector3&) { return Vector3(0.0, 3.0, 0.0); });
  const SurfacePoint centre = field.Unfolded.Centre(90);
  const Vector3 middle = field.Unfolded.Position(centre.Face, centre.Point);
  for (const auto form : { Strokes, Solid })
  {
    const GlyphsOnSurface glyphs = FieldGlyphs(field.Unfolded, field.Field, { { centre, 2.0 } }, { form, 0.1, 0.0 });
    double low = 1e300, high = -1e300, widest = 0.0, heightOfWidest = 0.0;
    for (const Vector3& p : glyphs.Positions)
    {
      low = std::min(low, p[1] - middle[1]);
      high = std::max(high, p[1] - middle[1]);
      if (std::abs(p[0] - middle[0]) > widest)
      {
        widest = std::abs(p[0] - middle[0]);
        heightOfWidest = p[1] - middle[1];
      }
    }
    EXPECT_NEAR(low, -2.0, 1e-12);
    EXPECT_NEAR(high, 2.0, 1e-12);
    EXPECT_GT(heightOfWidest, 0.0) << "its head is in front";
  }
}

TEST(FieldGlyphs, AreLaidOntoTheSurface)
{
  const DrawnField field(Icosphere(4), 4, [](const Vector3& p) { return Vector3(p[1], 1.0, -p[0]); });
  std::vector<GlyphPlace> places;
  for (int face = 0; face < field.Mesh.NumberOfFaces(); face += 50)
  {
    places.push_back({ field.Unfolded.Centre(face), 0.8 });
  }
  for (const auto form : { Strokes, Solid })
  {
    const GlyphsOnSurface glyphs = FieldGlyphs(field.Unfolded, field.Field, places, { form, 0.1, 0.0 });
    EXPECT_EQ(glyphs.Glyphs.back(), static_cast<int>(places.size()) - 1);
    for (std::size_t i = 0; i < glyphs.Positions.size(); ++i)
    {
      EXPECT_NEAR(glyphs.Positions[i].norm(), 1.0, 0.002);
      EXPECT_GT(glyphs.Normals[i].dot(glyphs.Positions[i]), 0.99);
    }
  }
}

TEST(FieldGlyphs, EndAtTheBoundary)
{
  const DrawnField field(PlaneGrid(4, 4), 4, [](const Vector3&) { return Vector3(1.0, 0.0, 0.0); });
  const GlyphsOnSurface glyphs =
    FieldGlyphs(field.Unfolded, field.Field, { { field.Unfolded.Centre(9), 100.0 } }, { Solid, 0.1, 0.0 });
  for (const Vector3& p : glyphs.Positions)
  {
    EXPECT_GT(std::min({ p[0], p[1], 4.0 - p[0], 4.0 - p[1] }), -1e-12);
  }
}

TEST(FieldGlyphs, AreFiniteOnFacesWithoutArea)
{
  for (const Surface& surface : { SphereWithZeroAreaFaces(3, 10), CapsuleFromRectangle(16, 12) })
  {
    const DrawnField field(surface, 4, 5u);
    for (const auto placement : { GlyphPlacement::EvenlySpread, GlyphPlacement::EveryTriangle })
    {
      const std::vector<GlyphPlace> places =
        PlaceGlyphs(field.Unfolded, field.Field, { placement, 0.2, GlyphSizing::ByTriangle, 1.0 });
      const GlyphsOnSurface glyphs = FieldGlyphs(field.Unfolded, field.Field, places, GlyphOptions());
      EXPECT_GT(glyphs.NumberOfCells(), 0);
      for (const Vector3& p : glyphs.Positions)
      {
        ASSERT_TRUE(p.allFinite());
      }
    }
  }
}

TEST(PlaceGlyphs, SizesThemAsAsked)
{
  const DrawnField field(PlaneGrid(10, 10), 1, [](const Vector3& p) { return Vector3(p[0], 0.0, 0.0); });
  const auto place = [&](GlyphPlacement placement, GlyphSizing sizing) {
    return PlaceGlyphs(field.Unfolded, field.Field, { placement, 0.7, sizing, 2.0 });
  };
  const double inscribed = std::sqrt(0.5 / (3.0 * std::sqrt(3.0)));
  for (const GlyphPlace& glyph : place(GlyphPlacement::EvenlySpread, GlyphSizing::Even))
  {
    EXPECT_NEAR(glyph.Radius, 0.7, 1e-15);
  }
  for (const auto placement : { GlyphPlacement::EvenlySpread, GlyphPlacement::EveryTriangle })
  {
    for (const GlyphPlace& glyph : place(placement, GlyphSizing::ByTriangle))
    {
      EXPECT_NEAR(glyph.Radius, 2.0 * inscribed, 1e-14);
    }
  }
  for (const GlyphPlace& glyph : place(GlyphPlacement::EvenlySpread, GlyphSizing::ByMagnitude))
  {
    const double largest = 9.0 + 2.0 / 3.0;
    EXPECT_NEAR(glyph.Radius, 0.7 * field.Centre(glyph.Centre.Face)[0] / largest, 1e-14);
  }
  EXPECT_EQ(place(GlyphPlacement::EveryTriangle, GlyphSizing::Even).size(), 200u);
}

TEST(PlaceGlyphs, RefusesMoreThanPicturesShow)
{
  const DrawnField field(PlaneGrid(10, 10), 1, [](const Vector3&) { return Vector3(1.0, 0.0, 0.0); });
  for (const auto placement : { GlyphPlacement::EvenlySpread, GlyphPlacement::EveryTriangle })
  {
    GlyphPlaceOptions options{ placement, 0.7 };
    options.MostGlyphs = static_cast<int>(PlaceGlyphs(field.Unfolded, field.Field, options).size());
    EXPECT_NO_THROW(PlaceGlyphs(field.Unfolded, field.Field, options));
    --options.MostGlyphs;
    EXPECT_THROW(PlaceGlyphs(field.Unfolded, field.Field, options), InvalidInput);
  }
}

}
