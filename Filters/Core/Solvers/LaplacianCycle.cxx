#include "Solvers/LaplacianCycle.h"

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

SmootherOptions SweepsOf(const RoughnessCycleOptions& options)
{
  SmootherOptions smoothing;
  smoothing.PreSweeps = smoothing.PostSweeps = options.Sweeps;
  return smoothing;
}

}

LaplacianCycle::LaplacianCycle(const LaplacianHierarchy& hierarchy, const Vector<double>& D,
  const RoughnessCycleOptions& options, const ExecutionContext& context)
  : Fine(hierarchy)
  , InverseScales(hierarchy.Scales(Eigen::seqN(0, hierarchy.L.rows(), 2)).cwiseInverse())
  , InverseDiagonal(hierarchy.L.rows())
  , FineSmoother(
      Smoother<Single>::NewShifted(hierarchy.A, this->InverseDiagonal, SweepsOf(options)))
  , b(hierarchy.L.rows())
  , x(hierarchy.L.rows())
  , Residual(hierarchy.L.rows())
  , SumsOfTiles(hierarchy.Prolongation.SizeOfSums())
{
  this->SetDiagonal(D, context);
  SparseMatrix<Complex> coarse = this->CoarseMatrix(context);
  context.Checkpoint(0.3);
  GalerkinOptions coarsening;
  if (2 * coarse.rows() <= options.LargestFactor)
  {
    coarsening.CoarsestLevel = 0;
  }
  this->Hierarchy = std::make_unique<GalerkinHierarchy<Complex>>(
    std::move(coarse), hierarchy.Coarser, coarsening, PartOfContext(context, 0.3, 0.8));
  this->Coarse = std::make_unique<MultigridCycle<Complex>>(
    *this->Hierarchy, options.Coarse, PartOfContext(context, 0.8, 1.0));
  this->Hierarchy->ForgetMatrices();
}

void LaplacianCycle::Update(const Vector<double>& D, const ExecutionContext& context)
{
  this->SetDiagonal(D, context);
  this->Hierarchy->Update(this->CoarseMatrix(context), PartOfContext(context, 0.3, 0.8));
  this->Coarse->Update(PartOfContext(context, 0.8, 1.0));
  this->Hierarchy->ForgetMatrices();
}

void LaplacianCycle::SetDiagonal(const Vector<double>& D, const ExecutionContext& context)
{
  assert(D.size() == this->Fine.NumberOfUnknowns());
  const int size = static_cast<int>(D.size() / 2);
  this->Shift.resize(size);
  context.ParallelFor(0, size, RowGrain, [&](int first, int last) {
    for (int k = first; k < last; ++k)
    {
      this->Shift[k] = D[2 * k] * this->InverseScales[k] * this->InverseScales[k];
      this->InverseDiagonal[k] = static_cast<float>(1.0 / (1.0 + this->Shift[k]));
    }
  });
  this->Held =
    Choose(size, [this](int k) { return !std::isfinite(this->Shift[k]); }, context);
  for (const int k : this->Fine.Isolated)
  {
    const double shift = this->Shift[k];
    this->InverseDiagonal[k] =
      shift > 0.0 && std::isfinite(shift) ? static_cast<float>(1.0 / shift) : 0.0f;
  }
}

SparseMatrix<Complex> LaplacianCycle::CoarseMatrixOfFree(const ExecutionContext& context) const
{
  SparseMatrix<Complex> P = this->Rows(Identity(this->Fine.Prolongation.Rows()), context);
  for (int k = 0; k < static_cast<int>(P.rows()); ++k)
  {
    // Held rows are zero, but stay in the pattern, so that it does not depend on D.
    const double factor =
      std::isfinite(this->Shift[k]) ? this->InverseScales[k] : 0.0;
    for (int e = P.outerIndexPtr()[k]; e < P.outerIndexPtr()[k + 1]; ++e)
    {
      P.valuePtr()[e] *= factor;
    }
  }
  return TripleProduct(Adjoint(P, context), this->Fine.L, P, context);
}

SparseMatrix<Complex> LaplacianCycle::CoarseMatrix(const ExecutionContext& context) const
{
  SparseMatrix<Complex> coarse;
  if (this->Held.empty())
  {
    coarse = this->Fine.CoarseMatrix;
  }
  else
  {
    SparseMatrix<Complex> ofFree = this->CoarseMatrixOfFree(context);
    coarse.swap(ofFree); // an assignment would copy
  }
  // P^H D P is the product of sqrt(D) P with its adjoint. An unknown with an entry of D couples all that
  // it is interpolated from, so the pattern has room for it.
  const std::vector<int> pulled = Choose(static_cast<int>(this->Shift.size()),
    [this](int k) { return this->Shift[k] > 0.0 && std::isfinite(this->Shift[k]); }, context);
  SparseMatrix<Complex> rows = this->Rows(pulled, context);
  for (std::size_t k = 0; k < pulled.size(); ++k)
  {
    const double root = std::sqrt(this->Shift[pulled[k]]);
    for (int e = rows.outerIndexPtr()[k]; e < rows.outerIndexPtr()[k + 1]; ++e)
    {
      rows.valuePtr()[e] *= root;
    }
  }
  AddInPattern(coarse, NormalMatrix(rows, context), context);
  return coarse;
}

SparseMatrix<Complex> LaplacianCycle::Rows(
  const std::vector<int>& rows, const ExecutionContext& context) const
{
  return this->Fine.Prolongation.SelectedRows(rows, context).cast<Complex>();
}

void LaplacianCycle::Apply(
  const Vector<double>& r, Vector<double>& z, const ExecutionContext& context)
{
  const int size = static_cast<int>(this->b.size());
  context.ParallelFor(0, size, RowGrain, [&](int first, int last) {
    for (int k = first; k < last; ++k)
    {
      const double factor = this->InverseScales[k];
      this->b[k] = { static_cast<float>(r[2 * k] * factor),
        static_cast<float>(r[2 * k + 1] * factor) };
    }
  });
  this->FineSmoother->PreSmooth(this->b, this->x, this->Residual, context);
  for (const int k : this->Held)
  {
    this->Residual[k] = 0.0f;
  }
  this->Fine.Prolongation.MultiplyAdjoint(
    this->Residual, this->CoarseResidual, this->SumsOfTiles, context);
  this->Coarse->Apply(this->CoarseResidual, this->CoarseCorrection, context);
  this->Fine.Prolongation.AddProduct(this->CoarseCorrection, this->x, context);
  for (const int k : this->Held)
  {
    this->x[k] = 0.0f;
  }
  this->FineSmoother->PostSmooth(this->b, this->x, context);
  z.resize(r.size());
  context.ParallelFor(0, size, RowGrain, [&](int first, int last) {
    for (int k = first; k < last; ++k)
    {
      const double factor = this->InverseScales[k];
      z[2 * k] = this->x[k].real() * factor;
      z[2 * k + 1] = this->x[k].imag() * factor;
    }
  });
}

std::vector<LevelReport> LaplacianCycle::Levels() const
{
  std::vector<LevelReport> levels = {
    { static_cast<long long>(this->Fine.L.rows()), static_cast<long long>(this->Fine.L.nonZeros()) }
  };
  levels.insert(levels.end(), this->Hierarchy->Levels().begin(), this->Hierarchy->Levels().end());
  return levels;
}

long long LaplacianCycle::Bytes() const
{
  return this->Hierarchy->Bytes() + this->Coarse->Bytes() +
    this->b.size() *
    static_cast<long long>(4 * sizeof(Single) + sizeof(float) + 2 * sizeof(double)) +
    this->SumsOfTiles.size() * static_cast<long long>(sizeof(double));
}

}
