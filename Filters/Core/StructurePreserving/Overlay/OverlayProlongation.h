#ifndef dmgOverlayProlongation_h
#define dmgOverlayProlongation_h

#include "Levels/TransportOperator.h"
#include "Mesh/TangentFrames.h"
#include "StructurePreserving/Decimation/MeshHierarchy.h"
#include "Support/Types.h"

namespace dmg
{

/// The prolongations between two levels as the thesis makes them: the exact operators of each
/// collapse (LocalProlongation.h), multiplied over all collapses. The reference for the fast
/// operators, which come from tracked paths.
///
/// Both constructions keep the same structure to rounding: S0 has rows of weights, d0 S0 = S1 d0,
/// closed forms stay closed, G S0 = SX G. For a single collapse they give the same S0 and S1. Over
/// several collapses this one is interpolated anew after each of them, and every interpolation adds
/// neighbours, where tracked points and paths are linear on the coarse mesh however many collapses
/// they passed: S1 has some 30 entries per row here and 5 there.
struct OverlayProlongation
{
  /// #V_l x #V_{l+1}: 0-forms. Rows are non-negative and sum to 1. Thesis, sections 3.5 and 5.3.
  SparseMatrix<double> S0;

  /// #E_l x #E_{l+1}: 1-forms. Thesis, section 4.2.
  SparseMatrix<double> S1;

  /// 2 #F_l x 2 #F_{l+1}: face fields, components 2 f and 2 f + 1 in the frame of face f;
  /// P_fine^+ (Q S_h) ... (Q S_h) P_coarse. Thesis, section 4.3.
  SparseMatrix<double> SX;

  /// #F_l x #F_{l+1}: power fields of all N. The weight of an entry is the product of the weights
  /// of the collapses, its turn that of the product for N = 1: the mean rotation along all ways from
  /// one face to the other. Thesis, section 4.4.
  TransportOperator SP;

  /// \pre the transition recorded its collapses: ProlongationConstruction::ExactOverlay.
  /// \param fineFrames, coarseFrames of the faces; SX and SP are between them.
  /// \throw InvalidInput the transition has no record. \throw Cancelled
  /// Cost: O(#F_l) for bounded valence, in exact arithmetic; checkpoints every 64 collapses and
  /// between the operators.
  /// Same bits for any number of threads.
  OverlayProlongation(const LevelTransition& transition, const TangentFrames& fineFrames,
    const TangentFrames& coarseFrames, const ExecutionContext& context);
};

}

#endif
