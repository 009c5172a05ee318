#include "Solvers/Kernels/SingleProlongation.h"

#include "Solvers/Kernels/Packs.h"
#include "Support/SparseAssembly.h"
#include "Support/SparseKernels.h"

#include <algorithm>
#include <cassert>

namespace dmg
{
namespace
{

constexpr int RowGrain = 2048;
constexpr int ColumnGrain = 4096;

/// The sums of the products of components, over the entries of a row and the pairs that they take.
FloatPair ProductOfRow(const float* entries, const int* columns, int size, const float* z)
{
  FloatPair sums[4] = {}; // so that additions do not wait for each other
  int k = 0;
  for (; k + 4 <= size; k += 4)
  {
    for (int lane = 0; lane < 4; ++lane)
    {
      sums[lane] += LoadPack<FloatPair>(entries + 2 * (k + lane)) * LoadPack<FloatPair>(z + 2 * columns[k + lane]);
    }
  }
  for (; k < size; ++k)
  {
    sums[0] += LoadPack<FloatPair>(entries + 2 * k) * LoadPack<FloatPair>(z + 2 * columns[k]);
  }
  return (sums[0] + sums[1]) + (sums[2] + sums[3]);
}

/// Calls visit(row, its entries as pairs, their columns, their number).
template <class Visit>
void ForRows(const SparseMatrix<Complex32>& P, int first, int last, const Visit& visit)
{
  const auto* const entries = reinterpret_cast<const float*>(P.valuePtr());
  for (int row = first; row < last; ++row)
  {
    const int begin = P.outerIndexPtr()[row];
    visit(row, entries + 2 * static_cast<std::size_t>(begin), P.innerIndexPtr() + begin,
      P.outerIndexPtr()[row + 1] - begin);
  }
}

}

SingleProlongation::SingleProlongation(SparseMatrix<Complex32>&& matrix)
{
  assert(matrix.isCompressed());
  this->P.swap(matrix);
}

void SingleProlongation::AddProduct(const Vector<double>& z, Vector<double>& x, const ExecutionContext& context) const
{
  assert(z.size() == 2 * this->Columns() && x.size() == this->Rows());
  const Vector<float> from = z.cast<float>();
  context.ParallelFor(0, this->Rows(), RowGrain,
    [&](int firstRow, int lastRow)
    {
      ForRows(this->P, firstRow, lastRow,
        [&](int row, const float* entries, const int* columns, int size)
        {
          const FloatPair product = ProductOfRow(entries, columns, size, from.data());
          x[row] += product[0] + product[1];
        });
    });
}

void SingleProlongation::AddProduct(
  const Vector<Complex>& z, Vector<Complex32>& x, const ExecutionContext& context) const
{
  assert(z.size() == this->Columns() && x.size() == this->Rows());
  const Vector<Complex32> from = z.cast<Complex32>();
  // With components exchanged, for the second component of products.
  const Vector<Complex32> crossed =
    from.unaryExpr([](Complex32 value) { return Complex32(value.imag(), value.real()); });
  context.ParallelFor(0, this->Rows(), RowGrain,
    [&](int firstRow, int lastRow)
    {
      ForRows(this->P, firstRow, lastRow,
        [&](int row, const float* entries, const int* columns, int size)
        {
          const auto times = [&](const Vector<Complex32>& numbers)
          { return ProductOfRow(entries, columns, size, reinterpret_cast<const float*>(numbers.data())); };
          const FloatPair straight = times(from);
          const FloatPair across = times(crossed);
          x[row] += Complex32(straight[0] - straight[1], across[0] + across[1]);
        });
    });
}

template <class Real, class Add, class Sum>
void SingleProlongation::SumParts(
  Vector<Real>& sums, const ExecutionContext& context, const Add& add, const Sum& sum) const
{
  const int size = 2 * this->Columns();
  sums.resize(this->SizeOfSums());
  const auto firstRow = [this](int part)
  { return static_cast<int>(static_cast<long long>(this->Rows()) * part / NumberOfParts); };
  context.ParallelFor(0, NumberOfParts, 1,
    [&](int firstPart, int lastPart)
    {
      for (int part = firstPart; part < lastPart; ++part)
      {
        Real* const ofPart = sums.data() + static_cast<Eigen::Index>(part) * size;
        std::fill(ofPart, ofPart + size, Real(0));
        ForRows(this->P, firstRow(part), firstRow(part + 1),
          [&](int row, const float* entries, const int* columns, int count)
          { add(row, entries, columns, count, ofPart); });
      }
    });
  context.ParallelFor(0, this->Columns(), ColumnGrain,
    [&](int first, int last)
    {
      for (int column = first; column < last; ++column)
      {
        double components[2] = { 0.0, 0.0 };
        for (int part = 0; part < NumberOfParts; ++part)
        {
          const Real* const pair = sums.data() + static_cast<Eigen::Index>(part) * size + 2 * column;
          components[0] += pair[0];
          components[1] += pair[1];
        }
        sum(column, components[0], components[1]);
      }
    });
}

void SingleProlongation::MultiplyAdjoint(
  const Vector<double>& x, Vector<double>& z, Vector<double>& sums, const ExecutionContext& context) const
{
  assert(x.size() == this->Rows());
  z.resize(2 * this->Columns());
  this->SumParts(
    sums, context,
    [&x](int row, const float* entries, const int* columns, int size, double* ofPart)
    {
      const DoublePack factor = { x[row], x[row] };
      for (int k = 0; k < size; ++k)
      {
        double* const sum = ofPart + 2 * columns[k];
        const auto entry = Widened(LoadPack<FloatPair>(entries + 2 * k));
        StorePack(LoadPack<DoublePack>(sum) + entry * factor, sum);
      }
    },
    [&z](int column, double first, double second)
    {
      z[2 * column] = first;
      z[2 * column + 1] = second;
    });
}

void SingleProlongation::MultiplyAdjoint(
  const Vector<Complex32>& x, Vector<Complex>& z, Vector<float>& sums, const ExecutionContext& context) const
{
  assert(x.size() == this->Rows());
  z.resize(this->Columns());
  this->SumParts(
    sums, context,
    [&x](int row, const float* entries, const int* columns, int size, float* ofPart)
    {
      // conj(p) x = (p_0 x_0 + p_1 x_1, p_0 x_1 - p_1 x_0)
      const FloatPair ofFirst = { x[row].real(), x[row].imag() };
      const FloatPair ofSecond = { x[row].imag(), -x[row].real() };
      for (int k = 0; k < size; ++k)
      {
        float* const sum = ofPart + 2 * columns[k];
        const FloatPair first = { entries[2 * k], entries[2 * k] };
        const FloatPair second = { entries[2 * k + 1], entries[2 * k + 1] };
        StorePack(LoadPack<FloatPair>(sum) + first * ofFirst + second * ofSecond, sum);
      }
    },
    [&z](int column, double first, double second) { z[column] = Complex(first, second); });
}

SparseMatrix<Complex32> SingleProlongation::SelectedRows(
  const std::vector<int>& rows, const ExecutionContext& context) const
{
  return SelectRows(this->P, rows, context);
}

long long SingleProlongation::Bytes() const
{
  return BytesOf(this->P);
}

}
