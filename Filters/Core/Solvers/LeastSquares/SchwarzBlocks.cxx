#include "Solvers/LeastSquares/SchwarzBlocks.h"

#include "Support/Errors.h"
#include "Support/Permutations.h"
#include "Support/Remedy.h"

#include <Eigen/Cholesky>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>
#include <vector>

namespace dmg
{
namespace
{

// Keeps a block of dependent unknowns, as of a face without area, invertible in single precision.
constexpr double Ridge = 1e-6;
constexpr int GroupGrain = 256;

bool FollowEachOther(const int* begin, const int* end)
{
  return std::adjacent_find(begin, end, [](int a, int b) { return b != a + 1; }) == end;
}

/// Whether the unknowns of a pack follow each other, and the lanes of each inner row.
bool AreInOrder(const BlockGroups& groups, const BlockGroups::Group& group)
{
  if (group.Lanes == 1 || !FollowEachOther(groups.Unknowns(group), groups.Rows(group)))
  {
    return false;
  }
  for (int k = 0; k < groups.PatternOf(group).InnerRows; ++k)
  {
    const int* const lanes = groups.Rows(group) + k * group.Lanes;
    if (!FollowEachOther(lanes, lanes + group.Lanes))
    {
      return false;
    }
  }
  return true;
}

/// Inverts blocks one after the other.
class Inverter
{
public:
  Inverter(const SchwarzBlocks& blocks, const Vector<double>& diagonal)
    : Blocks(blocks)
    , D(diagonal)
    , Column(BlockGroups::MostRows, 0.0)
  {
  }

  /// \param inverse of the whole group.
  void operator()(const SchwarzBlocks::Group& group, int lane, float* inverse)
  {
    const BlockPattern& pattern = this->Blocks.PatternOf(group);
    const float* const values = this->Blocks.Values(group) + lane;
    const int size = pattern.Unknowns();
    // B^T B + D, scaled to ones on the diagonal.
    Dense A(size, size);
    double scales[SchwarzBlocks::LargestBlock];
    for (int i = 0; i < size; ++i)
    {
      for (int e = pattern.Offsets[i]; e < pattern.Offsets[i + 1]; ++e)
      {
        this->Column[pattern.RowOf[e]] = values[e * group.Lanes];
      }
      for (int j = 0; j <= i; ++j)
      {
        A(i, j) = 0.0;
        for (int e = pattern.Offsets[j]; e < pattern.Offsets[j + 1]; ++e)
        {
          A(i, j) += values[e * group.Lanes] * this->Column[pattern.RowOf[e]];
        }
      }
      for (int e = pattern.Offsets[i]; e < pattern.Offsets[i + 1]; ++e)
      {
        this->Column[pattern.RowOf[e]] = 0.0;
      }
      const double diagonal = A(i, i) + this->D[this->Blocks.UnknownOf(group, i * group.Lanes + lane)];
      // Zero where there is nothing to solve for.
      scales[i] = diagonal > 0.0 ? 1.0 / std::sqrt(diagonal) : 0.0;
    }
    for (int i = 0; i < size; ++i)
    {
      for (int j = 0; j < i; ++j)
      {
        A(i, j) *= scales[i] * scales[j];
      }
      A(i, i) = 1.0 + Ridge;
    }
    const Dense inverted = A.selfadjointView<Eigen::Lower>().llt().solve(Dense::Identity(size, size));
    inverse += lane;
    for (int i = 0; i < size; ++i)
    {
      for (int j = 0; j <= i; ++j, inverse += group.Lanes)
      {
        *inverse = static_cast<float>(scales[i] * inverted(i, j) * scales[j]);
      }
    }
  }

private:
  using Dense =
    Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, SchwarzBlocks::LargestBlock, SchwarzBlocks::LargestBlock>;

  const SchwarzBlocks& Blocks;
  const Vector<double>& D;
  std::vector<double> Column; ///< of B, zero in between
};

}

SchwarzBlocks::SchwarzBlocks(
  const SparseMatrix<double>& Bt, const UnknownBlocks& blocks, const ExecutionContext& context)
{
  {
    BlockGroups groups = GroupBlocks(Bt, blocks, context);
    this->OrderOfUnknowns = groups.OrderOfUnknowns(static_cast<int>(Bt.rows()));
    this->PlacesInUnknowns = dmg::Inverse(this->OrderOfUnknowns, context);
    this->PlacesInRows = dmg::Inverse(groups.OrderOfRows(static_cast<int>(Bt.cols())), context);
    groups.Renumber(this->PlacesInUnknowns, this->PlacesInRows);
    this->MakeRoom(groups);
    this->Fill(Bt, groups, context);
    this->TileBegins = std::move(groups.TileBegins);
    this->RunBegins = std::move(groups.RunBegins);
    this->TileColours = std::move(groups.ColoursOfTiles);
    this->Patterns = std::move(groups.Patterns);
  }
  std::vector<float*> places;
  places.reserve(this->GroupsInOrder.size());
  for (const Group& group : this->GroupsInOrder)
  {
    places.push_back(this->Inverses.data() + group.Inverse);
  }
  this->Invert(
    Vector<double>::Zero(Bt.rows()), Identity(static_cast<int>(this->GroupsInOrder.size())), places, context);
}

/// Gives each group its place in the arrays.
void SchwarzBlocks::MakeRoom(const BlockGroups& groups)
{
  std::size_t places = 0;
  std::size_t values = 0;
  std::size_t inverses = 0;
  this->GroupsInOrder.reserve(groups.Groups.size());
  for (const BlockGroups::Group& group : groups.Groups)
  {
    const BlockPattern& pattern = groups.PatternOf(group);
    const bool areInOrder = AreInOrder(groups, group);
    this->GroupsInOrder.push_back(
      { group.Pattern, group.Lanes, group.Blocks, areInOrder ? groups.Unknowns(group)[0] : -1,
        static_cast<std::uint32_t>(places), static_cast<std::uint32_t>(values), static_cast<std::uint32_t>(inverses) });
    places += areInOrder ? pattern.InnerRows + (pattern.Rows() - pattern.InnerRows) * group.Lanes
                         : (pattern.Unknowns() + pattern.Rows()) * group.Lanes;
    values += static_cast<std::size_t>(pattern.Entries()) * group.Lanes;
    inverses += static_cast<std::size_t>(pattern.InverseSize()) * group.Lanes;
  }
  if (std::max({ places, values, inverses }) > std::numeric_limits<std::uint32_t>::max())
  {
    throw InvalidInput("the smoothing blocks hold more than 2^32 numbers; " + TextOf(Remedy::FewerTriangles));
  }
  this->Places.resize(places);
  this->EntriesOfB.resize(values);
  this->Inverses.resize(inverses);
}

/// Places and entries of B.
void SchwarzBlocks::Fill(const SparseMatrix<double>& Bt, const BlockGroups& groups, const ExecutionContext& context)
{
  const int size = static_cast<int>(groups.Groups.size());
  const int grain = std::max(GroupGrain, size / (4 * context.NumberOfThreads()));
  context.ParallelFor(0, size, grain,
    [&](int first, int last)
    {
      std::vector<float> column(Bt.cols()); // of B, and what is left of others
      for (int g = first; g < last; ++g)
      {
        const Group& group = this->GroupsInOrder[g];
        const BlockPattern& pattern = groups.Patterns[group.Pattern];
        const int* const unknowns = groups.Unknowns(groups.Groups[g]);
        const int* const rows = groups.Rows(groups.Groups[g]);
        const int* const end = rows + pattern.Rows() * group.Lanes;
        int* const places = this->Places.data() + group.Places;
        if (group.FirstPlace >= 0)
        {
          for (int k = 0; k < pattern.InnerRows; ++k)
          {
            places[k] = rows[k * group.Lanes];
          }
          std::copy(rows + pattern.InnerRows * group.Lanes, end, places + pattern.InnerRows);
        }
        else
        {
          std::copy(unknowns, end, places);
        }
        float* const values = this->EntriesOfB.data() + group.Values;
        for (int slot = 0; slot < pattern.Unknowns() * group.Lanes; ++slot)
        {
          const int unknown = this->OrderOfUnknowns[unknowns[slot]];
          for (int e = Bt.outerIndexPtr()[unknown]; e < Bt.outerIndexPtr()[unknown + 1]; ++e)
          {
            column[this->PlacesInRows[Bt.innerIndexPtr()[e]]] = static_cast<float>(Bt.valuePtr()[e]);
          }
          const int lane = slot % group.Lanes;
          const int i = slot / group.Lanes;
          for (int e = pattern.Offsets[i]; e < pattern.Offsets[i + 1]; ++e)
          {
            values[e * group.Lanes + lane] = column[rows[pattern.RowOf[e] * group.Lanes + lane]];
          }
        }
      }
    });
}

void SchwarzBlocks::Invert(const Vector<double>& D, const std::vector<int>& groups, const std::vector<float*>& inverses,
  const ExecutionContext& context) const
{
  context.ParallelFor(0, static_cast<int>(groups.size()), GroupGrain,
    [&](int first, int last)
    {
      Inverter invert(*this, D);
      for (int k = first; k < last; ++k)
      {
        const Group& group = this->GroupsInOrder[groups[k]];
        for (int l = 0; l < group.Lanes; ++l)
        {
          invert(group, l, inverses[k]);
        }
      }
    });
}

long long SchwarzBlocks::Bytes() const
{
  const auto bytes = [](const auto& vector) { return static_cast<long long>(vector.size() * sizeof(vector[0])); };
  long long sum = bytes(this->TileBegins) + bytes(this->RunBegins) + bytes(this->TileColours) +
    bytes(this->GroupsInOrder) + bytes(this->OrderOfUnknowns) + bytes(this->PlacesInUnknowns) +
    bytes(this->PlacesInRows) + bytes(this->Places) + bytes(this->EntriesOfB) + bytes(this->Inverses);
  for (const BlockPattern& pattern : this->Patterns)
  {
    sum += sizeof(BlockPattern) + bytes(pattern.Offsets) + bytes(pattern.RowOf) + bytes(pattern.RowOffsets) +
      bytes(pattern.EntryAt) + bytes(pattern.UnknownAt);
  }
  return sum;
}

}
