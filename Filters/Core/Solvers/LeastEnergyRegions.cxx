#include "Solvers/LeastEnergyRegions.h"

#include "Support/Permutations.h"

#include <utility>

namespace dmg
{

LeastEnergyRegions::Region::Region(Subdomain unknowns)
  : Unknowns(std::move(unknowns))
  , Factor(this->Unknowns.Matrix(), FillOrdering::AMD, FactorKind::Simplicial)
{
}

LeastEnergyRegions::LeastEnergyRegions(
  const SparseMatrix<double>& Bt, const UnknownBlocks& regions, const ExecutionContext& context)
  : Regions(regions.Size())
{
  if (this->IsEmpty())
  {
    return;
  }
  context.ParallelFor(0, regions.Size(), 1, [&](int first, int last) {
    for (int k = first; k < last; ++k)
    {
      const auto unknowns = regions.Unknowns.begin();
      this->Regions[k] = std::make_unique<Region>(Subdomain(Bt,
        std::vector<int>(unknowns + regions.Offsets[k], unknowns + regions.Offsets[k + 1])));
    }
  });
  std::vector<int> rows;
  std::vector<int> regionOf; // of each of them
  for (int k = 0; k < regions.Size(); ++k)
  {
    const std::vector<int>& own = (*this)[k].Rows;
    rows.insert(rows.end(), own.begin(), own.end());
    regionOf.insert(regionOf.end(), own.size(), k);
  }
  this->RegionsOfRows = SortByKey(Identity(static_cast<int>(rows.size())), static_cast<int>(Bt.cols()),
    [&rows](int k) { return rows[k]; }, context);
  for (int& item : this->RegionsOfRows.Items)
  {
    item = regionOf[item];
  }
  this->AreNear.resize(Bt.rows());
  constexpr int grain = 8192;
  context.ParallelFor(0, static_cast<int>(Bt.rows()), grain, [&](int first, int last) {
    for (int i = first; i < last; ++i)
    {
      char isNear = 0;
      for (int e = Bt.outerIndexPtr()[i]; e < Bt.outerIndexPtr()[i + 1]; ++e)
      {
        this->VisitRegions(Bt.innerIndexPtr()[e], [&isNear](int) { isNear = 1; });
      }
      this->AreNear[i] = isNear;
    }
  });
}

void LeastEnergyRegions::Solve(int k, const Columns& b, Columns& x) const
{
  Region& region = *this->Regions[k];
  const std::lock_guard<std::mutex> lock(region.OneAtATime); // the factor has one workspace
  region.Factor.Solve(b, x);
}

}
