#ifndef dmgStiffnessHierarchy_h
#define dmgStiffnessHierarchy_h

#include "Solvers/Krylov/ConvergenceMeasure.h"
#include "Solvers/Krylov/LinearOperator.h"
#include "Solvers/Krylov/Preconditioner.h"
#include "Solvers/Krylov/SolveReport.h"
#include "Solvers/Multigrid/CycleOptions.h"
#include "Solvers/Multigrid/NestedIteration.h"
#include "Support/CountingSort.h"
#include "Support/ExecutionContext.h"
#include "Support/Types.h"

#include <algorithm>
#include <memory>
#include <utility>
#include <vector>

/// A field minimises x^T R x plus penalties, a diagonal D. R depends on the surface only. Cycles for A = R + D keep the two
/// apart: their parts of R belong to the set-up, and another D changes little.
///
/// Unknowns are real here; complex numbers are pairs of them.
namespace dmg
{

struct StiffnessCycleOptions
{
  /// Sweeps on the finest level before and after the coarse correction, >= 1.
  int Sweeps = 4;
  /// The number of unknowns up to which the first coarse level is factored; where R and D are kept apart.
  int LargestFactor = 10000;
  /// The options of the levels below.
  CycleOptions Coarse;
  /// Options of a matrix that is assembled (AssembledHierarchy): V-cycles in a row, the level that is factored, and how often
  /// the finest prolongation is smoothed.
  int CyclesInARow = 1;
  GalerkinOptions Coarsening;

  /// The coarsening of the first coarse level: none, but a factor, where it is small.
  GalerkinOptions CoarseningOf(int numberOfUnknowns) const
  {
    GalerkinOptions coarsening;
    if (numberOfUnknowns <= this->LargestFactor)
    {
      coarsening.CoarsestLevel = 0;
    }
    return coarsening;
  }
};

/// R x = theta M x in parts of the unknowns that nothing couples, with a shift of the eigenvalues of each.
struct ShiftedParts
{
  const Vector<double>& Mass; ///< the diagonal of M; the same for so many consecutive unknowns each:
  int UnknownsPerMass;
  const SortedItems& Parts;
  const std::vector<double>& Shifts;
};

/// One V-cycle for A = R + D, as a linear operator that is symmetric positive definite. Unknowns are in the
/// order of the hierarchy, and not scaled.
class StiffnessCycle : public Preconditioner<double>
{
public:
  /// Takes another D. Patterns stay. Coarse matrices, their factor and the penalised part of the finest level are computed
  /// anew. After an error the cycle must not be used.
  virtual void Update(const Vector<double>& D, const ExecutionContext& context) = 0;

  /// The lowest eigenvectors of the first coarse level, prolonged: where those of the finest level may be looked for from. Their
  /// lengths mean nothing. Zero in parts, or empty, where there are none.
  /// \pre D is the shift times the mass in all parts.
  virtual Vector<double> CoarseEigenvectors(const ShiftedParts&, const ExecutionContext&) { return {}; }

  /// Unknowns and non-zeros, finest first.
  virtual std::vector<LevelReport> Levels() const = 0;
  /// Held by this object, without the hierarchy.
  virtual long long Bytes() const = 0;

protected:
  static std::vector<LevelReport> FinestAnd(const LevelReport& finest, const std::vector<LevelReport>& coarser)
  {
    std::vector<LevelReport> levels = { finest };
    levels.insert(levels.end(), coarser.begin(), coarser.end());
    return levels;
  }
};

/// Full multigrid for A = R + D; see NestedIteration. Unknowns are those of the hierarchy.
class StiffnessNestedIteration
{
public:
  virtual ~StiffnessNestedIteration() = default;

  virtual void Solve(const Vector<double>& b, const SweepOptions& sweeps, Vector<double>& x, SolveReport& report,
    const ExecutionContext& context, const ConvergenceMeasure<double>& measure) = 0;
  virtual std::vector<LevelReport> Levels() const = 0;
  virtual long long Bytes() const = 0;
};

/// A = R + D. Where D is infinite the unknown is zero: x should be, and its row of A x is. Whatever x is there, the
/// other rows of A x are those of R x + D x; only the product that Apply returns counts it.
class StiffnessOperator : public LinearOperator<double>
{
public:
  /// Takes another D, >= 0.
  virtual void SetDiagonal(const Vector<double>& D, const ExecutionContext& context) = 0;

  void SetInverseDiagonal(Vector<double> inverse) { this->Inverse = std::move(inverse); }
  const Vector<double>* InverseDiagonal() const override { return this->Inverse.size() > 0 ? &this->Inverse : nullptr; }

private:
  Vector<double> Inverse;
};

/// The part of cycles that depends on the stiffness matrix R alone. Its unknowns stand in an order of their own, which those of
/// its cycles and operators share.
class StiffnessHierarchy
{
public:
  virtual ~StiffnessHierarchy() = default;

  /// The caller's index of each unknown.
  std::vector<int> Order;
  /// The connected component of each unknown; empty if there is one.
  std::vector<int> Components;
  int NumberOfUnknowns() const { return static_cast<int>(this->Order.size()); }
  /// \param components of each unknown.
  void SetComponents(std::vector<int> components)
  {
    const bool areConnected = std::all_of(
      components.begin(), components.end(), [&components](int component) { return component == components[0]; });
    this->CountOfComponents = areConnected ? 1 : 1 + *std::max_element(components.begin(), components.end());
    this->Components = areConnected ? std::vector<int>() : std::move(components);
  }
  int NumberOfComponents() const { return this->CountOfComponents; }
  int ComponentOf(int unknown) const { return this->Components.empty() ? 0 : this->Components[unknown]; }

  /// R_ii, in single precision.
  virtual double DiagonalOf(int unknown) const = 0;

  /// R as a matrix. Cost: that of its product, where R and D are kept apart; memory several times that of the hierarchy's own.
  virtual SparseMatrix<double> RealMatrix(const ExecutionContext& context) const = 0;

  /// R, with D = 0. Borrows the hierarchy.
  virtual std::unique_ptr<StiffnessOperator> Operator() const = 0;

  /// A cycle for R + D, or its factor where there are no coarse levels. Borrows the hierarchy; several may
  /// share it.
  /// \param D one entry per unknown, >= 0. Infinite: the unknown is zero.
  /// \throw as GalerkinHierarchy.
  virtual std::unique_ptr<StiffnessCycle> Cycle(
    const Vector<double>& D, const StiffnessCycleOptions& options, const ExecutionContext& context) const = 0;

  /// Full multigrid for R + D, if the hierarchy has it; else null. Parameters as above; maySweep: see NestedOptions.
  virtual std::unique_ptr<StiffnessNestedIteration> NestedIterations(
    const Vector<double>&, const StiffnessCycleOptions&, bool /*maySweep*/, const ExecutionContext&) const
  {
    return nullptr;
  }

  /// The inverse of R + D by a factor of the whole matrix (ShiftedFactor), for where cycles do not converge.
  /// \param D as for cycles.
  /// \throw as ShiftedFactor.
  virtual std::unique_ptr<Preconditioner<double>> Factor(
    const Vector<double>& D, const ExecutionContext& context) const = 0;

  /// Held by this object.
  virtual long long Bytes() const = 0;

protected:
  StiffnessHierarchy() = default;
  StiffnessHierarchy(StiffnessHierarchy&&) = default;

  /// The bytes that this class holds.
  long long BytesOfUnknowns() const
  {
    return static_cast<long long>((this->Order.size() + this->Components.size()) * sizeof(int));
  }

private:
  int CountOfComponents = 1;
};

}

#endif
