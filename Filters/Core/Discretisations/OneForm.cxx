#include "Discretisations/OneForm.h"

#include "Analysis/HarmonicBasis.h"
#include "Analysis/HarmonicForms.h"
#include "Discretisations/Constraints/OneFormConstraints.h"
#include "Discretisations/Levels/LeastSquaresLevels.h"

#include <utility>

namespace dmg
{
namespace
{

// The number of unknowns up to which a factor is ready before multigrid, from the bare mesh: factors
// have few entries.
constexpr int LargestForCholesky = 400000;
// SolverTuning says what these are; they were measured on surfaces of some 100,000 vertices.
constexpr double SolvesForFactor = 0.06;
constexpr double BytesOfFactor = 80.0;

Vector<Complex> InFrames(const TangentFrames& frames, const Points& vectors)
{
  Vector<Complex> result(vectors.rows());
  for (int i = 0; i < static_cast<int>(result.size()); ++i)
  {
    result[i] = frames.ToComplex(i, vectors.row(i).transpose());
  }
  return result;
}

}

Vector<double> OneForm::Mass(const ExecutionContext& context) const
{
  return PositiveStar1(this->Surface.Mesh, context);
}

SparseMatrix<double> OneForm::Factor(const ExecutionContext& context) const
{
  return OneFormLaplacianFactor(this->Surface.Mesh, context, this->Areas);
}

LeastSquaresLevels OneForm::LinearLevels(
  const std::vector<TransportOperator>& linear, const ExecutionContext& context) const
{
  return LinearLevelsOfOneForms(this->Surface.Mesh, this->Surface.Faces, linear, context);
}

std::vector<SparseMatrix<double>> OneForm::LinearProlongationsOfUnknowns(
  const std::vector<TransportOperator>& linear, const ExecutionContext& context) const
{
  std::vector<SparseMatrix<double>> prolongations = OnComponents(linear, context);
  prolongations[0] =
    SparseMatrix<double>(FormFromFaceField(this->Surface.Mesh, this->Surface.Faces, context) * prolongations[0]);
  return prolongations;
}

SolverTuning OneForm::Tuning() const
{
  SolverTuning tuning = LeastSquaresField::Tuning();
  tuning.LargestForCholesky = LargestForCholesky;
  tuning.SolvesForFactor = SolvesForFactor;
  tuning.BytesOfFactor = BytesOfFactor;
  return tuning;
}

Eigen::MatrixXd OneForm::HarmonicFields(const ProlongationOperators* operators, const ExecutionContext& context) const
{
  return HarmonicForms(this->Surface.Mesh, context, operators);
}

Eigen::MatrixXd OneForm::HarmonicBasis(Eigen::MatrixXd basis, const ExecutionContext& context) const
{
  return HarmonicBasisOfForms(this->Surface.Mesh, this->Surface.Faces, std::move(basis), context);
}

FieldConstraints OneForm::Prescribe(const Constraints& constraints, const ElementNames& names) const
{
  const auto& [mesh, faceFrames, vertexFrames] = this->Surface;
  const FieldConstraints onFaces = OneFormConstraintsOnFaces(mesh, faceFrames, constraints.OnFaces, names);
  const FieldConstraints atVertices =
    OneFormConstraintsAtVertices(mesh, faceFrames, vertexFrames, constraints.AtVertices, names);
  return Joined(onFaces, atVertices);
}

Discretisation::IntegralWeights OneForm::WeightsOfIntegral() const
{
  // Penalties are the integral over twice the mean area.
  const double meanArea = this->Surface.Mesh.FaceAreas().mean();
  return { 2.0 * meanArea, 2.0 * meanArea };
}

Vector<double> OneForm::PenaltiesOfElements(const std::vector<int>& edges, const ExecutionContext&) const
{
  const double scale = 1.0 / (2.0 * Star2(this->Surface.Mesh).cwiseInverse().mean());
  Vector<double> penalties(edges.size());
  for (std::size_t b = 0; b < edges.size(); ++b)
  {
    penalties[b] = scale * PositiveStar1OfEdge(this->Surface.Mesh, edges[b]);
  }
  return penalties;
}

FieldPowers OneForm::Powers(
  const Vector<double>& unknowns, const Unfilled<Corner>& corners, const ExecutionContext& context) const
{
  const auto& [mesh, faceFrames, vertexFrames] = this->Surface;
  return { InFrames(faceFrames, WhitneyAtFaces(mesh, unknowns, context)),
    InFrames(vertexFrames, WhitneyAtVertices(mesh, faceFrames, vertexFrames, corners, unknowns, context)) };
}

std::vector<ElementValues> OneForm::Values(const Vector<double>& unknowns, const FieldPowers&) const
{
  return { { "OneForm", ElementKind::Edges, 1, unknowns } };
}

Points OneForm::VectorsOnFaces(const Vector<double>& unknowns, const ExecutionContext& context) const
{
  return WhitneyAtFaces(this->Surface.Mesh, unknowns, context);
}

}
