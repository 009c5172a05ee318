#include "Preparation/Orientation.h"

#include <algorithm>
#include <deque>
#include <utility>

namespace dmg
{

namespace
{

class Orienter
{
public:
  Orienter(const Points& positions, const Triangles& triangles, const SheetPairs& pairs)
    : Positions(positions)
    , Corners(triangles.data())
    , Pairs(pairs)
    , IsTurned(triangles.rows(), 0)
    , IsSeen(triangles.rows(), 0)
  {
  }

  /// Visits a component from a triangle on, ring by ring, and lets each agree with the one that it was reached from.
  void Spread(int seed)
  {
    this->Component.assign(1, seed);
    this->IsSeen[seed] = 1;
    for (std::size_t i = 0; i < this->Component.size(); ++i)
    {
      const int triangle = this->Component[i];
      for (int side = 3 * triangle; side < 3 * triangle + 3; ++side)
      {
        const int beyond = this->Pairs.Of(side);
        if (beyond >= 0 && !this->IsSeen[beyond / 3])
        {
          this->IsSeen[beyond / 3] = 1;
          this->IsTurned[beyond / 3] = this->IsTurned[triangle] ^ this->RunsAlike(side, beyond);
          this->Component.push_back(beyond / 3);
        }
      }
    }
  }

  /// Whether two neighbours do not agree.
  bool IsSeam(int side) const
  {
    const int beyond = this->Pairs.Of(side);
    return beyond >= 0 && (this->IsTurned[side / 3] ^ this->IsTurned[beyond / 3] ^ this->RunsAlike(side, beyond)) != 0;
  }

  bool HasSeam() const
  {
    return std::any_of(this->Component.begin(), this->Component.end(),
      [this](int t) { return this->IsSeam(3 * t) || this->IsSeam(3 * t + 1) || this->IsSeam(3 * t + 2); });
  }

  /// Takes the shorter of two seams: the one that the triangles have as they were given, and the one where the rings met.
  void ChooseSeam()
  {
    constexpr double Gain = 1e-9;
    this->ShortenSeam();
    const std::vector<char> ofRings = this->IsTurned;
    const double length = this->SeamLength();
    for (const int triangle : this->Component)
    {
      this->IsTurned[triangle] = 0;
    }
    this->ShortenSeam();
    if (length < (1.0 - Gain) * this->SeamLength())
    {
      this->IsTurned = ofRings;
    }
  }

  /// Lets most triangles of the component stay as they are.
  void KeepMost()
  {
    std::size_t turned = 0;
    for (const int triangle : this->Component)
    {
      turned += this->IsTurned[triangle];
    }
    if (2 * turned > this->Component.size())
    {
      for (const int triangle : this->Component)
      {
        this->IsTurned[triangle] ^= 1;
      }
    }
  }

  bool IsVisited(int triangle) const { return this->IsSeen[triangle] != 0; }
  std::vector<char> Take() { return std::move(this->IsTurned); }

private:
  double SeamLength() const
  {
    double length = 0.0;
    for (const int triangle : this->Component)
    {
      for (int side = 3 * triangle; side < 3 * triangle + 3; ++side)
      {
        length += this->IsSeam(side) ? this->Length(side) : 0.0;
      }
    }
    return length;
  }

  /// Lets triangles change sides while that makes the seam shorter.
  void ShortenSeam()
  {
    constexpr double Gain = 1e-9; // of the length, so that rounding does not go on for ever
    std::deque<int> queue(this->Component.begin(), this->Component.end());
    while (!queue.empty())
    {
      const int triangle = queue.front();
      queue.pop_front();
      double with = 0.0, without = 0.0;
      for (int side = 3 * triangle; side < 3 * triangle + 3; ++side)
      {
        if (this->Pairs.Of(side) >= 0)
        {
          (this->IsSeam(side) ? with : without) += this->Length(side);
        }
      }
      if (with > without + Gain * (with + without))
      {
        this->IsTurned[triangle] ^= 1;
        for (int side = 3 * triangle; side < 3 * triangle + 3; ++side)
        {
          if (this->Pairs.Of(side) >= 0)
          {
            queue.push_back(this->Pairs.Of(side) / 3);
          }
        }
      }
    }
  }

  /// Whether both triangles run along their edge in the same direction, and so disagree.
  char RunsAlike(int side, int beyond) const { return this->Corners[side] == this->Corners[beyond] ? 1 : 0; }

  double Length(int side) const
  {
    return (this->Positions.row(this->Corners[side]) - this->Positions.row(this->Corners[NextSide(side)])).norm();
  }

  const Points& Positions;
  const int* const Corners;
  const SheetPairs& Pairs;
  std::vector<char> IsTurned, IsSeen;
  std::vector<int> Component;
};

}

Orientation Orient(const Points& positions, const Triangles& triangles, SheetPairs& pairs)
{
  const int size = static_cast<int>(triangles.rows());
  Orienter orienter(positions, triangles, pairs);
  bool hasSeam = false;
  for (int triangle = 0; triangle < size; ++triangle)
  {
    if (orienter.IsVisited(triangle))
    {
      continue;
    }
    orienter.Spread(triangle);
    if (orienter.HasSeam())
    {
      orienter.ChooseSeam();
      hasSeam = true;
    }
    orienter.KeepMost();
  }
  Orientation result;
  std::vector<int> seam;
  for (int side = 0; hasSeam && side < 3 * size; ++side)
  {
    if (side < pairs.Of(side) && orienter.IsSeam(side))
    {
      seam.push_back(side);
    }
  }
  for (const int side : seam)
  {
    pairs.Part(side);
    result.Cut.push_back({ triangles.data()[side], triangles.data()[side % 3 == 2 ? side - 2 : side + 1] });
  }
  result.IsTurned = orienter.Take();
  return result;
}

void TurnOver(Triangles& triangles, SheetPairs& pairs, const std::vector<char>& isTurned)
{
  const auto turned = [&isTurned](int side)
  { return side >= 0 && isTurned[side / 3] ? side - side % 3 + (2 - side % 3) : side; };
  std::vector<int> beyond(pairs.Opposite.size());
  for (int side = 0; side < static_cast<int>(beyond.size()); ++side)
  {
    beyond[turned(side)] = turned(pairs.Of(side));
  }
  pairs.Opposite = std::move(beyond);
  for (int triangle = 0; triangle < triangles.rows(); ++triangle)
  {
    if (isTurned[triangle])
    {
      std::swap(triangles(triangle, 1), triangles(triangle, 2));
    }
  }
}

}
