#ifndef dmgLowestEigenvectors_h
#define dmgLowestEigenvectors_h

#include "Solvers/Krylov/LinearOperator.h"
#include "Solvers/Krylov/Preconditioner.h"
#include "Solvers/Krylov/SolveReport.h"
#include "Solvers/Krylov/StoppingCriteria.h"
#include "Support/CountingSort.h"
#include "Support/ExecutionContext.h"
#include "Support/SumOverProcesses.h"
#include "Support/Types.h"

#include <vector>

namespace dmg
{

/// A x = theta M x for the lowest theta, in each of some parts of a matrix that nothing couples.
struct EigenProblem
{
  /// Symmetric positive definite.
  const LinearOperator<double>& A;
  /// Close to the inverse of A.
  Preconditioner<double>& Inverse;
  /// The diagonal of M, > 0, one per unknown or per pair of consecutive ones.
  const Vector<double>& Mass;
  /// Unknowns by part; those in none are zero.
  const SortedItems& Parts;
  /// All processes have the same number of parts, and each has its unknowns of them.
  dmg::SumOverProcesses SumOverProcesses = {};

  /// Unknowns that share a mass.
  int UnknownsPerMass(Eigen::Index unknowns) const
  {
    return this->Mass.size() > 0 ? static_cast<int>(unknowns / this->Mass.size()) : 1;
  }
  /// Sums numbers, or structs and matrices of them.
  void Sum(double* numbers, std::size_t size) const
  {
    if (this->SumOverProcesses)
    {
      this->SumOverProcesses(numbers, static_cast<int>(size));
    }
  }
};

/// The eigenvectors of lowest eigenvalues by the locally optimal preconditioned conjugate gradient method, LOBPCG (Knyazev
/// 2001), with a vector for each part: the least Rayleigh quotient in the span of x, the preconditioned residual w
/// and the last step p. Where an eigenvalue is multiple, which of its vectors comes out depends on the start.
///
/// The residual in the history is the largest sqrt(r^T B r / theta) of all parts, with r = A x - theta M x for x^T M x = 1
/// and the preconditioner B: about the relative error of x in the energy norm, times the relative distance of theta to the
/// next eigenvalue. The relative error of theta is about its square.
/// \param x a start, which parts without one (zero) take from a fixed sequence of pseudo-random numbers; on exit x^T M x =
///   1 in each part.
/// \param report its Iterations (with the sum of all theta as Energy), SolveSeconds, Converged and Warnings.
/// \return theta of each part.
/// \throw Cancelled
/// A part that has not converged after all iterations, if these are 100 or more, continues with FindLowestOfBlocks, recorded as
/// one more iteration.
/// Cost per iteration: one application of B, one product with A and about fifteen passes over a vector.
std::vector<double> FindLowestEigenvectors(const EigenProblem& problem, const StoppingCriteria& stop, Vector<double>& x,
  SolveReport& report, const ExecutionContext& context);

}

#endif
