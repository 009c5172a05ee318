#ifndef dmgClosestIntegers_h
#define dmgClosestIntegers_h

#include "Support/ExecutionContext.h"
#include "Support/Types.h"

#include <Eigen/Dense>

namespace dmg
{

/// Integers y of a low energy (y - x)^T S (y - x): a good solution of the closest vector problem, which is NP-hard.
///
/// One number after another is rounded, whichever costs least: with C = S^-1, rounding y_i costs at least d^2 / C_ii, d the distance to
/// the nearest integer, where all numbers that are still real follow it, by d C_ji / C_ii (conditional rounding). Then single numbers,
/// and pairs of them, are moved by one while that lowers the energy.
/// \param S symmetric, positive definite.
/// \param inverse C; see InverseOf.
/// Cost: n^3. Checkpoints: one per number.
Vector<double> ClosestIntegers(const Eigen::MatrixXd& S, const Eigen::MatrixXd& inverse, const Vector<double>& x,
  const ExecutionContext& context = SerialContext());

/// The inverse of a symmetric positive definite matrix. Cost: n^3. Checkpoints: one per 32 columns.
Eigen::MatrixXd InverseOf(const Eigen::MatrixXd& S, const ExecutionContext& context = SerialContext());

}

#endif
