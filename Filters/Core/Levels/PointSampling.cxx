#include "Levels/PointSampling.h"

#include "Support/CountingSort.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace dmg
{

namespace
{

constexpr int Grain = 4096;

/// The number of points that a thread samples at a time. It is constant, so that samples do not depend on the number of threads.
constexpr int BlockSize = 8192;

/// The number of times that places and rotations are averaged over neighbours after the points have found their
/// owners: each comes from a single path at first, which passes some curvature on one side only.
constexpr int NumberOfMeans = 2;

/// The place of a point seen from a sample.
struct Sight
{
  int Owner = -1; // the sample's point, -1: none
  Complex Place = 0.0;
  Complex Turn = 1.0;
};

using Sights = Unfilled<Sight>;

/// The sight of a point along a link, from that of the neighbour at the link's other end.
Sight Along(const TangentGraph& graph, int link, const Sight& neighbour)
{
  const Complex turn = neighbour.Turn * std::conj(graph.Turns[link]);
  return { neighbour.Owner, neighbour.Place - turn * graph.Steps[link], turn };
}

/// Harmonic mean of the three shortest steps of a point.
double Spacing(const TangentGraph& graph, int point)
{
  constexpr int few = 3;
  std::array<double, few> shortest;
  shortest.fill(std::numeric_limits<double>::max());
  for (int link = graph.Offsets[point]; link < graph.Offsets[point + 1]; ++link)
  {
    double squared = std::norm(graph.Steps[link]);
    for (double& other : shortest)
    {
      if (squared < other)
      {
        std::swap(squared, other);
      }
    }
  }
  const int count = std::min(few, graph.Offsets[point + 1] - graph.Offsets[point]);
  double sum = 0.0;
  for (int k = 0; k < count; ++k)
  {
    sum += 1.0 / std::sqrt(shortest[k]); // infinite for a step of no length, and no error
  }
  return count > 0 ? count / sum : 0.0;
}

/// Takes every point that no sample covers as the next sample.
class Sampler
{
public:
  Sampler(const TangentGraph& graph, double radius, double largestCurvature, const ExecutionContext& context)
    : Graph(graph)
    , LargestCurvature(largestCurvature)
    , Radii(graph.NumberOfPoints())
    , Seen(graph.NumberOfPoints())
    , Marks(graph.NumberOfPoints())
  {
    context.ParallelFor(0, graph.NumberOfPoints(), Grain,
      [&](int first, int last)
      {
        for (int point = first; point < last; ++point)
        {
          this->Radii[point] = radius * Spacing(graph, point);
          this->Seen[point] = {};
          this->Marks[point] = -1;
        }
      });
  }

  /// Samples blocks of points in parallel, as far as samples cover points of their block only; then what lies between blocks.
  Sights Run(const ExecutionContext& context)
  {
    const int points = this->Graph.NumberOfPoints();
    const int blocks = (points + BlockSize - 1) / BlockSize;
    std::vector<std::vector<int>> left(blocks);
    context.ParallelFor(0, blocks, 1,
      [&](int firstBlock, int lastBlock)
      {
        for (int block = firstBlock; block < lastBlock; ++block)
        {
          left[block] = this->SampleBlock(block * BlockSize, std::min((block + 1) * BlockSize, points));
        }
      });
    std::vector<Visit> visits;
    for (const std::vector<int>& ofBlock : left)
    {
      for (const int point : ofBlock)
      {
        if (this->Seen[point].Owner < 0)
        {
          this->Flood(point, 0, points, visits);
          this->Cover(visits);
        }
      }
    }
    return std::move(this->Seen);
  }

private:
  struct Visit
  {
    int Point;
    Sight Seen;
  };

  /// \return points that no sample covered when their turn came, for what they cover reaches beyond
  ///   [first, last).
  std::vector<int> SampleBlock(int first, int last)
  {
    std::vector<int> left;
    std::vector<Visit> visits;
    for (int point = first; point < last; ++point)
    {
      if (this->Seen[point].Owner >= 0)
      {
        continue;
      }
      if (this->Flood(point, first, last, visits))
      {
        this->Cover(visits);
      }
      else
      {
        left.push_back(point);
        for (const Visit& visit : visits)
        {
          this->Marks[visit.Point] = -1;
        }
      }
    }
    return left;
  }

  /// The points within the radius of a sample, ring by ring, as far as the curvature lets it see.
  /// \return false if some lie beyond [first, last).
  bool Flood(int sample, int first, int last, std::vector<Visit>& visits)
  {
    visits.assign(1, { sample, { sample, 0.0, 1.0 } });
    this->Marks[sample] = sample;
    double curvature = 0.0;
    for (std::size_t next = 0; next < visits.size(); ++next)
    {
      const Visit visit = visits[next];
      curvature += std::abs(this->Graph.Curvatures[visit.Point]);
      if (next > 0 && curvature > this->LargestCurvature)
      {
        visits.resize(next);
        break;
      }
      for (int link = this->Graph.Offsets[visit.Point]; link < this->Graph.Offsets[visit.Point + 1]; ++link)
      {
        const int point = this->Graph.Neighbours[link];
        const Complex place = visit.Seen.Place + visit.Seen.Turn * this->Graph.Steps[link];
        const double radius = std::min(this->Radii[sample], this->Radii[point]);
        if (std::norm(place) > radius * radius)
        {
          continue;
        }
        if (point < first || point >= last)
        {
          return false;
        }
        if (this->Marks[point] != sample)
        {
          this->Marks[point] = sample;
          visits.push_back({ point, { sample, place, visit.Seen.Turn * this->Graph.Turns[link] } });
        }
      }
    }
    return true;
  }

  void Cover(const std::vector<Visit>& visits)
  {
    for (const Visit& visit : visits)
    {
      Sight& present = this->Seen[visit.Point];
      if (present.Owner < 0 || std::norm(visit.Seen.Place) < std::norm(present.Place))
      {
        present = visit.Seen;
      }
    }
  }

  const TangentGraph& Graph;
  const double LargestCurvature;
  Unfilled<double> Radii;
  Sights Seen;
  Unfilled<int> Marks; // the last sample from where the point was visited
};

/// Points whose neighbours belong to a nearer sample follow them.
Sights FollowNeighbours(const TangentGraph& graph, const Sights& former, const ExecutionContext& context)
{
  Sights sights(former.size());
  context.ParallelFor(0, graph.NumberOfPoints(), Grain,
    [&](int first, int last)
    {
      for (int point = first; point < last; ++point)
      {
        Sight& nearest = sights[point] = former[point];
        for (int link = graph.Offsets[point]; link < graph.Offsets[point + 1]; ++link)
        {
          const Sight& neighbour = former[graph.Neighbours[link]];
          if (neighbour.Owner == former[point].Owner)
          {
            continue;
          }
          const Sight other = Along(graph, link, neighbour);
          // Rounding must not decide between distances that are equal up to it.
          if (std::norm(other.Place) < (1.0 - 1e-9) * std::norm(nearest.Place))
          {
            nearest = other;
          }
        }
      }
    });
  return sights;
}

/// The mean of what a point sees along its links.
Sights MeansOfNeighbours(const TangentGraph& graph, const Sights& former, const ExecutionContext& context)
{
  Sights sights(former.size());
  context.ParallelFor(0, graph.NumberOfPoints(), Grain,
    [&](int first, int last)
    {
      for (int point = first; point < last; ++point)
      {
        Sight& mean = sights[point] = former[point];
        if (mean.Owner == point)
        {
          continue;
        }
        Complex places = 0.0;
        Complex turns = 0.0;
        int count = 0;
        for (int link = graph.Offsets[point]; link < graph.Offsets[point + 1]; ++link)
        {
          const Sight& neighbour = former[graph.Neighbours[link]];
          if (neighbour.Owner == mean.Owner)
          {
            const Sight seen = Along(graph, link, neighbour);
            places += seen.Place;
            turns += seen.Turn;
            ++count;
          }
        }
        const double length = std::sqrt(std::norm(turns));
        if (length > 0.0)
        {
          mean.Place = places / static_cast<double>(count);
          mean.Turn = turns / length;
        }
      }
    });
  return sights;
}

/// Renumbers samples in the order of their points.
PointSampling Numbered(const Sights& sights, const ExecutionContext& context)
{
  const int points = static_cast<int>(sights.size());
  PointSampling sampling;
  sampling.Samples = Choose(
    points, [&sights](int point) { return sights[point].Owner == point; }, context);
  Unfilled<int> numbers(points); // of samples only
  for (std::size_t sample = 0; sample < sampling.Samples.size(); ++sample)
  {
    numbers[sampling.Samples[sample]] = static_cast<int>(sample);
  }
  sampling.Owners.resize(points);
  sampling.Places.resize(points);
  sampling.Turns.resize(points);
  context.ParallelFor(0, points, Grain,
    [&](int first, int last)
    {
      for (int point = first; point < last; ++point)
      {
        sampling.Owners[point] = numbers[sights[point].Owner];
        sampling.Places[point] = sights[point].Place;
        sampling.Turns[point] = sights[point].Turn;
      }
    });
  return sampling;
}

}

PointSampling SamplePoints(
  const TangentGraph& graph, double radius, double largestCurvature, const ExecutionContext& context)
{
  Sights sights = Sampler(graph, radius, largestCurvature, context).Run(context);
  sights = FollowNeighbours(graph, sights, context);
  for (int k = 0; k < NumberOfMeans; ++k)
  {
    sights = MeansOfNeighbours(graph, sights, context);
  }
  return Numbered(sights, context);
}

}
