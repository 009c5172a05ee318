#include "Drawing/FieldGlyphs.h"

#include <cmath>

namespace dmg
{

namespace
{

/// The number of places where a branch bends with the surface.
constexpr int Steps = 5;

/// The head of an arrow, in parts of its radius.
constexpr double HeadLength = 0.7;
constexpr double HeadWidth = 3.2; ///< over the width of the shaft

/// Half width at the tip over that at the centre.
constexpr double Tip = 0.5;

constexpr int GlyphsBetweenCheckpoints = 1024;

class GlyphDrawing
{
public:
  GlyphDrawing(const UnfoldedSurface& surface, const DirectionsOnFaces& field, const GlyphOptions& options)
    : Surface(surface)
    , Field(field)
    , Options(options)
  {
    this->Glyphs.Offsets.push_back(0);
  }

  void Draw(const GlyphPlace& place, int glyph)
  {
    this->Place = place;
    this->Glyph = glyph;
    const int N = this->Field.N();
    for (this->Branch = 0; this->Branch < N; ++this->Branch)
    {
      const bool isSolid = this->Options.Form == GlyphOptions::Shape::Solid;
      if (N == 1)
      {
        isSolid ? this->AddArrow() : this->AddArrowOfStrokes();
      }
      else
      {
        isSolid ? this->AddBranch() : this->AddStroke({ 0.0, 1.0 });
      }
    }
  }

  GlyphsOnSurface Take() { return std::move(this->Glyphs); }

private:
  /// A point of the glyph whose current branch goes from 0 to 1; \return its number.
  int AddPoint(Complex offset)
  {
    const double length = std::abs(offset);
    SurfacePoint at = this->Place.Centre;
    if (length > 0.0)
    {
      Complex direction = this->Field.Direction(at.Face, this->Branch) * (offset / length);
      this->Surface.GoStraight(at, direction, length * this->Place.Radius);
    }
    const Vector3 normal = this->Surface.Frames().Normal(at.Face);
    this->Glyphs.Positions.push_back(this->Surface.Position(at.Face, at.Point) + this->Options.Lift * normal);
    this->Glyphs.Normals.push_back(normal);
    return static_cast<int>(this->Glyphs.Positions.size()) - 1;
  }

  void AddCell(const std::vector<int>& corners)
  {
    this->Glyphs.Corners.insert(this->Glyphs.Corners.end(), corners.begin(), corners.end());
    this->Glyphs.Offsets.push_back(static_cast<int>(this->Glyphs.Corners.size()));
    this->Glyphs.Directions.push_back(this->Branch);
    this->Glyphs.Glyphs.push_back(this->Glyph);
    this->Glyphs.Magnitudes.push_back(this->Field.Magnitude(this->Place.Centre.Face));
  }

  /// A polyline between offsets.
  void AddStroke(const std::vector<Complex>& offsets)
  {
    std::vector<int> corners(1, this->AddPoint(offsets.front()));
    for (std::size_t i = 1; i < offsets.size(); ++i)
    {
      for (int step = 1; step <= Steps; ++step)
      {
        const double part = static_cast<double>(step) / Steps;
        corners.push_back(this->AddPoint((1.0 - part) * offsets[i - 1] + part * offsets[i]));
      }
    }
    this->AddCell(corners);
  }

  /// Quadrilaterals along the branch, whose half width changes from one value to another.
  void AddStrip(double from, double to, double widthFrom, double widthTo)
  {
    std::vector<int> last;
    for (int step = 0; step <= Steps; ++step)
    {
      const double part = static_cast<double>(step) / Steps;
      const double along = (1.0 - part) * from + part * to;
      const double width = (1.0 - part) * widthFrom + part * widthTo;
      const int right = this->AddPoint({ along, -width });
      const int left = width > 0.0 ? this->AddPoint({ along, width }) : right;
      if (step > 0)
      {
        this->AddCell(left == right ? std::vector<int>{ last[0], right, last[1] }
                                    : std::vector<int>{ last[0], right, left, last[1] });
      }
      last = { right, left };
    }
  }

  void AddArrow()
  {
    const double neck = 1.0 - HeadLength;
    const double width = this->Options.Width;
    this->AddStrip(-1.0, neck, width, width);
    this->AddStrip(neck, 1.0, HeadWidth * width, 0.0);
  }

  void AddArrowOfStrokes()
  {
    this->AddStroke({ -1.0, 1.0 });
    const double half = 0.5 * HeadLength;
    this->AddStroke({ { 1.0 - HeadLength, half }, 1.0, { 1.0 - HeadLength, -half } });
  }

  /// Branches meet along the lines between them, without overlap.
  void AddBranch()
  {
    const double width = this->Options.Width;
    const double base = this->Field.N() == 2 ? 0.0 : width / std::tan(Pi / this->Field.N());
    if (base > 0.0)
    {
      const int centre = this->AddPoint(0.0);
      const int right = this->AddPoint({ base, -width });
      this->AddCell({ centre, right, this->AddPoint({ base, width }) });
    }
    this->AddStrip(base, 1.0, width, Tip * width);
  }

  const UnfoldedSurface& Surface;
  const DirectionsOnFaces& Field;
  const GlyphOptions Options;
  GlyphsOnSurface Glyphs;
  GlyphPlace Place{};
  int Glyph = 0;
  int Branch = 0;
};

}

GlyphsOnSurface FieldGlyphs(const UnfoldedSurface& surface, const DirectionsOnFaces& field,
  const std::vector<GlyphPlace>& places, const GlyphOptions& options, const ExecutionContext& context)
{
  GlyphDrawing drawing(surface, field, options);
  const int numberOfPlaces = static_cast<int>(places.size());
  for (int i = 0; i < numberOfPlaces; ++i)
  {
    if (field.HasDirection(places[i].Centre.Face) && places[i].Radius > 0.0)
    {
      drawing.Draw(places[i], i);
    }
    if (i % GlyphsBetweenCheckpoints == 0)
    {
      context.Checkpoint(static_cast<double>(i) / numberOfPlaces);
    }
  }
  context.Checkpoint(1.0);
  return drawing.Take();
}

}
