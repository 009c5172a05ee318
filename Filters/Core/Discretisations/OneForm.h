#ifndef dmgOneForm_h
#define dmgOneForm_h

#include "Discretisations/Discretisation.h"

namespace dmg
{

/// A number h_e per edge, the integral of a 1-form along it. Thesis, section 6.1, as corrected: its alignment term
/// aims at half the values, and its mass, the cotangents, may be negative.
///
/// The smoothness energy is h^T L1 h, L1 = OneFormLaplacian: squared divergence and curl. A prescribed edge has the penalty
/// PositiveStar1 / (2 mean A), A the areas of the faces: so a prescribed region pulls as hard, by its area, as the same region
/// on a power field with the same weights, as the power energy is twice the Dirichlet energy and h^T L1 h is not. The
/// mass is PositiveStar1.
///
/// The field flows along a boundary, not across it: that is what the natural conditions of L1 ask. The kernel are
/// the harmonic forms, of dimension 2 g on a closed surface of genus g, 2 g + b - 1 with b > 0 boundary loops. One
/// prescribed face fixes two of them, so genus 2 needs two faces at least.
///
/// Solved by LeastSquaresHierarchy, L1 = B^T B with OneFormLaplacianFactor, smoothed on the sides of faces.
class OneForm : public Discretisation
{
public:
  /// \param areas the star of 0-forms.
  OneForm(const FramedMesh& surface, VertexAreas areas)
    : Discretisation(surface)
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
  std::unique_ptr<const StiffnessHierarchy> Coarsen(
    const LinearProlongations& linear, const ExecutionContext& context) const override;
  std::unique_ptr<const StiffnessHierarchy> Assemble(
    const ProlongationOperators* operators, CoarseSpaceKind space, const ExecutionContext& context) const override;
  OperatorSelection StructurePreservingOperators() const override { return { false, false, true }; }
  std::string NameOfLevels() const override { return "levels of 1-forms"; }
  double SampleDistance() const override;
  SolverTuning Tuning() const override;

  bool HasHarmonicFields() const override { return true; }
  int NumberOfHarmonicFields() const override;
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
  Vector<double> PenaltiesOfElements(const std::vector<int>& edges, const ExecutionContext& context) const override;

private:
  const VertexAreas Areas;
};

}

#endif
