#ifndef dmgRegionSmoother_h
#define dmgRegionSmoother_h

#include "Solvers/CholeskySolver.h"
#include "Solvers/SplitMatrix.h"
#include "Solvers/UnknownBlocks.h"
#include "Support/ExecutionContext.h"
#include "Support/Types.h"

#include <cmath>
#include <optional>
#include <vector>

namespace dmg
{

/// Some unknowns of a Hermitian matrix that no entry couples with those of another region.
struct MatrixRegion
{
  std::vector<int> Unknowns; ///< ascending
  SparseMatrix<Complex> A;   ///< the matrix on them; every diagonal entry is in the pattern

  long long Bytes() const;
};

/// \param places the index of each unknown of \p regions in a matrix that has rows and columns in another order, by
///   which the result names it. \param order the inverse: row k of the other matrix is row order[k] of \p A.
std::vector<MatrixRegion> RegionsOf(const SparseMatrix<Complex>& A, const UnknownBlocks& regions,
  const std::vector<int>& places, const std::vector<int>& order);

/// Solves L + D on regions, next to the coarse correction, for a Hermitian L of few entries per row and a diagonal D. Where
/// triangles are needles, L couples unknowns along them so much less than across that Gauss-Seidel and coarse levels leave
/// errors between them. Same bits for any number of threads.
class RegionSmoother
{
public:
  using Single = SplitMatrix::Single;

  /// All arguments are borrowed and must stay where they are. SetDiagonal comes next.
  RegionSmoother(const SplitMatrix& L, const std::vector<MatrixRegion>& regions);

  /// \param D two equal entries per unknown, >= 0. Infinite: the unknown is zero.
  /// \throw SolverFailure memory ran out.
  /// Cost: a sparse Cholesky factorisation per region; ordered and analysed the first time only.
  void SetDiagonal(const Vector<double>& D, const ExecutionContext& context);

  /// Solves on each region for what is left over.
  /// \param r in and out b - A x. \pre It is zero where unknowns are held.
  void PreSmooth(Vector<Single>& r, Vector<Single>& x, const ExecutionContext& context);

  /// Solves A x = b on each region from the given x: the adjoint of PreSmooth.
  /// \pre x is zero where unknowns are held.
  void PostSmooth(const Vector<Single>& b, Vector<Single>& x, const ExecutionContext& context);

  /// Held by this object, without the regions.
  long long Bytes() const;

private:
  /// What a region has of its own.
  struct State
  {
    Vector<double> D; ///< of its unknowns
    std::optional<CholeskySolver<Complex>> Factor;
    Vector<Complex> Residual;
    Vector<Complex> Step;
  };

  SparseMatrix<Complex> MatrixOf(int region) const;
  /// x += what solves for the residuals, residualOf(unknown, its D), on each region.
  template <class ResidualOf>
  void Solve(const ResidualOf& residualOf, Vector<Single>& x, const ExecutionContext& context);

  const SplitMatrix& L;
  const std::vector<MatrixRegion>& Regions;
  std::vector<State> States;
  std::vector<int> Begins;       ///< of regions among the unknowns of all
  Vector<Single> Steps;          ///< of these
  std::vector<int> Around;       ///< unknowns that L couples with some of a region, but in none
  SparseMatrix<Single> Coupling; ///< of these, with the unknowns of all regions
  std::vector<char> AreAroundHeld;
};

}

#endif
