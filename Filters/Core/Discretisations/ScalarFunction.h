#ifndef dmgScalarFunction_h
#define dmgScalarFunction_h

#include "Discretisations/VertexDiscretisation.h"

namespace dmg
{

/// A function u, linear on faces, by its values at the vertices: the solution of a Poisson problem -Laplace u = f with given values at
/// some vertices. PoissonSolver solves many of them at once.
///
/// The smoothness energy is u^T L0 u, L0 = d0^T star1 d0 the cotangent Laplacian: the Dirichlet energy. A prescribed vertex v has the
/// penalty A_v / mean A with the areas A_v of Star0, which are the mass as well. What crosses a boundary vanishes
/// there, by the natural condition. The kernel are the constants of the components of the surface: one prescribed value
/// determines that of its component.
///
/// Solved by cycles on the assembled matrix, two in a row. Coarse functions live at the samples of the linear levels: a vertex takes the mean
/// over its faces of what these take from the samples; or at the vertices of decimated levels, by S0.
class ScalarFunction : public VertexDiscretisation
{
public:
  /// \param areas Star0. \param conductivity that of the cotangent Laplacian.
  ScalarFunction(const FramedMesh& surface, VertexAreas areas, std::vector<double> conductivity = {});

  std::string Name() const override
  {
    return this->Areas == VertexAreas::MixedVoronoi ? "functions" : "functions with barycentric areas";
  }
  int UnknownsPerElement() const override { return 1; }

  Vector<double> Mass(const ExecutionContext& context) const override;
  /// Constants.
  bool HasSmoothest() const override { return false; }
  std::unique_ptr<const StiffnessHierarchy> Coarsen(
    const LinearProlongations& linear, const ExecutionContext& context) const override;
  std::unique_ptr<const StiffnessHierarchy> Assemble(
    const ProlongationOperators* operators, CoarseSpaceKind space, const ExecutionContext& context) const override;
  /// S0 is always there.
  OperatorSelection StructurePreservingOperators() const override { return { false, false, false }; }
  std::string NameOfLevels() const override { return "levels of functions"; }
  SolverTuning Tuning() const override;

  Vector<double> AreasOfVertices(const ExecutionContext& context) const override { return this->Mass(context); }
  SparseMatrix<Complex> Stiffness(const ExecutionContext& context) const override;
  SparseMatrix<Complex> ProlongationOfUnknowns(
    const TransportOperator& transport, const ExecutionContext& context) const override;
  /// Sums of values alone.
  std::vector<PowerAtVertex> SumsAtVertices(
    const Constraints& constraints, const std::vector<char>& isSurrounded, const ElementNames& names) const override;

  /// Takes the prescribed values and the source, not the directions; values at one vertex are averaged by weight. On a component with a
  /// source and without values, u has a mean of zero.
  /// \throw InvalidInput there is neither a value nor a source; one is out of range or not finite, or a weight not positive; the source
  ///   does not sum to zero on a component without values, and is to be refused.
  FieldConstraints Prescribe(const Constraints& constraints, const ElementNames& names) const override;

  /// Pins the first vertex of each component without a prescribed vertex at zero; the solution is free by a constant there. The sum of
  /// its equations says that even a penalty holds it exactly.
  /// \param net the treatment of a source that does not sum to zero on such a component.
  /// \throw InvalidInput it is to be refused.
  void PinFree(NetSource net, FieldConstraints& constraints) const;
  void CentreFree(const FieldConstraints& constraints, Vector<double>& unknowns) const override;
  /// Shifts a function on each component with a pinned vertex so that it vanishes there: a first guess.
  void VanishAtPinned(const FieldConstraints& constraints, Vector<double>& unknowns) const;

  /// The gradient.
  FieldPowers Powers(
    const Vector<double>& unknowns, const Unfilled<Corner>& corners, const ExecutionContext& context) const override;
  std::vector<ElementValues> Values(const Vector<double>& unknowns, const FieldPowers& powers) const override;
  Points VectorsOnFaces(const Vector<double>& unknowns, const ExecutionContext& context) const override;

private:
  void AddSource(const Constraints& given, const ElementNames& names, FieldConstraints& constraints) const;

  const VertexAreas Areas;
  const std::vector<double> Conductivity;
  const std::vector<int> Components; ///< by vertex
};

}

#endif
