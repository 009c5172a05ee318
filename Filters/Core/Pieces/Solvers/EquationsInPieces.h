#ifndef dmgEquationsInPieces_h
#define dmgEquationsInPieces_h

#include "Operators/FunctionSource.h"
#include "Pieces/Solvers/SetupInPieces.h"
#include "Solvers/Krylov/SolveReport.h"
#include "Solvers/Krylov/StoppingCriteria.h"
#include "Solvers/UnprescribedComponents.h"

#include <optional>
#include <vector>

namespace dmg
{

/// The equations (R + D) x = D y + f of the unknowns that a rank owns, as HarmonicProblem has them for a whole surface. Components
/// without constraints have the smoothest field (UnprescribedComponents). Where there is none, and f is zero, x is zero.
/// All functions are collective, but for the comparisons.
class EquationsInPieces
{
public:
  /// \param setup is borrowed.
  /// \param atOwned ConstraintsAtOwned. \param source SourceAtOwned.
  /// \param net the treatment of a source that does not sum to zero on a component without values.
  /// \throw InvalidInput what is prescribed holds nothing, a function has no value and no source on any rank, a source is to be refused,
  ///   or as CheckWeights.
  EquationsInPieces(const SetupInPieces& setup, const std::vector<PowerAtVertex>& atOwned, Vector<double> source,
    NetSource net, const FieldWeights& weights);

  bool HasSameMatrix(const EquationsInPieces& other) const
  {
    return this->D == other.D && this->IsFixed == other.IsFixed;
  }
  bool HasSameValues(const EquationsInPieces& other) const
  {
    return this->Known == other.Known && this->Source.size() == other.Source.size() && this->Source == other.Source;
  }

  /// Brings the matrix to the multigrid of the set-up. \throw as PetscMultigrid::SetPenalties
  void SetMatrix(const ExecutionContext& context) const;

  /// \pre the last SetMatrix was of the same matrix.
  /// \param smoothest the field on components without constraints, of the last solve and on exit of this one, where it starts. It consists
  ///   of pairs, and is empty in the beginning.
  /// \return the owned unknowns. \throw as PetscMultigrid::Solve
  Vector<Complex> Solve(Vector<double>& smoothest, const StoppingCriteria& stop, SolveReport& report,
    const ExecutionContext& context) const;

private:
  /// \return the owned vertices that a constraint holds.
  std::vector<int> Prescribe(const std::vector<PowerAtVertex>& atOwned, const FieldWeights& weights);
  void BalanceSource(NetSource net, double smoothness);
  void FillUnprescribed();
  Vector<Complex> RightHandSide() const;
  void FindSmoothest(Vector<double>& smoothest, const StoppingCriteria& stop, Vector<Complex>& x, SolveReport& report,
    const ExecutionContext& context) const;

  const SetupInPieces& Setup;
  Vector<double> D;
  std::vector<char> IsFixed;    ///< by hard constraints, or since a constant is free
  Vector<Complex> Known;        ///< values that are fixed, and the diagonal solution elsewhere
  Vector<double> Source;        ///< f
  Vector<double> AreasOfSource; ///< the integrals of 1
  bool HasSource = false;       ///< on some rank
  bool IsPrescribed = false;    ///< on some rank, by constraints or a source
  std::optional<FreeComponents> Free;
  UnprescribedComponents Smoothest;
  long long NumberOfZero = 0; ///< components
};

}

#endif
