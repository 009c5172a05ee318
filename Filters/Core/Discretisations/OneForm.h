#ifndef dmgOneForm_h
#define dmgOneForm_h

#include "Discretisations/LeastSquaresField.h"

namespace dmg
{

/// A number h_e per edge, the integral of a 1-form along it. Thesis, section 6.1, as corrected: its alignment term
/// aims at half the values, and its mass, the cotangents, may be negative.
///
/// The smoothness energy is |B h|^2 with B = OneFormLaplacianFactor. A prescribed edge has the penalty
/// PositiveStar1 / (2 mean A), A the areas of the faces. A prescribed region then pulls as hard, by its area, as the same region on a
/// power field with the same weights, as the power energy is twice the Dirichlet energy and h^T L1 h is not. The mass is PositiveStar1.
///
/// The field flows along a boundary, not across it, by the natural conditions of L1. One prescribed face fixes two harmonic forms, so
/// genus 2 needs two faces at least.
///
/// Smoothed on the sides of faces.
class OneForm : public LeastSquaresField
{
public:
  /// \param areas the star of 0-forms.
  OneForm(const FramedMesh& surface, VertexAreas areas)
    : LeastSquaresField(surface)
    , Areas(areas)
  {
  }

  std::string Name() const override
  {
    return this->Areas == VertexAreas::MixedVoronoi ? "1-forms" : "1-forms with barycentric areas";
  }
  ElementKind Elements() const override { return ElementKind::Edges; }
  int UnknownsPerElement() const override { return 1; }

  Vector<double> Mass(const ExecutionContext& context) const override;
  double SquaredNormOfUnit(const Vector<double>&) const override { return this->Surface.Mesh.FaceAreas().sum(); }
  OperatorSelection StructurePreservingOperators() const override { return { false, false, true }; }
  std::string NameOfLevels() const override { return "levels of 1-forms"; }
  SolverTuning Tuning() const override;

  Eigen::MatrixXd HarmonicFields(
    const ProlongationOperators* operators, const ExecutionContext& context) const override;
  Eigen::MatrixXd HarmonicBasis(Eigen::MatrixXd basis, const ExecutionContext& context) const override;

  /// See OneFormConstraints.h.
  FieldConstraints Prescribe(const Constraints& constraints, const ElementNames& names) const override;

  /// The vectors of its Whitney interpolant.
  FieldPowers Powers(
    const Vector<double>& unknowns, const Unfilled<Corner>& corners, const ExecutionContext& context) const override;
  std::vector<ElementValues> Values(const Vector<double>& unknowns, const FieldPowers& powers) const override;
  Points VectorsOnFaces(const Vector<double>& unknowns, const ExecutionContext& context) const override;
  IntegralWeights WeightsOfIntegral() const override;

protected:
  SparseMatrix<double> Factor(const ExecutionContext& context) const override;
  LeastSquaresLevels LinearLevels(
    const std::vector<TransportOperator>& linear, const ExecutionContext& context) const override;
  std::vector<SparseMatrix<double>> LinearProlongationsOfUnknowns(
    const std::vector<TransportOperator>& linear, const ExecutionContext& context) const override;
  const std::vector<SparseMatrix<double>>& PreservingProlongations(
    const ProlongationOperators& operators) const override
  {
    return operators.S1;
  }
  Remedy RemedyOfOperators() const override { return Remedy::OneFormOperators; }
  Vector<double> PenaltiesOfElements(const std::vector<int>& edges, const ExecutionContext& context) const override;

private:
  const VertexAreas Areas;
};

}

#endif
