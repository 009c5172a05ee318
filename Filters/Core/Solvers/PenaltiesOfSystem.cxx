#include "Solvers/PenaltiesOfSystem.h"

#include "Support/Permutations.h"

#include <algorithm>

namespace dmg
{

double LimitedPenalty(double penalty, double diagonalOfR)
{
  constexpr double Strongest = 1e13;
  return diagonalOfR > 0.0 ? std::min(penalty, Strongest * diagonalOfR) : penalty;
}

Vector<double> InverseDiagonal(
  const RoughnessHierarchy& hierarchy, const Vector<double>& D, const ExecutionContext& context)
{
  constexpr int Grain = 8192;
  Vector<double> inverse(D.size());
  context.ParallelFor(0, static_cast<int>(D.size()), Grain, [&](int first, int last) {
    for (int i = first; i < last; ++i)
    {
      const double diagonal = hierarchy.DiagonalOf(i) + D[i];
      inverse[i] = diagonal > 0.0 ? 1.0 / diagonal : 0.0;
    }
  });
  return inverse;
}

std::vector<int> PlacesOf(
  const std::vector<int>& items, const std::vector<int>& order, const ExecutionContext& context)
{
  const std::vector<int> all = Inverse(order, context);
  std::vector<int> places;
  places.reserve(items.size());
  for (const int item : items)
  {
    places.push_back(all[item]);
  }
  return places;
}

std::string WarningAboutUnreached(int unreached, int unknowns)
{
  if (unreached == 0)
  {
    return {};
  }
  return std::to_string(unreached) + " of " + std::to_string(unknowns) +
    " unknowns lie in components of the surface that hold no prescribed direction; the field is "
    "zero there";
}

}
