#ifndef dmgBlockStrips_h
#define dmgBlockStrips_h

#include "Solvers/PlanarProlongation.h"
#include "Solvers/UnknownBlocks.h"
#include "Support/ExecutionContext.h"
#include "Support/Types.h"

#include <vector>

namespace dmg
{

/// An order of blocks by strips across a surface, so that blocks that depend on each other are in the same
/// strip or in one of the next: sweeps can follow each other closely (TileWaves).
struct BlockStrips
{
  std::vector<int> Order;  ///< of blocks, strip by strip, ascending in each
  std::vector<int> Begins; ///< the place of the first block of each strip, and their number
};

/// Blocks by their distance from the first one, in steps between blocks that take from a coarse unknown in
/// common (as far as three unknowns of each tell); component by component. Whole levels make a strip, as few
/// as hold \p smallest blocks. Components of fewer blocks join the strip of the block before them.
/// \param P prolongation to the unknowns.
/// Cost: linear in the blocks.
BlockStrips StripsOf(const PlanarProlongation& P, const UnknownBlocks& blocks, int smallest,
  const ExecutionContext& context);

}

#endif
