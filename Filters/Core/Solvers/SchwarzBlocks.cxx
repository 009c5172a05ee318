#include "Solvers/SchwarzBlocks.h"

#include "Support/Errors.h"
#include "Support/SparseKernels.h"

#include <Eigen/Cholesky>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <string>
#include <utility>

namespace dmg
{
namespace
{

// Tiles for the caches of a core, and some for each of many threads on small surfaces.
constexpr int LargestTile = 1024;
constexpr int SmallestTile = 16;
constexpr int WantedTiles = 128;
// Keeps a block of dependent unknowns, as of a face without area, invertible in single precision.
constexpr double Ridge = 1e-6;

using Dense = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0,
  SchwarzBlocks::LargestBlock, SchwarzBlocks::LargestBlock>;

/// Inverts blocks one after the other.
class Inverter
{
public:
  Inverter(const SparseMatrix<double>& transpose, const Vector<double>& diagonal)
    : Bt(transpose)
    , D(diagonal)
    , Column(transpose.cols(), 0.0)
  {
  }

  void operator()(const int* unknowns, int size, float* inverse)
  {
    // B^T B + D, scaled to ones on the diagonal.
    Dense A(size, size);
    double scales[SchwarzBlocks::LargestBlock];
    for (int i = 0; i < size; ++i)
    {
      const int row = unknowns[i];
      for (int e = this->Bt.outerIndexPtr()[row]; e < this->Bt.outerIndexPtr()[row + 1]; ++e)
      {
        this->Column[this->Bt.innerIndexPtr()[e]] = this->Bt.valuePtr()[e];
      }
      for (int j = 0; j <= i; ++j)
      {
        A(i, j) = RowTimes(this->Bt, unknowns[j], this->Column.data());
      }
      for (int e = this->Bt.outerIndexPtr()[row]; e < this->Bt.outerIndexPtr()[row + 1]; ++e)
      {
        this->Column[this->Bt.innerIndexPtr()[e]] = 0.0;
      }
      const double diagonal = A(i, i) + this->D[row];
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
    for (int i = 0; i < size; ++i)
    {
      for (int j = 0; j <= i; ++j)
      {
        *inverse++ = static_cast<float>(scales[i] * inverted(i, j) * scales[j]);
      }
    }
  }

private:
  const SparseMatrix<double>& Bt;
  const Vector<double>& D;
  std::vector<double> Column; ///< of B, zero in between
};

}

SchwarzBlocks::SchwarzBlocks(
  const SparseMatrix<double>& Bt, UnknownBlocks blocks, const ExecutionContext& context)
  : Members(std::move(blocks))
{
  const int size = this->Members.Size();
  for (int k = 0; k < size; ++k)
  {
    const int unknowns = this->Members.Offsets[k + 1] - this->Members.Offsets[k];
    if (unknowns > LargestBlock)
    {
      throw InvalidInput("block " + std::to_string(k) + " holds " + std::to_string(unknowns) +
        " unknowns; split it into blocks of at most " + std::to_string(LargestBlock));
    }
  }
  this->MakeTiles();
  this->SortTiles(Bt, context);
  this->ColourTiles(Bt);
  this->CopyEntries(Bt, context);

  this->InverseBegins.reserve(size + 1);
  for (int k = 0; k < size; ++k)
  {
    const std::size_t unknowns = this->Members.Offsets[k + 1] - this->Members.Offsets[k];
    this->InverseBegins.push_back(this->InverseBegins.back() + unknowns * (unknowns + 1) / 2);
  }
  this->Inverses.resize(this->InverseBegins.back());
  std::vector<int> all(size);
  std::iota(all.begin(), all.end(), 0);
  std::vector<float*> places(size);
  for (int k = 0; k < size; ++k)
  {
    places[k] = this->Inverses.data() + this->InverseBegins[k];
  }
  this->Invert(Bt, Vector<double>::Zero(Bt.rows()), all, places, context);
}

void SchwarzBlocks::MakeTiles()
{
  const int size = this->Members.Size();
  const int tileSize = std::clamp(size / WantedTiles, SmallestTile, LargestTile);
  for (int begin = 0; begin < size; begin += tileSize)
  {
    this->TileBegins.push_back(begin);
  }
  this->TileBegins.push_back(size);
}

void SchwarzBlocks::SortTiles(const SparseMatrix<double>& Bt, const ExecutionContext& context)
{
  constexpr int numberOfColours = 64; // blocks that find none share the last; none must be independent
  const int numberOfTiles = static_cast<int>(this->TileBegins.size()) - 1;
  const int grain = std::max(1, numberOfTiles / (4 * context.NumberOfThreads()));
  context.ParallelFor(0, numberOfTiles, grain, [&](int firstTile, int lastTile) {
    std::vector<std::uint64_t> taken(Bt.cols(), 0); // by row of B: colours of the blocks that touch it
    std::vector<std::pair<int, int>> order;         // colour, block
    UnknownBlocks sorted;
    for (int tile = firstTile; tile < lastTile; ++tile)
    {
      const int first = this->TileBegins[tile];
      const int last = this->TileBegins[tile + 1];
      const auto forRows = [&](int firstBlock, int lastBlock, const auto& visit) {
        const int lastSlot = this->Members.Offsets[lastBlock];
        for (int s = this->Members.Offsets[firstBlock]; s < lastSlot; ++s)
        {
          const int unknown = this->Members.Unknowns[s];
          for (int e = Bt.outerIndexPtr()[unknown]; e < Bt.outerIndexPtr()[unknown + 1]; ++e)
          {
            visit(taken[Bt.innerIndexPtr()[e]]);
          }
        }
      };
      order.clear();
      for (int k = first; k < last; ++k)
      {
        std::uint64_t forbidden = 0;
        forRows(k, k + 1, [&forbidden](std::uint64_t colours) { forbidden |= colours; });
        int colour = 0;
        while (colour + 1 < numberOfColours && (forbidden >> colour & 1) != 0)
        {
          ++colour;
        }
        forRows(k, k + 1, [colour](std::uint64_t& set) { set |= std::uint64_t(1) << colour; });
        order.emplace_back(colour, k);
      }
      forRows(first, last, [](std::uint64_t& colours) { colours = 0; });
      std::sort(order.begin(), order.end());

      const int firstSlot = this->Members.Offsets[first];
      sorted.Offsets = { firstSlot };
      sorted.Unknowns.clear();
      for (const auto& [colour, k] : order)
      {
        sorted.Unknowns.insert(sorted.Unknowns.end(),
          this->Members.Unknowns.begin() + this->Members.Offsets[k],
          this->Members.Unknowns.begin() + this->Members.Offsets[k + 1]);
        sorted.Offsets.push_back(firstSlot + static_cast<int>(sorted.Unknowns.size()));
      }
      std::copy(
        sorted.Unknowns.begin(), sorted.Unknowns.end(), this->Members.Unknowns.begin() + firstSlot);
      // The ends of a tile are the same as before, and belong to its neighbours, too.
      std::copy(sorted.Offsets.begin() + 1, sorted.Offsets.end() - 1,
        this->Members.Offsets.begin() + first + 1);
    }
  });
}

/// Each tile gets the first colour that no earlier tile on one of its rows has.
void SchwarzBlocks::ColourTiles(const SparseMatrix<double>& Bt)
{
  const int numberOfTiles = static_cast<int>(this->TileBegins.size()) - 1;
  // Rows keep their tiles as linked lists, the last one first.
  struct Touch
  {
    int Tile;
    int Next;
  };
  std::vector<Touch> touches;
  std::vector<int> lastTouch(Bt.cols(), -1);
  std::vector<int> colours(numberOfTiles, 0);
  std::vector<int> forbiddenBy(numberOfTiles, -1); // by colour: the last tile that must not have it
  for (int tile = 0; tile < numberOfTiles; ++tile)
  {
    const int lastSlot = this->Members.Offsets[this->TileBegins[tile + 1]];
    for (int s = this->Members.Offsets[this->TileBegins[tile]]; s < lastSlot; ++s)
    {
      const int unknown = this->Members.Unknowns[s];
      for (int e = Bt.outerIndexPtr()[unknown]; e < Bt.outerIndexPtr()[unknown + 1]; ++e)
      {
        int& last = lastTouch[Bt.innerIndexPtr()[e]];
        if (last >= 0 && touches[last].Tile == tile)
        {
          continue;
        }
        for (int touch = last; touch >= 0; touch = touches[touch].Next)
        {
          forbiddenBy[colours[touches[touch].Tile]] = tile;
        }
        touches.push_back({ tile, last });
        last = static_cast<int>(touches.size()) - 1;
      }
    }
    while (forbiddenBy[colours[tile]] == tile)
    {
      ++colours[tile];
    }
  }

  const int numberOfColours =
    numberOfTiles > 0 ? *std::max_element(colours.begin(), colours.end()) + 1 : 0;
  this->ColourBegins.assign(numberOfColours + 1, 0);
  for (const int colour : colours)
  {
    ++this->ColourBegins[colour + 1];
  }
  OffsetsFromCounts(this->ColourBegins);
  std::vector<int> next = this->ColourBegins;
  this->Tiles.resize(numberOfTiles);
  for (int tile = 0; tile < numberOfTiles; ++tile)
  {
    this->Tiles[next[colours[tile]]++] = tile;
  }
}

void SchwarzBlocks::CopyEntries(const SparseMatrix<double>& Bt, const ExecutionContext& context)
{
  const int* const offsets = Bt.outerIndexPtr();
  for (Eigen::Index unknown = 0; unknown < Bt.rows(); ++unknown)
  {
    this->Width = std::max(this->Width, offsets[unknown + 1] - offsets[unknown]);
  }
  this->Columns.resize(static_cast<std::size_t>(Bt.rows()) * this->Width, { 0, 0.0f });
  constexpr int grain = 4096;
  context.ParallelFor(0, static_cast<int>(Bt.rows()), grain, [&](int first, int last) {
    for (int unknown = first; unknown < last; ++unknown)
    {
      Entry* entry = this->Columns.data() + static_cast<std::size_t>(unknown) * this->Width;
      for (int e = offsets[unknown]; e < offsets[unknown + 1]; ++e)
      {
        *entry++ = { Bt.innerIndexPtr()[e], static_cast<float>(Bt.valuePtr()[e]) };
      }
    }
  });
}

void SchwarzBlocks::Invert(const SparseMatrix<double>& Bt, const Vector<double>& D,
  const std::vector<int>& blocks, const std::vector<float*>& inverses,
  const ExecutionContext& context) const
{
  const int size = static_cast<int>(blocks.size());
  // Every part has a workspace of its own.
  const int grain = std::max(1024, size / (4 * context.NumberOfThreads()));
  context.ParallelFor(0, size, grain, [&](int first, int last) {
    Inverter invert(Bt, D);
    for (int k = first; k < last; ++k)
    {
      const int begin = this->Members.Offsets[blocks[k]];
      invert(this->Members.Unknowns.data() + begin,
        this->Members.Offsets[blocks[k] + 1] - begin, inverses[k]);
    }
  });
}

long long SchwarzBlocks::Bytes() const
{
  const auto bytes = [](const auto& vector) {
    return static_cast<long long>(vector.size() * sizeof(vector[0]));
  };
  return bytes(this->Members.Offsets) + bytes(this->Members.Unknowns) + bytes(this->Tiles) +
    bytes(this->Columns) + bytes(this->InverseBegins) + bytes(this->Inverses);
}

}
