#ifndef dmgPowerField_h
#define dmgPowerField_h

#include "Discretisations/Discretisation.h"

namespace dmg
{

/// \throw InvalidInput N is not between 1 and 8.
void CheckNumberOfDirections(int N);

/// Fields of N directions by their N-th powers X, a complex number per face in its frame. Thesis, section 6.3.
///
/// The smoothness energy is X^H L X, L the PowerLaplacian: how much the field turns. A prescribed face f has the penalty
/// m_f = A_f / mean A, so that at weights of 1 a face of mean area counts as much as
/// an edge of weight 1; PowerEdgeWeight is 3.46 on equilateral triangles. The mass are the areas over their mean; ones where the whole
/// surface has no area. A field has no smoothness energy only where it can be parallel everywhere: on flat surfaces, and where all angles
/// that fields turn by around loops are multiples of 2 pi / N, as on a cube for N = 4. One prescribed direction determines it.
///
/// Solved by LaplacianHierarchy, its coarse levels N-th powers at samples.
class PowerField : public Discretisation
{
public:
  /// \param N 1 to 8.
  /// \throw InvalidInput N is out of range.
  PowerField(const FramedMesh& surface, int N);

  std::string Name() const override;
  ElementKind Elements() const override { return ElementKind::Faces; }
  int UnknownsPerElement() const override { return 2; }
  int NumberOfEquations() const override { return this->NumberOfElements(); }
  int DirectionsPerPoint() const override { return this->N; }

  bool IsAccurateOnShearedTriangles() const override { return false; }
  Vector<double> Mass(const ExecutionContext& context) const override;
  std::unique_ptr<const StiffnessHierarchy> Coarsen(
    const LinearProlongations& linear, const ExecutionContext& context) const override;
  std::unique_ptr<const StiffnessHierarchy> Assemble(
    const ProlongationOperators* operators, CoarseSpaceKind space, const ExecutionContext& context) const override;
  OperatorSelection StructurePreservingOperators() const override { return { true, false, false }; }
  std::string NameOfLevels() const override { return "levels of face powers"; }
  SolverTuning Tuning() const override;

  FieldConstraints Prescribe(const Constraints& constraints, const ElementNames& names) const override;

  FieldPowers Powers(
    const Vector<double>& unknowns, const Unfilled<Corner>& corners, const ExecutionContext& context) const override;
  std::vector<ElementValues> Values(const Vector<double>& unknowns, const FieldPowers& powers) const override;
  Points VectorsOnFaces(const Vector<double>& unknowns, const ExecutionContext& context) const override;
  IntegralWeights WeightsOfIntegral() const override;

protected:
  Vector<double> PenaltiesOfElements(const std::vector<int>& faces, const ExecutionContext& context) const override;

private:
  const int N;
};

}

#endif
