#ifndef dmgFaceFieldSystem_h
#define dmgFaceFieldSystem_h

#include "Mesh/TangentFrames.h"
#include "Mesh/TriangleMesh.h"
#include "Systems/AlignmentConstraints.h"
#include "Systems/HarmonicSystem.h"

namespace dmg
{

/// The system of the most harmonic vector field that follows prescribed vectors; unknowns are the
/// two components per face, in the frames given:
///   argmin  lambda_S X^T A X + lambda_A sum_b w_b (A_b / mean A) |X_b - Y_b|^2   (soft)
///   argmin  X^T A X  subject to  X_b = Y_b                                       (hard)
/// with A = FaceFieldSmoothness, which does not depend on the unit of length, as little as the
/// second term: weights mean the same for every mesh and about the same as for power fields.
/// The mass M are the areas over their mean, each twice. Thesis, section 6.2, as corrected: the
/// masses of divergence and curl enter inverted.
///
/// Fields run along the boundary, where nothing else is prescribed. Components of the surface
/// without a prescribed face get the zero field.
/// \throw InvalidInput a weight is out of range, nothing is prescribed, or the constraints leave
/// nothing to solve for.
/// \pre prescribed faces are ascending and in range; see MakePowerConstraints.
/// Cost: O(#F).
HarmonicSystem<double> MakeFaceFieldSystem(const TriangleMesh& mesh,
  const TangentFrames& faceFrames, const PrescribedFaces& prescribed,
  const FieldWeights& weights, const ExecutionContext& context = SerialContext());

/// What is prescribed there, as the system takes it. Errors as above.
PrescribedUnknowns PrescribedUnknownsOf(
  const TriangleMesh& mesh, const PrescribedFaces& prescribed, const FieldWeights& weights);

/// The mass M.
Vector<double> MassOfFaceFields(const TriangleMesh& mesh);

}

#endif
