#ifndef dmgBlockSmoother_h
#define dmgBlockSmoother_h

#include "Solvers/Kernels/RowRuns.h"
#include "Solvers/Kernels/RowTiles.h"
#include "Solvers/LeastSquares/SchwarzBlocks.h"
#include "Support/ExecutionContext.h"
#include "Support/Types.h"

#include <vector>

namespace dmg
{

/// Block successive over-relaxation (multiplicative Schwarz) for a sum of squares, A = B^T B + D with D
/// diagonal.
///
/// Each step solves for the unknowns of one block exactly. That damps what points one by one cannot on
/// uneven triangles: the three sides of a sliver differ by little, and so do their equations. The step is then
/// over-relaxed, since blocks that do not overlap know too little of each other: four sweeps over fans of faces,
/// each face in one, take as many iterations as two over all stars of vertices, each face in three. Groups of
/// blocks that D touches are not over-relaxed: over-relaxation would miss the exact solution of a strong penalty
/// by 0.4 of the step, sweep by sweep.
///
/// A is never formed. B x is kept up to date beside x; B has a third to a half of the entries of A. Blocks
/// that look alike and are independent are solved for at once (SchwarzBlocks). Threads share the tiles of a
/// colour (BlockTiles).
///
/// Steps are taken in single precision, and added up in double. The rounding errors are noise in B x. Vectors
/// of little energy, which the coarse levels are for, do not see it. Results have the same bits for any number
/// of threads.
class BlockSmoother
{
public:
  /// Iterations of fields are the same within one from 1.3 to 1.5. Over fans, 1 takes two more.
  static constexpr double UsualRelaxation = 1.4;

  /// A = B^T B, until SetDiagonal. Matrices, tiles and blocks are borrowed and must stay where they are.
  /// \param B the factor. \param tiles of its rows.
  /// \param blocks of B, covering all unknowns that are to be smoothed.
  /// \param sweeps before and after the coarse correction, >= 1.
  /// \param relaxation what steps are multiplied by where D is zero, in (0, 2); by 1 in block Gauss-Seidel.
  BlockSmoother(const SparseMatrix<double>& B, const RowTiles& tiles, const SchwarzBlocks& blocks, int sweeps,
    double relaxation = UsualRelaxation);
  BlockSmoother(const BlockSmoother&) = delete; // inverses are referred to
  BlockSmoother& operator=(const BlockSmoother&) = delete;

  /// A = B^T B + D.
  /// \param D one entry per unknown, >= 0. Infinite: the unknown is zero.
  /// Cost: one pass over the unknowns, and the inverses of the blocks where D is not zero.
  void SetDiagonal(const Vector<double>& D, const ExecutionContext& context);

  /// The unknowns where D is infinite; ascending.
  const std::vector<int>& HeldUnknowns() const { return this->Held; }

  /// Smooths A x = b from x = 0, colours of tiles in ascending order.
  /// \param x, r on exit the result and its residual b - A x; zero where unknowns are held.
  void PreSmooth(const Vector<double>& b, Vector<double>& x, Vector<double>& r, const ExecutionContext& context);

  /// Smooths A x = b from the given x, colours in descending order: the adjoint of PreSmooth.
  /// \pre x is zero where unknowns are held.
  void PostSmooth(const Vector<double>& b, Vector<double>& x, const ExecutionContext& context);

  /// Held by this object.
  long long Bytes() const;

private:
  /// Sets the right sides of the sweeps, b - D x, and their steps to zero.
  /// \param x what the sweeps start from; null for zero.
  void Begin(const Vector<double>& b, const ExecutionContext& context, const Vector<double>* x = nullptr);
  /// Calls visit(i, D_i) for unknowns [first, last) where D is neither zero nor infinite.
  template <class Visit>
  void ForPenalised(int first, int last, const Visit& visit) const;
  void RunSweeps(bool descending, const ExecutionContext& context);
  /// Takes the groups of a tile one after the other.
  void SmoothTile(const SchwarzBlocks::Tile& tile, bool descending);
  bool Touches(const Vector<double>& D, const SchwarzBlocks::Group& group) const;
  /// The beginnings of a group in the arrays that are read from first to last.
  struct Streams
  {
    const int* Places;
    const float* Values;
    const float* Inverse;
  };
  Streams StreamsOf(int group) const;
  /// \tparam Penalised D is not zero on some of its unknowns.
  /// \param ahead of a group that is soon to be smoothed, and is asked for meanwhile: between reads from all
  ///   over the vectors a processor does not foresee how streams go on. It may be smaller; what lies
  ///   behind it is not read.
  template <bool Penalised>
  void SmoothGroup(const SchwarzBlocks::Group& group, const Streams& of, const Streams& ahead);
  /// Solves for the unknowns of each block of a group.
  /// \tparam Pack of so many lanes as the group has.
  /// \param pattern of its blocks. \param places of its unknowns and rows in vectors.
  template <bool Penalised, class Pack, class Places>
  void SmoothBlocks(const BlockPattern& pattern, const Places& places, const Streams& of, const Streams& ahead);

  const RowRuns<double> B;
  const RowTiles& Tiles;
  const SchwarzBlocks& Blocks;
  const int Sweeps;
  const float Relaxation;
  Vector<float> Diagonal;             ///< D where it is finite, else zero; by place
  std::vector<int> Held;              ///< where D is infinite; ascending
  std::vector<int> Penalised;         ///< where it is neither that nor zero; ascending
  std::vector<const float*> Inverses; ///< of each group: of the smoothness energy alone where D is zero
  std::vector<float> ChangedInverses; ///< where D is not zero
  Vector<float> Right;                ///< b - D x before the sweeps; by place
  Vector<float> Step;                 ///< what the sweeps have added to x; by place
  Vector<float> Bx;                   ///< by place
};

}

#endif
