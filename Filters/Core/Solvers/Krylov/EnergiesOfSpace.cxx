#include "Solvers/Krylov/EnergiesOfSpace.h"

namespace dmg
{

EnergiesOfSpace::EnergiesOfSpace(const Eigen::MatrixXd& H, const Eigen::MatrixXd& energies, double largest)
{
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(energies);
  const double rounding = 1e-13 * largest;
  const Eigen::VectorXd inverses =
    solver.eigenvalues().unaryExpr([rounding](double energy) { return energy > rounding ? 1.0 / energy : 0.0; });
  this->InverseEnergies = solver.eigenvectors() * inverses.asDiagonal() * solver.eigenvectors().transpose();
  const Eigen::Index free = (solver.eigenvalues().array() <= rounding).count(); // ascending
  if (free > 0)
  {
    // Vectors of H have lost length, or vanished, where unknowns are held or penalised.
    const Eigen::MatrixXd spanned = H * solver.eigenvectors().leftCols(free);
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> lengths(spanned.transpose() * spanned);
    const Eigen::Index rank = (lengths.eigenvalues().array() > 1e-8).count();
    const Eigen::VectorXd inverseRoots = lengths.eigenvalues().tail(rank).cwiseSqrt().cwiseInverse();
    this->Kernel = spanned * lengths.eigenvectors().rightCols(rank) * inverseRoots.asDiagonal();
  }
}

}
