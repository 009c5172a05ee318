#include "Drawing/EvenlySpacedLines.h"

#include "Drawing/LineSpacing.h"
#include "Drawing/LineTracer.h"
#include "Drawing/StagnationCheck.h"
#include "Support/Errors.h"
#include "Support/Remedy.h"

#include <algorithm>
#include <cmath>
#include <deque>
#include <unordered_map>

namespace dmg
{

namespace
{

// Distances, as parts of the separation.
constexpr double NearestSeed = 0.95;  ///< a seed beside a bent line is a little nearer to it than it was put
constexpr double ShortestStep = 0.02; ///< between two looks at the neighbours
constexpr double WidestClosing = 0.1; ///< offset across which a line is closed
constexpr double CoverRadius = 0.9;
constexpr double FailureRadius = 0.25; ///< around a line that is too short, others are as well
constexpr double CoverStep = 0.8;      ///< the faces within CoverRadius of such samples are near the line
constexpr double FailureStep =
  0.2;                           ///< the faces within FailureRadius of such samples are near a line that is too short
constexpr double SeedStep = 0.5; ///< along a line, between seeds beside it

constexpr double IdleDistance = 0.05; ///< within which a line that stays ends

/// The number of pieces between two checkpoints.
constexpr int PiecesBetweenCheckpoints = 512;

struct Seed
{
  SurfacePoint Place;
  int Direction;
};

class LineDrawing
{
public:
  LineDrawing(const UnfoldedSurface& surface, const DirectionsOnFaces& field, const LineOptions& options,
    const ExecutionContext& context)
    : Surface(surface)
    , Field(field)
    , Options(options)
    , Context(context)
    , Spacing(surface, field, options.Separation)
    , TooShort(surface, field, options.Separation)
    , Walk(surface)
    , Tracer(surface, field)
    , StopDistance(options.StopRatio * options.Separation)
  {
    this->Lines.Offsets.push_back(0);
  }

  LinesOnSurface DrawAll()
  {
    const int numberOfFaces = this->Surface.Mesh().NumberOfFaces();
    for (int face = 0; face < numberOfFaces; ++face)
    {
      for (int family = 0; family < this->Field.NumberOfFamilies(); ++family)
      {
        if (this->Field.HasDirection(face) && !this->Spacing.IsCovered(face, family))
        {
          this->Spacing.CoverFamily(face, family);
          this->DrawFrom({ this->Surface.Centre(face), family });
        }
      }
      this->Count();
    }
    this->Context.Checkpoint(1.0);
    return std::move(this->Lines);
  }

private:
  struct TrailPoint
  {
    Vector3 Position;
    int Face;
    double Magnitude;
  };
  /// One half of a line, from its seed.
  struct Trail
  {
    std::vector<TrailPoint> Points;
    double Length = 0.0;
    bool IsClosed = false;
  };

  void Count()
  {
    if (++this->Pieces % PiecesBetweenCheckpoints == 0)
    {
      this->Context.Checkpoint(std::min(this->Spacing.CoveredPart(), 1.0));
    }
  }

  /// A line through a seed, lines beside it, and so on.
  void DrawFrom(const Seed& first)
  {
    std::deque<Seed> waiting(1, first);
    while (!waiting.empty())
    {
      const Seed seed = waiting.front();
      waiting.pop_front();
      this->Count();
      const Complex direction = this->Field.Direction(seed.Place.Face, seed.Direction);
      const std::size_t size = this->Spacing.Segments().size();
      if (!this->Spacing.IsFree(seed.Place, direction, NearestSeed * this->Options.Separation) ||
        !this->TooShort.IsFree(seed.Place, direction, FailureRadius * this->Options.Separation))
      {
        continue;
      }
      if (!this->DrawThrough(seed))
      {
        // The faces around begin no line, as TooShort would say of each of them after a walk.
        const auto cover = [this](const SurfacePoint& at, Complex along)
        { this->Spacing.Cover(at, along, FailureRadius * this->Options.Separation); };
        cover(seed.Place, direction);
        this->VisitSamples(size, FailureStep, cover);
        for (std::size_t i = size; i < this->Spacing.Segments().size(); ++i)
        {
          this->TooShort.Add(this->Spacing.Segments()[i]);
        }
        this->Spacing.Shrink(size);
        continue;
      }
      this->VisitSamples(size, CoverStep,
        [&](const SurfacePoint& at, Complex along)
        { this->Spacing.Cover(at, along, CoverRadius * this->Options.Separation); });
      this->VisitSamples(size, SeedStep,
        [&](const SurfacePoint& at, Complex along)
        {
          this->SeedBeside(at, along, waiting);
          this->SeedBeside(at, -along, waiting);
        });
    }
  }

  /// visit(place, direction) at equal steps along the segments from a first one.
  template <class Visit>
  void VisitSamples(std::size_t first, double step, const Visit& visit)
  {
    double rest = 0.5 * step * this->Options.Separation;
    const std::size_t size = this->Spacing.Segments().size();
    for (std::size_t i = first; i < size; ++i)
    {
      const LineSpacing::Segment segment = this->Spacing.Segments()[i];
      const double length = std::abs(segment.To - segment.From);
      for (; rest < length; rest += step * this->Options.Separation)
      {
        const Complex at = segment.From + rest / length * (segment.To - segment.From);
        this->Count();
        visit(SurfacePoint{ segment.Face, at }, segment.Direction);
      }
      rest -= length;
    }
  }

  /// The direction to the left.
  void SeedBeside(const SurfacePoint& at, Complex along, std::deque<Seed>& waiting)
  {
    SurfacePoint place = at;
    Complex left = Complex(0.0, 1.0) * along;
    if (this->Surface.GoStraight(place, left, this->Options.Separation) && this->Field.HasDirection(place.Face))
    {
      waiting.push_back({ place, this->Field.NearestFamily(place.Face, Complex(0.0, 1.0) * left) });
    }
  }

  /// \return whether the line is long enough; else only its segments are left.
  bool DrawThrough(const Seed& seed)
  {
    Trail forth;
    this->AddPoint(forth, this->Surface.Position(seed.Place.Face, seed.Place.Point), seed.Place.Face, seed.Place.Face);
    Trail back = forth;
    this->Tracer.Start(seed.Place, seed.Direction, false);
    this->Follow(seed, 1.0, forth);
    if (!forth.IsClosed)
    {
      this->Tracer.Start(seed.Place, seed.Direction, true);
      this->Follow(seed, -1.0, back);
    }
    if (!(forth.Length + back.Length >= this->Options.MinimumLength) || forth.Points.size() + back.Points.size() < 3)
    {
      this->Lines.LongestLeftOut = std::max(this->Lines.LongestLeftOut, forth.Length + back.Length);
      return false;
    }
    std::reverse(back.Points.begin(), back.Points.end());
    back.Points.pop_back(); // the seed
    for (const Trail* trail : { &back, &forth })
    {
      for (const TrailPoint& point : trail->Points)
      {
        this->Lines.Positions.push_back(point.Position);
        this->Lines.Faces.push_back(point.Face);
        this->Lines.Magnitudes.push_back(point.Magnitude);
      }
    }
    this->Lines.Offsets.push_back(static_cast<int>(this->Lines.Positions.size()));
    this->Lines.Lengths.push_back(forth.Length + back.Length);
    this->Lines.Families.push_back(this->Field.FamilyOf(seed.Direction));
    this->Lines.IsClosed.push_back(forth.IsClosed);
    return true;
  }

  /// Follows a line from where the tracer started.
  void Follow(const Seed& seed, double sign, Trail& trail)
  {
    // The room is a length that the line can go without coming too near to another one: distances change no faster
    // than it moves. The second half of a line begins at the seed, whose distance is known only before the first half.
    double room = sign > 0.0 ? (NearestSeed - this->Options.StopRatio) * this->Options.Separation : 0.0;
    StagnationCheck progress(trail.Points.back().Position, IdleDistance * this->Options.Separation);
    while (true)
    {
      const LineTracer::Piece piece = this->Tracer.Current();
      const double length = piece.Length();
      double done = 0.0;
      while (done + room < length)
      {
        done += room;
        this->Count();
        const Complex at = piece.From + done / length * (piece.To - piece.From);
        const LineSpacing::Neighbour neighbour =
          this->Spacing.Nearest({ piece.Face, at }, piece.Direction, this->Options.Separation,
            { this->Lines.NumberOfLines(), sign * (trail.Length + done), 2.0 * this->StopDistance });
        if (neighbour.Distance <= this->StopDistance)
        {
          const bool isOwn = neighbour.Line == this->Lines.NumberOfLines();
          this->AddSegment(piece, piece.From, at, sign, trail);
          this->AddPoint(trail, this->Surface.Position(piece.Face, at), piece.Face, piece.Face);
          if (isOwn && sign > 0.0 && std::abs(neighbour.Arc) < 2.0 * this->Options.Separation)
          {
            this->Close(seed, at, trail);
          }
          return;
        }
        room = std::max(std::min(neighbour.Distance, this->Options.Separation) - this->StopDistance,
          ShortestStep * this->Options.Separation);
      }
      room -= length - done;
      this->AddSegment(piece, piece.From, piece.To, sign, trail);
      if (this->Spacing.Segments().size() > static_cast<std::size_t>(this->Options.MostSegments))
      {
        throw InvalidInput("the lines cross more than " + std::to_string(this->Options.MostSegments) +
          " triangles; raise " + TextOf(Remedy::LineSeparation) +
          ", or take a surface of fewer and less thin triangles");
      }
      const bool goesOn = this->Tracer.Advance();
      this->AddPoint(trail, this->Surface.PositionAlong(piece.Halfedge, piece.Part), piece.Face,
        goesOn ? this->Tracer.Current().Face : piece.Face);
      this->Count();
      if (!goesOn || progress.IsStagnant(trail.Points.back().Position))
      {
        return;
      }
    }
  }

  /// Goes on to the seed, where the line passes it closely enough; else it stays as it is.
  /// \param from where the line is, in the tracer's piece.
  void Close(const Seed& seed, Complex from, Trail& trail)
  {
    std::unordered_map<int, SurfaceWalk::Placement> aroundSeed;
    this->Walk.Around(seed.Place, 2.0 * this->Options.Separation,
      [&](const SurfaceWalk::Placement& placement)
      {
        aroundSeed.emplace(placement.Face, placement);
        return true;
      });
    const Complex along = this->Field.Direction(seed.Place.Face, seed.Direction);
    const std::size_t size = this->Spacing.Segments().size();
    Trail rest = { {}, trail.Length, true };
    StagnationCheck progress(trail.Points.back().Position, IdleDistance * this->Options.Separation);
    while (rest.Length - trail.Length < 2.0 * this->Options.Separation)
    {
      const LineTracer::Piece& piece = this->Tracer.Current();
      const auto found = aroundSeed.find(piece.Face);
      if (found == aroundSeed.end() || Dot(found->second.Turn * piece.Direction, along) < 0.5)
      {
        break;
      }
      const Complex a = std::conj(along) * found->second.Place(from);
      const Complex b = std::conj(along) * found->second.Place(piece.To);
      if (a.real() < 0.0 && b.real() >= 0.0)
      {
        const double part = a.real() / (a.real() - b.real());
        if (std::abs(a.imag() + part * (b.imag() - a.imag())) > WidestClosing * this->Options.Separation)
        {
          break;
        }
        this->AddSegment(piece, from, from + part * (piece.To - from), 1.0, rest);
        trail.Points.insert(trail.Points.end(), rest.Points.begin(), rest.Points.end());
        trail.Length = rest.Length;
        trail.IsClosed = true;
        return;
      }
      this->AddSegment(piece, from, piece.To, 1.0, rest);
      this->AddPoint(rest, this->Surface.PositionAlong(piece.Halfedge, piece.Part), piece.Face, piece.Face);
      this->Count();
      if (!this->Tracer.Advance() || progress.IsStagnant(rest.Points.back().Position))
      {
        break;
      }
      from = this->Tracer.Current().From;
    }
    this->Spacing.Shrink(size);
  }

  void AddSegment(const LineTracer::Piece& piece, Complex from, Complex to, double sign, Trail& trail)
  {
    const double length = std::abs(to - from);
    this->Spacing.Add({ piece.Face, from, to, piece.Direction, this->Lines.NumberOfLines(), sign * trail.Length,
      sign * (trail.Length + length), piece.IsAlongEdge, -1 });
    trail.Length += length;
  }

  /// \param before, after the faces on both sides of a point.
  void AddPoint(Trail& trail, const Vector3& position, int before, int after) const
  {
    if (!trail.Points.empty() && trail.Points.back().Position == position)
    {
      return;
    }
    trail.Points.push_back({ position, before, 0.5 * (this->Field.Magnitude(before) + this->Field.Magnitude(after)) });
  }

  const UnfoldedSurface& Surface;
  const DirectionsOnFaces& Field;
  const LineOptions Options;
  const ExecutionContext& Context;
  LineSpacing Spacing;
  LineSpacing TooShort; ///< lines that were not drawn
  SurfaceWalk Walk;
  LineTracer Tracer;
  const double StopDistance;
  LinesOnSurface Lines;
  long long Pieces = 0;
};

}

LinesOnSurface EvenlySpacedLines(const UnfoldedSurface& surface, const DirectionsOnFaces& field,
  const LineOptions& options, const ExecutionContext& context)
{
  return LineDrawing(surface, field, options, context).DrawAll();
}

}
