#ifndef dmgConvergenceMeasure_h
#define dmgConvergenceMeasure_h

#include "Solvers/Krylov/SolveReport.h"
#include "Support/ExecutionContext.h"
#include "Support/Types.h"

namespace dmg
{

/// Measures of an iterate x of A x = b beside its residual r = b - A x. Handed
/// to a solver, it fills the columns of the history that are NaN otherwise. Solvers borrow it.
///
/// Thesis, section 6.4, calls MassResidual the normalized L2 energy and Error the normalized L2
/// error. The former is no energy: after coarse prolongation it is above one in the thesis's
/// tables, where a minimum over a space that holds zero cannot be. Energy is what x minimises.
///
/// Cost: about three passes over a vector per row. It does not count in the solve time.
template <class Scalar>
struct ConvergenceMeasure
{
  /// The energy of x = 0, so that a sum of squares |C x - d|^2 has the constant |d|^2.
  double EnergyConstant = 0.0;
  /// The number that the equations were divided by.
  double EnergyScale = 1.0;
  /// Diagonal of M, > 0, one per unknown or per pair of consecutive ones, borrowed; null for ones.
  /// |x|_M^2 = x^H M x.
  const Vector<double>* Mass = nullptr;
  /// The offset where the solver is given A x = b - A Offset: all is about x + Offset then. Both are borrowed; null for none.
  const Vector<Scalar>* Offset = nullptr;
  const Vector<Scalar>* RightHandSide = nullptr; ///< b
  /// The solution by other means, one value per unknown; empty if there is none, then Error is NaN.
  Vector<Scalar> Reference;
  /// Full multigrid leaves a level after the first sweep that lowers Error by less than this fraction of it (thesis, section
  /// 6.5.2). Zero: after SweepOptions::Sweeps, which is else the limit. \pre a Reference, if not zero.
  double LeastImprovement = 0.0;

  /// \throw InvalidInput sizes differ.
  void Check(int numberOfUnknowns) const;

  /// |x - Reference|_M / |Reference|_M.
  /// \pre Reference is not empty.
  double Error(const Vector<Scalar>& x, const ExecutionContext& context) const;

  /// Energy = constant + scale (x^H A x - 2 Re x^H b) = constant - scale Re x^H (b + r), MassResidual
  /// and Error.
  void Fill(IterationReport& row, const Vector<Scalar>& x, const Vector<Scalar>& b, const Vector<Scalar>& r,
    const ExecutionContext& context) const;
};

}

#endif
