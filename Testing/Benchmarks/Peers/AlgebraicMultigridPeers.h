#ifndef dmgBenchmarksAlgebraicMultigridPeers_h
#define dmgBenchmarksAlgebraicMultigridPeers_h

#include "Benchmarks/Peers/Peer.h"

#include <Eigen/Core>

#include <memory>

/// Algebraic multigrid of others, one cycle as preconditioner of our conjugate gradients, so that
/// all iterative peers stop by the same rule. Each function returns null where its library was not
/// found when this was built. One thread; one of the libraries per process, since both own MPI.
namespace dmg::peers
{

/// BoomerAMG of hypre (Henson and Yang 2002).
/// \param numbersPerElement 2 for vectors, whose components are then coarsened apart.
std::unique_ptr<Peer<double>> NewBoomerAmgPeer(int numbersPerElement);

/// AMS of hypre (Kolev and Vassilevski 2009): auxiliary spaces of gradients and of vector fields
/// with nodal components. It is meant for curl-curl systems with a mass; ours are Hodge Laplacians.
/// \param d0 the discrete gradient, a row per unknown.
std::unique_ptr<Peer<double>> NewAmsPeer(const SparseMatrix<double>& d0, const Points& vertexPositions);

/// GAMG of PETSc: smoothed aggregation (Vanek, Mandel and Brezina 1996).
/// \param nearNullSpace a column per vector that coarse spaces shall contain.
std::unique_ptr<Peer<double>> NewGamgPeer(int numbersPerElement, const Eigen::MatrixXd& nearNullSpace);

}

#endif
