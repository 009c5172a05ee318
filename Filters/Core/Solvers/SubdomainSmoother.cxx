#include "Solvers/SubdomainSmoother.h"

#include "Support/CountingSort.h"
#include "Support/RowRuns.h"
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

}

SubdomainSmoother::SubdomainSmoother(const SparseMatrix<double>& factor, const RowTiles& tiles,
  const std::vector<Subdomain>& subdomains)
  : B(factor)
  , Tiles(tiles)
  , Subdomains(subdomains)
  , States(subdomains.size())
  , HaveRows(tiles.Size(), 0)
  , Bx(factor.rows())
{
  const int rows = static_cast<int>(factor.rows());
  for (const Subdomain& subdomain : subdomains)
  {
    for (const int row : subdomain.Rows)
    {
      this->HaveRows[row / RowTiles::RowsOfTile] = 1;
    }
  }
  this->Colouring = ColourParts(static_cast<int>(subdomains.size()),
    rows + static_cast<int>(factor.cols()), [&](int part, const auto& visit) {
      std::for_each(subdomains[part].Rows.begin(), subdomains[part].Rows.end(), visit);
      for (const int unknown : subdomains[part].Unknowns)
      {
        visit(rows + unknown);
      }
    });
  for (std::size_t s = 0; s < subdomains.size(); ++s)
  {
    this->States[s].Bx.resize(subdomains[s].Rows.size());
    this->States[s].Residual.resize(subdomains[s].Unknowns.size());
    this->States[s].Step.resize(subdomains[s].Unknowns.size());
  }
}

bool SubdomainSmoother::IsHeld(int unknown) const
{
  return !std::isfinite(this->D[unknown]);
}

SparseMatrix<double> SubdomainSmoother::MatrixOf(const Subdomain& subdomain) const
{
  SparseMatrix<double> A = subdomain.Matrix();
  for (int k = 0; k < A.rows(); ++k)
  {
    for (SparseMatrix<double>::InnerIterator entry(A, k); entry; ++entry)
    {
      if (this->IsHeld(subdomain.Unknowns[k]) || this->IsHeld(subdomain.Unknowns[entry.col()]))
      {
        entry.valueRef() = entry.col() == k ? 1.0 : 0.0; // stays in the pattern
      }
      else if (entry.col() == k)
      {
        entry.valueRef() += this->D[subdomain.Unknowns[k]];
      }
    }
  }
  return A;
}

void SubdomainSmoother::SetDiagonal(const Vector<double>& diagonal, const ExecutionContext& context)
{
  assert(diagonal.size() == this->B.cols());
  this->D = diagonal;
  this->Held = Choose(
    static_cast<int>(diagonal.size()), [this](int i) { return this->IsHeld(i); }, context);
  context.ParallelFor(0, static_cast<int>(this->Subdomains.size()), 1, [&](int first, int last) {
    for (int s = first; s < last; ++s)
    {
      const SparseMatrix<double> A = this->MatrixOf(this->Subdomains[s]);
      if (this->States[s].Factor)
      {
        this->States[s].Factor->Update(A);
      }
      else
      {
        this->States[s].Factor.emplace(A, FillOrdering::AMD, FactorKind::Simplicial);
      }
    }
  });
}

void SubdomainSmoother::Correct(int s, const Vector<double>& b, Vector<double>& x)
{
  const Subdomain& subdomain = this->Subdomains[s];
  State& state = this->States[s];
  state.Bx = this->Bx(subdomain.Rows);
  state.Residual.noalias() = -(subdomain.Columns * state.Bx);
  for (std::size_t k = 0; k < subdomain.Unknowns.size(); ++k)
  {
    const int unknown = subdomain.Unknowns[k];
    state.Residual[k] =
      this->IsHeld(unknown) ? 0.0 : state.Residual[k] + b[unknown] - this->D[unknown] * x[unknown];
  }
  state.Factor->Solve(state.Residual, state.Step);
  for (std::size_t k = 0; k < subdomain.Unknowns.size(); ++k)
  {
    x[subdomain.Unknowns[k]] += state.Step[k];
  }
  state.Bx += subdomain.Columns.transpose() * state.Step;
  for (std::size_t k = 0; k < subdomain.Rows.size(); ++k)
  {
    this->Bx[subdomain.Rows[k]] = state.Bx[k];
  }
}

void SubdomainSmoother::Sweep(
  bool descending, const Vector<double>& b, Vector<double>& x, const ExecutionContext& context)
{
  const int colours = this->Colouring.NumberOfColours();
  for (int c = 0; c < colours; ++c)
  {
    const int colour = descending ? colours - 1 - c : c;
    context.ParallelFor(this->Colouring.Begins[colour], this->Colouring.Begins[colour + 1], 1,
      [&](int first, int last) {
        for (int k = first; k < last; ++k)
        {
          this->Correct(this->Colouring.Parts[k], b, x);
        }
      });
  }
}

template <class Visit>
void SubdomainSmoother::ForTilesWithRows(const ExecutionContext& context, const Visit& visit) const
{
  this->Tiles.ForTiles(context, [&](int tile, int firstRow, int lastRow) {
    if (this->HaveRows[tile])
    {
      visit(firstRow, lastRow);
    }
  });
}

void SubdomainSmoother::PreSmooth(
  const Vector<double>& b, Vector<double>& x, Vector<double>& r, const ExecutionContext& context)
{
  x.resize(b.size());
  context.ParallelFor(0, static_cast<int>(x.size()), RowGrain,
    [&x](int first, int last) { x.segment(first, last - first).setZero(); });
  this->ForTilesWithRows(context, [this](int first, int last) {
    this->Bx.segment(first, last - first).setZero();
  });
  this->Sweep(false, b, x, context);
  r.resize(b.size());
  context.ParallelFor(0, static_cast<int>(r.size()), RowGrain, [&](int first, int last) {
    for (int i = first; i < last; ++i)
    {
      r[i] = this->IsHeld(i) ? 0.0 : b[i] - this->D[i] * x[i];
    }
  });
  const RowRuns<double> runs(this->B);
  this->ForTilesWithRows(context, [&](int first, int last) {
    runs.AddAdjoint(first, last, [this](int row) { return -this->Bx[row]; }, r.data());
  });
  SetZero(r, this->Held, context);
}

void SubdomainSmoother::PostSmooth(
  const Vector<double>& b, Vector<double>& x, const ExecutionContext& context)
{
  this->ForTilesWithRows(context, [&](int first, int last) {
    for (int row = first; row < last; ++row)
    {
      this->Bx[row] = RowTimes(this->B, row, x.data());
    }
  });
  this->Sweep(true, b, x, context);
}

long long SubdomainSmoother::Bytes() const
{
  long long sum = (this->D.size() + this->Bx.size()) * static_cast<long long>(sizeof(double)) +
    static_cast<long long>(this->HaveRows.size() + this->Held.size() * sizeof(int));
  for (const State& state : this->States)
  {
    sum += state.Factor->Bytes() + static_cast<long long>(sizeof(State)) +
      (state.Bx.size() + state.Residual.size() + state.Step.size()) * static_cast<long long>(sizeof(double));
  }
  return sum;
}

}
