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

void CheckOptions(int N, const PrescribedFaces& prescribed, const FieldWeights& weights)
{
  if (N < 1 || N > LargestN)
  {
    throw InvalidInput("fields of " + std::to_string(N) +
      " directions per point are not supported; choose N from 1 to " + std::to_string(LargestN));
  }
  CheckWeights(weights);
  if (prescribed.Faces.empty())
  {
    throw InvalidInput("no direction is prescribed, so the smoothest field is zero; "
                       "prescribe a direction on at least one cell");
  }
}

}

HarmonicSystem<Complex> MakePowerFieldSystem(const TriangleMesh& mesh,
  const TangentFrames& faceFrames, int N, const PrescribedFaces& prescribed,
  const FieldWeights& weights, const ExecutionContext& context)
{
  CheckOptions(N, prescribed, weights);
  assert(prescribed.Faces.size() == prescribed.Weights.size());

  SparseMatrix<Complex> smoothness = PowerLaplacian(mesh, faceFrames, N, context);
  Vector<double> mass = mesh.FaceAreas();
  const double meanArea = mass.mean();
  // Where the whole surface has no area, every face counts alike.
  mass = meanArea > 0.0 ? Vector<double>(mass / meanArea) : Vector<double>::Ones(mass.size());

  PrescribedUnknowns unknowns{ weights.Constraints, prescribed.Faces, {} };
  if (weights.Constraints == ConstraintKind::Soft)
  {
    smoothness *= weights.Smoothness;
    unknowns.Alignment.resize(prescribed.Faces.size());
    for (Eigen::Index b = 0; b < unknowns.Alignment.size(); ++b)
    {
      unknowns.Alignment[b] = weights.Alignment * prescribed.Weights[b] * mass[prescribed.Faces[b]];
    }
  }
  HarmonicSystem<Complex> system =
    HarmonicSystem<Complex>::Make(std::move(smoothness), mass, std::move(unknowns));
  CheckAnyIsFree(system.NumberOfFree(), weights.Constraints, "cell");
  return system;
}

}
