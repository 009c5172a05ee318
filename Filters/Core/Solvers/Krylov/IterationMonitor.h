#ifndef dmgIterationMonitor_h
#define dmgIterationMonitor_h

#include "Solvers/Krylov/ConvergenceMeasure.h"
#include "Solvers/Krylov/LinearOperator.h"
#include "Solvers/Krylov/SolveReport.h"
#include "Solvers/Krylov/StoppingCriteria.h"
#include "Support/ExecutionContext.h"
#include "Support/Types.h"

#include <chrono>
#include <string>

namespace dmg
{

/// What iterative solvers of A x = b share: the start, the history, the best vector met so far, and
/// the ways to end. Its methods are called in the order in which they stand here.
///
/// Residuals r = b - A x are measured by what they say of the error e = x - A^-1 b: in the norm of the preconditioner B,
///
///   |r|_B = sqrt(r^H B r) ,   which is the energy norm |e|_A of the error where B is the inverse of A ,
///
/// relative to the energy norm |x|_A = sqrt(x^H (b - r)) of the iterate; 1 for x = 0. Solvers know r^H B r
/// when they go on from x (SetProduct). For x itself it is estimated before that: |r|_B is to the norm scaled by the
/// diagonal of A as it was for the iterate before, which was seen to be right within a factor of two from
/// about the third iteration on, and of four after the first.
///
/// x is the solver's iterate. The best vector is copied only once the iteration leaves it, and then
/// by taking the last step back; a solve that improves all the time never copies.
template <class Scalar>
class IterationMonitor
{
public:
  /// Empties the solver's part of the report and starts the clock. All arguments are borrowed.
  /// \param x the start, or empty for zero.
  /// \throw InvalidInput sizes differ, or b or x is not finite.
  /// \param measure of each row of the history, or null.
  IterationMonitor(const LinearOperator<Scalar>& A, const Vector<Scalar>& b, const StoppingCriteria& stop,
    Vector<Scalar>& x, SolveReport& report, const ExecutionContext& context,
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

  /// r^H B r of the last row.
  void SetProduct(double product);

  bool HasConverged() const;

  /// False once the iterations are used up. Otherwise reports progress.
  /// \throw Cancelled
  bool MayContinue();

  /// One more iteration ended.
  /// \param norm of the residual, the root of the sum of SquareOf.
  /// \param stepBack called as stepBack(v), where v is a copy of x, to take the last step back.
  template <class StepBack>
  void Append(double norm, const StepBack& stepBack)
  {
    this->AppendRow(norm);
    if (this->ResidualNorm() < this->BestNorm)
    {
      this->BestNorm = this->ResidualNorm();
      this->BestRatio = this->Ratio;
      this->BestIteration = this->LastRow().Iteration;
      this->Best.resize(0);
    }
    else if (this->Best.size() == 0)
    {
      this->Best = this->x;
      stepBack(this->Best);
    }
  }

  /// The same with r = b - A x.
  template <class StepBack>
  void AppendResidual(Vector<Scalar>& r, const StepBack& stepBack)
  {
    this->Append(this->SubtractFromB(r), stepBack);
  }

  /// r = b - A x replaces the residual of the last row.
  void ComputeResidual(Vector<Scalar>& r);

  /// |r|_B, estimated until SetProduct.
  double ResidualNorm() const { return this->Ratio * this->Norm; }
  int IterationsSinceBest() const { return this->LastRow().Iteration - this->BestIteration; }

  /// Ends without convergence. \param reason half a sentence.
  void StopShort(const std::string& reason) { this->Reason = reason; }
  void StopAtRounding();

  /// Without convergence, x becomes the best vector, and the report gets a warning.
  void End();

private:
  void AppendRow(double norm);
  /// Of the last row.
  void SetRelativeResidual();
  /// |x|_A
  double EnergyNorm(const Vector<Scalar>& r) const;
  /// Fills the last row.
  void Measure();
  /// r = b - A x. \return NormOf(r).
  double SubtractFromB(Vector<Scalar>& r) const;
  double NormOf(const Vector<Scalar>& r) const;
  const IterationReport& LastRow() const { return this->Report.Iterations.back(); }
  double Seconds() const;

  const LinearOperator<Scalar>& A;
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
  double Norm = 0.0;  ///< of the last residual, scaled by the diagonal
  double Ratio = 1.0; ///< of |r|_B to it, as far as known
  double Energy = 0.0; ///< |x|_A
  double BestNorm = 0.0;
  double BestRatio = 1.0;
  int BestIteration = 0;
  Vector<Scalar> Best; ///< empty while x is the best
  double Progress = 0.0;
  std::string Reason;
};

}

#endif
