#include "Solvers/Kernels/SweepOrder.h"

#include "Solvers/Kernels/PartColouring.h"
#include "Support/CountingSort.h"
#include "Support/ExecutionContext.h"
#include "Support/Permutations.h"

#include <algorithm>
#include <utility>

namespace dmg
{
namespace
{

constexpr int WantedTiles = 64;
constexpr int SmallestTile = 64;
constexpr int LargestTile = 1024;
// Short rows are taken faster in runs of one length, as colours have them, even by one thread.
constexpr int LongRow = 32;

/// Tiles that have entries in each other's columns.
template <class Scalar>
PartGraph CoupledTiles(const SparseMatrix<Scalar>& A, int tiles, int rowsOfTile)
{
  PartGraph graph;
  std::vector<int> metBy(tiles, -1); // the last tile that has met it
  for (int tile = 0; tile < tiles; ++tile)
  {
    metBy[tile] = tile;
    const int last = std::min((tile + 1) * rowsOfTile, static_cast<int>(A.rows()));
    for (int e = A.outerIndexPtr()[tile * rowsOfTile]; e < A.outerIndexPtr()[last]; ++e)
    {
      const int other = A.innerIndexPtr()[e] / rowsOfTile;
      if (metBy[other] != tile)
      {
        metBy[other] = tile;
        graph.Neighbours.push_back(other);
      }
    }
    std::sort(graph.Neighbours.begin() + graph.Begins.back(), graph.Neighbours.end());
    graph.Begins.push_back(static_cast<int>(graph.Neighbours.size()));
  }
  return graph;
}

}

template <class Scalar>
SweepOrder Colouring(const SparseMatrix<Scalar>& A)
{
  const int size = static_cast<int>(A.rows());
  const int* offsets = A.outerIndexPtr();
  const int* columns = A.innerIndexPtr();
  std::vector<int> colours(size, -1);
  std::vector<int> seenBy; // of each colour: the unknown that saw it last among its neighbours
  int longestRow = 0;
  for (int i = 0; i < size; ++i)
  {
    for (int k = offsets[i]; k < offsets[i + 1]; ++k)
    {
      const int colour = colours[columns[k]];
      if (colour >= 0)
      {
        seenBy[colour] = i;
      }
    }
    const auto free = std::find_if(seenBy.begin(), seenBy.end(), [i](int last) { return last != i; });
    colours[i] = static_cast<int>(free - seenBy.begin());
    if (free == seenBy.end())
    {
      seenBy.push_back(-1);
    }
    longestRow = std::max(longestRow, offsets[i + 1] - offsets[i]);
  }

  std::vector<int> earlier(size, 0);
  for (int i = 0; i < size; ++i)
  {
    for (int k = offsets[i]; k < offsets[i + 1]; ++k)
    {
      earlier[i] += colours[columns[k]] < colours[i] ? 1 : 0;
    }
  }
  const SerialContext serial;
  const auto length = [offsets](int i) { return offsets[i + 1] - offsets[i]; };
  const auto byLength = SortByKey(Identity(size), longestRow + 1, length, serial);
  const auto byEarlier = SortByKey(
    byLength.Items, longestRow + 1, [&earlier](int i) { return earlier[i]; }, serial);
  SortedItems byColours = SortByKey(
    byEarlier.Items, static_cast<int>(seenBy.size()), [&colours](int i) { return colours[i]; }, serial);
  return { std::move(byColours.Items), std::move(byColours.Begins), {} };
}

template <class Scalar>
SweepOrder Tiling(const SparseMatrix<Scalar>& A)
{
  const int size = static_cast<int>(A.rows());
  const int rowsOfTile = std::clamp(size / WantedTiles / 2 * 2, SmallestTile, LargestTile);
  const int tiles = (size + rowsOfTile - 1) / rowsOfTile;
  PartColouring colouring = ColourParts(CoupledTiles(A, tiles, rowsOfTile));
  SweepOrder order;
  order.Unknowns.reserve(size);
  order.Begins.push_back(0);
  for (const int tile : colouring.Parts)
  {
    for (int i = tile * rowsOfTile; i < std::min((tile + 1) * rowsOfTile, size); ++i)
    {
      order.Unknowns.push_back(i);
    }
    order.Begins.push_back(static_cast<int>(order.Unknowns.size()));
  }
  order.ColoursOfTiles = std::move(colouring.Begins);
  return order;
}

template <class Scalar>
SweepOrder OrderForSweeps(const SparseMatrix<Scalar>& A)
{
  return A.nonZeros() < LongRow * static_cast<long long>(A.rows()) ? Colouring(A) : Tiling(A);
}

SweepOrder SingleColour(int size)
{
  return { Identity(size), { 0, size }, {} };
}

template SweepOrder Colouring(const SparseMatrix<double>&);
template SweepOrder Colouring(const SparseMatrix<Complex>&);
template SweepOrder Tiling(const SparseMatrix<double>&);
template SweepOrder Tiling(const SparseMatrix<Complex>&);
template SweepOrder OrderForSweeps(const SparseMatrix<double>&);
template SweepOrder OrderForSweeps(const SparseMatrix<Complex>&);

}
