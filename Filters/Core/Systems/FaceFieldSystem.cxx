#include "Systems/FaceFieldSystem.h"

#include "Operators/FaceFieldOperators.h"
#include "Support/Errors.h"
#include "Support/SparseAssembly.h"

#include <cassert>
#include <string>
#include <utility>

namespace dmg
{

Vector<double> MassOfFaceFields(const TriangleMesh& mesh)
{
  const Vector<double> mass = MassesOfFaceFields(mesh).Faces;
  const double meanArea = mass.mean();
  // Where the whole surface has no area, every face counts alike.
  return meanArea > 0.0 ? Vector<double>(mass / meanArea) : Vector<double>::Ones(mass.size());
}

PrescribedUnknowns PrescribedUnknownsOf(
  const TriangleMesh& mesh, const PrescribedFaces& prescribed, const FieldWeights& weights)
{
  CheckWeights(weights);
  if (prescribed.Faces.empty())
  {
    throw InvalidInput("no vector is prescribed, so the most harmonic field is zero; "
                       "prescribe a vector on at least one cell");
  }
  assert(prescribed.Faces.size() == prescribed.Weights.size());
  PrescribedUnknowns unknowns{ weights.Constraints, PairsOf(prescribed.Faces), {} };
  if (weights.Constraints == ConstraintKind::Soft)
  {
    const Vector<double> mass = MassOfFaceFields(mesh);
    unknowns.Alignment.resize(unknowns.Unknowns.size());
    for (Eigen::Index b = 0; b < unknowns.Alignment.size(); ++b)
    {
      unknowns.Alignment[b] =
        weights.Alignment * prescribed.Weights[b / 2] * mass[unknowns.Unknowns[b]];
    }
  }
  return unknowns;
}

HarmonicSystem<double> MakeFaceFieldSystem(const TriangleMesh& mesh,
  const TangentFrames& faceFrames, const PrescribedFaces& prescribed,
  const FieldWeights& weights, const ExecutionContext& context)
{
  PrescribedUnknowns unknowns = PrescribedUnknownsOf(mesh, prescribed, weights);
  SparseMatrix<double> smoothness = FaceFieldSmoothness(mesh, faceFrames, context);
  if (weights.Constraints == ConstraintKind::Soft)
  {
    smoothness *= weights.Smoothness;
  }
  HarmonicSystem<double> system = HarmonicSystem<double>::Make(
    std::move(smoothness), MassOfFaceFields(mesh), std::move(unknowns));
  CheckAnyIsFree(system.NumberOfFree(), weights.Constraints, "cell");
  return system;
}

}
