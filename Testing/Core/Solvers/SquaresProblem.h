#ifndef dmgTestSquaresProblem_h
#define dmgTestSquaresProblem_h

#include "GridProblem.h"
#include "Solvers/SchwarzBlocks.h"
#include "Support/RowTiles.h"

#include <Eigen/Dense>

#include <utility>
#include <vector>

namespace dmg::test
{

/// A sum of squares |B x|^2 and blocks for it; columns of B have length 1.
struct Squares
{
  Squares(const SparseMatrix<double>& factor, UnknownBlocks blocks)
    : B(factor)
    , Bt(factor.transpose())
    , Tiles(this->B)
    , Blocks(std::move(blocks))
  {
  }

  int Size() const { return static_cast<int>(this->B.cols()); }
  Eigen::MatrixXd Matrix() const
  {
    const Eigen::MatrixXd dense(this->B);
    return dense.transpose() * dense;
  }

  SparseMatrix<double> B;
  SparseMatrix<double> Bt;
  RowTiles Tiles;
  UnknownBlocks Blocks;
};

inline SparseMatrix<double> WithUnitColumns(const SparseMatrix<double>& B)
{
  const SparseMatrix<double> squares = B.cwiseAbs2();
  const Vector<double> lengths = (squares.transpose() * Vector<double>::Ones(B.rows())).cwiseSqrt();
  return B * lengths.cwiseInverse().asDiagonal();
}

/// Differences of neighbours on a ring of \p size unknowns, and the unknowns themselves with less
/// weight; blocks of four, each half of which the next one shares. \pre size is even, at least 4
inline Squares Ring(int size)
{
  Random random(3101);
  std::vector<Eigen::Triplet<double>> entries;
  for (int i = 0; i < size; ++i)
  {
    const double weight = random.Uniform(0.2, 1.0);
    entries.emplace_back(i, i, -weight);
    entries.emplace_back(i, (i + 1) % size, weight);
    entries.emplace_back(size + i, i, random.Uniform(0.1, 0.3));
  }
  UnknownBlocks blocks;
  for (int first = 0; first + 4 <= size; first += 2)
  {
    for (int i = first; i < first + 4; ++i)
    {
      blocks.Unknowns.push_back(i);
    }
    blocks.EndBlock();
  }
  return { WithUnitColumns(FromTriplets(2 * size, size, entries)), std::move(blocks) };
}

/// As around a vertex of \p blades faces: one square holds all unknowns, two per blade, so that no
/// two blocks are independent; others hold neighbours.
inline Squares Fan(int blades)
{
  Random random(3102);
  std::vector<Eigen::Triplet<double>> entries;
  const int size = 2 * blades;
  for (int i = 0; i < size; ++i)
  {
    entries.emplace_back(0, i, random.Uniform(-0.2, 0.2));
    entries.emplace_back(1 + i, i, 1.0);
    entries.emplace_back(1 + i, (i + 2) % size, random.Uniform(-0.8, 0.8));
  }
  UnknownBlocks blocks;
  for (int blade = 0; blade < blades; ++blade)
  {
    blocks.Unknowns.push_back(2 * blade);
    blocks.Unknowns.push_back(2 * blade + 1);
    blocks.EndBlock();
  }
  return { WithUnitColumns(FromTriplets(1 + size, size, entries)), std::move(blocks) };
}

/// The unknowns of a block of a group.
inline std::vector<int> MembersOf(
  const SchwarzBlocks& blocks, const SchwarzBlocks::Group& group, int lane)
{
  std::vector<int> members;
  for (int i = 0; i < blocks.PatternOf(group).Unknowns(); ++i)
  {
    members.push_back(blocks.Unknowns(group)[i * group.Lanes + lane]);
  }
  return members;
}

/// The blocks of some groups, lane by lane.
inline void AppendBlocks(
  const SchwarzBlocks& blocks, const SchwarzBlocks::Tile& tile, UnknownBlocks& to)
{
  const SchwarzBlocks::Run groups = blocks.GroupsOf(tile);
  for (int g = groups.First; g < groups.Last; ++g)
  {
    for (int lane = 0; lane < blocks.Groups()[g].Lanes; ++lane)
    {
      const std::vector<int> members = MembersOf(blocks, blocks.Groups()[g], lane);
      to.Unknowns.insert(to.Unknowns.end(), members.begin(), members.end());
      to.EndBlock();
    }
  }
}

/// As a smoother takes them upwards.
inline UnknownBlocks BlocksInOrder(const SchwarzBlocks& blocks)
{
  UnknownBlocks inOrder;
  for (int tile = 0; tile < blocks.NumberOfTiles(); ++tile)
  {
    AppendBlocks(blocks, blocks.TileAt(tile), inOrder);
  }
  return inOrder;
}

/// The block of a matrix.
inline Eigen::MatrixXd BlockOf(const Eigen::MatrixXd& A, const std::vector<int>& unknowns)
{
  return A(unknowns, unknowns);
}

/// The unknowns of a block.
inline std::vector<int> MembersOf(const UnknownBlocks& blocks, int block)
{
  return { blocks.Unknowns.begin() + blocks.Offsets[block],
    blocks.Unknowns.begin() + blocks.Offsets[block + 1] };
}

}

#endif
