#include "Systems/PowerFieldSystem.h"

#include "Operators/PowerFieldOperators.h"
#include "Support/Errors.h"

#include <cassert>
#include <cmath>
#include <string>
#include <utility>

namespace dmg
{

namespace
{

constexpr int LargestN = 8;

void CheckWeight(const char* name, double weight)
{
  if (!(weight > 0.0) || !std::isfinite(weight))
  {
    throw InvalidInput(std::string("the ") + name + " weight is " + std::to_string(weight) +
      "; make it positive and finite");
  }
}

void CheckOptions(int N, const PrescribedFaces& prescribed, const PowerFieldWeights& weights)
{
  if (N < 1 || N > LargestN)
  {
    throw InvalidInput("fields of " + std::to_string(N) +
      " directions per point are not supported; choose N from 1 to " + std::to_string(LargestN));
  }
  CheckWeight("smoothness", weights.Smoothness);
  CheckWeight("alignment", weights.Alignment);
  if (prescribed.Faces.empty())
  {
    throw InvalidInput("no direction is prescribed, so the smoothest field is zero; "
                       "prescribe a direction on at least one cell");
  }
}

}

HarmonicSystem<Complex> MakePowerFieldSystem(const TriangleMesh& mesh,
  const TangentFrames& faceFrames, int N, const PrescribedFaces& prescribed,
  const PowerFieldWeights& weights, const ExecutionContext& context)
{
  CheckOptions(N, prescribed, weights);
  assert(prescribed.Faces.size() == prescribed.Weights.size());

  SparseMatrix<Complex> smoothness = PowerLaplacian(mesh, faceFrames, N, context);
  Vector<double> mass = mesh.FaceAreas();
  const double meanArea = mass.mean();
  // Where the whole surface has no area, every face counts alike.
  mass = meanArea > 0.0 ? Vector<double>(mass / meanArea) : Vector<double>::Ones(mass.size());

  const auto makeSystem = [&]() {
    if (weights.Constraints == ConstraintKind::Hard)
    {
      return HarmonicSystem<Complex>::Hard(std::move(smoothness), mass, prescribed.Faces);
    }
    smoothness *= weights.Smoothness;
    Vector<double> alignment(prescribed.Faces.size());
    for (Eigen::Index b = 0; b < alignment.size(); ++b)
    {
      alignment[b] = weights.Alignment * prescribed.Weights[b] * mass[prescribed.Faces[b]];
    }
    return HarmonicSystem<Complex>::Soft(
      std::move(smoothness), mass, prescribed.Faces, std::move(alignment));
  };
  HarmonicSystem<Complex> system = makeSystem();

  if (system.NumberOfFree() == 0)
  {
    throw InvalidInput(weights.Constraints == ConstraintKind::Hard
        ? "hard constraints leave no cell to solve for; prescribe fewer cells or make the "
          "constraints soft"
        : "all prescribed cells have zero area, so that they hold nothing; prescribe a direction "
          "on another cell or make the constraints hard");
  }
  return system;
}

}
