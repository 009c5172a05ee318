#include "Solvers/Kernels/SplitMatrix.h"

#include "Solvers/Kernels/Packs.h"
#include "Support/Permutations.h"
#include "Support/SparseKernels.h"

#include <algorithm>

namespace dmg
{
namespace
{

using Single = SplitMatrix::Single;

constexpr int RowGrain = 4096;

using Two = float __attribute__((vector_size(2 * sizeof(float))));

/// The two parts of an entry as a pair of numbers.
DoublePack Sum(Single rounded, Single rest)
{
  return DoublePack{ rounded.real(), rounded.imag() } + DoublePack{ rest.real(), rest.imag() };
}

/// The entries of A with keep(row, column), rows and columns in another order.
template <class Keep>
void Split(const SparseMatrix<Complex>& A, const std::vector<int>& order,
  const std::vector<int>& places, const Keep& keep, SparseMatrix<Single>& rounded,
  Unfilled<Single>& rests, const ExecutionContext& context)
{
  const int size = static_cast<int>(A.rows());
  const auto forEntries = [&](int row, const auto& visit) {
    for (SparseMatrix<Complex>::InnerIterator entry(A, order[row]); entry; ++entry)
    {
      const int column = places[entry.col()];
      if (keep(row, column))
      {
        visit(column, entry.value());
      }
    }
  };
  rounded.resize(size, size);
  MakeRoom(rounded, context, [&forEntries](int row) {
    int count = 0;
    forEntries(row, [&count](int, Complex) { ++count; });
    return count;
  });
  rests.resize(rounded.nonZeros());
  context.ParallelFor(0, size, RowGrain, [&](int first, int last) {
    for (int row = first; row < last; ++row)
    {
      int next = rounded.outerIndexPtr()[row];
      forEntries(row, [&](int column, Complex value) {
        // In packs, because GCC 12 takes a number for its rounded one when it makes packs of this itself.
        const auto entry = LoadPack<DoublePack>(&value);
        const Two nearest = __builtin_convertvector(entry, Two);
        rounded.innerIndexPtr()[next] = column;
        const Two rest =
          __builtin_convertvector(entry - __builtin_convertvector(nearest, DoublePack), Two);
        rounded.valuePtr()[next] = { nearest[0], nearest[1] };
        rests[next] = { rest[0], rest[1] };
        ++next;
      });
    }
  });
}

/// Calls visit(row, product of the row and x).
template <class Visit>
void MultiplyPart(const RowRuns<Single>& part, const SparseMatrix<Single>& rounded,
  const Unfilled<Single>& rests, int first, int last, const Complex* x, const Visit& visit)
{
  part.ForRows(first, last, [&](int row, const auto& entries) {
    const Single* const restsOfRow = rests.data() + (entries.Values - rounded.valuePtr());
    DoublePack straight{}; // real times real, imaginary times imaginary
    DoublePack crossed{};
    for (int k = 0; k < entries.Size; ++k)
    {
      const DoublePack entry = Sum(entries.Values[k], restsOfRow[k]);
      const auto factor = LoadPack<DoublePack>(x + entries.Columns[k]);
      straight += entry * factor;
      crossed += entry * __builtin_shufflevector(factor, factor, 1, 0);
    }
    visit(row, Complex(straight[0] - straight[1], crossed[0] + crossed[1]));
  });
}

}

SplitMatrix::SplitMatrix(
  const SparseMatrix<Complex>& A, const SweepOrder& colours, const ExecutionContext& context)
{
  const std::vector<int>& order = colours.Unknowns;
  const std::vector<int> places = Inverse(order, context);
  this->Diagonal.resize(A.rows());
  context.ParallelFor(0, this->Size(), RowGrain, [&](int first, int last) {
    for (int k = first; k < last; ++k)
    {
      this->Diagonal[k] = A.coeff(order[k], order[k]).real();
    }
  });
  this->Rounded.Begins = colours.Begins;
  Split(A, order, places, [](int row, int column) { return column < row; }, this->Rounded.Lower,
    this->RestsOfLower, context);
  Split(A, order, places, [](int row, int column) { return column > row; }, this->Rounded.Upper,
    this->RestsOfUpper, context);
}

double SplitMatrix::Operator::Multiply(int first, int last, const Complex* x, Complex* y) const
{
  MultiplyPart(this->Lower, this->A.Rounded.Lower, this->A.RestsOfLower, first, last, x,
    [this, x, y](int row, Complex sum) { y[row] = this->A.Diagonal[row] * x[row] + sum; });
  double product = 0.0;
  MultiplyPart(this->Upper, this->A.Rounded.Upper, this->A.RestsOfUpper, first, last, x,
    [x, y, &product](int row, Complex sum) {
      y[row] += sum;
      product += x[row].real() * y[row].real() + x[row].imag() * y[row].imag();
    });
  return product;
}

SparseMatrix<Complex> SplitMatrix::Whole(const ExecutionContext& context) const
{
  const SparseMatrix<Single>& lower = this->Rounded.Lower;
  const SparseMatrix<Single>& upper = this->Rounded.Upper;
  const int* const beginsOfLower = lower.outerIndexPtr();
  const int* const beginsOfUpper = upper.outerIndexPtr();
  SparseMatrix<Complex> A(this->Size(), this->Size());
  MakeRoom(A, context, [=](int row) {
    return beginsOfLower[row + 1] - beginsOfLower[row] + 1 + beginsOfUpper[row + 1] -
      beginsOfUpper[row];
  });
  context.ParallelFor(0, this->Size(), RowGrain, [&](int first, int last) {
    using Entry = std::pair<int, Complex>;
    std::vector<Entry> entries;
    for (int row = first; row < last; ++row)
    {
      entries.assign(1, { row, this->Diagonal[row] });
      for (int e = beginsOfLower[row]; e < beginsOfLower[row + 1]; ++e)
      {
        entries.emplace_back(lower.innerIndexPtr()[e],
          Complex(lower.valuePtr()[e]) + Complex(this->RestsOfLower[e]));
      }
      for (int e = beginsOfUpper[row]; e < beginsOfUpper[row + 1]; ++e)
      {
        entries.emplace_back(upper.innerIndexPtr()[e],
          Complex(upper.valuePtr()[e]) + Complex(this->RestsOfUpper[e]));
      }
      std::sort(entries.begin(), entries.end(),
        [](const Entry& a, const Entry& b) { return a.first < b.first; });
      int next = A.outerIndexPtr()[row];
      for (const auto& [column, value] : entries)
      {
        A.innerIndexPtr()[next] = column;
        A.valuePtr()[next++] = value;
      }
    }
  });
  return A;
}

long long SplitMatrix::Bytes() const
{
  return this->Size() * static_cast<long long>(sizeof(double)) + BytesOf(this->Rounded.Lower) +
    BytesOf(this->Rounded.Upper) +
    static_cast<long long>(
      (this->RestsOfLower.size() + this->RestsOfUpper.size()) * sizeof(Single));
}

void SplitMatrix::Swap(SplitMatrix& other) noexcept
{
  this->Diagonal.swap(other.Diagonal);
  this->Rounded.Begins.swap(other.Rounded.Begins);
  this->Rounded.Lower.swap(other.Rounded.Lower);
  this->Rounded.Upper.swap(other.Rounded.Upper);
  this->RestsOfLower.swap(other.RestsOfLower);
  this->RestsOfUpper.swap(other.RestsOfUpper);
}

}
