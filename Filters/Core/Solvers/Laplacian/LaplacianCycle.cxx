#include "Solvers/Laplacian/LaplacianCycle.h"

#include "Solvers/Krylov/LowestEigenvectors.h"
#include "Solvers/Multigrid/MatrixPlusDiagonal.h"
#include "Support/CountingSort.h"
#include "Support/Permutations.h"
#include "Support/SparseKernels.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

namespace dmg
{
namespace
{

constexpr int RowGrain = 4096;

SmootherOptions SweepsOf(const StiffnessCycleOptions& options)
{
  SmootherOptions smoothing;
  smoothing.PreSweeps = smoothing.PostSweeps = options.Sweeps;
  return smoothing;
}

/// Parts of the unknowns as the first coarse level has them. Its mass matrix is lumped: a coarse unknown has the shares that it
/// has in fine ones.
struct CoarseParts
{
  CoarseParts(const SparseMatrix<Complex32>& P, const ShiftedParts& fine, const ExecutionContext& context)
    : Mass(Vector<double>::Zero(P.cols()))
    , Diagonal(Vector<double>::Zero(2 * P.cols()))
  {
    const int numberOfParts = static_cast<int>(fine.Shifts.size());
    std::vector<int> partOf(P.cols(), numberOfParts); // that of no unknown
    for (int part = 0; part < numberOfParts; ++part)
    {
      for (int item = fine.Parts.Begins[part]; item < fine.Parts.Begins[part + 1]; ++item)
      {
        const int unknown = fine.Parts.Items[item];
        for (SparseMatrix<Complex32>::InnerIterator entry(P, unknown / 2); entry; ++entry)
        {
          partOf[entry.col()] = part;
          this->Mass[entry.col()] += 0.5 * std::abs(entry.value()) * fine.Mass[unknown / fine.UnknownsPerMass];
        }
      }
    }
    const std::vector<int> unknowns = Choose(
      2 * static_cast<int>(P.cols()), [&](int i) { return partOf[i / 2]<numberOfParts&& this->Mass[i / 2]> 0.0; },
      context);
    this->Parts = SortByKey(
      unknowns, numberOfParts, [&](int i) { return partOf[i / 2]; }, context);
    for (const int i : unknowns)
    {
      this->Diagonal[i] = fine.Shifts[partOf[i / 2]] * this->Mass[i / 2];
    }
  }

  Vector<double> Mass;     ///< one per complex unknown
  Vector<double> Diagonal; ///< the shift times the mass
  SortedItems Parts;
};

}

LaplacianCycle::LaplacianCycle(const LaplacianHierarchy& hierarchy, const Vector<double>& D,
  const StiffnessCycleOptions& options, const ExecutionContext& context)
  : Fine(hierarchy)
  , InverseDiagonal(hierarchy.Rows())
  , FineSmoother(Smoother<Single>::NewWithDiagonal(hierarchy.Sweeps, this->InverseDiagonal, SweepsOf(options)))
  , b(hierarchy.Rows())
  , x(hierarchy.Rows())
  , SumsOfParts(hierarchy.Prolongation.SizeOfSums())
{
  this->SetDiagonal(D, context);
  SparseMatrix<Complex> coarse = this->CoarseMatrix(context);
  const GalerkinOptions coarsening = options.CoarseningOf(2 * static_cast<int>(coarse.rows()));
  this->Coarse = std::make_unique<GalerkinCycle<Complex>>(
    std::move(coarse), hierarchy.Coarser, coarsening, options.Coarse, PartOfContext(context, 0.3, 1.0));
}

void LaplacianCycle::Update(const Vector<double>& D, const ExecutionContext& context)
{
  this->SetDiagonal(D, context);
  this->Coarse->Update(this->CoarseMatrix(context), PartOfContext(context, 0.3, 1.0));
}

void LaplacianCycle::SetDiagonal(const Vector<double>& D, const ExecutionContext& context)
{
  assert(D.size() == this->Fine.NumberOfUnknowns());
  const int size = static_cast<int>(D.size() / 2);
  context.ParallelFor(0, size, RowGrain,
    [&](int first, int last)
    {
      for (int k = first; k < last; ++k)
      {
        // An isolated unknown without a penalty is held as well.
        const double diagonal = this->Fine.DiagonalOf(2 * k) + D[2 * k];
        this->InverseDiagonal[k] = diagonal > 0.0 ? static_cast<float>(1.0 / diagonal) : 0.0f;
      }
    });
  this->HeldUnknowns = Choose(
    size, [&D](int k) { return !std::isfinite(D[2 * k]); }, context);
  this->Penalised = PenalisedUnknowns<Single>(
    size, [&D](int k) { return D[2 * k]; }, [this](int k) { return this->Fine.DiagonalOf(2 * k); }, context);
}

SparseMatrix<Complex> LaplacianCycle::CoarseMatrixOfFree(const ExecutionContext& context) const
{
  SparseMatrix<Complex> P = this->Rows(Identity(this->Fine.Prolongation.Rows()), context);
  for (const int k : this->HeldUnknowns)
  {
    // Rows become zero, but stay in the pattern, so that it does not depend on D.
    std::fill(P.valuePtr() + P.outerIndexPtr()[k], P.valuePtr() + P.outerIndexPtr()[k + 1], 0.0);
  }
  return TripleProduct(Adjoint(P, context), this->Fine.L, P, context);
}

SparseMatrix<Complex> LaplacianCycle::CoarseMatrix(const ExecutionContext& context) const
{
  SparseMatrix<Complex> coarse = this->HeldUnknowns.empty() ? SymmetricFromLower(this->Fine.CoarseLower, context)
                                                            : this->CoarseMatrixOfFree(context);
  // The added matrix is the product of some rows of P, times roots, with their adjoint. An unknown couples all that it
  // is interpolated from, so the pattern has room for it.
  SparseMatrix<Complex> rows = this->Rows(this->Penalised.Unknowns(), context);
  this->Penalised.ScaleRows(rows, context);
  AddInPattern(coarse, NormalMatrix(rows, context), context);
  return coarse;
}

SparseMatrix<Complex> LaplacianCycle::Rows(const std::vector<int>& rows, const ExecutionContext& context) const
{
  return this->Fine.Prolongation.SelectedRows(rows, context).cast<Complex>();
}

void LaplacianCycle::Apply(const Vector<double>& r, Vector<double>& z, const ExecutionContext& context)
{
  const int size = static_cast<int>(this->b.size());
  context.ParallelFor(0, size, RowGrain,
    [&](int first, int last)
    {
      for (int k = first; k < last; ++k)
      {
        this->b[k] = { static_cast<float>(r[2 * k]), static_cast<float>(r[2 * k + 1]) };
      }
    });
  Vector<Single>& residual = this->FineSmoother->PreSmooth(this->b, this->x, context);
  SetZero(residual, this->HeldUnknowns, context);
  this->Penalised.ScaleResidual(residual, this->x, context);
  this->Fine.Prolongation.MultiplyAdjoint(residual, this->CoarseResidual, this->SumsOfParts, context);
  this->Coarse->Apply(this->CoarseResidual, this->CoarseCorrection, context);
  this->Fine.Prolongation.AddProduct(this->CoarseCorrection, this->x, context);
  SetZero(this->x, this->HeldUnknowns, context);
  this->Penalised.ScaleCorrection(this->x, context);
  this->FineSmoother->PostSmooth(this->b, this->x, context);
  z.resize(r.size());
  context.ParallelFor(0, size, RowGrain,
    [&](int first, int last)
    {
      for (int k = first; k < last; ++k)
      {
        z[2 * k] = this->x[k].real();
        z[2 * k + 1] = this->x[k].imag();
      }
    });
}

Vector<double> LaplacianCycle::CoarseEigenvectors(const ShiftedParts& parts, const ExecutionContext& context)
{
  constexpr StoppingCriteria Stop = { 1e-2, 50 }; // the levels differ by about as much
  const CoarseParts coarse(this->Fine.Prolongation.Matrix(), parts, context);
  const SparseMatrix<Complex> matrix = SymmetricFromLower(this->Fine.CoarseLower, context);
  MatrixPlusDiagonal<Complex> A(matrix);
  A.SetDiagonal(coarse.Diagonal, context);
  PreconditionerOnPairs inverse(*this->Coarse);
  Vector<double> y = Vector<double>::Zero(A.Size());
  SolveReport report;
  FindLowestEigenvectors({ A, inverse, coarse.Mass, coarse.Parts }, Stop, y, report, context);
  Vector<Single> z = Vector<Single>::Zero(this->Fine.Rows());
  this->Fine.Prolongation.AddProduct(Eigen::Map<const Vector<Complex>>(AsRows<Complex>(y), y.size() / 2), z, context);
  Vector<double> x(2 * z.size());
  Eigen::Map<Vector<Complex>>(AsRows<Complex>(x), z.size()) = z.cast<Complex>();
  return x;
}

std::vector<LevelReport> LaplacianCycle::Levels() const
{
  return FinestAnd({ this->Fine.Rows(), this->Fine.L.nonZeros() }, this->Coarse->Levels());
}

long long LaplacianCycle::Bytes() const
{
  return this->Coarse->Bytes() + this->FineSmoother->Bytes() + this->Penalised.Bytes() +
    this->b.size() * static_cast<long long>(2 * sizeof(Single) + sizeof(float)) +
    this->SumsOfParts.size() * static_cast<long long>(sizeof(float));
}

}
