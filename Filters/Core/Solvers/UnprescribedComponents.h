#ifndef dmgUnprescribedComponents_h
#define dmgUnprescribedComponents_h

#include "Solvers/Krylov/LinearOperator.h"
#include "Solvers/Krylov/Preconditioner.h"
#include "Solvers/Krylov/SolveReport.h"
#include "Solvers/Krylov/StoppingCriteria.h"
#include "Solvers/MultigridSetup.h"
#include "Support/CountingSort.h"
#include "Support/ExecutionContext.h"
#include "Support/SumOverProcesses.h"
#include "Support/Types.h"

#include <functional>
#include <vector>

namespace dmg
{

/// The data of smoothest fields, besides the matrix. Of several processes each has some unknowns; components and sizes are those of
/// all processes together.
struct MeasureOfFields
{
  const Vector<double>& Mass; ///< borrowed; the same for so many consecutive unknowns each:
  int UnknownsPerMass = 1;
  std::function<double(int unknown)> DiagonalOf; ///< of R
  std::function<int(int unknown)> ComponentOf;
  int NumberOfComponents = 1;
  double TotalMass = 1.0;         ///< the sum of Mass
  double SquaredNormOfUnit = 1.0; ///< in Mass, of a field of magnitude 1
  double Area = 1.0;              ///< of the surface
  dmg::SumOverProcesses SumOverProcesses = {};
};

/// Components of a surface without prescriptions. There the solution is the smoothest field of unit norm: the eigenvector of
/// the lowest eigenvalue of R in the mass of the set-up (Knoeppel et al. 2013), or a harmonic field, of eigenvalue zero.
///
/// In a system R + D they have as D a small multiple of the mass, about the lowest eigenvalue: R + D is positive definite, has
/// the eigenvectors of R, and eigenvalues that are so much larger. Its cycle is the eigensolver's preconditioner.
/// All is in the order of the hierarchy. Over several processes the second constructor and FindSmoothest are collective.
class UnprescribedComponents
{
public:
  /// None.
  UnprescribedComponents() = default;
  /// \param setup is borrowed.
  /// \param unknowns of these components, each of which has an area.
  UnprescribedComponents(
    const MultigridSetup& setup, const std::vector<int>& unknowns, const ExecutionContext& context);
  UnprescribedComponents(
    const MeasureOfFields& measure, const std::vector<int>& unknowns, const ExecutionContext& context);

  const std::vector<int>& Unknowns() const { return this->ByComponent.Items; }
  /// Whether a component, of any process, has unknowns.
  bool AreAny() const;

  /// Writes the multiple of the mass for these unknowns.
  void SetDiagonal(Vector<double>& D) const;

  /// A start for FindSmoothest from the first coarse level of a cycle for R + D; zero where it has none.
  Vector<double> StartFrom(StiffnessCycle& cycle, const ExecutionContext& context) const;

  /// Writes the fields into x, with a mean square magnitude of 1.
  /// \param A R + D, \param inverse close to its inverse.
  /// \param start of the iteration; zero on a component: one of pseudo-random numbers.
  /// \param stop the tolerance and the iterations that a solve with constraints would have. The residual falls to a hundredth of the
  ///   tolerance, 1e-8 at least, in three times as many iterations at most.
  /// \param report is added to: eigenvalues, in 1 / length^2, seconds, convergence and warnings.
  /// \return the history of the iteration.
  std::vector<IterationReport> FindSmoothest(const LinearOperator<double>& A, Preconditioner<double>& inverse,
    Vector<double> start, const StoppingCriteria& stop, Vector<double>& x, SolveReport& report,
    const ExecutionContext& context) const;

private:
  double MassOf(int unknown) const { return (*this->Mass)[unknown / this->UnknownsPerMass]; }

  const Vector<double>* Mass = nullptr;
  int UnknownsPerMass = 1;
  SortedItems ByComponent;        ///< unknowns; components with prescriptions have none
  std::vector<double> Shifts;     ///< of eigenvalues, by component
  std::vector<double> Lengths;    ///< the norms of unit fields, by component; zero where there are no unknowns
  double SquaredNormOfUnit = 1.0; ///< over Area, the unit in which eigenvalues are reported
  double Area = 1.0;
  dmg::SumOverProcesses SumOverProcesses;
};

}

#endif
