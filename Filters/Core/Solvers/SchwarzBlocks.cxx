#include "Solvers/SchwarzBlocks.h"

#include <Eigen/Cholesky>

#include <cmath>
#include <vector>

namespace dmg
{
namespace
{

// Keeps a block of dependent unknowns, as of a face without area, invertible in single precision.
constexpr double Ridge = 1e-6;

/// Inverts blocks one after the other.
class Inverter
{
public:
  Inverter(const SchwarzBlocks& blocks, const Vector<double>& diagonal)
    : Blocks(blocks)
    , D(diagonal)
    , Column(SchwarzBlocks::MostRows, 0.0)
  {
  }

  /// \param inverse of the whole group.
  void operator()(const SchwarzBlocks::Group& group, int lane, float* inverse)
  {
    const SchwarzBlocks::Pattern& pattern = this->Blocks.PatternOf(group);
    const int* const unknowns = this->Blocks.Unknowns(group) + lane;
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
      const double diagonal = A(i, i) + this->D[unknowns[i * group.Lanes]];
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
    const Dense inverted =
      A.selfadjointView<Eigen::Lower>().llt().solve(Dense::Identity(size, size));
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
  using Dense = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, SchwarzBlocks::LargestBlock,
    SchwarzBlocks::LargestBlock>;

  const SchwarzBlocks& Blocks;
  const Vector<double>& D;
  std::vector<double> Column; ///< of B, zero in between
};

}

void SchwarzBlocks::Invert(const Vector<double>& D, const std::vector<int>& groups,
  const std::vector<float*>& inverses, const ExecutionContext& context) const
{
  constexpr int grain = 256;
  context.ParallelFor(0, static_cast<int>(groups.size()), grain, [&](int first, int last) {
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
  const auto bytes = [](const auto& vector) {
    return static_cast<long long>(vector.size() * sizeof(vector[0]));
  };
  long long sum = bytes(this->TileBegins) + bytes(this->RunBegins) + bytes(this->Neighbours.Begins) +
    bytes(this->Neighbours.Neighbours) + bytes(this->GroupsInOrder) + bytes(this->Indices) + bytes(this->EntriesOfB) +
    bytes(this->Inverses);
  for (const Pattern& pattern : this->Patterns)
  {
    sum += sizeof(Pattern) + bytes(pattern.Offsets) + bytes(pattern.RowOf) +
      bytes(pattern.RowOffsets) + bytes(pattern.EntryAt) + bytes(pattern.UnknownAt);
  }
  return sum;
}

}
