#ifndef dmgBlockSmoother_h
#define dmgBlockSmoother_h

#include "Support/ExecutionContext.h"
#include "Support/Types.h"

#include <vector>

namespace dmg
{

/// Small sets of unknowns that are solved for together. They may overlap.
struct UnknownBlocks
{
  std::vector<int> Offsets = { 0 }; ///< block k holds Unknowns[Offsets[k]] to [Offsets[k + 1] - 1]
  std::vector<int> Unknowns;

  int Size() const { return static_cast<int>(this->Offsets.size()) - 1; }
  void EndBlock() { this->Offsets.push_back(static_cast<int>(this->Unknowns.size())); }
};

/// Block Gauss-Seidel (multiplicative Schwarz) for a sum of squares, A = B^T B.
///
/// Each step solves for the unknowns of one block exactly. That damps what points one by one cannot on
/// uneven triangles: the three sides of a sliver differ by little, and so do their equations.
///
/// A is never formed. B x is kept up to date beside x; B has a third to a half of the entries of A,
/// so that a sweep over overlapping blocks costs no more than a sweep over the rows of A.
///
/// Blocks that share a row of B have different colours; blocks of a colour are independent. Same bits
/// for any number of threads.
template <class Value>
class BlockSmoother
{
public:
  /// \param B with columns of length 1.
  /// \param blocks cover all unknowns that are to be smoothed; copied.
  /// \param sweeps before and after the coarse correction, >= 1.
  /// \throw InvalidInput a block of more than 16 unknowns.
  BlockSmoother(const SparseMatrix<double>& B, const UnknownBlocks& blocks, int sweeps,
    const ExecutionContext& context);

  /// Smooths A x = b from x = 0, blocks in ascending order.
  /// \param x, r on exit the result and its residual b - A x.
  void PreSmooth(const Vector<Value>& b, Vector<Value>& x, Vector<Value>& r,
    const ExecutionContext& context);

  /// Smooths A x = b from the given x, blocks in descending order: the adjoint of PreSmooth.
  void PostSmooth(const Vector<Value>& b, Vector<Value>& x, const ExecutionContext& context);

  /// Held by this object.
  long long Bytes() const;

private:
  void ColourBlocks(const SparseMatrix<double>& Bt, const UnknownBlocks& blocks);
  void Arrange(const SparseMatrix<double>& Bt, const UnknownBlocks& blocks,
    const std::vector<int>& order, const ExecutionContext& context);
  void SmoothColour(std::size_t colour, bool descending, const Vector<Value>& b, Vector<Value>& x,
    const ExecutionContext& context);
  void SmoothBlocks(int first, int last, const Vector<Value>& b, Vector<Value>& x);

  const int Sweeps;
  SparseMatrix<Value> B;
  SparseMatrix<Value> Bt;
  Vector<Value> Bx;

  // The blocks colour by colour. Slots are the unknowns of the blocks, one after the other.
  std::vector<int> ColourBegins;
  bool LastColourIsMixed = false; ///< blocks that found no colour; one after the other
  std::vector<int> BlockSlots;    ///< first slot of each block
  std::vector<int> SlotUnknowns;
  std::vector<int> SlotEntries;   ///< first entry of each slot
  std::vector<int> EntryRows;     ///< the column of B of the slot's unknown
  std::vector<Value> EntryValues;
  std::vector<int> BlockInverses; ///< first entry of the inverse of each block
  std::vector<Value> Inverses;
};

extern template class BlockSmoother<float>;
extern template class BlockSmoother<double>;

}

#endif
