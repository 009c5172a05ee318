#ifndef dmgLaplacianHierarchy_h
#define dmgLaplacianHierarchy_h

#include "Solvers/Kernels/SingleProlongation.h"
#include "Solvers/Kernels/SweepOrder.h"
#include "Solvers/Kernels/TriangularParts.h"
#include "Solvers/Multigrid/StiffnessHierarchy.h"

#include <complex>
#include <functional>
#include <memory>
#include <vector>

namespace dmg
{

/// The levels of a smoothness energy that is given by its matrix: a Hermitian positive semi-definite L of few
/// entries per row, which Gauss-Seidel smooths. Unknowns 2 k and 2 k + 1 are the parts of complex unknown k.
///
/// Complex unknowns are sorted by colours.
class LaplacianHierarchy : public StiffnessHierarchy
{
public:
  using Single = std::complex<float>;

  LaplacianHierarchy() = default;
  /// Eigen 3.4 would copy the matrices.
  LaplacianHierarchy(LaplacianHierarchy&& other) noexcept;

  /// Sets what is known of L.
  /// \param colours of its unknowns, in whose order it is held.
  void SetMatrix(const SparseMatrix<Complex>& matrix, const SweepOrder& colours, const ExecutionContext& context);
  int Rows() const { return static_cast<int>(this->L.rows()); }

  SparseMatrix<Complex> L;
  TriangularParts<Single> Sweeps;             ///< L as sweeps read it, in single precision for their speed
  SingleProlongation Prolongation;            ///< complex
  SparseMatrix<Complex> CoarseLower;          ///< the lower triangle of P^H L P
  std::vector<SparseMatrix<Complex>> Coarser; ///< prolongations between the levels below, finest first

  double DiagonalOf(int unknown) const override { return this->L.coeff(unknown / 2, unknown / 2).real(); }
  SparseMatrix<double> RealMatrix(const ExecutionContext& context) const override;
  std::unique_ptr<StiffnessOperator> Operator() const override;
  std::unique_ptr<StiffnessCycle> Cycle(
    const Vector<double>& D, const StiffnessCycleOptions& options, const ExecutionContext& context) const override;
  std::unique_ptr<Preconditioner<double>> Factor(
    const Vector<double>& D, const ExecutionContext& context) const override;
  long long Bytes() const override;
};

/// Assembles a matrix with its rows and columns in another order; [k] is the caller's index of row k.
using MatrixInOrder =
  std::function<SparseMatrix<Complex>(const std::vector<int>& order, const ExecutionContext& context)>;

/// \param makeL gives L, N_0 x N_0, compressed.
/// \param prolongations [l] is N_l x N_{l+1}, compressed; one or more. The first is smoothed.
/// \param smoothingSteps >= 0; see SmoothedProlongation.
/// \throw InvalidInput the sizes do not chain.
/// \throw Cancelled
/// Cost: linear in the entries of L.
LaplacianHierarchy CoarsenLaplacian(const MatrixInOrder& makeL, std::vector<SparseMatrix<Complex>> prolongations,
  int smoothingSteps, const ExecutionContext& context);

}

#endif
