#include "Solvers/SubdomainSmoother.h"

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
// Far below the energies that matter, and far above rounding errors, which may make a subdomain with a
// harmonic field of its own indefinite.
constexpr double Ridge = 1e-12;

}

SubdomainSmoother::SubdomainSmoother(
  const SparseMatrix<double>& factor, const SparseMatrix<double>& transpose, const UnknownBlocks& subdomains)
  : B(factor)
  , Bt(transpose)
  , Bx(factor.rows())
{
  std::vector<Subdomain> all(subdomains.Size());
  for (int k = 0; k < subdomains.Size(); ++k)
  {
    all[k].Unknowns = subdomains.Unknowns.data() + subdomains.Offsets[k];
    all[k].Size = subdomains.Offsets[k + 1] - subdomains.Offsets[k];
    all[k].Residual.resize(all[k].Size);
    all[k].Step.resize(all[k].Size);
  }
  this->SortByColour(std::move(all));
}

/// Subdomains of a colour share no unknown and no row of B. Each colour takes all that it can.
void SubdomainSmoother::SortByColour(std::vector<Subdomain> subdomains)
{
  while (!subdomains.empty())
  {
    std::vector<char> isUnknownTaken(this->B.cols(), 0);
    std::vector<char> isRowTaken(this->B.rows(), 0);
    const auto anyOf = [&](const Subdomain& subdomain, const auto& visit) {
      return std::any_of(
        subdomain.Unknowns, subdomain.Unknowns + subdomain.Size, [&](int unknown) {
          const int* const rows = this->Bt.innerIndexPtr();
          return visit(isUnknownTaken[unknown]) ||
            std::any_of(rows + this->Bt.outerIndexPtr()[unknown],
              rows + this->Bt.outerIndexPtr()[unknown + 1],
              [&](int row) { return visit(isRowTaken[row]); });
        });
    };
    std::vector<Subdomain> others;
    for (Subdomain& subdomain : subdomains)
    {
      if (anyOf(subdomain, [](char isTaken) { return isTaken != 0; }))
      {
        others.push_back(std::move(subdomain));
        continue;
      }
      anyOf(subdomain, [](char& isTaken) {
        isTaken = 1;
        return false;
      });
      this->Subdomains.push_back(std::move(subdomain));
    }
    this->ColourBegins.push_back(static_cast<int>(this->Subdomains.size()));
    subdomains.swap(others);
  }
}

/// B^T B on a subdomain, and the ridge.
SparseMatrix<double> SubdomainSmoother::MatrixOf(const Subdomain& subdomain) const
{
  std::vector<int> rows; // of B, on the subdomain
  std::vector<Eigen::Triplet<double>> entries;
  for (int k = 0; k < subdomain.Size; ++k)
  {
    for (SparseMatrix<double>::InnerIterator entry(this->Bt, subdomain.Unknowns[k]); entry; ++entry)
    {
      rows.push_back(static_cast<int>(entry.col()));
      entries.emplace_back(k, static_cast<int>(entry.col()), entry.value());
    }
  }
  std::sort(rows.begin(), rows.end());
  rows.erase(std::unique(rows.begin(), rows.end()), rows.end());
  for (Eigen::Triplet<double>& entry : entries)
  {
    const auto place = std::lower_bound(rows.begin(), rows.end(), entry.col());
    entry = { entry.row(), static_cast<int>(place - rows.begin()), entry.value() };
  }
  SparseMatrix<double> columns(subdomain.Size, static_cast<int>(rows.size()));
  columns.setFromTriplets(entries.begin(), entries.end());
  const SparseMatrix<double> transpose = columns.transpose();
  SparseMatrix<double> ridge(subdomain.Size, subdomain.Size);
  ridge.setIdentity();
  ridge *= Ridge;
  return SparseMatrix<double>(columns * transpose) + ridge;
}

void SubdomainSmoother::SetDiagonal(const Vector<double>& diagonal, const ExecutionContext& context)
{
  assert(diagonal.size() == this->B.cols());
  this->D = diagonal;
  context.ParallelFor(0, static_cast<int>(this->Subdomains.size()), 1, [&](int first, int last) {
    for (int s = first; s < last; ++s)
    {
      Subdomain& subdomain = this->Subdomains[s];
      SparseMatrix<double> A = this->MatrixOf(subdomain);
      const auto isHeld = [&](Eigen::Index k) { return !std::isfinite(this->D[subdomain.Unknowns[k]]); };
      for (int k = 0; k < subdomain.Size; ++k)
      {
        for (SparseMatrix<double>::InnerIterator entry(A, k); entry; ++entry)
        {
          if (isHeld(k) || isHeld(entry.col()))
          {
            entry.valueRef() = entry.col() == k ? 1.0 : 0.0; // stays in the pattern
          }
          else if (entry.col() == k)
          {
            entry.valueRef() += this->D[subdomain.Unknowns[k]];
          }
        }
      }
      if (subdomain.Factor)
      {
        subdomain.Factor->Update(A);
      }
      else
      {
        subdomain.Factor.emplace(A);
      }
    }
  });
}

double SubdomainSmoother::ResidualAt(
  int unknown, const Vector<double>& b, const Vector<double>& x) const
{
  return std::isfinite(this->D[unknown])
    ? b[unknown] - this->D[unknown] * x[unknown] - RowTimes(this->Bt, unknown, this->Bx.data())
    : 0.0;
}

void SubdomainSmoother::Correct(Subdomain& subdomain, const Vector<double>& b, Vector<double>& x)
{
  for (int k = 0; k < subdomain.Size; ++k)
  {
    subdomain.Residual[k] = this->ResidualAt(subdomain.Unknowns[k], b, x);
  }
  subdomain.Factor->Solve(subdomain.Residual, subdomain.Step);
  for (int k = 0; k < subdomain.Size; ++k)
  {
    const int unknown = subdomain.Unknowns[k];
    x[unknown] += subdomain.Step[k];
    for (SparseMatrix<double>::InnerIterator entry(this->Bt, unknown); entry; ++entry)
    {
      this->Bx[entry.col()] += entry.value() * subdomain.Step[k];
    }
  }
}

void SubdomainSmoother::Sweep(
  bool descending, const Vector<double>& b, Vector<double>& x, const ExecutionContext& context)
{
  const int colours = static_cast<int>(this->ColourBegins.size()) - 1;
  for (int c = 0; c < colours; ++c)
  {
    const int colour = descending ? colours - 1 - c : c;
    context.ParallelFor(this->ColourBegins[colour], this->ColourBegins[colour + 1], 1,
      [&](int first, int last) {
        for (int s = first; s < last; ++s)
        {
          this->Correct(this->Subdomains[s], b, x);
        }
      });
  }
}

void SubdomainSmoother::PreSmooth(
  const Vector<double>& b, Vector<double>& x, Vector<double>& r, const ExecutionContext& context)
{
  x.setZero(b.size());
  this->Bx.setZero();
  this->Sweep(false, b, x, context);
  r.resize(b.size());
  context.ParallelFor(0, static_cast<int>(r.size()), RowGrain, [&](int first, int last) {
    for (int i = first; i < last; ++i)
    {
      r[i] = this->ResidualAt(i, b, x);
    }
  });
}

void SubdomainSmoother::PostSmooth(
  const Vector<double>& b, Vector<double>& x, const ExecutionContext& context)
{
  Multiply(this->B, x, this->Bx, context);
  this->Sweep(true, b, x, context);
}

long long SubdomainSmoother::Bytes() const
{
  long long sum = (this->D.size() + this->Bx.size()) * static_cast<long long>(sizeof(double));
  for (const Subdomain& subdomain : this->Subdomains)
  {
    sum += subdomain.Factor->Bytes() +
      subdomain.Size * static_cast<long long>(2 * sizeof(double)) + static_cast<long long>(sizeof(Subdomain));
  }
  return sum;
}

}
