#ifndef dmgBenchmarksSimplicialCholmodPeer_h
#define dmgBenchmarksSimplicialCholmodPeer_h

#include "Benchmarks/Peers/Peer.h"
#include "Support/Errors.h"

#include <Eigen/CholmodSupport>

#include <string>

namespace dmg::peers
{

/// The factor that geometry-central takes where it has SuiteSparse: CHOLMOD, simplicial L D L^H with 64-bit indices, and the
/// orderings that CHOLMOD tries by itself. Elsewhere geometry-central takes the one of Eigen (SimplicialPeer).
template <class Scalar>
class SimplicialCholmodPeer : public Peer<Scalar>
{
public:
  std::string Name() const override { return "geometry-central's factor"; }

  void Prepare(const SparseMatrix<Scalar>& A) override
  {
    this->Solver.compute(Matrix(A));
    if (this->Solver.info() != Eigen::Success)
    {
      throw SolverFailure("CHOLMOD's simplicial factorisation failed");
    }
  }

  int Solve(const Vector<Scalar>& b, double, Vector<Scalar>& x) override
  {
    x = this->Solver.solve(b);
    return 0;
  }

  long long Bytes() const override { return static_cast<long long>(this->Solver.cholmod().memory_inuse); }

private:
  using Matrix = Eigen::SparseMatrix<Scalar, Eigen::ColMajor, SuiteSparse_long>;
  mutable Eigen::CholmodSimplicialLDLT<Matrix> Solver; // Eigen's access to its memory is not const
};

}

#endif
