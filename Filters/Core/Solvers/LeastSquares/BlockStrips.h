#ifndef dmgBlockStrips_h
#define dmgBlockStrips_h

#include "Solvers/LeastSquares/UnknownBlocks.h"
#include "Support/ExecutionContext.h"
#include "Support/Types.h"

#include <vector>

namespace dmg
{

/// Strips of blocks across a surface, so that blocks that depend on each other are in the same strip or in one of
/// the next: sweeps can follow each other closely (TimeSkewedSweeps).
struct BlockStrips
{
  std::vector<int> OfBlocks; ///< the strip of each block
  int Size = 0;
};

/// Blocks by their distance from the first one, in steps between blocks that share a row of B; component by
/// component. Whole levels make a strip, as few as hold \p smallest blocks. Components of fewer blocks join the
/// strip of the block before them.
/// \param Bt B^T, a row per unknown.
/// Cost: linear in the entries of B in all blocks.
BlockStrips StripsOf(const SparseMatrix<double>& Bt, const UnknownBlocks& blocks, int smallest,
  const ExecutionContext& context);

}

#endif
