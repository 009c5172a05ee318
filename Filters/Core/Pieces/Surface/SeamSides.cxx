#include "Pieces/Surface/SeamSides.h"

#include "Support/CountingSort.h"
#include "Support/DisjointSets.h"
#include "Support/Errors.h"
#include "Support/Hash.h"
#include "Support/Remedy.h"
#include "Support/ShortText.h"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <string>
#include <utility>

namespace dmg
{

namespace
{

int NextSide(int side)
{
  return side % 3 == 2 ? side - 2 : side + 1;
}

/// A point as all ranks know it: the bits of its place, or its global number.
using PointKey = std::array<std::int64_t, 3>;

PointKey KeyOf(const SurfacePiece& piece, int point)
{
  if (!piece.GlobalIds.empty())
  {
    return { piece.GlobalIds[point], 0, 0 };
  }
  PointKey key;
  for (int k = 0; k < 3; ++k)
  {
    const double coordinate = piece.Positions(point, k) + 0.0; // no negative zero
    std::memcpy(&key[k], &coordinate, sizeof(coordinate));
  }
  return key;
}

/// A boundary side on its way to the rank that pairs those of its ends.
struct MeetingSide
{
  PointKey Smaller;
  PointKey Larger;
  int Side;
  int Direction; ///< 1: from the smaller to the larger point

  bool HasSameEnds(const MeetingSide& other) const
  {
    return this->Smaller == other.Smaller && this->Larger == other.Larger;
  }
};

int MeetingRank(const MeetingSide& side, int numberOfRanks)
{
  std::uint64_t hash = 0xcbf29ce484222325ULL;
  for (const PointKey* key : { &side.Smaller, &side.Larger })
  {
    for (const std::int64_t part : *key)
    {
      hash = MixHash(hash, static_cast<std::uint64_t>(part));
    }
  }
  return static_cast<int>(hash % static_cast<std::uint64_t>(numberOfRanks));
}

std::string NameOf(const PointKey& key, bool isPlace)
{
  if (!isPlace)
  {
    return "point " + std::to_string(key[0]);
  }
  std::string text = "(";
  for (int k = 0; k < 3; ++k)
  {
    double coordinate;
    std::memcpy(&coordinate, &key[k], sizeof(coordinate));
    text += (k > 0 ? ", " : "") + ShortText(coordinate);
  }
  return text + ")";
}

/// The sides that met at this rank, each with the rank that it came from.
struct Meeting
{
  MeetingSide Side;
  int Rank;
};

std::vector<Meeting> SortedByEnds(const Received<MeetingSide>& received, int numberOfRanks)
{
  std::vector<Meeting> meetings;
  for (int rank = 0; rank < numberOfRanks; ++rank)
  {
    for (int k = received.Begins[rank]; k < received.Begins[rank + 1]; ++k)
    {
      meetings.push_back({ received.Items[k], rank });
    }
  }
  std::sort(meetings.begin(), meetings.end(),
    [](const Meeting& a, const Meeting& b)
    {
      const auto order = [](const Meeting& m)
      { return std::make_tuple(std::cref(m.Side.Smaller), std::cref(m.Side.Larger), m.Rank, m.Side.Side); };
      return order(a) < order(b);
    });
  return meetings;
}

[[noreturn]] void RefuseMeeting(const Meeting* first, const Meeting* last, bool arePlaces)
{
  const std::string edge = "the edge between " + NameOf(first->Side.Smaller, arePlaces) + " and " +
    NameOf(first->Side.Larger, arePlaces) + ", where pieces of ranks " + std::to_string(first->Rank) + " and " +
    std::to_string(last[-1].Rank) + " meet, has ";
  if (last - first > 2)
  {
    throw InvalidInput(
      edge + std::to_string(last - first) + " triangles; gather the surface on one rank, which parts them");
  }
  throw InvalidInput(edge + "triangles that run along it in the same direction; " + TextOf(Remedy::Orient) +
    ", and leave out triangles that two ranks have");
}

}

FansOfPiece FansAround(int numberOfPoints, const Triangles& triangles, const ExecutionContext& context)
{
  const int* const points = triangles.data();
  const int sides = 3 * static_cast<int>(triangles.rows());
  const ItemsByPair byEnds = SortByPair(
    sides, numberOfPoints,
    [points](int side) -> std::pair<int, int> {
      return std::minmax({ points[side], points[NextSide(side)] });
    },
    context);
  FansOfPiece result;
  DisjointSets fans(sides);
  for (int point = 0; point < numberOfPoints; ++point)
  {
    for (int first = byEnds.Begins[point], last = first; first < byEnds.Begins[point + 1]; first = last)
    {
      while (last < byEnds.Begins[point + 1] && byEnds.Items[last].Second == byEnds.Items[first].Second)
      {
        ++last;
      }
      const int a = byEnds.Items[first].Item;
      if (last - first == 1)
      {
        result.Boundary.push_back(a);
        continue;
      }
      const int b = byEnds.Items[first + 1].Item;
      if (last - first > 2 || points[a] == points[b])
      {
        throw InvalidInput("the edge between points " + std::to_string(point) + " and " +
          std::to_string(byEnds.Items[first].Second) +
          (last - first > 2 ? " has more than two triangles; gather the surface on one rank, which parts them"
                            : " has two triangles that run along it in the same direction; " + TextOf(Remedy::Orient)));
      }
      fans.Unite(a, NextSide(b));
      fans.Unite(NextSide(a), b);
    }
  }
  std::sort(result.Boundary.begin(), result.Boundary.end());
  const std::vector<int> firsts = fans.AllSmallest();
  const std::vector<int> chosen = Choose(
    sides, [&firsts](int side) { return firsts[side] == side; }, context);
  const std::vector<int> order = SortByKey(
    chosen, numberOfPoints, [points](int side) { return points[side]; }, context)
                                   .Items;
  std::vector<int> numbers(sides);
  for (const int side : order)
  {
    numbers[side] = static_cast<int>(result.OfPoints.size());
    result.OfPoints.push_back(points[side]);
  }
  result.Corners.resize(triangles.rows(), 3);
  for (int side = 0; side < sides; ++side)
  {
    result.Corners.data()[side] = numbers[firsts[side]];
  }
  return result;
}

std::vector<SeamSide> PairSides(const Ranks& ranks, const SurfacePiece& piece, const FansOfPiece& fans)
{
  std::vector<std::vector<MeetingSide>> toRanks(ranks.Size());
  for (const int side : fans.Boundary)
  {
    const PointKey tail = KeyOf(piece, piece.Corners.data()[side]);
    const PointKey head = KeyOf(piece, piece.Corners.data()[NextSide(side)]);
    if (tail != head) // a side without length could meet any other
    {
      const MeetingSide meeting{ std::min(tail, head), std::max(tail, head), side, tail < head ? 1 : 0 };
      toRanks[MeetingRank(meeting, ranks.Size())].push_back(meeting);
    }
  }
  const std::vector<Meeting> meetings = SortedByEnds(ranks.Exchange(toRanks), ranks.Size());
  std::vector<std::vector<SeamSide>> answers(ranks.Size());
  ranks.Together(
    [&]
    {
      const Meeting* const end = meetings.data() + meetings.size();
      for (const Meeting *first = meetings.data(), *last = first; first != end; first = last)
      {
        while (last != end && last->Side.HasSameEnds(first->Side))
        {
          ++last;
        }
        if (last - first == 1)
        {
          continue;
        }
        if (last - first > 2 || first[0].Side.Direction == first[1].Side.Direction)
        {
          RefuseMeeting(first, last, piece.GlobalIds.empty());
        }
        answers[first[0].Rank].push_back({ first[0].Side.Side, { first[1].Rank, first[1].Side.Side } });
        answers[first[1].Rank].push_back({ first[1].Side.Side, { first[0].Rank, first[0].Side.Side } });
      }
    });
  std::vector<SeamSide> seams = ranks.Exchange(answers).Items;
  std::sort(seams.begin(), seams.end(), [](const SeamSide& a, const SeamSide& b) { return a.Here < b.Here; });
  return seams;
}

std::vector<PlaceOnRank> JoinFans(const Ranks& ranks, const FansOfPiece& fans, const std::vector<SeamSide>& seams)
{
  const int* const corners = fans.Corners.data();
  std::vector<PlaceOnRank> joined;
  for (std::size_t fan = 0; fan < fans.OfPoints.size(); ++fan)
  {
    joined.push_back({ ranks.Rank(), static_cast<int>(fan) });
  }
  std::vector<PlaceOnRank> beyond;
  for (const SeamSide& seam : seams)
  {
    beyond.push_back(seam.Beyond);
  }
  struct Ends
  {
    PlaceOnRank Tail;
    PlaceOnRank Head;
  };
  const ValuesOfOwners sides(ranks, beyond);
  bool hasChanged = true;
  while (ranks.Any(hasChanged))
  {
    hasChanged = false;
    const std::vector<Ends> others = sides.Fetch<Ends>(
      [&](int side) -> Ends {
        return { joined[corners[side]], joined[corners[NextSide(side)]] };
      });
    const auto lower = [&](int fan, const PlaceOnRank& other)
    {
      if (other < joined[fan])
      {
        joined[fan] = other;
        hasChanged = true;
      }
    };
    for (std::size_t k = 0; k < seams.size(); ++k)
    {
      lower(corners[seams[k].Here], others[k].Head);
      lower(corners[NextSide(seams[k].Here)], others[k].Tail);
    }
  }
  return joined;
}

}
