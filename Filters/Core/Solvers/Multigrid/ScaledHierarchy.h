#ifndef dmgScaledHierarchy_h
#define dmgScaledHierarchy_h

#include "Solvers/Multigrid/GalerkinHierarchy.h"
#include "Solvers/Multigrid/Smoother.h"

#include <vector>

namespace dmg
{

/// The levels of a Galerkin hierarchy for smoothers: scaled to unit diagonal, in a SweepOrder, in numbers of type Value.
/// Gauss-Seidel is invariant under the scaling, and single precision does not overflow.
///
/// With D the diagonal of A_l, a level's unknowns are D^{1/2} x and its right-hand sides D^{-1/2} b.
/// Inactive unknowns have empty rows and columns everywhere.
///
/// Each level has a right-hand side b and an iterate x for its users to work with.
template <class Scalar, class Value>
class ScaledHierarchy
{
  using Real = typename Eigen::NumTraits<Value>::Real;

public:
  struct Level
  {
    TriangularParts<Value> A; ///< empty on the coarsest level, and without matrices
    Vector<Value> b;
    Vector<Value> x;

  private:
    friend class ScaledHierarchy;
    std::vector<int> Order; ///< [k] is the unknown of the hierarchy at place k
    SparseMatrix<Value> P;  ///< from the next coarser level to this
    SparseMatrix<Value> R;  ///< P^H
  };

  enum class Content
  {
    Transfers,         ///< P and R only
    MatricesForSweeps, ///< also A, in an order of each level's own
  };

  /// \param hierarchy must outlive this object; its matrices may be forgotten.
  ScaledHierarchy(GalerkinHierarchy<Scalar>& hierarchy, Content content, const ExecutionContext& context);

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

  /// Held by this object.
  long long Bytes() const;

private:
  void LoadScaling(const Vector<double>& scale);

  GalerkinHierarchy<Scalar>& Hierarchy;
  const bool HasMatrices;
  std::vector<Level> Levels;
  std::vector<int> CallersOrder; ///< [k] is the caller's index of place k on the finest level
  Vector<Real> FinestScale;      ///< D^{-1/2} by place
  Vector<Scalar> CoarsestRightHandSide;
  Vector<Scalar> CoarsestSolution;
};

}

#endif
