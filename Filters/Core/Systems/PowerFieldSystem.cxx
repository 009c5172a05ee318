#include "Systems/PowerFieldSystem.h"

#include "Operators/PowerFieldOperators.h"
#include "Support/Errors.h"

#include <cassert>
#include <string>
#include <utility>

namespace dmg
{

namespace
{

constexpr int LargestN = 8;

}

void CheckNumberOfDirections(int N)
{
  if (N < 1 || N > LargestN)
  {
    throw InvalidInput("fields of " + std::to_string(N) +
      " directions per point are not supported; choose N from 1 to " + std::to_string(LargestN));
  }
}

Vector<double> MassOfPowerFields(const TriangleMesh& mesh, const ExecutionContext& context)
{
  const Vector<double> areas = mesh.FaceAreas(context);
  const double meanArea = areas.mean();
  return meanArea > 0.0 ? Vector<double>(areas / meanArea) : Vector<double>::Ones(areas.size());
}

PrescribedUnknowns PrescribedPowersOf(const TriangleMesh& mesh, const PrescribedFaces& prescribed,
  const FieldWeights& weights, const ExecutionContext& context)
{
  CheckWeights(weights);
  if (prescribed.Faces.empty())
  {
    throw InvalidInput("no direction is prescribed, so the smoothest field is zero; "
                       "prescribe a direction on at least one cell");
  }
  assert(prescribed.Faces.size() == prescribed.Weights.size());
  PrescribedUnknowns unknowns{ weights.Constraints, prescribed.Faces, {} };
  if (weights.Constraints == ConstraintKind::Soft)
  {
    const Vector<double> mass = MassOfPowerFields(mesh, context);
    unknowns.Alignment.resize(prescribed.Faces.size());
    for (Eigen::Index b = 0; b < unknowns.Alignment.size(); ++b)
    {
      unknowns.Alignment[b] = weights.Alignment * prescribed.Weights[b] * mass[prescribed.Faces[b]];
    }
  }
  return unknowns;
}

HarmonicSystem<Complex> MakePowerFieldSystem(const TriangleMesh& mesh,
  const TangentFrames& faceFrames, int N, const PrescribedFaces& prescribed,
  const FieldWeights& weights, const ExecutionContext& context)
{
  CheckNumberOfDirections(N);
  PrescribedUnknowns unknowns = PrescribedPowersOf(mesh, prescribed, weights, context);
  SparseMatrix<Complex> smoothness = PowerLaplacian(mesh, faceFrames, N, context);
  if (weights.Constraints == ConstraintKind::Soft)
  {
    smoothness *= weights.Smoothness;
  }
  HarmonicSystem<Complex> system = HarmonicSystem<Complex>::Make(
    std::move(smoothness), MassOfPowerFields(mesh, context), std::move(unknowns));
  CheckAnyIsFree(system.NumberOfFree(), weights.Constraints, "cell");
  return system;
}

}
