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
  , Begins(1, 0)
{
  std::vector<int> slots(matrix.Size(), -1);
  for (const MatrixRegion& region : regions)
  {
    int slot = this->Begins.back();
    for (const int unknown : region.Unknowns)
    {
      slots[unknown] = slot++;
    }
    this->Begins.push_back(slot);
  }
  this->Steps.resize(this->Begins.back());
  for (const MatrixRegion& region : regions)
  {
    for (const int unknown : region.Unknowns)
    {
      ForEntries(matrix, unknown, [&](int column, Single) {
        if (slots[column] < 0)
        {
          this->Around.push_back(column);
        }
      });
    }
  }
  std::sort(this->Around.begin(), this->Around.end());
  this->Around.erase(std::unique(this->Around.begin(), this->Around.end()), this->Around.end());
  this->AreAroundHeld.resize(this->Around.size());
  std::vector<Eigen::Triplet<Single>> entries;
  for (std::size_t k = 0; k < this->Around.size(); ++k)
  {
    ForEntries(matrix, this->Around[k], [&](int column, Single value) {
      if (slots[column] >= 0)
      {
        entries.emplace_back(static_cast<int>(k), slots[column], value);
      }
    });
  }
  this->Coupling.resize(static_cast<Eigen::Index>(this->Around.size()), this->Steps.size());
  this->Coupling.setFromTriplets(entries.begin(), entries.end());
}

SparseMatrix<Complex> RegionSmoother::MatrixOf(int region) const
{
  const Vector<double>& D = this->States[region].D;
  SparseMatrix<Complex> A = this->Regions[region].A;
  for (int k = 0; k < A.rows(); ++k)
  {
    for (SparseMatrix<Complex>::InnerIterator entry(A, k); entry; ++entry)
    {
      if (std::isinf(D[k]) || std::isinf(D[entry.col()]))
      {
        entry.valueRef() = entry.col() == k ? 1.0 : 0.0; // stays in the pattern
      }
      else if (entry.col() == k)
      {
        const double diagonal = entry.value().real();
        entry.valueRef() = diagonal > 0.0 ? (1.0 + Ridge) * diagonal + D[k] : std::max(1.0, D[k]);
      }
    }
  }
  return A;
}

void RegionSmoother::SetDiagonal(const Vector<double>& diagonal, const ExecutionContext& context)
{
  assert(diagonal.size() == 2 * this->L.Size());
  for (std::size_t k = 0; k < this->Around.size(); ++k)
  {
    this->AreAroundHeld[k] = std::isinf(diagonal[2 * this->Around[k]]) ? 1 : 0;
  }
  context.ParallelFor(0, static_cast<int>(this->Regions.size()), 1, [&](int first, int last) {
    for (int k = first; k < last; ++k)
    {
      State& state = this->States[k];
      const std::vector<int>& unknowns = this->Regions[k].Unknowns;
      state.D.resize(static_cast<Eigen::Index>(unknowns.size()));
      for (std::size_t i = 0; i < unknowns.size(); ++i)
      {
        state.D[i] = diagonal[2 * unknowns[i]];
      }
      const SparseMatrix<Complex> A = this->MatrixOf(k);
      if (state.Factor)
      {
        state.Factor->Update(A);
      }
      else
      {
        state.Factor.emplace(A, FillOrdering::AMD, FactorKind::Simplicial);
      }
    }
  });
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
      state.Residual.resize(state.D.size());
      for (std::size_t i = 0; i < unknowns.size(); ++i)
      {
        state.Residual[i] =
          std::isinf(state.D[i]) ? Complex(0.0) : residualOf(unknowns[i], state.D[i]);
      }
      state.Factor->Solve(state.Residual, state.Step);
      for (std::size_t i = 0; i < unknowns.size(); ++i)
      {
        const auto step = static_cast<Single>(state.Step[i]);
        this->Steps[this->Begins[k] + i] = step;
        x[unknowns[i]] += step;
      }
    }
  });
}

void RegionSmoother::PreSmooth(
  Vector<Single>& r, Vector<Single>& x, const ExecutionContext& context)
{
  this->Solve([&r](int unknown, double) { return static_cast<Complex>(r[unknown]); }, x, context);
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
      if (!this->AreAroundHeld[k])
      {
        Complex sum = 0.0;
        for (SparseMatrix<Single>::InnerIterator entry(this->Coupling, k); entry; ++entry)
        {
          sum += static_cast<Complex>(entry.value()) * static_cast<Complex>(this->Steps[entry.col()]);
        }
        r[this->Around[k]] -= static_cast<Single>(sum);
      }
    }
  });
}

void RegionSmoother::PostSmooth(
  const Vector<Single>& b, Vector<Single>& x, const ExecutionContext& context)
{
  // Regions do not know of each other, so that none sees what another one changes.
  this->Solve(
    [&](int unknown, double D) {
      Complex residual = static_cast<Complex>(b[unknown]) -
        (this->L.Diagonal[unknown] + D) * static_cast<Complex>(x[unknown]);
      ForEntries(this->L, unknown, [&](int column, Single value) {
        residual -= static_cast<Complex>(value) * static_cast<Complex>(x[column]);
      });
      return residual;
    },
    x, context);
}

long long RegionSmoother::Bytes() const
{
  long long sum = this->Steps.size() * static_cast<long long>(sizeof(Single)) +
    static_cast<long long>(this->Around.size() * (sizeof(int) + sizeof(char))) +
    BytesOf(this->Coupling);
  for (const State& state : this->States)
  {
    sum += state.Factor->Bytes() + static_cast<long long>(sizeof(State)) +
      state.D.size() * static_cast<long long>(sizeof(double) + 2 * sizeof(Complex));
  }
  return sum;
}

}
