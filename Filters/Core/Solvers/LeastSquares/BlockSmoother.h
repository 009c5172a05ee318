#ifndef dmgBlockSmoother_h
#define dmgBlockSmoother_h

#include "Solvers/Kernels/PartColouring.h"
#include "Solvers/Kernels/RowRuns.h"
#include "Solvers/Kernels/RowTiles.h"
#include "Solvers/LeastSquares/UnknownBlocks.h"
#include "Support/ExecutionContext.h"
#include "Support/Types.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace dmg
{

/// Blocks in the order in which a BlockSmoother should have them: tile by tile, and in these colour by colour. A block has
/// the first colour that no earlier block of its tile on one of its rows of B has. So a processor works on several
/// independent blocks at once.
/// \param Bt B^T, a row per unknown. \param blocks near each other if they follow each other.
UnknownBlocks OrderedByColours(
  const SparseMatrix<double>& Bt, const UnknownBlocks& blocks, const ExecutionContext& context);

/// Multiplicative Schwarz with over-relaxation for A = B^T B + D, with D diagonal.
///
/// A step solves for the unknowns of one block exactly, by the dense inverse of its part of A. That damps errors
/// which point smoothers leave on thin triangles, whose three equations are nearly equal. Small blocks converge
/// slowly, so steps are over-relaxed. Blocks on which D is not zero are not over-relaxed: over-relaxation would
/// miss the exact solution of a strong penalty by 0.4 of the step, sweep by sweep.
///
/// A is never formed. B x is kept up to date beside x; B has a third to a half of the entries of A.
///
/// Consecutive blocks form tiles, which are coloured: tiles of a colour share no row of B. Threads share the tiles of a
/// colour, and one thread takes the blocks of a tile one after the other. So results have the same bits for any number
/// of threads.
///
/// Steps are taken in single precision, and added to x in double. The rounding errors are noise in B x, which has
/// no effect on vectors of little energy; these are the ones that coarse levels are for.
class BlockSmoother
{
public:
  static constexpr double UsualRelaxation = 1.4;

  /// \param B the factor, borrowed. \param tiles of its rows, borrowed.
  /// \param blocks of columns of B, borrowed, in the order of OrderedByColours; they cover all unknowns that are to be smoothed.
  ///   \pre none has more than UnknownBlocks::LargestBlock.
  /// \param D see SetDiagonal.
  /// \param sweeps before and after the coarse correction, >= 1.
  /// \param relaxation the factor of steps where D is zero, in (0, 2); 1 is block Gauss-Seidel.
  /// Cost: linear in the entries of B, and in the cubes of the sizes of blocks.
  BlockSmoother(const SparseMatrix<double>& B, const RowTiles& tiles, const UnknownBlocks& blocks,
    const Vector<double>& D, int sweeps, const ExecutionContext& context, double relaxation = UsualRelaxation);

  /// Takes another D.
  /// \param D one entry per unknown, >= 0. Infinite: the unknown is zero.
  /// Cost: one pass over the unknowns, and the inverses of the blocks where D is or was not zero.
  void SetDiagonal(const Vector<double>& D, const ExecutionContext& context);

  /// The unknowns where D is infinite; ascending.
  const std::vector<int>& HeldUnknowns() const { return this->Held; }

  /// Smooths A x = b from x = 0, colours in ascending order.
  /// \param x, r on exit the result and its residual b - A x; zero where unknowns are held.
  void PreSmooth(const Vector<double>& b, Vector<double>& x, Vector<double>& r, const ExecutionContext& context);

  /// Smooths A x = b from the given x, colours in descending order: the adjoint of PreSmooth.
  /// \pre x is zero where unknowns are held.
  void PostSmooth(const Vector<double>& b, Vector<double>& x, const ExecutionContext& context);

  /// Held by this object.
  long long Bytes() const;

private:
  int NumberOfTiles() const { return static_cast<int>(this->BlockBegins.size()) - 1; }
  const int* UnknownsOf(int block) const { return this->Blocks.Unknowns.data() + this->Blocks.Offsets[block]; }
  void CollectEntries(const SparseMatrix<double>& Bt);
  bool Touches(const Vector<double>& D, int block) const;
  /// \param D of all unknowns. \param factor of the result. \param room a zero for each row of the tile; zero on exit.
  void Invert(int block, const Vector<double>& D, double factor, Vector<double>& room);
  void RunSweeps(bool descending, const ExecutionContext& context);
  void SmoothTile(int tile, bool descending);
  /// \param products the rows of B x that the tile of the block touches.
  void SmoothBlock(int block, float* products);

  const RowRuns<double> B;
  const RowTiles& Tiles;
  const UnknownBlocks& Blocks;
  const int Sweeps;
  const double Relaxation;
  std::vector<int> BlockBegins; ///< tile t has the blocks [BlockBegins[t], BlockBegins[t + 1])
  PartColouring TileColours;

  // All that sweeps read of the blocks, in their order.
  std::vector<int> RowBegins;               ///< tile t touches Rows[RowBegins[t]] to [RowBegins[t + 1] - 1]
  std::vector<int> Rows;                    ///< of B
  std::vector<int> EntryBegins;             ///< of the columns of B, one for each of Blocks.Unknowns
  std::vector<std::uint16_t> RowsOfEntries; ///< counted from the first row of the tile
  std::vector<float> Entries;
  std::vector<std::size_t> InverseBegins;
  std::vector<float> Inverses; ///< of blocks, times the relaxation; lower triangles by rows

  std::vector<char> AreTouched; ///< the blocks where D is not zero
  std::vector<int> Held;        ///< ascending
  Vector<float> Diagonal;       ///< D where it is finite, else zero
  Vector<float> Right;          ///< b - D x before the sweeps
  Vector<float> Step;           ///< what the sweeps have added to x
  Vector<float> Bx;
};

}

#endif
