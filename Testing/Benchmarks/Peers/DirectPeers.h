#ifndef dmgBenchmarksDirectPeers_h
#define dmgBenchmarksDirectPeers_h

#include "Benchmarks/Peers/Peer.h"
#include "Solvers/Direct/CholeskySolver.h"
#include "Support/Errors.h"

#include <Eigen/CholmodSupport>
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

/// The factor that geometry-central takes where it has SuiteSparse: CHOLMOD, simplicial L D L^H with 64-bit indices, and the
/// orderings that CHOLMOD tries by itself. Elsewhere geometry-central takes the one of Eigen, below.
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
