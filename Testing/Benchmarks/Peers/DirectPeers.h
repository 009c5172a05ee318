#ifndef dmgBenchmarksDirectPeers_h
#define dmgBenchmarksDirectPeers_h

#include "Benchmarks/Peers/Peer.h"
#include "Solvers/Direct/CholeskySolver.h"
#include "Support/Errors.h"

#include <Eigen/SparseCholesky>

#include <optional>

namespace dmg::peers
{

/// CHOLMOD, supernodal.
template <class Scalar>
class CholmodPeer : public Peer<Scalar>
{
public:
  explicit CholmodPeer(FillOrdering ordering)
    : Ordering(ordering)
  {
  }

  std::string Name() const override
  {
    switch (this->Ordering)
    {
      case FillOrdering::AMD:
        return "CHOLMOD, AMD";
      case FillOrdering::METIS:
        return "CHOLMOD, METIS";
      default:
        return "CHOLMOD, best ordering";
    }
  }

  void Prepare(const SparseMatrix<Scalar>& A) override { this->Solver.emplace(A, this->Ordering); }

  int Solve(const Vector<Scalar>& b, double, Vector<Scalar>& x) override
  {
    this->Solver->Solve(b, x);
    return 0;
  }

  long long Bytes() const override { return this->Solver->Bytes(); }

private:
  const FillOrdering Ordering;
  std::optional<CholeskySolver<Scalar>> Solver;
};

/// Eigen's simplicial L D L^H with AMD: the thesis's solver.
template <class Scalar>
class SimplicialPeer : public Peer<Scalar>
{
public:
  std::string Name() const override { return "Eigen SimplicialLDLT"; }

  void Prepare(const SparseMatrix<Scalar>& A) override
  {
    this->Solver.compute(A);
    if (this->Solver.info() != Eigen::Success)
    {
      throw SolverFailure("SimplicialLDLT failed");
    }
  }

  int Solve(const Vector<Scalar>& b, double, Vector<Scalar>& x) override
  {
    x = this->Solver.solve(b);
    return 0;
  }

  long long Bytes() const override
  {
    return this->Solver.matrixL().nestedExpression().nonZeros() * static_cast<long long>(sizeof(Scalar) + sizeof(int));
  }

private:
  // The lower triangle of a matrix by rows is the upper of its conjugate by columns; Eigen converts.
  Eigen::SimplicialLDLT<Eigen::SparseMatrix<Scalar>> Solver;
};

}

#endif
