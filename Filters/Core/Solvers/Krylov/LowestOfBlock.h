#ifndef dmgLowestOfBlock_h
#define dmgLowestOfBlock_h

#include "Solvers/Krylov/LowestEigenvectors.h"

namespace dmg
{

/// The lowest eigenvector of one part by LOBPCG with a block of vectors (Knyazev 2001). Eigenvalues that are close to the
/// lowest one, as the two sides of a thin plate have them, hold up an iteration with one vector; in a block, what counts is
/// the distance to the first eigenvalue that is not in it.
/// \param part its number in problem.Parts.
/// \param x a start in the unknowns of the part, not zero; on exit x^T M x = 1. Other unknowns stay as they are.
/// \param theta on exit the eigenvalue.
/// \return the residual, as FindLowestEigenvectors measures it. It is at most \p stop.RelativeTolerance, unless the limit of
///   iterations is reached.
/// \throw Cancelled
/// Cost per iteration: those of FindLowestEigenvectors, times the eight vectors of the block.
double FindLowestOfBlock(const EigenProblem& problem, int part, const StoppingCriteria& stop, Vector<double>& x,
  double& theta, const ExecutionContext& context);

}

#endif
