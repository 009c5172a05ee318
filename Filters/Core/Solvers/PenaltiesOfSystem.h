#ifndef dmgPenaltiesOfSystem_h
#define dmgPenaltiesOfSystem_h

#include "Solvers/Multigrid/RoughnessHierarchy.h"
#include "Support/ExecutionContext.h"
#include "Support/Types.h"

#include <string>
#include <vector>

/// The diagonal D of a system R + D. Unknowns are in the order of the hierarchy.
namespace dmg
{

/// A penalty of at most 1e13 times the diagonal of R, if that is not zero: it holds its unknown to rounding, and a stronger
/// one would drown the rest of the system in rounding errors.
double LimitedPenalty(double penalty, double diagonalOfR);

/// 1 / (R_ii + D_i), zero where unknowns are held or neither is there.
Vector<double> InverseDiagonal(
  const RoughnessHierarchy& hierarchy, const Vector<double>& D, const ExecutionContext& context);

/// Where some items stand in an order.
std::vector<int> PlacesOf(
  const std::vector<int>& items, const std::vector<int>& order, const ExecutionContext& context);

/// One sentence for the user where no prescription reaches some unknowns, else empty.
std::string WarningAboutUnreached(int unreached, int unknowns);

}

#endif
