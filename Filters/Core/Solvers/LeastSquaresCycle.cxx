#include "Solvers/LeastSquaresCycle.h"

#include "Support/CountingSort.h"
#include "Support/SparseKernels.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

namespace dmg
{
namespace
{

constexpr int RowGrain = 8192;

Vector<double> SquaredLengthsOfColumns(const SparseMatrix<double>& B)
{
  Vector<double> squared = Vector<double>::Zero(B.cols());
  for (Eigen::Index e = 0; e < B.nonZeros(); ++e)
  {
    squared[B.innerIndexPtr()[e]] += B.valuePtr()[e] * B.valuePtr()[e];
  }
  return squared;
}

}

LeastSquaresCycle::LeastSquaresCycle(const LeastSquaresHierarchy& hierarchy,
  const Vector<double>& D, const RoughnessCycleOptions& options,
  const ExecutionContext& context)
  : Fine(hierarchy)
  , Smoother(hierarchy.B, hierarchy.Tiles, hierarchy.Blocks, options.Sweeps)
  , b(hierarchy.NumberOfUnknowns())
  , SumsOfTiles(hierarchy.Prolongation.SizeOfSums())
{
  if (!hierarchy.Subdomains.empty())
  {
    this->OfSubdomains.resize(this->b.size());
    this->Remainder.resize(this->b.size());
    this->Subdomains.emplace(hierarchy.B, hierarchy.Tiles, hierarchy.Subdomains);
  }
  const Vector<double> scaled = this->Scaled(D);
  this->SetDiagonal(scaled, context);
  context.Checkpoint(0.2);
  SparseMatrix<double> coarse = this->CoarseMatrix(scaled, context);
  GalerkinOptions coarsening;
  if (coarse.rows() <= options.LargestFactor)
  {
    coarsening.CoarsestLevel = 0;
  }
  this->Hierarchy = std::make_unique<GalerkinHierarchy<double>>(
    std::move(coarse), hierarchy.Coarser, coarsening, PartOfContext(context, 0.4, 0.8));
  this->Coarse = std::make_unique<MultigridCycle<double>>(
    *this->Hierarchy, options.Coarse, PartOfContext(context, 0.8, 1.0));
  this->Hierarchy->ForgetMatrices();
}

void LeastSquaresCycle::Update(const Vector<double>& D, const ExecutionContext& context)
{
  const Vector<double> scaled = this->Scaled(D);
  this->SetDiagonal(scaled, context);
  context.Checkpoint(0.2);
  this->Hierarchy->Update(
    this->CoarseMatrix(scaled, context), PartOfContext(context, 0.4, 0.8));
  this->Coarse->Update(PartOfContext(context, 0.8, 1.0));
  this->Hierarchy->ForgetMatrices();
}

void LeastSquaresCycle::SetDiagonal(const Vector<double>& scaledD, const ExecutionContext& context)
{
  this->Pulled = Choose(static_cast<int>(scaledD.size()),
    [&scaledD](int i) { return scaledD[i] > 0.0 && std::isfinite(scaledD[i]); }, context);
  const Vector<double> couplings = SquaredLengthsOfColumns(this->Fine.B);
  this->Yielded.resize(this->Pulled.size());
  this->Smoothed.resize(this->Pulled.size());
  for (std::size_t k = 0; k < this->Pulled.size(); ++k)
  {
    const int i = this->Pulled[k];
    this->Yielded[k] = couplings[i] / (couplings[i] + scaledD[i]);
  }
  this->Smoother.SetDiagonal(scaledD, context);
  if (this->Subdomains)
  {
    this->Subdomains->SetDiagonal(scaledD, context);
  }
}

Vector<double> LeastSquaresCycle::Scaled(const Vector<double>& D) const
{
  assert(D.size() == this->Fine.NumberOfUnknowns());
  return D.cwiseQuotient(this->Fine.Scales.cwiseAbs2());
}

SparseMatrix<double> LeastSquaresCycle::CoarseMatrix(
  const Vector<double>& D, const ExecutionContext& context) const
{
  SparseMatrix<double> lowerOfFree;
  const bool areAllFree = this->Smoother.HeldUnknowns().empty();
  if (!areAllFree)
  {
    SparseMatrix<double> lower = CoarseRoughness(this->Fine.B, Adjoint(this->Fine.B, context),
      this->Fine.Prolongation, this->Smoother.HeldUnknowns(), context);
    lowerOfFree.swap(lower); // an assignment would copy
  }
  SparseMatrix<double> coarse =
    SymmetricFromLower(areAllFree ? this->Fine.CoarseLower : lowerOfFree, context);
  // What is added are the squares of rows of P, times roots.
  SparseMatrix<Plane> pulled = this->Fine.Prolongation.SelectedRows(this->Pulled, context);
  for (std::size_t k = 0; k < this->Pulled.size(); ++k)
  {
    const auto root = static_cast<float>(std::sqrt(D[this->Pulled[k]] * this->Yielded[k]));
    for (int e = pulled.outerIndexPtr()[k]; e < pulled.outerIndexPtr()[k + 1]; ++e)
    {
      pulled.valuePtr()[e] *= root;
    }
  }
  AddInPattern(coarse, GramOfPlanar(pulled, context), context);
  return coarse;
}

void LeastSquaresCycle::PreSmooth(Vector<double>& x, const ExecutionContext& context)
{
  if (!this->Subdomains)
  {
    this->Smoother.PreSmooth(this->b, x, this->Residual, context);
    return;
  }
  this->Subdomains->PreSmooth(this->b, this->OfSubdomains, this->Remainder, context);
  this->Smoother.PreSmooth(this->Remainder, x, this->Residual, context);
  x += this->OfSubdomains;
}

void LeastSquaresCycle::PostSmooth(Vector<double>& x, const ExecutionContext& context)
{
  this->Smoother.PostSmooth(this->b, x, context);
  if (this->Subdomains)
  {
    this->Subdomains->PostSmooth(this->b, x, context);
  }
}

void LeastSquaresCycle::Apply(
  const Vector<double>& r, Vector<double>& x, const ExecutionContext& context)
{
  const Vector<double>& scales = this->Fine.Scales;
  context.ParallelFor(0, static_cast<int>(r.size()), RowGrain, [&](int first, int last) {
    const int count = last - first;
    this->b.segment(first, count) =
      r.segment(first, count).cwiseQuotient(scales.segment(first, count));
  });
  this->PreSmooth(x, context);
  for (std::size_t k = 0; k < this->Pulled.size(); ++k)
  {
    this->Residual[this->Pulled[k]] *= this->Yielded[k];
    this->Smoothed[k] = x[this->Pulled[k]];
  }
  this->Fine.Prolongation.MultiplyAdjoint(
    this->Residual, this->CoarseResidual, this->SumsOfTiles, context);
  this->Coarse->Apply(this->CoarseResidual, this->CoarseCorrection, context);
  this->Fine.Prolongation.AddProduct(this->CoarseCorrection, x, context);
  for (const int i : this->Smoother.HeldUnknowns())
  {
    x[i] = 0.0;
  }
  for (std::size_t k = 0; k < this->Pulled.size(); ++k)
  {
    double& pulled = x[this->Pulled[k]];
    pulled = this->Smoothed[k] + this->Yielded[k] * (pulled - this->Smoothed[k]);
  }
  this->PostSmooth(x, context);
  context.ParallelFor(0, static_cast<int>(r.size()), RowGrain, [&](int first, int last) {
    const int count = last - first;
    x.segment(first, count).array() /= scales.segment(first, count).array();
  });
}

std::vector<LevelReport> LeastSquaresCycle::Levels() const
{
  std::vector<LevelReport> levels = {
    { this->Fine.NumberOfUnknowns(), static_cast<long long>(this->Fine.B.nonZeros()) }
  };
  levels.insert(levels.end(), this->Hierarchy->Levels().begin(), this->Hierarchy->Levels().end());
  return levels;
}

long long LeastSquaresCycle::Bytes() const
{
  return this->Smoother.Bytes() + (this->Subdomains ? this->Subdomains->Bytes() : 0) +
    this->Hierarchy->Bytes() + this->Coarse->Bytes() +
    (2 * this->b.size() + this->OfSubdomains.size() + this->Remainder.size() +
      this->SumsOfTiles.size() + 2 * this->Yielded.size()) *
    static_cast<long long>(sizeof(double));
}

}
