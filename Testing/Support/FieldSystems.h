#ifndef dmgTestFieldSystems_h
#define dmgTestFieldSystems_h

#include "Discretisations/Constraints/FieldConstraints.h"
#include "Discretisations/Constraints/OneFormConstraints.h"
#include "Operators/ExteriorCalculus.h"
#include "Support/ComplexPairs.h"
#include "Support/HarmonicSystem.h"

/// The systems of the discretisations as the thesis has them, assembled and reduced to free unknowns (HarmonicSystem):
/// what tests compare with, and what other solvers are given.
///
/// \throw InvalidInput a weight is out of range or nothing is prescribed.
/// \pre prescribed elements are ascending and in range.
namespace dmg
{

HarmonicSystem<Complex> MakePowerFieldSystem(const TriangleMesh& mesh, const TangentFrames& faceFrames, int N,
  const FieldConstraints& prescribed, const FieldWeights& weights, const ExecutionContext& context = SerialContext());

HarmonicSystem<double> MakeFaceFieldSystem(const TriangleMesh& mesh, const TangentFrames& faceFrames,
  const FieldConstraints& prescribed, const FieldWeights& weights, const ExecutionContext& context = SerialContext());

HarmonicSystem<double> MakeOneFormSystem(const TriangleMesh& mesh, const FieldConstraints& prescribed,
  const FieldWeights& weights, const ExecutionContext& context = SerialContext(),
  VertexAreas areas = VertexAreas::MixedVoronoi);

/// The penalties of faces, two per vector, and of edges.
Penalties PenaltiesOfFaces(const TriangleMesh& mesh, const FieldConstraints& prescribed, const FieldWeights& weights);
Penalties PenaltiesOfEdges(const TriangleMesh& mesh, const FieldConstraints& prescribed, const FieldWeights& weights);

/// The values of power fields in complex numbers.
inline Vector<Complex> ComplexValues(const FieldConstraints& constraints)
{
  return AsComplex(constraints.Values);
}

/// The masses.
Vector<double> MassOfPowerFields(const TriangleMesh& mesh);
Vector<double> MassOfFaceFields(const TriangleMesh& mesh);

}

#endif
