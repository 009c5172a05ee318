#ifndef dmgLeastSquaresField_h
#define dmgLeastSquaresField_h

#include "Discretisations/Discretisation.h"
#include "Solvers/LeastSquares/LeastSquaresHierarchy.h"

namespace dmg
{

/// Vector fields whose smoothness energy is the sum of their squared divergence and curl: R = B^T B, for B with few entries per row. The
/// kernel are the harmonic fields, of dimension 2 g on a closed surface of genus g, 2 g + b - 1 with b > 0 boundary loops.
///
/// Solved by LeastSquaresHierarchy, with coarse levels of vectors at points.
class LeastSquaresField : public Discretisation
{
public:
  using Discretisation::Discretisation;

  std::unique_ptr<const StiffnessHierarchy> Coarsen(
    const LinearProlongations& linear, const ExecutionContext& context) const override;
  std::unique_ptr<const StiffnessHierarchy> Assemble(
    const ProlongationOperators* operators, CoarseSpaceKind space, const ExecutionContext& context) const override;
  double SampleDistance() const override;
  SolverTuning Tuning() const override;

  bool HasHarmonicFields() const override { return true; }
  int NumberOfHarmonicFields() const override;

protected:
  /// B.
  virtual SparseMatrix<double> Factor(const ExecutionContext& context) const = 0;
  /// See LeastSquaresLevels.h.
  virtual LeastSquaresLevels LinearLevels(
    const std::vector<TransportOperator>& linear, const ExecutionContext& context) const = 0;
  virtual LeastSquaresHierarchyOptions Coarsening() const { return {}; }
  /// Prolongations of the unknowns by linear interpolation of vectors.
  virtual std::vector<SparseMatrix<double>> LinearProlongationsOfUnknowns(
    const std::vector<TransportOperator>& linear, const ExecutionContext& context) const = 0;
  /// The structure-preserving prolongations among the operators of a surface; empty if they are missing.
  virtual const std::vector<SparseMatrix<double>>& PreservingProlongations(
    const ProlongationOperators& operators) const = 0;
  /// The remedy for operators that are missing.
  virtual Remedy RemedyOfOperators() const = 0;
};

}

#endif
