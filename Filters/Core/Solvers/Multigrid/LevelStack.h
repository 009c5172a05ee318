#ifndef dmgLevelStack_h
#define dmgLevelStack_h

#include "Solvers/Multigrid/GalerkinHierarchy.h"
#include "Solvers/Multigrid/Smoother.h"

#include <memory>
#include <optional>
#include <vector>

namespace dmg
{

/// The levels of a Galerkin hierarchy as V-cycles run on them: matrices scaled to unit diagonal, in a SweepOrder, with their
/// transfers and smoothers, in numbers of type Value. Gauss-Seidel is invariant under the scaling, and single precision does not
/// overflow.
///
/// With D the diagonal of A_l, a level's unknowns are D^{1/2} x and its right-hand sides D^{-1/2} b.
/// Inactive unknowns have empty rows and columns everywhere.
///
/// Each level has a right-hand side b and an iterate x for its users to work with.
template <class Scalar, class Value>
class LevelStack
{
  using Real = typename Eigen::NumTraits<Value>::Real;

public:
  struct Level
  {
    TriangularParts<Value> A; ///< empty on the coarsest level, and without matrices
    Vector<Value> b;
    Vector<Value> x;

  private:
    friend class LevelStack;
    std::vector<int> Order; ///< [k] is the unknown of the hierarchy at place k
    SparseMatrix<Value> P;  ///< from the next coarser level to this
    SparseMatrix<Value> R;  ///< P^H
  };

  /// \param hierarchy must outlive this object; its matrices may be forgotten.
  /// \param sweeps on each level, and \p finestFactor times as many on level 0; none: transfers alone, without matrices.
  LevelStack(GalerkinHierarchy<Scalar>& hierarchy, const std::optional<SmootherOptions>& sweeps, int finestFactor,
    const ExecutionContext& context);
  LevelStack(const LevelStack&) = delete; // smoothers refer to matrices
  LevelStack& operator=(const LevelStack&) = delete;

  /// After an Update of the hierarchy. Orders are kept.
  void Update(const ExecutionContext& context);

  int NumberOfLevels() const { return static_cast<int>(this->Levels.size()); }
  Level& operator[](int level) { return this->Levels[level]; }

  /// Sets b of level 0. \param b in the order of the hierarchy's caller.
  void Load(const Vector<Scalar>& b, const ExecutionContext& context);
  /// Gets x of level 0. \param x in the order of the hierarchy's caller.
  void Store(Vector<Scalar>& x, const ExecutionContext& context) const;

  /// b_{l+1} = R_l r. \param r on level l.
  void Restrict(int level, const Vector<Value>& r, const ExecutionContext& context);
  /// x_l = P_l x_{l+1}.
  void Prolong(int level, const ExecutionContext& context);
  /// x_l += P_l x_{l+1}.
  void Correct(int level, const ExecutionContext& context);
  /// x_0 = P_0 ... P_{l-1} x_l; all finer iterates are overwritten.
  void ProlongToFinest(int level, const ExecutionContext& context);
  /// x = A^-1 b on the coarsest level, by the hierarchy's factor.
  void SolveCoarsest();
  /// Sweeps of A x = b on a level from its x, as they follow a coarse correction.
  void Sweep(int level, const ExecutionContext& context);
  /// One V-cycle from a level down: an approximate solution of A x = b, from x = 0. Right-hand sides of coarser levels are
  /// overwritten.
  void Cycle(int level, const ExecutionContext& context);

  /// Held by this object.
  long long Bytes() const;

private:
  void LoadScaling(const Vector<double>& scale);
  void MakeSmoothers();

  GalerkinHierarchy<Scalar>& Hierarchy;
  const std::optional<SmootherOptions> Sweeps;
  const int FinestFactor;
  std::vector<Level> Levels;
  std::vector<std::unique_ptr<Smoother<Value>>> Smoothers; ///< none for the coarsest level
  std::vector<int> CallersOrder;                           ///< [k] is the caller's index of place k on the finest level
  Vector<Real> FinestScale;                                ///< D^{-1/2} by place
  Vector<Scalar> CoarsestRightHandSide;
  Vector<Scalar> CoarsestSolution;
};

}

#endif
