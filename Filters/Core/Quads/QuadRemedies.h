#ifndef dmgQuadRemedies_h
#define dmgQuadRemedies_h

#include "Solvers/Direct/CholeskySolver.h"
#include "Support/Errors.h"
#include "Support/Remedy.h"

namespace dmg
{

/// Calls a function that makes quads, which have no choice of a solver.
/// \throw SolverFailure memory is not enough for a factor; with a remedy that quads have.
template <class Make>
auto WithRemedyOfQuads(const Make& make)
{
  try
  {
    return make();
  }
  catch (const FactorDoesNotFit&)
  {
    throw SolverFailure("the factors of quads do not fit into memory; " + TextOf(Remedy::FewerTriangles));
  }
}

}

#endif
