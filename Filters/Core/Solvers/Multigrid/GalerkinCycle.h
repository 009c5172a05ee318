#ifndef dmgGalerkinCycle_h
#define dmgGalerkinCycle_h

#include "Solvers/Krylov/Preconditioner.h"
#include "Solvers/Multigrid/CycleOptions.h"
#include "Solvers/Multigrid/GalerkinHierarchy.h"
#include "Solvers/Multigrid/LevelStack.h"

#include <complex>
#include <optional>
#include <type_traits>
#include <vector>

namespace dmg
{

/// One V-cycle of a Galerkin hierarchy, started from zero, as a linear operator B: smooth, correct
/// by the next coarser level, smooth; the factor of the matrix where the hierarchy has one level. Symmetric or Hermitian positive
/// definite if as many sweeps follow the coarse correction as precede it; then it preconditions conjugate gradients. As a
/// stationary iteration, x += B (b - A x).
///
/// It preconditions an assembled system, and stands in for the solution of the coarse equations of cycles whose
/// finest level is something else (LaplacianCycle, LeastSquaresCycle).
///
/// Cost of a V(2,2)-cycle with Gauss-Seidel: per level three products with the matrix and two with
/// the prolongation.
template <class Scalar>
class GalerkinCycle : public Preconditioner<Scalar>
{
public:
  /// \param matrix, prolongations see GalerkinHierarchy. The matrix comes back empty.
  /// \throw InvalidInput a number of sweeps is negative.
  /// \throw as GalerkinHierarchy.
  GalerkinCycle(SparseMatrix<Scalar>&& matrix, std::vector<SparseMatrix<Scalar>> prolongations,
    const GalerkinOptions& coarsening, const CycleOptions& cycle, const ExecutionContext& context);
  GalerkinCycle(const GalerkinCycle&) = delete; // the levels refer to the hierarchy
  GalerkinCycle& operator=(const GalerkinCycle&) = delete;

  /// Takes other values in the same pattern. Orders are kept unless the precision changes. After an error the cycle must not be
  /// used.
  void Update(SparseMatrix<Scalar>&& matrix, const ExecutionContext& context);

  /// z = B r, both N_0 long.
  void Apply(const Vector<Scalar>& r, Vector<Scalar>& z, const ExecutionContext& context) override;

  /// Unknowns and non-zeros, finest first.
  const std::vector<LevelReport>& Levels() const { return this->Hierarchy.Levels(); }
  /// Held by this object.
  long long Bytes() const;

private:
  using Single = std::conditional_t<std::is_same<Scalar, double>::value, float, std::complex<float>>;

  bool NeedsDoublePrecision() const;
  template <class Value>
  void TakeMatrix(std::optional<LevelStack<Scalar, Value>>& levels, const ExecutionContext& context);
  void TakeMatrix(const ExecutionContext& context);

  const CycleOptions Options;
  GalerkinHierarchy<Scalar> Hierarchy;
  std::optional<LevelStack<Scalar, Single>> InSingle; ///< or
  std::optional<LevelStack<Scalar, Scalar>> InDouble;
};

}

#endif
