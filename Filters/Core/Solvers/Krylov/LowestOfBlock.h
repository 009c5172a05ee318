#ifndef dmgLowestOfBlock_h
#define dmgLowestOfBlock_h

#include "Solvers/Krylov/LowestEigenvectors.h"

#include <vector>

namespace dmg
{

/// The end of FindLowestOfBlocks on a part.
struct LowestOfPart
{
  double Residual; ///< as FindLowestEigenvectors measures it
  /// Whether it is at most the tolerance, or held up by rounding errors at an error of x below 1e-4 in M; else the limit of
  /// iterations is reached.
  bool IsSolved;
};

/// The lowest eigenvectors of some parts by LOBPCG with a block of vectors for each (Knyazev 2001). With one vector, LOBPCG is slow
/// if the two lowest eigenvalues are close, as on a thin plate. With a block, the distance to the first eigenvalue beyond the block
/// counts.
/// \param parts their numbers in problem.Parts.
/// \param x a start in the unknowns of these parts, not zero; on exit x^T M x = 1. Other unknowns stay as they are.
/// \param theta by part of the problem; on exit the eigenvalues of these parts.
/// \throw Cancelled
/// Cost per iteration: those of FindLowestEigenvectors, times the eight vectors of a block, for all parts together.
std::vector<LowestOfPart> FindLowestOfBlocks(const EigenProblem& problem, const std::vector<int>& parts,
  const StoppingCriteria& stop, Vector<double>& x, std::vector<double>& theta, const ExecutionContext& context);

}

#endif
