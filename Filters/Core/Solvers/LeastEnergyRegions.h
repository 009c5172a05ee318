#ifndef dmgLeastEnergyRegions_h
#define dmgLeastEnergyRegions_h

#include "Solvers/CholeskySolver.h"
#include "Solvers/Subdomain.h"
#include "Solvers/UnknownBlocks.h"
#include "Support/CountingSort.h"
#include "Support/ExecutionContext.h"
#include "Support/Types.h"

#include <memory>
#include <mutex>
#include <vector>

namespace dmg
{

/// Regions of a sum of squares |B x|^2 where coarse functions take the values of least energy that go with their
/// values around: discrete harmonic extension, as in the coarse spaces of Dohrmann, Klawonn and Widlund (2008).
///
/// Inside of needles no interpolation comes near to what fields of little energy do, and no polynomial in B^T B mends it.
/// The energy of a single needle that a coarse function crosses then keeps the whole coarse correction too small.
class LeastEnergyRegions
{
public:
  /// None.
  LeastEnergyRegions() = default;
  /// \param Bt B^T, a row per unknown. \param regions sets of unknowns that share none.
  /// \throw SolverFailure memory ran out.
  /// Cost: a sparse Cholesky factorisation per region.
  LeastEnergyRegions(
    const SparseMatrix<double>& Bt, const UnknownBlocks& regions, const ExecutionContext& context);

  bool IsEmpty() const { return this->Regions.empty(); }
  const Subdomain& operator[](int region) const { return this->Regions[region]->Unknowns; }

  /// Whether a region knows of a row of B that this unknown touches.
  bool IsNear(int unknown) const { return this->AreNear[unknown] != 0; }
  /// Calls visit(region) for those that know of a row of B.
  template <class Visit>
  void VisitRegions(int row, const Visit& visit) const
  {
    for (int k = this->RegionsOfRows.Begins[row]; k < this->RegionsOfRows.Begins[row + 1]; ++k)
    {
      visit(this->RegionsOfRows.Items[k]);
    }
  }

  /// The values x on a region, one column per function, with B^T B x = b there. Threads may call it for the same region.
  using Columns = CholeskySolver<double>::Columns;
  void Solve(int region, const Columns& b, Columns& x) const;

private:
  struct Region
  {
    explicit Region(Subdomain unknowns);
    Subdomain Unknowns;
    CholeskySolver<double> Factor;
    std::mutex OneAtATime;
  };

  std::vector<std::unique_ptr<Region>> Regions;
  SortedItems RegionsOfRows;
  std::vector<char> AreNear; ///< by unknown
};

}

#endif
