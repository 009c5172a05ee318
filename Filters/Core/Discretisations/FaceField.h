#ifndef dmgFaceField_h
#define dmgFaceField_h

#include "Discretisations/Discretisation.h"

namespace dmg
{

/// A vector per face: its two components in the face's frame. Thesis, section 6.2, as corrected: the masses of
/// divergence and curl enter inverted.
///
/// The smoothness energy is X^T A X, A = B^T B with B = FaceFieldSmoothnessFactor: squared divergence and curl. It does not
/// depend on the unit of length, as little as the penalty of a face, A_f / mean A with the areas A_f of MassesOfFaceFields; so weights mean
/// the same for every mesh and about the same as for power fields. The mass are the same areas, each twice.
/// Fields run along the boundary, where nothing else is prescribed. The kernel are the harmonic fields, of dimension
/// 2 g on a closed surface of genus g, 2 g + b - 1 with b > 0 boundary loops.
///
/// Solved by LeastSquaresHierarchy, A = B^T B with FaceFieldSmoothnessFactor, smoothed on fans of faces.
class FaceField : public Discretisation
{
public:
  using Discretisation::Discretisation;

  std::string Name() const override { return "face fields"; }
  ElementKind Elements() const override { return ElementKind::Faces; }
  int UnknownsPerElement() const override { return 2; }

  Vector<double> Mass(const ExecutionContext& context) const override;
  std::unique_ptr<const StiffnessHierarchy> Coarsen(
    const LinearProlongations& linear, const ExecutionContext& context) const override;
  std::unique_ptr<const StiffnessHierarchy> Assemble(
    const ProlongationOperators* operators, CoarseSpaceKind space, const ExecutionContext& context) const override;
  OperatorSelection StructurePreservingOperators() const override { return { false, true, false }; }
  std::string NameOfLevels() const override { return "levels of face fields"; }
  double SampleDistance() const override;
  SolverTuning Tuning() const override;

  bool HasHarmonicFields() const override { return true; }
  int NumberOfHarmonicFields() const override;
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
  Vector<double> PenaltiesOfElements(const std::vector<int>& faces, const ExecutionContext& context) const override;
};

}

#endif
