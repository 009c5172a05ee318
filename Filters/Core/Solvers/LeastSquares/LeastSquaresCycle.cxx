#include "Solvers/LeastSquares/LeastSquaresCycle.h"

#include "Support/SparseKernels.h"

#include <cassert>
#include <utility>

namespace dmg
{
namespace
{

constexpr int RowGrain = 8192;

}

LeastSquaresCycle::LeastSquaresCycle(const LeastSquaresHierarchy& hierarchy, const Vector<double>& D,
  const StiffnessCycleOptions& options, const ExecutionContext& context)
  : Fine(hierarchy)
  , Smoother(hierarchy.B, hierarchy.Tiles, hierarchy.Blocks, this->Scaled(D), options.Sweeps, context)
  , Penalised(this->PenalisedBy(this->Scaled(D), context))
  , b(hierarchy.NumberOfUnknowns())
  , SumsOfParts(hierarchy.Prolongation.SizeOfSums())
{
  context.Checkpoint(0.2);
  SparseMatrix<double> coarse = this->CoarseMatrix(context);
  const GalerkinOptions coarsening = options.CoarseningOf(static_cast<int>(coarse.rows()));
  this->Coarse = std::make_unique<GalerkinCycle<double>>(
    std::move(coarse), hierarchy.Coarser, coarsening, options.Coarse, PartOfContext(context, 0.4, 1.0));
}

void LeastSquaresCycle::Update(const Vector<double>& D, const ExecutionContext& context)
{
  const Vector<double> scaled = this->Scaled(D);
  this->Smoother.SetDiagonal(scaled, context);
  this->Penalised = this->PenalisedBy(scaled, context);
  context.Checkpoint(0.2);
  this->Coarse->Update(this->CoarseMatrix(context), PartOfContext(context, 0.4, 1.0));
}

PenalisedUnknowns<double> LeastSquaresCycle::PenalisedBy(
  const Vector<double>& scaledD, const ExecutionContext& context) const
{
  return { this->Fine.NumberOfUnknowns(), [&scaledD](int i) { return scaledD[i]; },
    [this](int i) { return this->Fine.Diagonal[i]; }, context };
}

Vector<double> LeastSquaresCycle::Scaled(const Vector<double>& D) const
{
  assert(D.size() == this->Fine.NumberOfUnknowns());
  return D.cwiseQuotient(this->Fine.Scales.cwiseAbs2());
}

SparseMatrix<double> LeastSquaresCycle::CoarseMatrix(const ExecutionContext& context) const
{
  SparseMatrix<double> lowerOfFree;
  const bool areAllFree = this->Smoother.HeldUnknowns().empty();
  if (!areAllFree)
  {
    const SparseMatrix<Complex32>& P = this->Fine.Prolongation.Matrix();
    SparseMatrix<double> lower = CoarseStiffness(
      this->Fine.B, Adjoint(this->Fine.B, context), P, Adjoint(P, context), this->Smoother.HeldUnknowns(), context);
    lowerOfFree.swap(lower); // an assignment would copy
  }
  SparseMatrix<double> coarse = SymmetricFromLower(areAllFree ? this->Fine.CoarseLower : lowerOfFree, context);
  // The added matrix consists of the squares of rows of P, times roots.
  SparseMatrix<Complex32> rows = this->Fine.Prolongation.SelectedRows(this->Penalised.Unknowns(), context);
  this->Penalised.ScaleRows(rows, context);
  AddInPattern(coarse, GramOfPlanar(rows, context), context);
  return coarse;
}

void LeastSquaresCycle::Apply(const Vector<double>& r, Vector<double>& x, const ExecutionContext& context)
{
  const Vector<double>& scales = this->Fine.Scales;
  context.ParallelFor(0, static_cast<int>(r.size()), RowGrain,
    [&](int first, int last)
    {
      const int count = last - first;
      this->b.segment(first, count) = r.segment(first, count).cwiseQuotient(scales.segment(first, count));
    });
  this->Smoother.PreSmooth(this->b, x, this->Residual, context);
  this->Penalised.ScaleResidual(this->Residual, x, context);
  this->Fine.Prolongation.MultiplyAdjoint(this->Residual, this->CoarseResidual, this->SumsOfParts, context);
  this->Coarse->Apply(this->CoarseResidual, this->CoarseCorrection, context);
  this->Fine.Prolongation.AddProduct(this->CoarseCorrection, x, context);
  SetZero(x, this->Smoother.HeldUnknowns(), context);
  this->Penalised.ScaleCorrection(x, context);
  this->Smoother.PostSmooth(this->b, x, context);
  context.ParallelFor(0, static_cast<int>(r.size()), RowGrain,
    [&](int first, int last)
    {
      const int count = last - first;
      x.segment(first, count).array() /= scales.segment(first, count).array();
    });
}

std::vector<LevelReport> LeastSquaresCycle::Levels() const
{
  return FinestAnd(
    { this->Fine.NumberOfUnknowns(), static_cast<long long>(this->Fine.B.nonZeros()) }, this->Coarse->Levels());
}

long long LeastSquaresCycle::Bytes() const
{
  return this->Smoother.Bytes() + this->Coarse->Bytes() + this->Penalised.Bytes() +
    (2 * this->b.size() + this->SumsOfParts.size()) * static_cast<long long>(sizeof(double));
}

}
