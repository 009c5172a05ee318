#include "Solvers/Laplacian/LaplacianCycle.h"

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
