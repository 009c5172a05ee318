#include "Benchmarks/Peers/AlgebraicMultigridPeers.h"

#ifdef DMG_HAS_PETSC

#include "Benchmarks/Peers/IterativePeer.h"
#include "Benchmarks/Peers/MpiAlone.h"
#include "Support/Errors.h"

#include <petscksp.h>

#include <Eigen/QR>

#include <string>
#include <utility>
#include <vector>

namespace dmg::peers
{
namespace
{

void Check(PetscErrorCode code)
{
  if (code)
  {
    throw SolverFailure("PETSc failed with code " + std::to_string(static_cast<int>(code)));
  }
}

/// PETSc, and with it MPI, from its first use until the process exits.
class Session
{
public:
  static void Begin() { static const Session session; }
  ~Session() { PetscFinalize(); }

private:
  Session()
  {
    PrepareMpiForOneProcess();
    Check(PetscInitializeNoArguments());
    Check(PetscPushErrorHandler(PetscReturnErrorHandler, nullptr));
  }
};

class GamgPeer
  : public Peer<double>
  , private Preconditioner<double>
{
public:
  GamgPeer(int numbersPerElement, const Eigen::MatrixXd& nearNullSpace)
    : NumbersPerElement(numbersPerElement)
  {
    Session::Begin();
    // PETSc wants an orthonormal basis.
    const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> factors(nearNullSpace);
    this->NearNullSpace = factors.householderQ() * Eigen::MatrixXd::Identity(nearNullSpace.rows(), factors.rank());
  }
  ~GamgPeer() override { this->Forget(); }

  std::string Name() const override { return "PETSc GAMG"; }

  void Prepare(const SparseMatrix<double>& matrix) override
  {
    this->Forget();
    this->A = &matrix;
    const PetscInt size = static_cast<PetscInt>(matrix.rows());
    // PETSc borrows the arrays, and does not write to them.
    Check(MatCreateSeqAIJWithArrays(PETSC_COMM_SELF, size, size, const_cast<int*>(matrix.outerIndexPtr()),
      const_cast<int*>(matrix.innerIndexPtr()), const_cast<double*>(matrix.valuePtr()), &this->Matrix));
    Check(MatSetBlockSize(this->Matrix, this->NumbersPerElement));
    Check(MatSetOption(this->Matrix, MAT_SPD, PETSC_TRUE));
    std::vector<Vec> basis(this->NearNullSpace.cols());
    for (std::size_t k = 0; k < basis.size(); ++k)
    {
      Check(VecCreateSeqWithArray(PETSC_COMM_SELF, this->NumbersPerElement, size,
        this->NearNullSpace.col(static_cast<int>(k)).data(), &basis[k]));
    }
    MatNullSpace space = nullptr;
    Check(MatNullSpaceCreate(PETSC_COMM_SELF, PETSC_FALSE, static_cast<PetscInt>(basis.size()), basis.data(), &space));
    Check(MatSetNearNullSpace(this->Matrix, space));
    Check(MatNullSpaceDestroy(&space));
    Check(VecCreateSeqWithArray(PETSC_COMM_SELF, 1, size, nullptr, &this->Right));
    Check(VecCreateSeqWithArray(PETSC_COMM_SELF, 1, size, nullptr, &this->Left));
    Check(PCCreate(PETSC_COMM_SELF, &this->Cycle));
    Check(PCSetType(this->Cycle, PCGAMG));
    Check(PCSetOperators(this->Cycle, this->Matrix, this->Matrix));
    // Brings in defaults that PCCreate leaves out, and that are faster.
    Check(PCSetFromOptions(this->Cycle));
    Check(PCSetUp(this->Cycle));
    for (Vec& vector : basis)
    {
      Check(VecDestroy(&vector));
    }
  }

  int Solve(const Vector<double>& b, double tolerance, Vector<double>& x) override
  {
    return SolveIteratively<double>(*this->A, *this, b, tolerance, x);
  }

  long long Bytes() const override { return 0; }

private:
  void Apply(const Vector<double>& r, Vector<double>& z, const ExecutionContext&) override
  {
    z.resize(r.size());
    Check(VecPlaceArray(this->Right, r.data()));
    Check(VecPlaceArray(this->Left, z.data()));
    Check(PCApply(this->Cycle, this->Right, this->Left));
    Check(VecResetArray(this->Left));
    Check(VecResetArray(this->Right));
  }

  void Forget()
  {
    PCDestroy(&this->Cycle);
    VecDestroy(&this->Right);
    VecDestroy(&this->Left);
    MatDestroy(&this->Matrix);
  }

  const int NumbersPerElement;
  Eigen::MatrixXd NearNullSpace;
  const SparseMatrix<double>* A = nullptr;
  Mat Matrix = nullptr;
  PC Cycle = nullptr;
  Vec Right = nullptr;
  Vec Left = nullptr;
};

}

std::unique_ptr<Peer<double>> NewGamgPeer(int numbersPerElement, const Eigen::MatrixXd& nearNullSpace)
{
  return std::make_unique<GamgPeer>(numbersPerElement, nearNullSpace);
}

}

#else

namespace dmg::peers
{

std::unique_ptr<Peer<double>> NewGamgPeer(int, const Eigen::MatrixXd&)
{
  return nullptr;
}

}

#endif
