#ifndef dmgMultigridCycle_h
#define dmgMultigridCycle_h

#include "Solvers/Krylov/Preconditioner.h"
#include "Solvers/Multigrid/GalerkinHierarchy.h"
#include "Solvers/Multigrid/Smoother.h"

#include <memory>

namespace dmg
{

/// The precision of the numbers inside a cycle. The solvers around it work in double precision, correct its
/// rounding errors and reach any tolerance that double precision allows.
enum class CyclePrecision
{
  /// Single, unless the coarsest matrix is nearly singular (reciprocal condition below 2e-5), as under
  /// very weak constraints: rounding errors would then swamp the smoothest part of the solution. Repetitions depend on the
  /// condition of the finest matrix, which is estimated from that of the coarsest.
  Automatic,
  Single, ///< half the memory traffic
  Double,
};

struct CycleOptions
{
  SmootherOptions Smoothing;
  /// Sweeps on level 0 over sweeps on a coarse level, >= 1.
  int FinestFactor = 1;
  /// V-cycles x += s B (b - A x) that count as one; >= 1. Several replace an exact solution. Their steps s are Chebyshev's, for
  /// eigenvalues of B A from 1/2 to 1 (Saad, Iterative Methods for Sparse Linear Systems, 2003, section 12.3). A single one has
  /// a step of 1.
  int Repetitions = 1;
  CyclePrecision Precision = CyclePrecision::Automatic;
};

/// One V-cycle of a Galerkin hierarchy, started from zero, as a linear operator B: smooth, correct
/// by the next coarser level, smooth. Symmetric or Hermitian positive definite if as many sweeps
/// follow the coarse correction as precede it; then it preconditions conjugate gradients. As a
/// stationary iteration, x += B (b - A x).
///
/// Inside, each level is scaled to unit diagonal: Gauss-Seidel is invariant, and single precision does not overflow. Unknowns are
/// in a SweepOrder.
/// Vectors of Apply are in the order of the hierarchy's caller.
///
/// Cost of a V(2,2)-cycle with Gauss-Seidel: per level three products with the matrix and two with
/// the prolongation.
template <class Scalar>
class MultigridCycle : public Preconditioner<Scalar>
{
public:
  /// \param hierarchy must outlive the cycle; its matrices may be forgotten.
  /// \throw InvalidInput a number of sweeps is negative.
  MultigridCycle(GalerkinHierarchy<Scalar>& hierarchy, const CycleOptions& options, const ExecutionContext& context);
  ~MultigridCycle() override;

  /// After an Update of the hierarchy. Orders are kept unless the precision changes.
  void Update(const ExecutionContext& context);

  /// z = B r, both N_0 long.
  void Apply(const Vector<Scalar>& r, Vector<Scalar>& z, const ExecutionContext& context) override;

  /// Held by this object.
  long long Bytes() const;

private:
  class Internals;
  template <class Value>
  class InternalsOf;
  bool NeedsDoublePrecision() const;
  void Build(const ExecutionContext& context);

  GalerkinHierarchy<Scalar>& Hierarchy;
  const CycleOptions Options;
  bool IsDouble = false;
  std::unique_ptr<Internals> Internal;
};

}

#endif
