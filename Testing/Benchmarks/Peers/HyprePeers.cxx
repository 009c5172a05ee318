#include "Benchmarks/Peers/AlgebraicMultigridPeers.h"

#ifdef DMG_HAS_HYPRE

#include "Benchmarks/Peers/IterativePeer.h"
#include "Benchmarks/Peers/MpiAlone.h"
#include "Support/Errors.h"

#include <HYPRE.h>
#include <HYPRE_IJ_mv.h>
#include <HYPRE_parcsr_ls.h>
#include <mpi.h>

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace dmg::peers
{
namespace
{

/// MPI and hypre, from their first use until the process exits.
class Session
{
public:
  static void Begin() { static const Session session; }

  ~Session()
  {
    HYPRE_Finalize();
    MPI_Finalize();
  }

private:
  Session()
  {
    PrepareMpiForOneProcess();
    MPI_Init(nullptr, nullptr);
    HYPRE_Init();
  }
};

void Check(int code)
{
  if (code != 0)
  {
    const std::string text = "hypre failed with code " + std::to_string(code);
    HYPRE_ClearAllErrors();
    throw SolverFailure(text);
  }
}

/// A matrix in hypre's arrays, of one process.
class HypreMatrix
{
public:
  explicit HypreMatrix(const SparseMatrix<double>& A)
  {
    const int rows = static_cast<int>(A.rows());
    std::vector<int> sizes(rows);
    std::vector<int> numbers(rows);
    for (int i = 0; i < rows; ++i)
    {
      sizes[i] = A.outerIndexPtr()[i + 1] - A.outerIndexPtr()[i];
      numbers[i] = i;
    }
    Check(HYPRE_IJMatrixCreate(MPI_COMM_SELF, 0, rows - 1, 0, static_cast<int>(A.cols()) - 1, &this->Matrix));
    Check(HYPRE_IJMatrixSetObjectType(this->Matrix, HYPRE_PARCSR));
    Check(HYPRE_IJMatrixSetRowSizes(this->Matrix, sizes.data()));
    Check(HYPRE_IJMatrixInitialize(this->Matrix));
    Check(HYPRE_IJMatrixSetValues(this->Matrix, rows, sizes.data(), numbers.data(), A.innerIndexPtr(), A.valuePtr()));
    Check(HYPRE_IJMatrixAssemble(this->Matrix));
  }
  ~HypreMatrix() { HYPRE_IJMatrixDestroy(this->Matrix); }
  HypreMatrix(const HypreMatrix&) = delete;
  HypreMatrix& operator=(const HypreMatrix&) = delete;

  HYPRE_ParCSRMatrix Get() const
  {
    void* object = nullptr;
    Check(HYPRE_IJMatrixGetObject(this->Matrix, &object));
    return static_cast<HYPRE_ParCSRMatrix>(object);
  }

private:
  HYPRE_IJMatrix Matrix = nullptr;
};

class HypreVector
{
public:
  explicit HypreVector(const Vector<double>& x)
    : Size(static_cast<int>(x.size()))
  {
    Check(HYPRE_IJVectorCreate(MPI_COMM_SELF, 0, this->Size - 1, &this->Values));
    Check(HYPRE_IJVectorSetObjectType(this->Values, HYPRE_PARCSR));
    Check(HYPRE_IJVectorInitialize(this->Values));
    this->Set(x);
    Check(HYPRE_IJVectorAssemble(this->Values));
  }
  ~HypreVector() { HYPRE_IJVectorDestroy(this->Values); }
  HypreVector(const HypreVector&) = delete;
  HypreVector& operator=(const HypreVector&) = delete;

  void Set(const Vector<double>& x) { Check(HYPRE_IJVectorSetValues(this->Values, this->Size, nullptr, x.data())); }
  void Get(Vector<double>& x) const
  {
    x.resize(this->Size);
    Check(HYPRE_IJVectorGetValues(this->Values, this->Size, nullptr, x.data()));
  }
  HYPRE_ParVector Get() const
  {
    void* object = nullptr;
    Check(HYPRE_IJVectorGetObject(this->Values, &object));
    return static_cast<HYPRE_ParVector>(object);
  }

private:
  const int Size;
  HYPRE_IJVector Values = nullptr;
};

/// A preconditioner of hypre in conjugate gradients.
class HyprePeer
  : public Peer<double>
  , private Preconditioner<double>
{
public:
  HyprePeer() { Session::Begin(); }

  void Prepare(const SparseMatrix<double>& matrix) override
  {
    this->A = &matrix;
    this->Matrix.emplace(matrix);
    const Vector<double> zero = Vector<double>::Zero(matrix.rows());
    this->Right.emplace(zero);
    this->Left.emplace(zero);
    this->SetUp(this->Matrix->Get(), this->Right->Get(), this->Left->Get());
  }

  int Solve(const Vector<double>& b, double tolerance, Vector<double>& x) override
  {
    return SolveIteratively<double>(*this->A, *this, b, tolerance, x);
  }

  long long Bytes() const override { return 0; }

protected:
  virtual void SetUp(HYPRE_ParCSRMatrix matrix, HYPRE_ParVector b, HYPRE_ParVector x) = 0;
  /// One cycle from the x given.
  virtual void Cycle(HYPRE_ParCSRMatrix matrix, HYPRE_ParVector b, HYPRE_ParVector x) = 0;

private:
  void Apply(const Vector<double>& r, Vector<double>& z, const ExecutionContext&) override
  {
    this->Right->Set(r);
    Check(HYPRE_ParVectorSetConstantValues(this->Left->Get(), 0.0));
    this->Cycle(this->Matrix->Get(), this->Right->Get(), this->Left->Get());
    this->Left->Get(z);
  }

  const SparseMatrix<double>* A = nullptr;
  std::optional<HypreMatrix> Matrix;
  std::optional<HypreVector> Right;
  std::optional<HypreVector> Left;
};

class BoomerAmgPeer : public HyprePeer
{
public:
  explicit BoomerAmgPeer(int numbersPerElement)
    : NumbersPerElement(numbersPerElement)
  {
  }
  ~BoomerAmgPeer() override { this->Forget(); }

  std::string Name() const override { return "hypre BoomerAMG"; }

protected:
  void SetUp(HYPRE_ParCSRMatrix matrix, HYPRE_ParVector b, HYPRE_ParVector x) override
  {
    this->Forget();
    HYPRE_BoomerAMGCreate(&this->Solver);
    HYPRE_BoomerAMGSetNumFunctions(this->Solver, this->NumbersPerElement);
    HYPRE_BoomerAMGSetRelaxType(this->Solver, 6); // symmetric Gauss-Seidel
    HYPRE_BoomerAMGSetMaxIter(this->Solver, 1);
    HYPRE_BoomerAMGSetTol(this->Solver, 0.0);
    HYPRE_BoomerAMGSetPrintLevel(this->Solver, 0);
    Check(HYPRE_BoomerAMGSetup(this->Solver, matrix, b, x));
  }
  void Cycle(HYPRE_ParCSRMatrix matrix, HYPRE_ParVector b, HYPRE_ParVector x) override
  {
    Check(HYPRE_BoomerAMGSolve(this->Solver, matrix, b, x));
  }

private:
  void Forget()
  {
    if (this->Solver)
    {
      HYPRE_BoomerAMGDestroy(this->Solver);
      this->Solver = nullptr;
    }
  }

  const int NumbersPerElement;
  HYPRE_Solver Solver = nullptr;
};

class AmsPeer : public HyprePeer
{
public:
  AmsPeer(const SparseMatrix<double>& d0, const Points& vertexPositions)
    : Gradient(d0)
    , Coordinates{ HypreVector(vertexPositions.col(0)), HypreVector(vertexPositions.col(1)),
      HypreVector(vertexPositions.col(2)) }
  {
  }
  ~AmsPeer() override { this->Forget(); }

  std::string Name() const override { return "hypre AMS"; }

protected:
  void SetUp(HYPRE_ParCSRMatrix matrix, HYPRE_ParVector b, HYPRE_ParVector x) override
  {
    this->Forget();
    HYPRE_AMSCreate(&this->Solver);
    HYPRE_AMSSetDimension(this->Solver, 3);
    HYPRE_AMSSetDiscreteGradient(this->Solver, this->Gradient.Get());
    HYPRE_AMSSetCoordinateVectors(
      this->Solver, this->Coordinates[0].Get(), this->Coordinates[1].Get(), this->Coordinates[2].Get());
    // As MFEM uses it. The scalar cycles must be symmetric, which hypre's defaults are not.
    HYPRE_AMSSetCycleType(this->Solver, 13);
    HYPRE_AMSSetSmoothingOptions(this->Solver, 2, 1, 1.0, 1.0);
    HYPRE_AMSSetAlphaAMGOptions(this->Solver, 10, 1, 8, 0.25, 6, 4);
    HYPRE_AMSSetBetaAMGOptions(this->Solver, 10, 1, 8, 0.25, 6, 4);
    HYPRE_AMSSetMaxIter(this->Solver, 1);
    HYPRE_AMSSetTol(this->Solver, 0.0);
    HYPRE_AMSSetPrintLevel(this->Solver, 0);
    Check(HYPRE_AMSSetup(this->Solver, matrix, b, x));
  }
  void Cycle(HYPRE_ParCSRMatrix matrix, HYPRE_ParVector b, HYPRE_ParVector x) override
  {
    Check(HYPRE_AMSSolve(this->Solver, matrix, b, x));
  }

private:
  void Forget()
  {
    if (this->Solver)
    {
      HYPRE_AMSDestroy(this->Solver);
      this->Solver = nullptr;
    }
  }

  const HypreMatrix Gradient;
  const std::array<HypreVector, 3> Coordinates;
  HYPRE_Solver Solver = nullptr;
};

}

std::unique_ptr<Peer<double>> NewBoomerAmgPeer(int numbersPerElement)
{
  return std::make_unique<BoomerAmgPeer>(numbersPerElement);
}

std::unique_ptr<Peer<double>> NewAmsPeer(const SparseMatrix<double>& d0, const Points& vertexPositions)
{
  return std::make_unique<AmsPeer>(d0, vertexPositions);
}

}

#else

namespace dmg::peers
{

std::unique_ptr<Peer<double>> NewBoomerAmgPeer(int)
{
  return nullptr;
}

std::unique_ptr<Peer<double>> NewAmsPeer(const SparseMatrix<double>&, const Points&)
{
  return nullptr;
}

}

#endif
