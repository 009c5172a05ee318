#ifndef dmgFaceFieldProlongation_h
#define dmgFaceFieldProlongation_h

#include "Mesh/TangentFrames.h"
#include "StructurePreserving/Transfers/FineEdgePaths.h"

namespace dmg
{

/// Prolongation of face fields, SX.
///
/// A fine halfedge takes the integral of the coarse field along its pieces, each in the coarse face
/// on its own side; a fine face takes the vector whose integrals along its sides are nearest to
/// those three, P^+. For gradients the three sum to zero and depend on the ends of the pieces only:
/// G S0 = SX G, whatever way the pieces take. Constant fields in a plane are reproduced. Degenerate
/// fine faces stay finite; G is less than a gradient in degenerate coarse ones.
///
/// Every component of every coarse face reaches the fine level, where paths may lead through it at
/// all (FineEdgePaths), so that SX^T A SX has no zero on its diagonal (thesis, table 7.9).
/// \return 2 #F_l x 2 #F_{l+1}, in the frames given; about six entries per row.
/// Cost: O(#F_l). Thesis, section 4.3.
SparseMatrix<double> FaceFieldProlongation(const FineEdgePaths& paths, const TangentFrames& fineFrames,
  const TangentFrames& coarseFrames, const ExecutionContext& context);

}

#endif
