#include "Levels/GraphOfSamples.h"

#include "Support/CountingSort.h"
#include "Support/Permutations.h"
#include "Support/SparseAssembly.h"
#include "Support/SparseKernels.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace dmg
{

namespace
{

constexpr int Grain = 4096;

/// Sums over links between two samples.
struct Crossings
{
  Complex Steps = 0.0;
  Complex Turns = 0.0;
  double Count = 0.0;

  Crossings& operator+=(const Crossings& other)
  {
    this->Steps += other.Steps;
    this->Turns += other.Turns;
    this->Count += other.Count;
    return *this;
  }
};

/// The points of each sample, ascending.
SortedItems PointsOfSamples(const PointSampling& sampling, const ExecutionContext& context)
{
  return SortByKey(
    Identity(static_cast<int>(sampling.Owners.size())), static_cast<int>(sampling.Samples.size()),
    [&sampling](int point) { return sampling.Owners[point]; }, context);
}

void AddCrossings(const TangentGraph& graph, const PointSampling& sampling, int point, RowEntries<Crossings>& row)
{
  const int owner = sampling.Owners[point];
  for (int link = graph.Offsets[point]; link < graph.Offsets[point + 1]; ++link)
  {
    const int neighbour = graph.Neighbours[link];
    if (sampling.Owners[neighbour] != owner)
    {
      const Complex turn = sampling.Turns[point] * graph.Turns[link] * std::conj(sampling.Turns[neighbour]);
      const Complex step =
        sampling.Places[point] + sampling.Turns[point] * graph.Steps[link] - turn * sampling.Places[neighbour];
      AddTo(row, sampling.Owners[neighbour], Crossings{ step, turn, 1.0 });
    }
  }
}

/// The links of a sample, counter-clockwise.
void SetLinks(
  TangentGraph& graph, int sample, const std::pair<int, Crossings>* begin, const std::pair<int, Crossings>* end)
{
  thread_local std::vector<std::pair<double, const std::pair<int, Crossings>*>> around;
  around.clear();
  for (const auto* entry = begin; entry != end; ++entry)
  {
    around.emplace_back(std::arg(entry->second.Steps), entry);
  }
  std::sort(around.begin(), around.end());
  int link = graph.Offsets[sample];
  for (const auto& [angle, entry] : around)
  {
    const auto& [neighbour, crossings] = *entry;
    const double length = std::sqrt(std::norm(crossings.Turns));
    graph.Neighbours[link] = neighbour;
    graph.Steps[link] = crossings.Steps / crossings.Count;
    // Turns that contradict each other: any will do.
    graph.Turns[link] = length > 0.0 ? crossings.Turns / length : Complex(1.0);
    ++link;
  }
}

}

TangentGraph GraphOfSamples(const TangentGraph& graph, const PointSampling& sampling, const ExecutionContext& context)
{
  const int samples = static_cast<int>(sampling.Samples.size());
  const SortedItems members = PointsOfSamples(sampling, context);
  const AssembledRows<Crossings> rows(samples, context,
    [&](int sample, RowEntries<Crossings>& row)
    {
      for (int k = members.Begins[sample]; k < members.Begins[sample + 1]; ++k)
      {
        AddCrossings(graph, sampling, members.Items[k], row);
      }
    });
  TangentGraph result;
  result.Offsets.assign(samples + 1, 0);
  for (int sample = 0; sample < samples; ++sample)
  {
    result.Offsets[sample + 1] = rows.Size(sample);
  }
  const int links = OffsetsFromCounts(result.Offsets);
  result.Neighbours.resize(links);
  result.Steps.resize(links);
  result.Turns.resize(links);
  result.Curvatures.assign(samples, 0.0);
  context.ParallelFor(0, samples, Grain,
    [&](int first, int last)
    {
      for (int sample = first; sample < last; ++sample)
      {
        for (int k = members.Begins[sample]; k < members.Begins[sample + 1]; ++k)
        {
          result.Curvatures[sample] += graph.Curvatures[members.Items[k]];
        }
        SetLinks(result, sample, rows.Begin(sample), rows.End(sample));
      }
    });
  return result;
}

}
