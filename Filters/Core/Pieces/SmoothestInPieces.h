#ifndef dmgSmoothestInPieces_h
#define dmgSmoothestInPieces_h

#include "Pieces/PetscMultigrid.h"
#include "Pieces/Ranks.h"
#include "Solvers/Krylov/SolveReport.h"
#include "Support/CountingSort.h"
#include "Support/ExecutionContext.h"
#include "Support/Types.h"

#include <vector>

namespace dmg
{

/// Components of a surface in pieces that no constraint holds. There a power field is the smoothest one of unit norm, as
/// UnprescribedComponents says: the same multiple of the mass in the system, and the same iteration over all ranks.
/// All functions are collective, but for AddShifts.
class SmoothestInPieces
{
public:
  /// None.
  explicit SmoothestInPieces(const Ranks& ranks)
    : All(&ranks)
  {
  }
  /// \param components per owned vertex the number of its component among those, or -1.
  /// \param number of them over all ranks.
  /// \param stiffness the diagonal of the Laplacian, \param mass of owned vertices, over the mean of all.
  SmoothestInPieces(const Ranks& ranks, const std::vector<int>& components, int number, const Vector<double>& stiffness,
    const Vector<double>& mass);

  int NumberOfComponents() const { return static_cast<int>(this->Shifts.size()); }

  /// Adds the multiple of the mass to the diagonal of these vertices.
  void AddShifts(Vector<double>& D) const;

  /// Writes the fields into x, with a mean square magnitude of 1.
  /// \param system with the shifts. \param x of owned vertices.
  /// \param former the field of another time to start from, zero: none; on exit this one, zero elsewhere.
  /// \param meanMass of a vertex, an area.
  /// \param report is added to: eigenvalues, in 1 / length^2, seconds, convergence and warnings.
  /// \return the history of the iteration.
  std::vector<IterationReport> Find(PetscMultigrid& system, double meanMass, int maximumIterations,
    Vector<Complex>& former, Vector<Complex>& x, SolveReport& report, const ExecutionContext& context) const;

private:
  const Ranks* All;
  Vector<double> Mass;
  SortedItems ByComponent;    ///< real unknowns, two to a vertex
  std::vector<double> Shifts; ///< of eigenvalues, by component
  std::vector<double> Masses; ///< of components
};

}

#endif
