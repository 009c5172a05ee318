#ifndef dmgHarmonicFlows_h
#define dmgHarmonicFlows_h

#include "Flows/FlowPotentials.h"

namespace dmg
{

/// An orthonormal basis of the flows with neither divergence nor vorticity, 2 #F x k: components of vectors in the frames of the faces
/// (HodgeDecomposition.md). With a closed boundary none flows through it, and nothing from one loop to another; with an open one, none
/// runs along it.
/// \param potentials of the surface, whose solver is used.
/// \throw InvalidInput they are too many to hold.
/// \throw Cancelled
/// Cost: a solve for each homology generator, and one for each loop of the boundary if potentials has not made its functions.
Eigen::MatrixXd HarmonicFlows(FlowPotentials& potentials, FlowBoundary boundary, const ExecutionContext& context);

}

#endif
