#ifndef dmgNodalProlongation_h
#define dmgNodalProlongation_h

#include "Mesh/TangentFrames.h"
#include "Mesh/TriangleMesh.h"
#include "Prolongation/TransportOperator.h"
#include "Support/ExecutionContext.h"

namespace dmg
{

/// Prolongation of directions from the vertices of a coarse level to the vertices of the next finer
/// one: S0 for the weights, the rotation between the tangent planes for the angles.
/// \return #V_l x #V_{l+1}
TransportOperator VerticesFromVertices(const SparseMatrix<double>& S0,
  const TangentFrames& fineVertexFrames, const TangentFrames& coarseVertexFrames,
  const ExecutionContext& context);

/// Prolongation of directions from the vertices of level 1 to the faces of level 0: the mean of the
/// linear interpolants at the corners of a face. Linear where S0 is, which makes power fields
/// converge in a number of cycles that does not grow with the mesh; face-to-face injection does
/// not.
/// \return #F_0 x #V_1
TransportOperator FacesFromVertices(const TriangleMesh& fine, const SparseMatrix<double>& S0,
  const TangentFrames& fineFaceFrames, const TangentFrames& coarseVertexFrames,
  const ExecutionContext& context);

}

#endif
