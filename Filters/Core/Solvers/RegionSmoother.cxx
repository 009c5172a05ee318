#include "Solvers/RegionSmoother.h"

#include "Support/SparseKernels.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace dmg
{
namespace
{

// As in Subdomain: for a region that is a component of its own.
constexpr double Ridge = 1e-12;
constexpr int Grain = 256;

/// Calls visit(column, entry) but for the diagonal.
template <class Visit>
void ForEntries(const SplitMatrix& L, int row, const Visit& visit)
{
  for (const SparseMatrix<SplitMatrix::Single>* part : { &L.Rounded.Lower, &L.Rounded.Upper })
  {
    for (int e = part->outerIndexPtr()[row]; e < part->outerIndexPtr()[row + 1]; ++e)
    {
      visit(part->innerIndexPtr()[e], part->valuePtr()[e]);
    }
  }
}

}

long long MatrixRegion::Bytes() const
{
  return BytesOf(this->A) + static_cast<long long>(this->Unknowns.size() * sizeof(int));
}

std::vector<MatrixRegion> RegionsOf(const SparseMatrix<Complex>& A, const UnknownBlocks& regions,
  const std::vector<int>& places, const std::vector<int>& order)
{
  std::vector<MatrixRegion> result(regions.Size());
  std::vector<int> rows(A.rows(), -1); // of the region's matrix
  for (int k = 0; k < regions.Size(); ++k)
  {
    std::vector<int>& unknowns = result[k].Unknowns;
    for (int s = regions.Offsets[k]; s < regions.Offsets[k + 1]; ++s)
    {
      unknowns.push_back(places[regions.Unknowns[s]]);
    }
    std::sort(unknowns.begin(), unknowns.end());
    const auto size = static_cast<int>(unknowns.size());
    for (int row = 0; row < size; ++row)
    {
      rows[order[unknowns[row]]] = row;
    }
    std::vector<Eigen::Triplet<Complex>> entries;
    for (int row = 0; row < size; ++row)
    {
      entries.emplace_back(row, row, 0.0);
      for (SparseMatrix<Complex>::InnerIterator entry(A, order[unknowns[row]]); entry; ++entry)
      {
        if (rows[entry.col()] >= 0)
        {
          entries.emplace_back(row, rows[entry.col()], entry.value());
        }
      }
    }
    result[k].A.resize(size, size);
    result[k].A.setFromTriplets(entries.begin(), entries.end());
    for (const int unknown : unknowns)
    {
      rows[order[unknown]] = -1;
    }
  }
  return result;
}

RegionSmoother::RegionSmoother(const SplitMatrix& matrix, const std::vector<MatrixRegion>& regions)
  : L(matrix)
  , Regions(regions)
  , States(regions.size())
  , Steps(Vector<Single>::Zero(matrix.Size()))
{
  std::vector<char> isInside(matrix.Size(), 0);
  for (std::size_t k = 0; k < regions.size(); ++k)
  {
    const auto size = static_cast<Eigen::Index>(regions[k].Unknowns.size());
    this->States[k].Residual.resize(size);
    this->States[k].Step.resize(size);
    for (const int unknown : regions[k].Unknowns)
    {
      isInside[unknown] = 1;
    }
  }
  for (const MatrixRegion& region : regions)
  {
    for (const int unknown : region.Unknowns)
    {
      ForEntries(matrix, unknown, [&](int column, Single) {
        if (!isInside[column])
        {
          this->Around.push_back(column);
        }
      });
    }
  }
  std::sort(this->Around.begin(), this->Around.end());
  this->Around.erase(std::unique(this->Around.begin(), this->Around.end()), this->Around.end());
}

SparseMatrix<Complex> RegionSmoother::MatrixOf(const MatrixRegion& region) const
{
  SparseMatrix<Complex> A = region.A;
  for (int k = 0; k < A.rows(); ++k)
  {
    for (SparseMatrix<Complex>::InnerIterator entry(A, k); entry; ++entry)
    {
      const int row = region.Unknowns[k];
      if (this->IsHeld(row) || this->IsHeld(region.Unknowns[entry.col()]))
      {
        entry.valueRef() = entry.col() == k ? 1.0 : 0.0; // stays in the pattern
      }
      else if (entry.col() == k)
      {
        const double diagonal = entry.value().real();
        entry.valueRef() = diagonal > 0.0 ? (1.0 + Ridge) * diagonal + this->D[2 * row]
                                          : std::max(1.0, this->D[2 * row]);
      }
    }
  }
  return A;
}

void RegionSmoother::SetDiagonal(const Vector<double>& diagonal, const ExecutionContext& context)
{
  assert(diagonal.size() == 2 * this->L.Size());
  this->D = diagonal;
  context.ParallelFor(0, static_cast<int>(this->Regions.size()), 1, [&](int first, int last) {
    for (int k = first; k < last; ++k)
    {
      const SparseMatrix<Complex> A = this->MatrixOf(this->Regions[k]);
      if (this->States[k].Factor)
      {
        this->States[k].Factor->Update(A);
      }
      else
      {
        this->States[k].Factor.emplace(A, FillOrdering::AMD, FactorKind::Simplicial);
      }
    }
  });
}

template <class Entry>
Complex RegionSmoother::RowTimes(int row, const Entry& entryOfX) const
{
  Complex sum = 0.0;
  ForEntries(this->L, row, [&](int column, Single value) {
    sum += static_cast<Complex>(value) * static_cast<Complex>(entryOfX(column));
  });
  return sum;
}

template <class ResidualOf>
void RegionSmoother::Solve(
  const ResidualOf& residualOf, Vector<Single>& x, const ExecutionContext& context)
{
  context.ParallelFor(0, static_cast<int>(this->Regions.size()), 1, [&](int first, int last) {
    for (int k = first; k < last; ++k)
    {
      const std::vector<int>& unknowns = this->Regions[k].Unknowns;
      State& state = this->States[k];
      for (std::size_t i = 0; i < unknowns.size(); ++i)
      {
        state.Residual[i] = this->IsHeld(unknowns[i]) ? Complex(0.0) : residualOf(unknowns[i]);
      }
      state.Factor->Solve(state.Residual, state.Step);
      for (std::size_t i = 0; i < unknowns.size(); ++i)
      {
        this->Steps[unknowns[i]] = static_cast<Single>(state.Step[i]);
        x[unknowns[i]] += this->Steps[unknowns[i]];
      }
    }
  });
}

void RegionSmoother::PreSmooth(
  Vector<Single>& r, Vector<Single>& x, const ExecutionContext& context)
{
  this->Solve([&r](int unknown) { return static_cast<Complex>(r[unknown]); }, x, context);
  for (const MatrixRegion& region : this->Regions)
  {
    for (const int unknown : region.Unknowns)
    {
      r[unknown] = 0.0f;
    }
  }
  context.ParallelFor(0, static_cast<int>(this->Around.size()), Grain, [&](int first, int last) {
    for (int k = first; k < last; ++k)
    {
      const int row = this->Around[k];
      if (!this->IsHeld(row))
      {
        r[row] -= static_cast<Single>(
          this->RowTimes(row, [this](int column) { return this->Steps[column]; }));
      }
    }
  });
}

void RegionSmoother::PostSmooth(
  const Vector<Single>& b, Vector<Single>& x, const ExecutionContext& context)
{
  // Regions do not know of each other, so that none sees what another one changes.
  this->Solve(
    [&](int unknown) {
      const double diagonal = this->L.Diagonal[unknown] + this->D[2 * unknown];
      return static_cast<Complex>(b[unknown]) - diagonal * static_cast<Complex>(x[unknown]) -
        this->RowTimes(unknown, [&x](int column) { return x[column]; });
    },
    x, context);
}

long long RegionSmoother::Bytes() const
{
  long long sum = this->D.size() * static_cast<long long>(sizeof(double)) +
    this->Steps.size() * static_cast<long long>(sizeof(Single)) +
    static_cast<long long>(this->Around.size() * sizeof(int));
  for (const State& state : this->States)
  {
    sum += state.Factor->Bytes() + static_cast<long long>(sizeof(State)) +
      2 * state.Step.size() * static_cast<long long>(sizeof(Complex));
  }
  return sum;
}

}
