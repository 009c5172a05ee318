#ifndef dmgPowerField_h
#define dmgPowerField_h

#include "Discretisations/Discretisation.h"

namespace dmg
{

/// \throw InvalidInput N is not between 1 and 8.
void CheckNumberOfDirections(int N);

/// Fields of N directions by their N-th powers X, a complex number per face in its frame. Thesis, section 6.3.
///
/// The roughness is X^H L X, L the PowerLaplacian: how much the field turns. A prescribed face f has the penalty
/// m_f = A_f / mean A, so that at weights of 1 a face of mean area pulls 1 / w_e times as hard as an edge e of PowerEdgeWeights
/// w_e does. The mass are the areas over their mean; ones where the whole surface has no area. There are no harmonic
/// fields but on flat surfaces, where one prescribed direction determines them.
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

  Vector<double> Mass(const ExecutionContext& context) const override;
  std::unique_ptr<const RoughnessHierarchy> Coarsen(
    const NodalProlongations& nodal, const ExecutionContext& context) const override;
  std::unique_ptr<const RoughnessHierarchy> Assemble(const ProlongationOperators* operators,
    CoarseSpaceKind space, const ExecutionContext& context) const override;
  OperatorSelection StructurePreservingOperators() const override { return { true, false, false }; }
  std::string NameOfLevels() const override { return "levels of face powers"; }
  SolverTuning Tuning() const override;

  FieldConstraints Prescribe(
    const PrescribedDirections& directions, const ElementNames& names) const override;

  FieldPowers Powers(const Vector<double>& unknowns, const Unfilled<Corner>& corners,
    const ExecutionContext& context) const override;
  std::vector<ElementValues> Values(
    const Vector<double>& unknowns, const FieldPowers& powers) const override;
  Points VectorsOnFaces(
    const Vector<double>& unknowns, const ExecutionContext& context) const override;

protected:
  Vector<double> PenaltiesOfElements(
    const std::vector<int>& faces, const ExecutionContext& context) const override;

private:
  const int N;
};

}

#endif
