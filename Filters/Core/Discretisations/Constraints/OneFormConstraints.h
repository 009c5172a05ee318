#ifndef dmgOneFormConstraints_h
#define dmgOneFormConstraints_h

#include "Discretisations/Constraints/FieldConstraints.h"
#include "Mesh/TangentFrames.h"
#include "Mesh/TriangleMesh.h"

#include <vector>

namespace dmg
{

/// Directions prescribed on faces, as 1-form: every side of a prescribed face is prescribed, with
/// the direction's product with the side. Where directions meet on an edge their values are
/// averaged by weight. An edge has the mean weight of its faces, those without a direction counting
/// as 0: inside a prescribed region that is the region's, on its boundary half of it. Lengths count: a
/// direction of length 2 asks for a field of length 2. \throw InvalidInput a direction is not
/// finite, has no part in the plane of its face (less than 1e-6 of its length), or its weight is
/// not positive; \p names says how messages call face i.
FieldConstraints OneFormConstraintsOnFaces(const TriangleMesh& mesh, const TangentFrames& faceFrames,
  const std::vector<Constraint>& directions, const ElementNames& names = {});

/// Directions prescribed at vertices, as 1-form: every edge at a prescribed vertex is prescribed.
/// Between two of them the value is the trapezoidal rule (by weight); an edge that leads away from
/// the prescribed ones takes the direction of its one end, with half the weight, so that a single
/// vertex holds its direction, and a curve of vertices also the part across. What an edge takes
/// from an end is the direction's product with it, carried into the two faces beside the edge
/// (CarriedIntoFaces) and averaged, so that creases do not shorten it.
/// \throw InvalidInput as above, for the tangent planes of the vertices.
FieldConstraints OneFormConstraintsAtVertices(const TriangleMesh& mesh, const TangentFrames& faceFrames,
  const TangentFrames& vertexFrames, const std::vector<Constraint>& directions, const ElementNames& names = {});

/// Two sets of constraints as one: on an edge of both the weights add up, and the value is the mean
/// by weight.
FieldConstraints Joined(const FieldConstraints& a, const FieldConstraints& b);

}

#endif
