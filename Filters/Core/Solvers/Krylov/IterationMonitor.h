#ifndef dmgIterationMonitor_h
#define dmgIterationMonitor_h

#include "Solvers/Krylov/ConvergenceMeasure.h"
#include "Solvers/Krylov/LinearOperator.h"
#include "Solvers/Krylov/Preconditioner.h"
#include "Solvers/Krylov/SolveReport.h"
#include "Solvers/Krylov/StoppingCriteria.h"
#include "Support/ExecutionContext.h"
#include "Support/Types.h"

#include <chrono>
#include <string>

namespace dmg
{

/// The bookkeeping of iterative solvers of A x = b: start, history, best iterate, stopping. Call the methods in the order of
/// declaration.
///
/// Residuals r = b - A x are measured by the error e = x - A^-1 b that they mean: in the norm of the preconditioner B,
///
///   |r|_B = sqrt(r^H B r) ,   which is the energy norm |e|_A of the error where B is the inverse of A ,
///
/// relative to the energy norm |x|_A = sqrt(x^H (b - r)) of the iterate; 1 for x = 0. B r is what the next step
/// starts from, so measuring costs nothing but one application of B in the end. Until it is measured, a row has an
/// estimate: |r|_B is to the norm scaled by the diagonal of A as it was for the iterate before. Where r changes its direction
/// that may be wrong by any factor, above all if B is the factor of a matrix that is nearly singular.
///
/// An iteration has converged by a measured residual. Where StoppingCriteria::MayEstimate and that ratio changed by less than a
/// factor of two between the two rows before, the estimate is enough. With V-cycles it is the measured residual up to
/// a factor of 1.5.
///
/// x is the solver's iterate. The best one, with the smallest |r|_B, is kept as a copy: taking a step back instead would
/// lose digits where that step was a large one.
template <class Scalar>
class IterationMonitor
{
public:
  /// Empties the solver's part of the report and starts the clock. All arguments are borrowed.
  /// \param x the start, or empty for zero.
  /// \throw InvalidInput sizes differ, or b or x is not finite.
  /// \param measure of each row of the history, or null.
  IterationMonitor(const LinearOperator<Scalar>& A, Preconditioner<Scalar>& B, const Vector<Scalar>& b,
    const StoppingCriteria& stop, Vector<Scalar>& x, SolveReport& report, const ExecutionContext& context,
    const ConvergenceMeasure<Scalar>* measure);

  /// True for b = 0, which is solved by x = 0: all is done.
  bool IsTrivial() const { return this->NormOfB == 0.0; }

  /// r = b - A x; the first row of the history. Whenever a row is appended, r must belong to x.
  void Begin(Vector<Scalar>& r);

  /// The squared norm of r, each entry scaled by the root of the diagonal of A, if that is known. \param r at i.
  double SquareOf(int i, const Scalar& r) const
  {
    return (this->InverseDiagonal ? (*this->InverseDiagonal)[i] : 1.0) * Eigen::numext::abs2(r);
  }

  /// z = B r, which measures the last row. \return r^H B r. Where that is not positive, the row stays an estimate.
  double Precondition(const Vector<Scalar>& r, Vector<Scalar>& z);

  /// Whether the measured residual, or an estimate that may be trusted, is small enough.
  bool HasConverged() const
  {
    return (this->IsMeasured || (this->Stop.MayEstimate && this->IsSteady)) && this->SeemsConverged();
  }

  /// Accepts the last residual, and keeps x if it is the best so far.
  void KeepBest();

  /// False once the iterations are used up. Otherwise reports progress.
  /// \throw Cancelled
  bool MayContinue();

  /// One more iteration ended.
  /// \param norm of the residual, the root of the sum of SquareOf.
  void Append(double norm);

  /// Append of the norm of r = b - A x, which it computes.
  void AppendResidual(Vector<Scalar>& r) { this->Append(this->SubtractFromB(r)); }

  /// Whether the residual, measured or estimated, is small enough.
  bool SeemsConverged() const { return this->LastRow().RelativeResidual <= this->Stop.RelativeTolerance; }

  /// r = b - A x replaces the residual of the last row, which is an estimate again.
  void ComputeResidual(Vector<Scalar>& r);

  /// |r|_B, estimated until the row is measured.
  double ResidualNorm() const { return this->Ratio * this->Norm; }
  int IterationsSinceBest() const { return this->LastRow().Iteration - this->BestIteration; }

  /// Ends without convergence. \param reason half a sentence.
  void StopShort(const std::string& reason) { this->Reason = reason; }
  void StopAtRounding();

  /// Without convergence, x becomes the best vector, and the report gets a warning.
  void End();

private:
  /// z = B r, and the Ratio. \return r^H B r.
  double MeasureRatio(const Vector<Scalar>& r, Vector<Scalar>& z);
  /// |r|_B / |x|_A
  double RelativeResidual() const;
  /// |x|_A
  double EnergyNorm(const Vector<Scalar>& r) const;
  /// Fills the last row with the measures that were asked for.
  void Measure();
  /// r = b - A x. \return NormOf(r).
  double SubtractFromB(Vector<Scalar>& r) const;
  double NormOf(const Vector<Scalar>& r) const;
  const IterationReport& LastRow() const { return this->Report.Iterations.back(); }
  double Seconds() const;

  const LinearOperator<Scalar>& A;
  Preconditioner<Scalar>& B;
  const Vector<Scalar>& b;
  const StoppingCriteria Stop;
  Vector<Scalar>& x;
  SolveReport& Report;
  const ExecutionContext& Context;
  const ConvergenceMeasure<Scalar>* const AskedMeasure;
  std::chrono::steady_clock::time_point Start; ///< later by what measuring has taken
  const Vector<Scalar>* Residual = nullptr;

  const Vector<double>* const InverseDiagonal;
  double NormOfB = 0.0;
  double Norm = 0.0;       ///< of the last residual, scaled by the diagonal
  double Ratio = 1.0;      ///< of |r|_B to it, as far as known
  bool IsMeasured = false; ///< Ratio, for the last residual
  bool IsSteady = false;   ///< Ratio, over the last two rows that were measured
  double Energy = 0.0;     ///< |x|_A
  double BestNorm = 0.0;
  double BestRatio = 1.0;
  int BestIteration = 0;
  Vector<Scalar> Best;
  double Progress = 0.0;
  std::string Reason;
};

}

#endif
