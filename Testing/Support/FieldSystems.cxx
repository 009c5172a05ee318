#include "Support/FieldSystems.h"

#include "Discretisations/FaceField.h"
#include "Discretisations/OneForm.h"
#include "Discretisations/PowerField.h"
#include "Operators/FaceFieldOperators.h"
#include "Operators/PowerFieldOperators.h"
#include "Support/Errors.h"
#include "Support/ReferenceOperators.h"

#include <utility>

namespace dmg
{
namespace
{

template <class Scalar>
HarmonicSystem<Scalar> MakeSystem(
  SparseMatrix<Scalar> stiffness, const Vector<double>& mass, Penalties prescribed, const FieldWeights& weights)
{
  if (weights.Constraints == ConstraintKind::Soft)
  {
    stiffness *= weights.Smoothness;
  }
  HarmonicSystem<Scalar> system = HarmonicSystem<Scalar>::Make(std::move(stiffness), mass, std::move(prescribed));
  if (system.NumberOfFree() == 0)
  {
    throw InvalidInput("nothing is left to solve for");
  }
  return system;
}

/// One per complex unknown instead of one per part.
Penalties OfComplex(const Penalties& pairs)
{
  Penalties powers{ pairs.Kind, {}, Vector<double>(pairs.Alignment.size() / 2) };
  for (std::size_t b = 0; b < pairs.Unknowns.size(); b += 2)
  {
    powers.Unknowns.push_back(pairs.Unknowns[b] / 2);
  }
  for (Eigen::Index b = 0; b < powers.Alignment.size(); ++b)
  {
    powers.Alignment[b] = pairs.Alignment[2 * b];
  }
  return powers;
}

}

HarmonicSystem<Complex> MakePowerFieldSystem(const TriangleMesh& mesh, const TangentFrames& faceFrames, int N,
  const FieldConstraints& prescribed, const FieldWeights& weights, const ExecutionContext& context)
{
  const FramedMesh surface(mesh);
  const PowerField field(surface, N);
  return MakeSystem<Complex>(PowerLaplacian(mesh, faceFrames, N, context), field.Mass(context),
    OfComplex(field.PenaltiesOf(prescribed, weights, context)), weights);
}

HarmonicSystem<double> MakeFaceFieldSystem(const TriangleMesh& mesh, const TangentFrames& faceFrames,
  const FieldConstraints& prescribed, const FieldWeights& weights, const ExecutionContext& context)
{
  return MakeSystem<double>(test::FaceFieldSmoothness(mesh, faceFrames, context), MassOfFaceFields(mesh),
    PenaltiesOfFaces(mesh, prescribed, weights), weights);
}

HarmonicSystem<double> MakeOneFormSystem(const TriangleMesh& mesh, const FieldConstraints& prescribed,
  const FieldWeights& weights, const ExecutionContext& context, VertexAreas areas)
{
  return MakeSystem<double>(test::OneFormLaplacian(mesh, context, areas), PositiveStar1(mesh, context),
    PenaltiesOfEdges(mesh, prescribed, weights), weights);
}

Penalties PenaltiesOfFaces(const TriangleMesh& mesh, const FieldConstraints& prescribed, const FieldWeights& weights)
{
  const FramedMesh surface(mesh);
  return FaceField(surface).PenaltiesOf(prescribed, weights, SerialContext());
}

Penalties PenaltiesOfEdges(const TriangleMesh& mesh, const FieldConstraints& prescribed, const FieldWeights& weights)
{
  const FramedMesh surface(mesh);
  return OneForm(surface, VertexAreas::MixedVoronoi).PenaltiesOf(prescribed, weights, SerialContext());
}

Vector<double> MassOfPowerFields(const TriangleMesh& mesh)
{
  const FramedMesh surface(mesh);
  return PowerField(surface, 1).Mass(SerialContext());
}

Vector<double> MassOfFaceFields(const TriangleMesh& mesh)
{
  const FramedMesh surface(mesh);
  return FaceField(surface).Mass(SerialContext());
}

}
