#include "Drawing/SurfaceSamples.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <unordered_map>

namespace dmg
{

namespace
{

/// The number of darts per square of the distance; 0.7 would do if none missed.
constexpr double DartsPerSquare = 20.0;

/// The length of a side, over the distance, from which a face is large.
constexpr double LargeFace = 8.0;

constexpr int DartsBetweenCheckpoints = 2048;

/// Fractional parts of multiples of the powers of 1 / 1.2207..., the root of x^4 = x + 1: evenly spread in the unit
/// cube (M. Roberts, The unreasonable effectiveness of quasirandom sequences, 2018).
double Sequence(long long index, double step)
{
  const double place = 0.5 + static_cast<double>(index) * step;
  return place - std::floor(place);
}

class DiscSampling
{
public:
  DiscSampling(const UnfoldedSurface& surface, double distance, const ExecutionContext& context)
    : Surface(surface)
    , Distance(distance)
    , Context(context)
    , Walk(surface)
    , Last(surface.Mesh().NumberOfFaces(), -1)
    , IsCovered(surface.Mesh().NumberOfFaces(), 0)
  {
  }

  std::vector<SurfacePoint> Run()
  {
    this->ThrowDarts();
    const int numberOfFaces = this->Surface.Mesh().NumberOfFaces();
    for (int face = 0; face < numberOfFaces; ++face)
    {
      if (!this->IsCovered[face])
      {
        this->Try(this->Surface.Centre(face));
      }
      if (face % DartsBetweenCheckpoints == 0)
      {
        this->Context.Checkpoint(0.5 + 0.5 * face / numberOfFaces);
      }
    }
    this->Context.Checkpoint(1.0);
    return std::move(this->Points);
  }

private:
  void ThrowDarts()
  {
    const TriangleMesh& mesh = this->Surface.Mesh();
    Vector<double> sums = mesh.FaceAreas(this->Context);
    for (int face = 1; face < mesh.NumberOfFaces(); ++face)
    {
      sums[face] += sums[face - 1];
    }
    const double area = sums[mesh.NumberOfFaces() - 1];
    const auto darts = static_cast<long long>(std::min(DartsPerSquare * area / this->Distance / this->Distance, 1e9));
    for (long long i = 0; i < darts; ++i)
    {
      const double* const found =
        std::upper_bound(sums.data(), sums.data() + sums.size(), area * Sequence(i, 0.8191725133961645));
      const int face = std::min(static_cast<int>(found - sums.data()), mesh.NumberOfFaces() - 1);
      if (!this->IsCovered[face])
      {
        this->Try(this->PointOf(face, Sequence(i, 0.6710436067037893), Sequence(i, 0.5497004779019703)));
      }
      if (i % DartsBetweenCheckpoints == 0)
      {
        this->Context.Checkpoint(0.5 * static_cast<double>(i) / static_cast<double>(darts));
      }
    }
  }

  SurfacePoint PointOf(int face, double a, double b) const
  {
    if (a + b > 1.0)
    {
      a = 1.0 - a;
      b = 1.0 - b;
    }
    const Complex origin = this->Surface.Corner(3 * face);
    return { face,
      origin + a * (this->Surface.Corner(3 * face + 1) - origin) + b * (this->Surface.Corner(3 * face + 2) - origin) };
  }

  /// Adds a point unless another one is near.
  void Try(const SurfacePoint& point)
  {
    const double square = this->Distance * this->Distance;
    bool isFree = true;
    this->Walk.Around(point, this->Distance,
      [&](const SurfaceWalk::Placement& placement)
      {
        this->VisitLists(placement,
          [&](int last)
          {
            for (int i = last; i >= 0 && isFree; i = this->Next[i])
            {
              isFree = std::norm(placement.Place(this->Points[i].Point)) >= square;
            }
          });
        return isFree;
      });
    if (!isFree)
    {
      return;
    }
    int& last = this->IsLarge(point.Face) ? this->Cells.emplace(this->CellOf(point.Face, point.Point), -1).first->second
                                          : this->Last[point.Face];
    this->Next.push_back(last);
    last = static_cast<int>(this->Points.size());
    this->Points.push_back(point);
    this->Walk.Around(point, this->Distance,
      [&](const SurfaceWalk::Placement& placement)
      {
        bool isCovered = true;
        for (int h = 3 * placement.Face; h < 3 * placement.Face + 3; ++h)
        {
          isCovered = isCovered && std::norm(placement.Place(this->Surface.Corner(h))) < square;
        }
        this->IsCovered[placement.Face] |= static_cast<char>(isCovered);
        return true;
      });
  }

  /// Whether the points of a face are sorted into square cells, rather than in one list.
  bool IsLarge(int face) const
  {
    const double square = LargeFace * LargeFace * this->Distance * this->Distance;
    const Complex origin = this->Surface.Corner(3 * face);
    return std::norm(this->Surface.Corner(3 * face + 1) - origin) > square ||
      std::norm(this->Surface.Corner(3 * face + 2) - origin) > square;
  }

  /// Cells of one face whose numbers differ by 2^16 are one, which costs nothing but time.
  std::uint64_t CellOf(int face, Complex point) const
  {
    const auto number = [this](double x)
    { return static_cast<std::uint64_t>(static_cast<std::int64_t>(std::floor(x / this->Distance))); };
    return static_cast<std::uint64_t>(face) << 32 | (number(point.real()) & 0xffffu) << 16 |
      (number(point.imag()) & 0xffffu);
  }

  /// Calls visit with the newest point of each list that may hold points of a face near the centre of the walk.
  template <class Visit>
  void VisitLists(const SurfaceWalk::Placement& placement, const Visit& visit) const
  {
    if (!this->IsLarge(placement.Face))
    {
      visit(this->Last[placement.Face]);
      return;
    }
    const Complex centre = -std::conj(placement.Turn) * placement.Origin;
    for (int x = -1; x <= 1; ++x)
    {
      for (int y = -1; y <= 1; ++y)
      {
        // A point at the distance, to rounding, may lie beyond the next cell; it is far enough.
        const auto found = this->Cells.find(this->CellOf(placement.Face, centre + this->Distance * Complex(x, y)));
        if (found != this->Cells.end())
        {
          visit(found->second);
        }
      }
    }
  }

  const UnfoldedSurface& Surface;
  const double Distance;
  const ExecutionContext& Context;
  SurfaceWalk Walk;
  std::vector<SurfacePoint> Points;
  std::vector<int> Last;                        // per face: its newest point, or -1
  std::unordered_map<std::uint64_t, int> Cells; // of large faces: the newest point
  std::vector<int> Next;                        // per point: the one before in the same list, or -1
  std::vector<char> IsCovered;                  // per face: whether all of it is near one point
};

}

std::vector<SurfacePoint> EvenlySpreadPoints(
  const UnfoldedSurface& surface, double distance, const ExecutionContext& context)
{
  return DiscSampling(surface, distance, context).Run();
}

}
