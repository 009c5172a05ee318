#include "Systems/FaceFieldSystem.h"

#include "Operators/FaceFieldOperators.h"
#include "Support/Errors.h"
#include "Support/SparseAssembly.h"
#include "Support/SparseKernels.h"

#include <cassert>
#include <cmath>
#include <string>
#include <utility>

namespace dmg
{

HarmonicSystem<double> MakeFaceFieldSystem(const TriangleMesh& mesh,
  const TangentFrames& faceFrames, const PrescribedFaces& prescribed,
  const FieldWeights& weights, const ExecutionContext& context)
{
  CheckWeights(weights);
  if (prescribed.Faces.empty())
  {
    throw InvalidInput("no vector is prescribed, so the most harmonic field is zero; "
                       "prescribe a vector on at least one cell");
  }
  assert(prescribed.Faces.size() == prescribed.Weights.size());

  SparseMatrix<double> factor = FaceFieldSmoothnessFactor(mesh, faceFrames, context);
  SparseMatrix<double> smoothness = NormalMatrix(factor, context);
  Vector<double> mass = MassesOfFaceFields(mesh).Faces;
  const double meanArea = mass.mean();
  // Where the whole surface has no area, every face counts alike.
  mass = meanArea > 0.0 ? Vector<double>(mass / meanArea) : Vector<double>::Ones(mass.size());
  std::vector<int> unknowns = PairsOf(prescribed.Faces);

  const auto makeSystem = [&]() {
    if (weights.Constraints == ConstraintKind::Hard)
    {
      return HarmonicSystem<double>::Hard(
        std::move(smoothness), mass, std::move(unknowns), std::move(factor));
    }
    smoothness *= weights.Smoothness;
    factor *= std::sqrt(weights.Smoothness);
    Vector<double> alignment(unknowns.size());
    for (Eigen::Index b = 0; b < alignment.size(); ++b)
    {
      alignment[b] = weights.Alignment * prescribed.Weights[b / 2] * mass[unknowns[b]];
    }
    return HarmonicSystem<double>::Soft(std::move(smoothness), mass, std::move(unknowns),
      std::move(alignment), std::move(factor));
  };
  HarmonicSystem<double> system = makeSystem();

  if (system.NumberOfFree() == 0)
  {
    throw InvalidInput(weights.Constraints == ConstraintKind::Hard
        ? "hard constraints leave no cell to solve for; prescribe fewer cells or make the "
          "constraints soft"
        : "all prescribed cells have zero area, so that they hold nothing; prescribe a vector on "
          "another cell or make the constraints hard");
  }
  return system;
}

}
