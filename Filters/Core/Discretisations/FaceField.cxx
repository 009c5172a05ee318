#include "Discretisations/FaceField.h"

#include "Analysis/HarmonicBasis.h"
#include "Analysis/HarmonicForms.h"
#include "Directions/PowerFieldDirections.h"
#include "Discretisations/Levels/LeastSquaresLevels.h"
#include "Operators/FaceFieldOperators.h"
#include "Support/ComplexPairs.h"

#include <utility>

namespace dmg
{
namespace
{

// Face fields leave more to the interpolation than 1-forms do; but smaller entries do not help them.
constexpr int ProlongationDegree = 9;
constexpr double DroppedEntries = 0.001;

// The number of unknowns up to which a factor is ready before multigrid, from the bare mesh.
constexpr int LargestForCholesky = 30000;
// SolverTuning says what these are; they were measured on surfaces of some 100,000 vertices.
constexpr double SolvesForFactor = 0.5;
constexpr double BytesOfFactor = 170.0;

}

Vector<double> FaceField::Mass(const ExecutionContext&) const
{
  const Vector<double> mass = MassesOfFaceFields(this->Surface.Mesh).Faces;
  const double meanArea = mass.mean();
  // Every face counts alike where the whole surface has no area.
  return meanArea > 0.0 ? Vector<double>(mass / meanArea) : Vector<double>::Ones(mass.size());
}

SparseMatrix<double> FaceField::Factor(const ExecutionContext& context) const
{
  return FaceFieldSmoothnessFactor(this->Surface.Mesh, this->Surface.Faces, context);
}

LeastSquaresLevels FaceField::LinearLevels(
  const std::vector<TransportOperator>& linear, const ExecutionContext& context) const
{
  return LinearLevelsOfFaceFields(this->Surface.Mesh, linear, context);
}

LeastSquaresHierarchyOptions FaceField::Coarsening() const
{
  LeastSquaresHierarchyOptions options;
  options.ProlongationDegree = ProlongationDegree;
  options.Dropped = DroppedEntries;
  return options;
}

std::vector<SparseMatrix<double>> FaceField::LinearProlongationsOfUnknowns(
  const std::vector<TransportOperator>& linear, const ExecutionContext& context) const
{
  return OnComponents(linear, context);
}

SolverTuning FaceField::Tuning() const
{
  SolverTuning tuning = LeastSquaresField::Tuning();
  tuning.LargestForCholesky = LargestForCholesky;
  tuning.SolvesForFactor = SolvesForFactor;
  tuning.BytesOfFactor = BytesOfFactor;
  return tuning;
}

Eigen::MatrixXd FaceField::HarmonicFields(const ProlongationOperators* operators, const ExecutionContext& context) const
{
  return HarmonicFaceFields(this->Surface.Mesh, this->Surface.Faces, context, operators);
}

Eigen::MatrixXd FaceField::HarmonicBasis(Eigen::MatrixXd basis, const ExecutionContext& context) const
{
  return HarmonicBasisOfFaceFields(this->Surface.Mesh, std::move(basis), context);
}

FieldConstraints FaceField::Prescribe(const Constraints& constraints, const ElementNames& names) const
{
  constexpr int OneDirection = 1;
  return MakePowerConstraints(
    this->Surface.Mesh, this->Surface.Faces, OneDirection, DirectionsOnFaces(this->Surface, constraints, names), names);
}

Discretisation::IntegralWeights FaceField::WeightsOfIntegral() const
{
  // A face gets the weights of its three corners.
  const double meanArea = this->Surface.Mesh.FaceAreas().mean();
  return { meanArea, meanArea / 3.0 };
}

Vector<double> FaceField::PenaltiesOfElements(const std::vector<int>& faces, const ExecutionContext& context) const
{
  const Vector<double> mass = this->Mass(context);
  Vector<double> penalties(faces.size());
  for (std::size_t b = 0; b < faces.size(); ++b)
  {
    penalties[b] = mass[2 * faces[b]];
  }
  return penalties;
}

FieldPowers FaceField::Powers(
  const Vector<double>& unknowns, const Unfilled<Corner>& corners, const ExecutionContext& context) const
{
  Vector<Complex> faces = AsComplex(unknowns);
  Vector<Complex> vertices = PowersAtVertices(this->Surface.Mesh, corners, faces, 1, context);
  return { std::move(faces), std::move(vertices) };
}

std::vector<ElementValues> FaceField::Values(const Vector<double>& unknowns, const FieldPowers&) const
{
  Vector<double> vectors(3 * this->Surface.Mesh.NumberOfFaces());
  Eigen::Map<Points>(vectors.data(), vectors.size() / 3, 3) = VectorsFromFaceField(this->Surface.Faces, unknowns);
  std::vector<ElementValues> values;
  values.push_back({ "FaceField", ElementKind::Faces, 3, std::move(vectors) });
  return values;
}

Points FaceField::VectorsOnFaces(const Vector<double>& unknowns, const ExecutionContext&) const
{
  return VectorsFromFaceField(this->Surface.Faces, unknowns);
}

}
