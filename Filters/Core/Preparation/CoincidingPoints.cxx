#include "Preparation/CoincidingPoints.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>
#include <unordered_map>
#include <utility>

namespace dmg
{

namespace
{

/// A grid over space whose cells have a number each. Coordinates reach to 2^19 cells from its origin.
class Cells
{
public:
  Cells(const Vector3& origin, double size)
    : Origin(origin)
    , Size(size)
  {
  }

  std::int64_t Along(int axis, double x) const
  {
    return static_cast<std::int64_t>(std::floor((x - this->Origin[axis]) / this->Size)) + (1 << 20);
  }
  static std::int64_t Number(std::int64_t x, std::int64_t y, std::int64_t z) { return (x << 42) | (y << 21) | z; }

private:
  const Vector3 Origin;
  const double Size;
};

using PointOfCell = std::pair<std::int64_t, int>;

class NearPoints
{
public:
  NearPoints(const Points& positions, const std::vector<BoundaryPoint>& points, double distance)
    : Positions(positions)
    , Boundary(points)
    , Distance(distance)
    , Grid(positions.row(points.front().Point).transpose(), 8.0 * distance)
  {
    this->Sorted.reserve(points.size());
    for (std::size_t i = 0; i < points.size(); ++i)
    {
      const auto& p = positions.row(points[i].Point);
      this->Sorted.emplace_back(
        Cells::Number(this->Grid.Along(0, p[0]), this->Grid.Along(1, p[1]), this->Grid.Along(2, p[2])),
        static_cast<int>(i));
    }
    std::sort(this->Sorted.begin(), this->Sorted.end());
  }

  /// Calls visit(j) for the points after point i that coincide with it.
  template <class Visit>
  void VisitAfter(int i, const Visit& visit) const
  {
    const auto& p = this->Positions.row(this->Boundary[i].Point);
    std::array<std::array<std::int64_t, 2>, 3> range;
    for (int axis = 0; axis < 3; ++axis)
    {
      range[axis] = { this->Grid.Along(axis, p[axis] - this->Distance),
        this->Grid.Along(axis, p[axis] + this->Distance) };
    }
    for (std::int64_t x = range[0][0]; x <= range[0][1]; ++x)
    {
      for (std::int64_t y = range[1][0]; y <= range[1][1]; ++y)
      {
        for (std::int64_t z = range[2][0]; z <= range[2][1]; ++z)
        {
          this->VisitCell(Cells::Number(x, y, z), i, visit);
        }
      }
    }
  }

private:
  template <class Visit>
  void VisitCell(std::int64_t cell, int i, const Visit& visit) const
  {
    auto at = std::lower_bound(this->Sorted.begin(), this->Sorted.end(), PointOfCell(cell, i + 1));
    for (; at != this->Sorted.end() && at->first == cell; ++at)
    {
      if (this->Coincide(this->Boundary[i], this->Boundary[at->second]))
      {
        visit(at->second);
      }
    }
  }

  bool Coincide(const BoundaryPoint& a, const BoundaryPoint& b) const
  {
    const double distance = (this->Positions.row(a.Point) - this->Positions.row(b.Point)).norm();
    return distance <= std::min(this->Distance, PartOfEdge * std::min(a.Size, b.Size));
  }

  const Points& Positions;
  const std::vector<BoundaryPoint>& Boundary;
  const double Distance;
  const Cells Grid;
  std::vector<PointOfCell> Sorted;
};

}

double RoundingOf(const Points& positions)
{
  constexpr double Ulps = 16.0 / (1 << 23);
  constexpr double DoubleOverSingle = 1.0 / (1 << 29);
  if (positions.rows() == 0)
  {
    return 0.0;
  }
  const double largest = positions.cwiseAbs().maxCoeff();
  if (positions.cast<float>().cast<double>() == positions)
  {
    return Ulps * largest;
  }
  const double extent = (positions.colwise().maxCoeff() - positions.colwise().minCoeff()).maxCoeff();
  return Ulps * std::max(std::min(extent, largest), DoubleOverSingle * largest);
}

bool UniteNear(
  const Points& positions, const std::vector<std::array<int, 2>>& pairs, double distance, DisjointSets& sets)
{
  using Box = Eigen::AlignedBox<double, 3>;
  DisjointSets chains(pairs.empty() ? 0 : static_cast<int>(positions.rows()));
  for (const auto& [a, b] : pairs)
  {
    chains.Unite(a, b);
  }
  std::unordered_map<int, Box> boxes;
  for (const auto& [a, b] : pairs)
  {
    boxes[chains.Smallest(a)].extend(positions.row(a).transpose()).extend(positions.row(b).transpose());
  }
  bool isAny = false;
  for (const auto& [a, b] : pairs)
  {
    if (boxes[chains.Smallest(a)].diagonal().norm() <= distance)
    {
      sets.Unite(a, b);
      isAny = true;
    }
  }
  return isAny;
}

namespace
{

/// Unites equal points. \return the first of each place, ascending, with the largest size there.
std::vector<BoundaryPoint> UniteEqual(
  const Points& positions, const std::vector<BoundaryPoint>& points, DisjointSets& sets)
{
  Points own(static_cast<Eigen::Index>(points.size()), 3);
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    own.row(static_cast<Eigen::Index>(i)) = positions.row(points[i].Point);
  }
  const std::vector<int> first = FirstOfEqual(own);
  std::vector<BoundaryPoint> places;
  std::vector<int> placeOf(points.size());
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    if (first[i] == static_cast<int>(i))
    {
      placeOf[i] = static_cast<int>(places.size());
      places.push_back(points[i]);
      continue;
    }
    BoundaryPoint& place = places[placeOf[first[i]]];
    place.Size = std::max(place.Size, points[i].Size);
    sets.Unite(place.Point, points[i].Point);
  }
  return places;
}

}

bool JoinBoundary(const Points& positions, const std::vector<BoundaryPoint>& points, DisjointSets& sets)
{
  const double rounding = RoundingOf(positions);
  if (!(rounding > 0.0) || !std::isfinite(rounding) || points.empty())
  {
    return false;
  }
  const std::vector<BoundaryPoint> places = UniteEqual(positions, points, sets);
  const NearPoints near(positions, places, rounding);
  std::vector<std::array<int, 2>> pairs;
  for (std::size_t i = 0; i < places.size(); ++i)
  {
    near.VisitAfter(static_cast<int>(i), [&](int j) { pairs.push_back({ places[i].Point, places[j].Point }); });
  }
  return UniteNear(positions, pairs, rounding, sets) || places.size() < points.size();
}

std::vector<int> FirstOfEqual(const Points& positions)
{
  const int size = static_cast<int>(positions.rows());
  std::vector<int> order(size);
  std::iota(order.begin(), order.end(), 0);
  const auto place = [&positions](int i) {
    return std::array<double, 3>{ positions(i, 0), positions(i, 1), positions(i, 2) };
  };
  std::sort(order.begin(), order.end(),
    [&place](int a, int b)
    {
      const auto p = place(a), q = place(b);
      return p != q ? p < q : a < b;
    });
  std::vector<int> first(size);
  for (int k = 0; k < size; ++k)
  {
    const bool isEqual = k > 0 && place(order[k]) == place(order[k - 1]);
    first[order[k]] = isEqual ? first[order[k - 1]] : order[k];
  }
  return first;
}

std::vector<int> FirstOfCoinciding(const Points& positions, const Triangles& corners)
{
  constexpr double Unused = std::numeric_limits<double>::infinity();
  std::vector<double> sizes(positions.rows(), Unused);
  for (Eigen::Index t = 0; t < corners.rows(); ++t)
  {
    const auto at = [&](int k) { return positions.row(corners(t, k % 3)); };
    const double size = std::sqrt(
      std::max({ (at(0) - at(1)).squaredNorm(), (at(1) - at(2)).squaredNorm(), (at(2) - at(0)).squaredNorm() }));
    for (int k = 0; k < 3; ++k)
    {
      double& least = sizes[corners(t, k)];
      least = std::min(least, size);
    }
  }
  std::vector<BoundaryPoint> points;
  for (std::size_t point = 0; point < sizes.size(); ++point)
  {
    if (sizes[point] < Unused)
    {
      points.push_back({ static_cast<int>(point), sizes[point] });
    }
  }
  DisjointSets sets(static_cast<int>(positions.rows()));
  JoinBoundary(positions, points, sets);
  return sets.AllSmallest();
}

void BoundaryPoints::Add(const Points& positions, int a, int b, int c)
{
  const double size = std::sqrt(std::max({ (positions.row(a) - positions.row(b)).squaredNorm(),
    (positions.row(b) - positions.row(c)).squaredNorm(), (positions.row(c) - positions.row(a)).squaredNorm() }));
  this->All.push_back({ a, size });
  this->All.push_back({ b, size });
}

std::vector<BoundaryPoint> BoundaryPoints::Take()
{
  std::sort(this->All.begin(), this->All.end(),
    [](const BoundaryPoint& p, const BoundaryPoint& q)
    { return p.Point != q.Point ? p.Point < q.Point : p.Size < q.Size; });
  const auto end = std::unique(this->All.begin(), this->All.end(),
    [](const BoundaryPoint& p, const BoundaryPoint& q) { return p.Point == q.Point; });
  this->All.erase(end, this->All.end());
  return std::move(this->All);
}

}
