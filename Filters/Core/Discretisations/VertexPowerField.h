#ifndef dmgVertexPowerField_h
#define dmgVertexPowerField_h

#include "Discretisations/VertexDiscretisation.h"
#include "Mesh/VertexConnection.h"

#include <memory>
#include <mutex>

namespace dmg
{

/// Fields of N directions by their N-th powers X at the vertices, a complex number each in VertexFrames, linear between
/// them (Knoeppel et al. 2013). VertexPowerField.md has the formulas.
///
/// The smoothness energy is X^H L X, L the ConnectionLaplacian: the Dirichlet energy of X, consistent on any triangles. The mass are
/// LumpedMass over its mean, which is the penalty of a prescribed vertex, too: soft constraints mean the
/// same as for power fields on faces, where both energies are twice as large. A direction on a face
/// prescribes its three corners, each with a third of the face's area; one along a side of a face the two ends of that
/// side with half of it.
///
/// Solved by LaplacianHierarchy, its coarse levels N-th powers at samples of the vertices.
class VertexPowerField : public VertexDiscretisation
{
public:
  /// \param N 1 to 8.
  /// \param connection of the surface, which is borrowed; null: it is made when it is needed.
  /// \throw InvalidInput N is out of range.
  VertexPowerField(const FramedMesh& surface, int N, const VertexConnection* connection = nullptr);

  std::string Name() const override;
  int UnknownsPerElement() const override { return 2; }
  int DirectionsPerPoint() const override { return this->N; }

  Vector<double> Mass(const ExecutionContext& context) const override;
  std::unique_ptr<const StiffnessHierarchy> Coarsen(
    const LinearProlongations& linear, const ExecutionContext& context) const override;
  std::unique_ptr<const StiffnessHierarchy> Assemble(
    const ProlongationOperators* operators, CoarseSpaceKind space, const ExecutionContext& context) const override;
  OperatorSelection StructurePreservingOperators() const override { return { false, false, false }; }
  std::string NameOfLevels() const override { return "levels of functions, transported"; }
  ProlongationOperators SampledLevels(double distance, const ExecutionContext& context) const override;
  double SampleDistance() const override;
  SolverTuning Tuning() const override;

  Vector<double> AreasOfVertices(const ExecutionContext& context) const override;
  SparseMatrix<Complex> Stiffness(const ExecutionContext& context) const override;
  SparseMatrix<Complex> ProlongationOfUnknowns(
    const TransportOperator& transport, const ExecutionContext& context) const override;
  /// N-th powers of directions.
  std::vector<PowerAtVertex> SumsAtVertices(
    const Constraints& constraints, const std::vector<char>& isSurrounded, const ElementNames& names) const override;

  FieldConstraints Prescribe(const Constraints& constraints, const ElementNames& names) const override;

  FieldPowers Powers(
    const Vector<double>& unknowns, const Unfilled<Corner>& corners, const ExecutionContext& context) const override;
  const VertexConnection* ConnectionOfPowers(const ExecutionContext& context) const override
  {
    return &this->Connection(context);
  }
  std::vector<ElementValues> Values(const Vector<double>& unknowns, const FieldPowers& powers) const override;
  Points VectorsOnFaces(const Vector<double>& unknowns, const ExecutionContext& context) const override;

private:
  /// Made when it is first asked for, unless it was given.
  const VertexConnection& Connection(const ExecutionContext& context) const;
  /// From the levels of samples of the vertices, or from those of the thesis: S0 with transport.
  std::vector<SparseMatrix<Complex>> ProlongationsOfPowers(
    const ProlongationOperators& operators, const ExecutionContext& context) const;
  /// The means of the corners.
  Vector<Complex> PowersOfFaces(const Vector<double>& unknowns, const ExecutionContext& context) const;

  const int N;
  const VertexConnection* const Given;
  mutable std::once_flag IsConnected;
  mutable std::unique_ptr<const VertexConnection> ConnectionOfSurface;
};

}

#endif
