#ifndef dmgUnprescribedComponents_h
#define dmgUnprescribedComponents_h

#include "Solvers/Krylov/LinearOperator.h"
#include "Solvers/Krylov/Preconditioner.h"
#include "Solvers/Krylov/SolveReport.h"
#include "Solvers/Krylov/StoppingCriteria.h"
#include "Solvers/MultigridSetup.h"
#include "Support/CountingSort.h"
#include "Support/ExecutionContext.h"
#include "Support/Types.h"

#include <vector>

namespace dmg
{

/// The end of an iteration for the smoothest field: a residual of 1e-6, or three times \p maximumIterations.
StoppingCriteria StopOfSmoothest(int maximumIterations);

/// The multiple of the mass that is about the lowest eigenvalue of a component. A surface of size L has eigenvalues from about
/// 1 / L^2 to 1 / h^2, where the diagonal is. The areas h^2 of its triangles sum to L^2. Triangles that are much smaller than
/// others, as on the rim of a thin plate, add little to the sum.
/// \param sumOfMassOverStiffness over the unknowns of the component, of the mass over the diagonal of R.
double ShiftOfSmoothest(double sumOfMassOverStiffness);

/// Components of a surface without prescriptions. There the solution is the smoothest field of unit norm: the eigenvector of
/// the lowest eigenvalue of R in the mass of the set-up (Knoeppel et al. 2013), or a harmonic field, of eigenvalue zero.
///
/// In a system R + D they have as D a small multiple of the mass, about the lowest eigenvalue: R + D is positive definite, has
/// the eigenvectors of R, and eigenvalues that are so much larger. Its cycle is the eigensolver's preconditioner.
/// All is in the order of the hierarchy.
class UnprescribedComponents
{
public:
  /// None.
  UnprescribedComponents() = default;
  /// \param setup is borrowed.
  /// \param unknowns of these components, each of which has an area.
  UnprescribedComponents(
    const MultigridSetup& setup, const std::vector<int>& unknowns, const ExecutionContext& context);

  const std::vector<int>& Unknowns() const { return this->ByComponent.Items; }

  /// Writes the multiple of the mass for these unknowns.
  void SetDiagonal(Vector<double>& D) const;

  /// Writes the fields into x, with a mean square magnitude of 1 and to a relative residual of 1e-6.
  /// \param A R + D, \param inverse close to its inverse.
  /// \param start of the iteration, or empty. It ends after three times \p maximumIterations.
  /// \param report is added to: eigenvalues, in 1 / length^2, seconds, convergence and warnings.
  /// \return the history of the iteration.
  std::vector<IterationReport> FindSmoothest(const LinearOperator<double>& A, Preconditioner<double>& inverse,
    Vector<double> start, int maximumIterations, Vector<double>& x, SolveReport& report,
    const ExecutionContext& context) const;

private:
  /// The share of the surface that a component has.
  double ShareOf(std::size_t component) const;

  const MultigridSetup* Setup = nullptr;
  SortedItems ByComponent;    ///< unknowns; components with prescriptions have none
  std::vector<double> Shifts; ///< of eigenvalues, by component
};

}

#endif
