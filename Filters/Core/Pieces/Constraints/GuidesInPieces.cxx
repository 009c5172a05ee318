#include "Pieces/Constraints/GuidesInPieces.h"

#include "Constraints/CutSegment.h"
#include "Pieces/Surface/GhostTriangles.h"
#include "Pieces/Surface/JoinedTriangles.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <vector>

namespace dmg
{

namespace
{

/// A part of a segment, or a vector, whose length is 0.
struct Stretch
{
  Vector3 Start;
  Vector3 End;
  int Rank;                                                  ///< whose share it is of
  double Distance = std::numeric_limits<double>::infinity(); ///< of its middle from the surface

  Vector3 Middle() const { return 0.5 * this->Start + 0.5 * this->End; }
  double Length() const { return (this->End - this->Start).norm(); }
};

/// The share of a rank: consecutive segments and vectors.
Guides ShareOf(const Guides& all, long long first, long long last)
{
  Guides share;
  share.MaximumDistance = all.MaximumDistance;
  share.MayMiss = all.MayMiss;
  long long before = 0;
  const auto range = [&before, first, last](std::size_t count)
  {
    const long long size = static_cast<long long>(count);
    const std::pair<long long, long long> own{ std::clamp(first - before, 0LL, size),
      std::clamp(last - before, 0LL, size) };
    before += size;
    return own;
  };
  for (const GuideLine& line : all.Lines)
  {
    const auto [begin, end] = range(std::max<std::size_t>(line.Points.size(), 1) - 1);
    if (begin < end)
    {
      GuideLine part{ { line.Points.begin() + begin, line.Points.begin() + end + 1 }, line.Weights, line.Direction };
      if (line.Weights.size() > 1)
      {
        part.Weights = { line.Weights.begin() + begin, line.Weights.begin() + end };
      }
      share.Lines.push_back(std::move(part));
    }
  }
  const auto [begin, end] = range(all.Vectors.size());
  share.Vectors = { all.Vectors.begin() + begin, all.Vectors.begin() + end };
  return share;
}

long long NumberOfElements(const Guides& guides)
{
  long long number = static_cast<long long>(guides.Vectors.size());
  for (const GuideLine& line : guides.Lines)
  {
    number += std::max<long long>(static_cast<long long>(line.Points.size()), 1) - 1;
  }
  return number;
}

/// The triangles that ranks need for their shares.
class TrianglesNearGuides
{
public:
  TrianglesNearGuides(
    const PieceOfSurface& piece, const NearestPlaces& places, const SurfaceSizes& sizes, double maximumDistance)
    : Piece(piece)
    , All(piece.Everyone())
    , Places(places)
    , Sizes(sizes)
    , MaximumDistance(maximumDistance)
    , LastRank(piece.NumberOfOwnFaces(), -1)
    , Needed(this->All.Size())
  {
  }

  /// \param share of a rank; shares come in the order of ranks.
  void AddShare(const Guides& share, int rank)
  {
    for (const GuideLine& line : share.Lines)
    {
      for (std::size_t i = 0; i + 1 < line.Points.size(); ++i)
      {
        const CutSegment cut = CutToSurface(line.Points[i], line.Points[i + 1], this->Sizes, this->MaximumDistance);
        if (cut.IsAny && std::isfinite((cut.End - cut.Start).norm()))
        {
          this->Stretches.push_back({ cut.Start, cut.End, rank });
        }
      }
    }
    for (const GuideVector& vector : share.Vectors)
    {
      this->Stretches.push_back({ vector.Position, vector.Position, rank });
    }
  }

  /// Collective.
  std::vector<TravellingTriangle> Collect(const ExecutionContext& context);

private:
  void FindDistances(std::vector<Stretch>& stretches, const ExecutionContext& context) const;
  bool IsFar(const Stretch& stretch) const;
  double LongestAt(double distance) const;
  void AddNear(const Stretch& stretch);
  std::vector<std::vector<TravellingTriangle>> Travelling() const;

  const PieceOfSurface& Piece;
  const Ranks& All;
  const NearestPlaces& Places;
  const SurfaceSizes& Sizes;
  const double MaximumDistance;
  std::vector<Stretch> Stretches;
  std::vector<int> LastRank;            ///< per own triangle the last one that needs it
  std::vector<std::vector<int>> Needed; ///< own triangles, by rank
};

/// The distance from the nearest piece.
void TrianglesNearGuides::FindDistances(std::vector<Stretch>& stretches, const ExecutionContext& context) const
{
  constexpr std::size_t Batch = 1024;
  std::vector<double> distances(stretches.size(), std::numeric_limits<double>::infinity());
  this->All.Together(
    [&]
    {
      int near = -1;
      for (std::size_t k = 0; k < stretches.size(); ++k)
      {
        if (k % Batch == 0)
        {
          context.Checkpoint(static_cast<double>(k) / static_cast<double>(stretches.size()));
        }
        const NearestPlace place = this->Places(stretches[k].Middle(), near);
        distances[k] = place.Distance;
        near = place.Face;
      }
    });
  this->All.Min(distances);
  for (std::size_t k = 0; k < stretches.size(); ++k)
  {
    stretches[k].Distance = distances[k];
  }
}

/// Whether nothing near the surface depends on a stretch. Steps of SegmentOnSurface are no longer than half of the distance from the
/// surface, so those from beyond twice the maximum distance stay outside of it.
bool TrianglesNearGuides::IsFar(const Stretch& stretch) const
{
  return !std::isfinite(stretch.Distance) || stretch.Distance - 0.5 * stretch.Length() > 2.0 * this->MaximumDistance;
}

/// The steps of SegmentOnSurface at a distance, but for those far away from the surface.
double TrianglesNearGuides::LongestAt(double distance) const
{
  constexpr double FarAway = 8.0; // mean edges
  return std::max(this->Sizes.MeanEdge, std::min(distance, FarAway * this->Sizes.MeanEdge));
}

/// Adds the triangles nearest to places of a stretch, and those that are passed on the way there from a place one step away.
void TrianglesNearGuides::AddNear(const Stretch& stretch)
{
  constexpr double Rounding = 1e-9;
  const double length = stretch.Length();
  const double farther = length > 0.0 ? length + 2.0 * this->LongestAt(stretch.Distance) : 0.0;
  const double reach = stretch.Distance + farther + Rounding * (stretch.Distance + this->Sizes.Diagonal());
  this->Places.VisitNear(stretch.Middle(), reach,
    [&](int face)
    {
      const int triangle = face - this->Piece.FirstOwnFace();
      if (this->Piece.IsOwnFace(face) && this->LastRank[triangle] != stretch.Rank)
      {
        this->LastRank[triangle] = stretch.Rank;
        this->Needed[stretch.Rank].push_back(triangle);
      }
    });
}

std::vector<TravellingTriangle> TrianglesNearGuides::Collect(const ExecutionContext& context)
{
  std::vector<Stretch> current = std::move(this->Stretches), shortOnes;
  while (!current.empty()) // the same on all ranks
  {
    this->FindDistances(current, context);
    std::vector<Stretch> halves;
    for (const Stretch& stretch : current)
    {
      if (this->IsFar(stretch))
      {
        continue;
      }
      if (stretch.Length() <= std::max(this->Sizes.MeanEdge, 0.5 * this->LongestAt(stretch.Distance)))
      {
        shortOnes.push_back(stretch);
        continue;
      }
      halves.push_back({ stretch.Start, stretch.Middle(), stretch.Rank });
      halves.push_back({ stretch.Middle(), stretch.End, stretch.Rank });
    }
    current = std::move(halves);
  }
  std::stable_sort(
    shortOnes.begin(), shortOnes.end(), [](const Stretch& a, const Stretch& b) { return a.Rank < b.Rank; });
  this->All.Together(
    [&]
    {
      for (const Stretch& stretch : shortOnes)
      {
        this->AddNear(stretch);
      }
    });
  std::vector<TravellingTriangle> triangles = this->All.Exchange(this->Travelling()).Items;
  std::sort(triangles.begin(), triangles.end(),
    [](const TravellingTriangle& a, const TravellingTriangle& b) { return a.Place < b.Place; });
  triangles.erase(std::unique(triangles.begin(), triangles.end(),
                    [](const TravellingTriangle& a, const TravellingTriangle& b) { return a.Place == b.Place; }),
    triangles.end());
  return triangles;
}

/// The first triangle of the surface goes to all, so that nobody's mesh is empty.
std::vector<std::vector<TravellingTriangle>> TrianglesNearGuides::Travelling() const
{
  const bool isFirst = this->All.SumBefore(static_cast<long long>(this->Piece.NumberOfOwnFaces())) == 0 &&
    this->Piece.NumberOfOwnFaces() > 0;
  std::vector<std::vector<TravellingTriangle>> toRanks(this->All.Size());
  for (int rank = 0; rank < this->All.Size(); ++rank)
  {
    for (const int triangle : this->Needed[rank])
    {
      toRanks[rank].push_back(this->Piece.Travelling(triangle));
    }
    if (isFirst)
    {
      toRanks[rank].push_back(this->Piece.Travelling(0));
    }
  }
  return toRanks;
}

/// A part of a surface that other ranks have, too.
FramedMesh MeshOf(const std::vector<TravellingTriangle>& triangles, const ExecutionContext& context)
{
  std::vector<PlaceOnRank> labels;
  std::vector<Vector3> positions;
  for (const TravellingTriangle& triangle : triangles)
  {
    for (int corner = 0; corner < 3; ++corner)
    {
      labels.push_back(triangle.Vertices[corner]);
      positions.emplace_back(triangle.Positions[corner].data());
    }
  }
  JoinedTriangles joined = Join(labels, positions, context);
  return FramedMesh(TriangleMesh(std::move(joined.Positions), std::move(joined.Corners), {}, context), context);
}

/// A direction on its way to the rank that has the triangle.
struct TravellingDirection
{
  int Triangle;
  double Numbers[3], Place[3];
  double Weight;
  int Side;
};

GuidesReport OfAllRanks(const Ranks& ranks, const GuidesReport& share)
{
  GuidesReport all = share;
  for (long long GuidesReport::*const count :
    { &GuidesReport::Taken, &GuidesReport::TooFar, &GuidesReport::OnFarSide, &GuidesReport::Perpendicular })
  {
    all.*count = ranks.Sum(share.*count);
  }
  all.Farthest = ranks.Max(share.Farthest);
  return all;
}

FollowedGuides ToTheirRanks(
  const Ranks& ranks, const FollowedGuides& followed, const std::vector<TravellingTriangle>& triangles)
{
  std::vector<std::vector<TravellingDirection>> toRanks(ranks.Size());
  for (std::size_t i = 0; i < followed.Directions.size(); ++i)
  {
    const Constraint& direction = followed.Directions[i];
    const PlaceOnRank& place = triangles[direction.Element].Place;
    const Vector3 &v = direction.Direction, &p = followed.Places[i];
    toRanks[place.Rank].push_back(
      { place.Number, { v[0], v[1], v[2] }, { p[0], p[1], p[2] }, direction.Weight, direction.Side });
  }
  FollowedGuides own{ {}, {}, OfAllRanks(ranks, followed.Report) };
  for (const TravellingDirection& direction : ranks.Exchange(toRanks).Items)
  {
    own.Directions.push_back({ direction.Triangle, Vector3(direction.Numbers), direction.Weight, direction.Side });
    own.Places.emplace_back(direction.Place);
  }
  return own;
}

}

FollowedGuides FollowGuidesInPieces(const Guides& guides, const PieceOfSurface& piece, const NearestPlaces& places,
  const SurfaceSizes& sizes, const ExecutionContext& context)
{
  const Ranks& ranks = piece.Everyone();
  ranks.Together([&guides] { CheckGuides(guides); });
  TrianglesNearGuides near(piece, places, sizes, guides.MaximumDistance * sizes.Diagonal());
  const long long elements = NumberOfElements(guides);
  const auto shareOf = [&](long long rank)
  { return ShareOf(guides, elements * rank / ranks.Size(), elements * (rank + 1) / ranks.Size()); };
  for (int rank = 0; rank < ranks.Size(); ++rank)
  {
    near.AddShare(shareOf(rank), rank);
  }
  const std::vector<TravellingTriangle> triangles = near.Collect(PartOfContext(context, 0.0, 0.5));
  FollowedGuides followed;
  ranks.Together(
    [&]
    {
      const FramedMesh mesh = MeshOf(triangles, context);
      followed = FollowGuides(shareOf(ranks.Rank()), NearestPlaces(mesh, sizes), PartOfContext(context, 0.5, 1.0));
    });
  FollowedGuides own = ToTheirRanks(ranks, followed, triangles);
  TakeOutNormalParts(own, piece.Surface().Mesh, piece.FirstOwnFace()); // which has all triangles around its own ones
  return own;
}

}
