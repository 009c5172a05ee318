#ifndef dmgWeightsOfPoints_h
#define dmgWeightsOfPoints_h

#include "Constraints/Constraints.h"
#include "Mesh/SurfaceRelation.h"

#include <vector>

namespace dmg
{

/// Shares the weights of constraints at vertices that were read from points, so that a place weighs once, however many points a file has there:
/// of points that were joined, or that stand at one place (SurfaceRelation::PlaceOf), all that have a constraint share their weight; of a point
/// that was parted, its vertices do.
/// Cost: O(#V).
void WeighPlacesOnce(std::vector<Constraint>& atVertices, const TriangleMesh& mesh, const SurfaceRelation& relation);
void WeighPlacesOnce(std::vector<ValueConstraint>& values, const TriangleMesh& mesh, const SurfaceRelation& relation);

}

#endif
