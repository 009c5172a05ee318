#include "Preparation/SheetPairs.h"

#include "Support/CountingSort.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace dmg
{

namespace
{

int NextSide(int side)
{
  return side % 3 == 2 ? side - 2 : side + 1;
}

/// The sheets at one edge.
class Sheets
{
public:
  Sheets(const Points& positions, const Triangles& triangles)
    : Positions(positions)
    , Corners(triangles.data())
  {
  }

  /// Pairs the sides of an edge from first to last, the smoothest continuation first.
  void Pair(const ItemOfPair* first, const ItemOfPair* last, std::vector<int>& beyond)
  {
    const double largest = -std::sqrt(0.5); // within 45 degrees of a plane
    this->Left.assign(first, last);
    this->Ways.clear();
    for (const ItemOfPair& side : this->Left)
    {
      this->Ways.push_back(this->Away(side.Item));
    }
    for (bool isFirst = true; this->Left.size() > 1; isFirst = false)
    {
      const auto [i, j, cosine] = this->Smoothest();
      if (!isFirst && cosine > largest)
      {
        return;
      }
      beyond[this->Left[i].Item] = this->Left[j].Item;
      beyond[this->Left[j].Item] = this->Left[i].Item;
      this->Remove(j); // the larger one
      this->Remove(i);
    }
  }

private:
  struct Choice
  {
    std::size_t I, J;
    double Cosine;
  };

  Choice Smoothest() const
  {
    Choice best{ 0, 1, 2.0 };
    for (std::size_t i = 0; i < this->Left.size(); ++i)
    {
      for (std::size_t j = i + 1; j < this->Left.size(); ++j)
      {
        constexpr double Gain = 1e-9; // equal choices do not hang on rounding
        const double cosine = this->Ways[i].dot(this->Ways[j]);
        best = cosine < best.Cosine - Gain ? Choice{ i, j, cosine } : best;
      }
    }
    return best;
  }

  void Remove(std::size_t i)
  {
    this->Left.erase(this->Left.begin() + static_cast<std::ptrdiff_t>(i));
    this->Ways.erase(this->Ways.begin() + static_cast<std::ptrdiff_t>(i));
  }

  /// The unit vector in the triangle's plane that leads from a side into the triangle; zero where it has no area.
  Vector3 Away(int side) const
  {
    const auto at = [this](int h) -> Vector3 { return this->Positions.row(this->Corners[h]); };
    const int next = NextSide(side);
    const Vector3 along = (at(next) - at(side)).stableNormalized();
    const Vector3 across = at(NextSide(next)) - at(side);
    const Vector3 away = across - along.dot(across) * along;
    return away.norm() > 1e-10 * across.norm() ? away.stableNormalized() : Vector3::Zero();
  }

  const Points& Positions;
  const int* const Corners;
  std::vector<ItemOfPair> Left;
  std::vector<Vector3> Ways;
};

}

SheetPairs PairSheets(const Points& positions, const Triangles& triangles, const ExecutionContext& context)
{
  const int* const corners = triangles.data();
  const int numberOfPoints = static_cast<int>(positions.rows());
  const ItemsByPair sides = SortByPair(
    3 * static_cast<int>(triangles.rows()), numberOfPoints,
    [corners](int side) -> std::pair<int, int> {
      return std::minmax({ corners[side], corners[NextSide(side)] });
    },
    context);
  SheetPairs pairs;
  pairs.Opposite.assign(sides.Items.size(), -1);
  Sheets sheets(positions, triangles);
  for (int point = 0; point < numberOfPoints; ++point)
  {
    const ItemOfPair* const end = sides.Items.data() + sides.Begins[point + 1];
    for (const ItemOfPair* first = sides.Items.data() + sides.Begins[point]; first != end;)
    {
      const ItemOfPair* const last =
        std::find_if(first, end, [first](const ItemOfPair& side) { return side.Second != first->Second; });
      if (last - first == 2)
      {
        pairs.Opposite[first[0].Item] = first[1].Item;
        pairs.Opposite[first[1].Item] = first[0].Item;
      }
      else if (last - first > 2)
      {
        sheets.Pair(first, last, pairs.Opposite);
        pairs.Crossed.push_back({ point, first->Second });
      }
      first = last;
    }
  }
  return pairs;
}

}
