#ifndef dmgGalerkinHierarchy_h
#define dmgGalerkinHierarchy_h

#include "Solvers/Direct/CholeskySolver.h"
#include "Solvers/Krylov/SolveReport.h"
#include "Support/ExecutionContext.h"
#include "Support/Types.h"

#include <limits>
#include <optional>
#include <vector>

namespace dmg
{

struct GalerkinOptions
{
  /// The level whose matrix is factored; prolongations beyond it are left out. 0: A itself.
  int CoarsestLevel = std::numeric_limits<int>::max();
  /// The number of times that the finest prolongation is smoothed before it is used, >= 0; see
  /// SmoothedProlongation.h. For a fine level whose coefficients jump where the coarse do not.
  int FinestProlongationSteps = 0;
};

/// The matrices of a multigrid method by Galerkin's products A_{l+1} = P_l^H A_l P_l, and a
/// factorisation of the coarsest. Level 0 is the finest.
///
/// Order. The caller's order may be random, which makes every product slow. The levels are therefore sorted
/// (HierarchicalOrder); FinestOrder relates level 0 to the caller's order.
///
/// Inactive unknowns. Where a diagonal entry of a semi-definite matrix is zero, up to rounding, its
/// whole row is. Coarse unknowns without entries in the prolongation are of this kind, and those that carry
/// the kernel of a component. Every step leaves them out; corrections are zero there.
///
/// Cost: linear in the number of multiply-adds of the products.
template <class Scalar>
class GalerkinHierarchy
{
public:
  /// \param A N_0 x N_0, symmetric or Hermitian, positive semi-definite, compressed.
  /// \param prolongations [l] is N_l x N_{l+1}, compressed. May be empty: then A itself is factored.
  /// \throw InvalidInput the sizes do not chain, or CoarsestLevel is negative.
  /// \throw SolverFailure a diagonal entry is negative or not finite, or the coarsest matrix is not
  ///   positive semi-definite.
  /// \throw Cancelled
  /// Checkpoints: one per level.
  GalerkinHierarchy(const SparseMatrix<Scalar>& A, std::vector<SparseMatrix<Scalar>> prolongations,
    const GalerkinOptions& options, const ExecutionContext& context);
  /// \param A comes back empty, as soon as it is not needed any more.
  GalerkinHierarchy(SparseMatrix<Scalar>&& A, std::vector<SparseMatrix<Scalar>> prolongations,
    const GalerkinOptions& options, const ExecutionContext& context);

  /// Takes other values in the same pattern. Prolongations, orders and analyses are kept, so that the
  /// bits are those of a new hierarchy with the prolongations of this one.
  /// \pre the prolongations have not been forgotten.
  /// \throw as the constructor; the hierarchy must not be used after that.
  void Update(const SparseMatrix<Scalar>& A, const ExecutionContext& context);
  void Update(SparseMatrix<Scalar>&& A, const ExecutionContext& context);

  int NumberOfLevels() const { return static_cast<int>(this->Reports.size()); }
  int NumberOfUnknowns(int level) const { return static_cast<int>(this->Reports[level].Unknowns); }

  /// A_l, N_l x N_l.
  const SparseMatrix<Scalar>& Matrix(int level) const { return this->Matrices[level]; }
  /// The diagonal of A_l; zero exactly for inactive unknowns.
  const Vector<double>& Diagonal(int level) const { return this->Diagonals[level]; }
  /// P_l, N_l x N_{l+1}.
  const SparseMatrix<Scalar>& Prolongation(int level) const { return this->Prolongations[level]; }
  /// [k] is the caller's index of unknown k of level 0.
  const std::vector<int>& FinestOrder() const { return this->Order; }

  /// Frees all A_l and diagonals, which nothing needs once a cycle is built. Update brings them back.
  void ForgetMatrices();
  /// Frees all P_l. The hierarchy cannot be updated any more.
  void ForgetProlongations();

  /// Factor of D^{-1/2} A D^{-1/2} on the coarsest level, D its diagonal. Inactive unknowns have
  /// ones on the diagonal, and all diagonal entries are lifted by 1e-12 so that a semi-definite
  /// matrix has a factor, too.
  CholeskySolver<Scalar>& CoarsestSolver() { return *this->CoarsestFactor; }
  const CholeskySolver<Scalar>& CoarsestSolver() const { return *this->CoarsestFactor; }

  /// Unknowns and non-zeros of each A_l.
  const std::vector<LevelReport>& Levels() const { return this->Reports; }
  /// Held by this object.
  long long Bytes() const;

private:
  void SetOrder(const SparseMatrix<Scalar>& A, std::vector<SparseMatrix<Scalar>> prolongations,
    const GalerkinOptions& options, const ExecutionContext& context);
  void SetFinest(const SparseMatrix<Scalar>& A, const ExecutionContext& context);
  void SmoothProlongation(const GalerkinOptions& options, const ExecutionContext& context);
  void ComputeCoarser(const ExecutionContext& context);
  /// \param scales of the entries of this level: their rounding errors are that much times epsilon.
  ///   On exit zero diagonals are zero exactly, and scales are the diagonal of active unknowns.
  void FindDiagonal(int level, Vector<double>& scales, const ExecutionContext& context);
  void FactorCoarsest();

  std::vector<int> Order;
  std::vector<SparseMatrix<Scalar>> Prolongations;
  std::vector<SparseMatrix<Scalar>> Matrices;
  std::vector<Vector<double>> Diagonals;
  std::vector<LevelReport> Reports;
  std::optional<CholeskySolver<Scalar>> CoarsestFactor;
};

}

#endif
