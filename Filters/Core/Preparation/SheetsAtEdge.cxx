#include "Preparation/SheetsAtEdge.h"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace dmg
{

namespace
{

constexpr double LargestBend = Pi / 4.0;

/// Six times the volume that triangles enclose, if they are closed.
double SignedVolume(const Points& positions, const Triangles& triangles)
{
  double volume = 0.0;
  const Vector3 origin = positions.row(triangles(0, 0));
  for (int t = 0; t < triangles.rows(); ++t)
  {
    const auto at = [&](int k) -> Vector3 { return positions.row(triangles(t, k)).transpose() - origin; };
    volume += at(0).dot(at(1).cross(at(2)));
  }
  return volume;
}

}

SheetsAtEdge::SheetsAtEdge(const Points& positions, const Triangles& triangles, const PairingOptions& options)
  : Positions(positions)
  , Corners(triangles.data())
  , Options(options)
  , IsInsideOut(triangles.rows() > 0 && SignedVolume(positions, triangles) < 0.0)
{
}

void SheetsAtEdge::Pair(const ItemOfPair* first, const ItemOfPair* last, SheetPairs& pairs)
{
  this->Collect(first, last);
  const auto forward =
    std::count_if(this->Sheets.begin(), this->Sheets.end(), [](const Sheet& sheet) { return sheet.IsForward; });
  const bool areBalanced = 2 * forward == static_cast<std::ptrdiff_t>(this->Sheets.size()) && !this->HaveBothSides();
  if (!areBalanced || !this->HasTwins())
  {
    this->PairSmoothest(areBalanced || this->Options.KeepsDirections, !areBalanced, pairs);
  }
  if (areBalanced)
  {
    this->PairWedges(pairs);
  }
}

void SheetsAtEdge::Collect(const ItemOfPair* first, const ItemOfPair* last)
{
  const auto at = [this](int side) -> Vector3 { return this->Positions.row(this->Corners[side]); };
  this->Sheets.clear();
  Vector3 x = Vector3::Zero(), y = Vector3::Zero(); // across the edge
  for (const ItemOfPair* item = first; item != last; ++item)
  {
    const int side = item->Item, next = NextSide(side);
    const bool isForward = this->Corners[side] < this->Corners[next];
    const Vector3 start = at(isForward ? side : next), end = at(isForward ? next : side);
    const Vector3 along = (end - start).stableNormalized();
    const Vector3 across = at(NextSide(next)) - start;
    const Vector3 away = across - along.dot(across) * along;
    const bool hasArea = away.norm() > 1e-10 * across.norm();
    if (hasArea && x.isZero(0.0))
    {
      x = away.stableNormalized();
      y = along.cross(x);
    }
    const double angle = hasArea ? std::atan2(away.dot(y), away.dot(x)) : 0.0;
    this->Sheets.push_back({ side, angle < 0.0 ? angle + 2.0 * Pi : angle, isForward, hasArea, true });
  }
}

/// Two triangles with the same corners.
bool SheetsAtEdge::HasTwins() const
{
  std::vector<int> others;
  for (const Sheet& sheet : this->Sheets)
  {
    others.push_back(this->Corners[NextSide(NextSide(sheet.Side))]);
  }
  std::sort(others.begin(), others.end());
  return std::adjacent_find(others.begin(), others.end()) != others.end();
}

bool SheetsAtEdge::HaveBothSides() const
{
  return !this->Options.HasBothSides.empty() &&
    std::all_of(this->Sheets.begin(), this->Sheets.end(),
      [this](const Sheet& sheet) { return this->Options.HasBothSides[sheet.Side / 3] != 0; });
}

void SheetsAtEdge::Join(int i, int j, SheetPairs& pairs)
{
  pairs.Join(this->Sheets[i].Side, this->Sheets[j].Side);
  this->Sheets[i].IsLeft = this->Sheets[j].IsLeft = false;
}

void SheetsAtEdge::PairSmoothest(bool areOpposite, bool isBentToo, SheetPairs& pairs)
{
  const int size = static_cast<int>(this->Sheets.size());
  this->Left[0].clear();
  this->Left[1].clear();
  this->Choices.clear();
  const auto placesOf = [&](int i) -> std::set<Place>&
  { return this->Left[areOpposite && this->Sheets[i].IsForward ? 1 : 0]; };
  for (int i = 0; i < size; ++i)
  {
    if (this->Sheets[i].HasArea)
    {
      placesOf(i).emplace(this->Sheets[i].Angle, i);
    }
  }
  for (int i = 0; i < size; ++i)
  {
    this->Look(i, areOpposite);
  }
  bool isFirst = isBentToo; // which stays joined whatever its bend is
  while (!this->Choices.empty())
  {
    const Choice choice = *this->Choices.begin();
    this->Choices.erase(this->Choices.begin());
    if (choice.Bend > LargestBend && !isFirst)
    {
      return;
    }
    if (this->Sheets[choice.First].IsLeft && this->Sheets[choice.Second].IsLeft)
    {
      for (const int i : { choice.First, choice.Second })
      {
        placesOf(i).erase({ this->Sheets[i].Angle, i });
      }
      this->Join(choice.First, choice.Second, pairs);
      isFirst = false;
    }
    else if (this->Sheets[choice.Owner].IsLeft)
    {
      this->Look(choice.Owner, areOpposite);
    }
  }
}

void SheetsAtEdge::Look(int owner, bool areOpposite)
{
  constexpr double Gain = 1e-9; // equal choices do not hang on rounding
  const Sheet& sheet = this->Sheets[owner];
  const std::set<Place>& places = this->Left[areOpposite && !sheet.IsForward ? 1 : 0];
  if (places.empty() || !sheet.HasArea)
  {
    return;
  }
  const double wanted = sheet.Angle < Pi ? sheet.Angle + Pi : sheet.Angle - Pi;
  auto after = places.lower_bound({ wanted - Gain, -1 });
  auto before = after == places.begin() ? std::prev(places.end()) : std::prev(after);
  after = after == places.end() ? places.begin() : after;
  Choice best{ 2.0 * Pi, 0, 0, owner };
  for (const auto& place : { after, before })
  {
    const int other = place->second;
    const double off = std::abs(place->first - wanted);
    const double bend = std::round(std::min(off, 2.0 * Pi - off) / Gain) * Gain;
    if (other != owner)
    {
      best = std::min(best, Choice{ bend, std::min(owner, other), std::max(owner, other), owner });
    }
  }
  if (best.First != best.Second)
  {
    this->Choices.insert(best);
  }
}

/// Sides around the edge are brackets: where the inside begins and where it ends. At one angle it ends first.
void SheetsAtEdge::PairWedges(SheetPairs& pairs)
{
  const auto begins = [this](int i) { return this->Sheets[i].IsForward == this->IsInsideOut; };
  std::vector<int> order;
  for (int i = 0; i < static_cast<int>(this->Sheets.size()); ++i)
  {
    if (this->Sheets[i].IsLeft)
    {
      order.push_back(i);
    }
  }
  std::sort(order.begin(), order.end(),
    [&](int i, int j)
    {
      return std::make_tuple(this->Sheets[i].Angle, begins(i), i) <
        std::make_tuple(this->Sheets[j].Angle, begins(j), j);
    });
  std::vector<int> open;
  for (int round = 0; round < 2; ++round) // the second for wedges over the angle zero
  {
    for (const int i : order)
    {
      if (this->Sheets[i].IsLeft && round == 0 && begins(i))
      {
        open.push_back(i);
      }
      else if (this->Sheets[i].IsLeft && !begins(i) && !open.empty())
      {
        this->Join(open.back(), i, pairs);
        open.pop_back();
      }
    }
  }
}

}
