#ifndef dmgPrescribedSystem_h
#define dmgPrescribedSystem_h

#include "Solvers/Multigrid/StiffnessHierarchy.h"
#include "Solvers/MultigridSetup.h"
#include "Solvers/Penalties.h"
#include "Solvers/UnprescribedComponents.h"
#include "Support/ExecutionContext.h"
#include "Support/Types.h"

#include <memory>
#include <string>
#include <vector>

namespace dmg
{

/// Equations A x = b, for a solver of the caller's own.
struct LinearSystem
{
  SparseMatrix<double> Matrix; ///< symmetric positive semi-definite
  Vector<double> RightHandSide;
};

/// The equations of a HarmonicProblem, (R + D) x = D y, without a solver. Vectors are in the order of the hierarchy, and all is
/// divided by the smoothness weight.
class PrescribedSystem
{
public:
  explicit PrescribedSystem(std::shared_ptr<const MultigridSetup> setup);

  /// Takes other prescriptions. After an error the system must not be used.
  /// \throw InvalidInput none holds anything.
  void Prescribe(Penalties prescribed, double smoothness, const ExecutionContext& context);

  const MultigridSetup& Setup() const { return *this->SetupOfSystem; }
  double Smoothness() const { return this->SmoothnessWeight; }
  int NumberOfPrescribed() const { return static_cast<int>(this->Prescribed.Unknowns.size()); }

  /// A = R + D.
  const StiffnessOperator& Matrix() const { return *this->A; }
  /// D, infinite where an unknown is held. Each call computes it, as operators and cycles keep their own form.
  Vector<double> Diagonal() const;
  /// Unknowns that are not free, ascending.
  const std::vector<int>& Held() const { return this->HeldUnknowns; }
  const UnprescribedComponents& Unprescribed() const { return this->WithoutPrescriptions; }
  /// One sentence for the user, or none.
  const std::vector<std::string>& Warnings() const { return this->WarningsOfSystem; }

  /// D y or, of hard prescriptions, -R y; zero where unknowns are held.
  /// \param values y, one per prescribed unknown.
  Vector<double> RightHandSide(const Vector<double>& values, const ExecutionContext& context) const;
  /// The initial guess: the diagonal solution D y / (R + D), with the diagonal of R. Without it, strong penalties would
  /// dominate the residual.
  Vector<double> HeldByPenalties(const Vector<double>& values) const;
  /// (R + D) x = D y with a matrix, in the caller's order. An unknown that is held has the row and the column of the identity,
  /// and its value on the right. On components without prescriptions A is R, and b is zero.
  /// \param source added to D y, divided by s; in the caller's order, or empty for zero.
  LinearSystem Equations(
    const Vector<double>& values, const ExecutionContext& context, const Vector<double>& source = {}) const;
  /// Writes y where hard prescriptions are.
  void InsertHeld(const Vector<double>& values, Vector<double>& x) const;

private:
  bool IsHard() const { return this->Prescribed.Kind == ConstraintKind::Hard; }
  /// \return for each component whether a prescription holds some of it.
  std::vector<char> SetPenalties();
  void SetUnreached(const std::vector<int>& unreached, const ExecutionContext& context);

  const std::shared_ptr<const MultigridSetup> SetupOfSystem;
  const std::unique_ptr<StiffnessOperator> A;
  Penalties Prescribed;
  std::vector<int> Places; ///< of those
  Vector<double> Limited;  ///< D, of soft ones
  double SmoothnessWeight = 1.0;
  std::vector<int> HeldUnknowns;
  UnprescribedComponents WithoutPrescriptions;
  std::vector<std::string> WarningsOfSystem;
};

}

#endif
