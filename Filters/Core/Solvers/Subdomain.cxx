#include "Solvers/Subdomain.h"

#include "Support/SparseKernels.h"

#include <algorithm>
#include <utility>

namespace dmg
{
namespace
{

// Far below the energies that matter, and far above rounding errors, which may make a subdomain with a
// harmonic field of its own indefinite.
constexpr double Ridge = 1e-12;

}

Subdomain::Subdomain(const SparseMatrix<double>& Bt, std::vector<int> unknowns)
  : Unknowns(std::move(unknowns))
{
  std::sort(this->Unknowns.begin(), this->Unknowns.end());
  for (const int unknown : this->Unknowns)
  {
    this->Rows.insert(this->Rows.end(), Bt.innerIndexPtr() + Bt.outerIndexPtr()[unknown],
      Bt.innerIndexPtr() + Bt.outerIndexPtr()[unknown + 1]);
  }
  const auto entries = static_cast<int>(this->Rows.size());
  std::sort(this->Rows.begin(), this->Rows.end());
  this->Rows.erase(std::unique(this->Rows.begin(), this->Rows.end()), this->Rows.end());

  this->Columns.resize(static_cast<int>(this->Unknowns.size()), static_cast<int>(this->Rows.size()));
  this->Columns.reserve(entries);
  for (std::size_t k = 0; k < this->Unknowns.size(); ++k)
  {
    const int row = static_cast<int>(k);
    this->Columns.startVec(row);
    for (SparseMatrix<double>::InnerIterator entry(Bt, this->Unknowns[k]); entry; ++entry)
    {
      const auto place = std::lower_bound(this->Rows.begin(), this->Rows.end(), entry.col());
      this->Columns.insertBack(row, static_cast<int>(place - this->Rows.begin())) = entry.value();
    }
  }
  this->Columns.finalize();
}

long long Subdomain::Bytes() const
{
  return BytesOf(this->Columns) +
    static_cast<long long>((this->Unknowns.size() + this->Rows.size()) * sizeof(int));
}

SparseMatrix<double> Subdomain::Matrix() const
{
  const SparseMatrix<double> transpose = this->Columns.transpose();
  SparseMatrix<double> ridge(this->Columns.rows(), this->Columns.rows());
  ridge.setIdentity(); // also where a column of B is empty
  ridge *= Ridge;
  return SparseMatrix<double>(this->Columns * transpose) + ridge;
}

}
