#ifndef dmgHarmonicFlows_h
#define dmgHarmonicFlows_h

#include "Flows/FlowPotentials.h"

namespace dmg
{

/// An orthonormal basis of the flows with neither divergence nor vorticity, 2 #F x k: components of vectors in the frames of the faces
/// (HodgeDecomposition.md). None flows through a coast or has a circulation along one, and none runs along an open part of the boundary.
/// \param potentials of the surface, with its boundary.
/// \throw InvalidInput they are too many to hold.
/// \throw Cancelled
/// Cost: a solve for each homology generator and for each open part of the boundary, and one for each coast if potentials has not made
/// its functions.
Eigen::MatrixXd HarmonicFlows(FlowPotentials& potentials, const ExecutionContext& context);

}

#endif
