#include "Solvers/SolveInUnits.h"

#include "Support/Errors.h"

#include <algorithm>
#include <cmath>

namespace dmg
{
namespace
{

/// The largest value is at least 2^k and less than 2^(k + 1).
int ExponentOf(const Vector<double>& values, const Vector<double>& source)
{
  const auto sizeOf = [](const Vector<double>& numbers)
  { return numbers.size() > 0 ? numbers.cwiseAbs().maxCoeff() : 0.0; };
  const double largest = std::max(sizeOf(values), sizeOf(source));
  return largest > 0.0 && std::isfinite(largest) ? std::ilogb(largest) : 0;
}

Vector<double> TimesPowerOfTwo(const Vector<double>& values, int exponent)
{
  return values.unaryExpr([exponent](double value) { return std::ldexp(value, exponent); });
}

}

Solution SolveInUnits(HarmonicProblem& problem, const Vector<double>& values, const Vector<double>& start,
  const StoppingCriteria& stop, const ExecutionContext& context, const Vector<double>& source)
{
  const int unit = ExponentOf(values, source);
  const Vector<double> unknowns = problem.Solve(
    TimesPowerOfTwo(values, -unit), TimesPowerOfTwo(start, -unit), {}, stop, context, TimesPowerOfTwo(source, -unit));
  Solution solution{ TimesPowerOfTwo(unknowns, unit), problem.Report() };
  if (!solution.Unknowns.allFinite())
  {
    throw UnexpectedFailure("the field is not finite");
  }
  for (IterationReport& row : solution.Report.Iterations)
  {
    row.Energy = std::ldexp(row.Energy, 2 * unit);
  }
  return solution;
}

}
