#ifndef dmgTestLeastSquaresProblem_h
#define dmgTestLeastSquaresProblem_h

#include "Solvers/Kernels/RowTiles.h"
#include "Solvers/LeastSquares/UnknownBlocks.h"
#include "Support/DenseAlgebra.h"
#include "Support/GridProblem.h"

#include <algorithm>
#include <cstdint>
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
    return Product<double>(dense.transpose(), dense);
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

/// Copies of a block: which of its unknowns touch each row of B is told by bits. Rows from \p innerRows on are
/// touched by one more unknown each, a block by itself. Copies share no row.
inline Squares Copies(int copies, int unknowns, int innerRows, const std::vector<std::uint64_t>& unknownsOfRows)
{
  Random random(3115);
  std::vector<Eigen::Triplet<double>> entries;
  UnknownBlocks blocks;
  UnknownBlocks others;
  const int rows = static_cast<int>(unknownsOfRows.size());
  const int ofCopy = unknowns + rows - innerRows;
  for (int copy = 0; copy < copies; ++copy)
  {
    const auto append = [&](int row, int unknown, double least)
    {
      entries.emplace_back(copy * rows + row, copy * ofCopy + unknown,
        random.Uniform(least, 1.0) * (random.Uniform(0.0, 1.0) < 0.5 ? -1.0 : 1.0));
    };
    for (int i = 0; i < unknowns; ++i)
    {
      for (int k = 0; k < rows; ++k)
      {
        if ((unknownsOfRows[k] >> i & 1) != 0)
        {
          append(k, i, 0.1);
        }
      }
      blocks.Unknowns.push_back(copy * ofCopy + i);
    }
    blocks.EndBlock();
    for (int k = innerRows; k < rows; ++k)
    {
      append(k, unknowns + k - innerRows, 0.5);
      others.Unknowns.push_back(copy * ofCopy + unknowns + k - innerRows);
      others.EndBlock();
    }
  }
  for (const int unknown : others.Unknowns)
  {
    blocks.Unknowns.push_back(unknown);
    blocks.EndBlock();
  }
  return { WithUnitColumns(FromTriplets(copies * rows, copies * ofCopy, entries)), std::move(blocks) };
}

/// Blocks like the sides of faces inside of a surface (the face; the faces beyond and the corners).
inline Squares Sides(int copies)
{
  return Copies(copies, 3, 1, { 7, 1, 2, 4, 3, 5, 6 });
}

/// Blocks like the components of the faces around a vertex (its edges and itself; the edges opposite and
/// the other vertices).
inline Squares Wheels(int copies, int faces)
{
  std::vector<std::uint64_t> ofFaces, ofTwo;
  for (int face = 0; face < faces; ++face)
  {
    ofFaces.push_back(std::uint64_t(3) << 2 * face);
    ofTwo.push_back(ofFaces.back() | std::uint64_t(3) << 2 * ((face + 1) % faces));
  }
  std::vector<std::uint64_t> rows = ofTwo;
  rows.push_back((std::uint64_t(1) << 2 * faces) - 1);
  rows.insert(rows.end(), ofFaces.begin(), ofFaces.end());
  rows.insert(rows.end(), ofTwo.begin(), ofTwo.end());
  return Copies(copies, 2 * faces, faces + 1, rows);
}

/// The block of a matrix.
inline Eigen::MatrixXd BlockOf(const Eigen::MatrixXd& A, const std::vector<int>& unknowns)
{
  return A(unknowns, unknowns);
}

/// The unknowns of a block.
inline std::vector<int> MembersOf(const UnknownBlocks& blocks, int block)
{
  return { blocks.Unknowns.begin() + blocks.Offsets[block], blocks.Unknowns.begin() + blocks.Offsets[block + 1] };
}

}

#endif
