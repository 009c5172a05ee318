#ifndef dmgFaceField_h
#define dmgFaceField_h

#include "Discretisations/LeastSquaresField.h"

namespace dmg
{

/// A vector per face: its two components in the face's frame. Thesis, section 6.2, as corrected: the masses of
/// divergence and curl enter inverted.
///
/// The smoothness energy is |B X|^2 with B = FaceFieldSmoothnessFactor. It does not depend on the unit of length, nor does the penalty
/// of a face, A_f / mean A with the areas A_f of MassesOfFaceFields; so weights mean the same for every mesh and about the same as for
/// power fields. The mass are the same areas, each twice. Fields run along the boundary, where nothing else is prescribed.
///
/// Smoothed on fans of faces.
class FaceField : public LeastSquaresField
{
public:
  using LeastSquaresField::LeastSquaresField;

  std::string Name() const override { return "face fields"; }
  ElementKind Elements() const override { return ElementKind::Faces; }
  int UnknownsPerElement() const override { return 2; }

  Vector<double> Mass(const ExecutionContext& context) const override;
  OperatorSelection StructurePreservingOperators() const override { return { false, true, false }; }
  std::string NameOfLevels() const override { return "levels of face fields"; }
  SolverTuning Tuning() const override;

  Eigen::MatrixXd HarmonicFields(
    const ProlongationOperators* operators, const ExecutionContext& context) const override;
  Eigen::MatrixXd HarmonicBasis(Eigen::MatrixXd basis, const ExecutionContext& context) const override;

  /// Directions at vertices count on the faces around.
  FieldConstraints Prescribe(const Constraints& constraints, const ElementNames& names) const override;

  FieldPowers Powers(
    const Vector<double>& unknowns, const Unfilled<Corner>& corners, const ExecutionContext& context) const override;
  std::vector<ElementValues> Values(const Vector<double>& unknowns, const FieldPowers& powers) const override;
  Points VectorsOnFaces(const Vector<double>& unknowns, const ExecutionContext& context) const override;
  IntegralWeights WeightsOfIntegral() const override;

protected:
  SparseMatrix<double> Factor(const ExecutionContext& context) const override;
  LeastSquaresLevels LinearLevels(
    const std::vector<TransportOperator>& linear, const ExecutionContext& context) const override;
  LeastSquaresHierarchyOptions Coarsening() const override;
  std::vector<SparseMatrix<double>> LinearProlongationsOfUnknowns(
    const std::vector<TransportOperator>& linear, const ExecutionContext& context) const override;
  const std::vector<SparseMatrix<double>>& PreservingProlongations(
    const ProlongationOperators& operators) const override
  {
    return operators.SX;
  }
  Remedy RemedyOfOperators() const override { return Remedy::FaceFieldOperators; }
  Vector<double> PenaltiesOfElements(const std::vector<int>& faces, const ExecutionContext& context) const override;
};

}

#endif
