#ifndef dmgPowerFieldSystem_h
#define dmgPowerFieldSystem_h

#include "Mesh/TangentFrames.h"
#include "Mesh/TriangleMesh.h"
#include "Systems/AlignmentConstraints.h"
#include "Systems/HarmonicSystem.h"

namespace dmg
{

/// \throw InvalidInput N is not between 1 and 8.
void CheckNumberOfDirections(int N);

/// Which powers of the system below are prescribed, and how strongly.
/// \throw InvalidInput a weight is out of range or nothing is prescribed.
PrescribedUnknowns PrescribedPowersOf(const TriangleMesh& mesh, const PrescribedFaces& prescribed,
  const FieldWeights& weights, const ExecutionContext& context = SerialContext());

/// The areas of the faces over their mean; ones where the whole surface has no area.
Vector<double> MassOfPowerFields(
  const TriangleMesh& mesh, const ExecutionContext& context = SerialContext());

/// The system of the smoothest N-direction field that follows prescribed directions; unknowns are
/// the powers of the faces, in their frames:
///   argmin  lambda_S X^H L X + lambda_A sum_b w_b (A_b / mean A) |X_b - Y_b|^2   (soft)
///   argmin  X^H L X  subject to  X_b = Y_b                                       (hard)
/// with L = PowerLaplacian. The mass M are the areas over their mean. Thesis, section 6.3, as
/// corrected: the printed stack of two systems is not the minimiser of its energy.
/// \param N 1 to 8.
/// Components of the surface without a prescribed face get the zero field.
/// \throw InvalidInput N or a weight is out of range, nothing is prescribed, or hard constraints
/// leave nothing to solve for.
/// \pre prescribed faces are ascending and in range; see MakePowerConstraints.
/// Cost: O(#F).
HarmonicSystem<Complex> MakePowerFieldSystem(const TriangleMesh& mesh,
  const TangentFrames& faceFrames, int N, const PrescribedFaces& prescribed,
  const FieldWeights& weights, const ExecutionContext& context = SerialContext());

}

#endif
