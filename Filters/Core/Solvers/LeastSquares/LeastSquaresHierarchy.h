#ifndef dmgLeastSquaresHierarchy_h
#define dmgLeastSquaresHierarchy_h

#include "Solvers/Kernels/RowRuns.h"
#include "Solvers/Kernels/RowTiles.h"
#include "Solvers/Kernels/SingleProlongation.h"
#include "Solvers/Kernels/SparseDiagonal.h"
#include "Solvers/LeastSquares/PlanarProlongation.h"
#include "Solvers/LeastSquares/UnknownBlocks.h"
#include "Solvers/Multigrid/StiffnessHierarchy.h"
#include "Support/ExecutionContext.h"
#include "Support/Types.h"

#include <vector>

namespace dmg
{

/// The origin of the levels of a LeastSquaresHierarchy.
struct LeastSquaresLevels
{
  UnknownBlocks Blocks;                      ///< of the fine level
  PlanarProlongation Prolongation;           ///< to the fine level
  std::vector<SparseMatrix<double>> Coarser; ///< between the levels below, finest first
};

struct LeastSquaresHierarchyOptions
{
  /// Degree of the polynomial that smooths the prolongation, >= 0.
  int ProlongationDegree = 7;
  /// Relative drop tolerance per row of the prolongation. Above 300,000 unknowns it is scaled by sqrt(300,000 / n), as the
  /// smallest eigenvalues decrease with n.
  double Dropped = 0.0003;
};

/// The multigrid set-up of an energy |B x|^2, for any constraints: its blocks, a smoothed
/// prolongation from plane vectors, and the smoothness energy of those. It is built once per surface. Each set of
/// constraints then takes a LeastSquaresCycle on it.
///
/// The fine level costs most, so the first coarse level is much smaller, and the polynomial that smooths its prolongation has a
/// high degree.
///
/// Unknowns are sorted by the coarse unknowns of their blocks. Rows of B are sorted by their first unknown, and within a tile by
/// length (RowRuns). Columns of B are scaled so that B^T B has about the same size everywhere and no eigenvalue above 1. The
/// caller's unknown Order[k] is x_k / Scales[k].
class LeastSquaresHierarchy : public StiffnessHierarchy
{
public:
  LeastSquaresHierarchy() = default;
  /// Eigen 3.4 would copy the matrices.
  LeastSquaresHierarchy(LeastSquaresHierarchy&& other) noexcept;

  Vector<double> Scales;  ///< |R_ii| <= Scales_i^2, nearly equal; 1 where R is zero
  SparseMatrix<double> B; ///< columns divided by Scales
  Vector<float> Diagonal; ///< of B^T B; 0 to 1
  RowTiles Tiles;         ///< of B, for products with its transpose
  UnknownBlocks Blocks;
  SingleProlongation Prolongation;
  /// The lower triangle of P^T B^T B P, 2 N_1 x 2 N_1.
  SparseMatrix<double> CoarseLower;
  /// Between the levels below, finest first.
  std::vector<SparseMatrix<double>> Coarser;

  double DiagonalOf(int unknown) const override
  {
    return this->Scales[unknown] * this->Scales[unknown] * this->Diagonal[unknown];
  }
  SparseMatrix<double> RealMatrix(const ExecutionContext& context) const override;
  std::unique_ptr<StiffnessOperator> Operator() const override;
  std::unique_ptr<StiffnessCycle> Cycle(
    const Vector<double>& D, const StiffnessCycleOptions& options, const ExecutionContext& context) const override;
  std::unique_ptr<Preconditioner<double>> Factor(
    const Vector<double>& D, const ExecutionContext& context) const override;
  long long Bytes() const override;
};

/// \param B m x n. \param levels Prolongation is n x N_1; Coarser [0] has 2 N_1 rows. Both are freed early: move them in.
/// \throw InvalidInput the sizes do not chain, or a block is too large.
/// \throw Cancelled
/// Cost: linear in the size of B; most of it smooths the prolongation.
LeastSquaresHierarchy CoarsenLeastSquares(SparseMatrix<double> B, LeastSquaresLevels levels,
  const LeastSquaresHierarchyOptions& options, const ExecutionContext& context);

/// A = B^T B + D of a hierarchy as operator, on unknowns in its order, but not scaled.
class LeastSquaresOperator : public StiffnessOperator
{
public:
  /// D = 0. \param hierarchy is borrowed.
  explicit LeastSquaresOperator(const LeastSquaresHierarchy& hierarchy);

  void SetDiagonal(const Vector<double>& D, const ExecutionContext& context) override;
  int Size() const override { return this->Hierarchy.NumberOfUnknowns(); }
  double Apply(const Vector<double>& x, Vector<double>& y, const ExecutionContext& context) const override;

private:
  const LeastSquaresHierarchy& Hierarchy;
  const RowRuns<double> B;
  SparseDiagonal D;
  mutable Vector<double> Scaled; ///< x in the units of B
  mutable std::vector<double> SquaresOfTiles;
};

}

#endif
