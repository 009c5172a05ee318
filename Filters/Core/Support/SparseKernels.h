#ifndef dmgSparseKernels_h
#define dmgSparseKernels_h

#include "Support/ExecutionContext.h"
#include "Support/Types.h"

#include <algorithm>
#include <cassert>
#include <complex>
#include <type_traits>
#include <vector>

/// Products and transposes of sparse matrices, and sums over vectors, on all threads and with the
/// same bits for any number of them. Every sparse matrix here is compressed, with ascending
/// columns in each row. Instantiated for double and Complex.
namespace dmg
{

/// sum += a * b. Complex factors are multiplied without the checks for infinities that
/// operator* of std::complex makes; they would cost more than the product.
template <class Real>
inline void AddProduct(Real& sum, Real a, Real b)
{
  sum += a * b;
}
template <class Real>
inline void AddProduct(std::complex<Real>& sum, std::complex<Real> a, std::complex<Real> b)
{
  sum = { sum.real() + (a.real() * b.real() - a.imag() * b.imag()),
    sum.imag() + (a.real() * b.imag() + a.imag() * b.real()) };
}

template <class Real>
inline void AddProduct(std::complex<Real>& sum, Real a, std::complex<Real> b)
{
  sum = { sum.real() + a * b.real(), sum.imag() + a * b.imag() };
}

/// The product of some entries, of any number, with x.
template <class Scalar>
inline Scalar EntriesTimes(const int* columns, const Scalar* values, int size, const Scalar* x)
{
  Scalar sum(0);
  int k = 0;
  if constexpr (std::is_floating_point_v<Scalar>)
  {
    // Four sums at once: additions to one would wait for each other. Complex numbers have two, and are slower so.
    Scalar sums[4] = {};
    for (; k + 4 <= size; k += 4)
    {
      for (int s = 0; s < 4; ++s)
      {
        AddProduct(sums[s], values[k + s], x[columns[k + s]]);
      }
    }
    sum = (sums[0] + sums[1]) + (sums[2] + sums[3]);
  }
  for (; k < size; ++k)
  {
    AddProduct(sum, values[k], x[columns[k]]);
  }
  return sum;
}

/// The product of row i of A with x.
template <class Scalar>
inline Scalar RowTimes(const SparseMatrix<Scalar>& A, int i, const Scalar* x)
{
  const int begin = A.outerIndexPtr()[i];
  return EntriesTimes(A.innerIndexPtr() + begin, A.valuePtr() + begin, A.outerIndexPtr()[i + 1] - begin, x);
}

/// Whether the columns of each row are pairs of an even one and the next.
template <class Scalar>
bool HasPairs(const SparseMatrix<Scalar>& A)
{
  const int* const columns = A.innerIndexPtr();
  for (int i = 0; i < static_cast<int>(A.rows()); ++i)
  {
    const int end = A.outerIndexPtr()[i + 1];
    for (int e = A.outerIndexPtr()[i]; e < end; e += 2)
    {
      if (e + 1 == end || columns[e] % 2 != 0 || columns[e + 1] != columns[e] + 1)
      {
        return false;
      }
    }
  }
  return true;
}

template <class Scalar>
long long BytesOf(const SparseMatrix<Scalar>& A)
{
  return A.nonZeros() * static_cast<long long>(sizeof(Scalar) + sizeof(int)) +
    A.outerSize() * static_cast<long long>(sizeof(int));
}

/// The sum of part(first, last) over blocks of fixed size that cover [0, size), added in order.
/// \param part a function (int first, int last) -> Sum, called for several blocks at the same time.
template <class Sum, class Part>
Sum SumOverBlocks(int size, const ExecutionContext& context, const Part& part)
{
  constexpr int blockSize = 4096;
  const int numberOfBlocks = (size + blockSize - 1) / blockSize;
  std::vector<Sum> sums(numberOfBlocks);
  context.ParallelFor(0, numberOfBlocks, 2,
    [size, &part, &sums](int firstBlock, int lastBlock)
    {
      for (int block = firstBlock; block < lastBlock; ++block)
      {
        const int first = block * blockSize;
        sums[block] = part(first, std::min(first + blockSize, size));
      }
    });
  Sum total(0);
  for (const Sum& sum : sums)
  {
    total += sum;
  }
  return total;
}

/// x_i = 0 for some i, each once.
template <class Scalar>
void SetZero(Vector<Scalar>& x, const std::vector<int>& indices, const ExecutionContext& context)
{
  constexpr int Grain = 8192;
  context.ParallelFor(0, static_cast<int>(indices.size()), Grain,
    [&x, &indices](int first, int last)
    {
      for (int k = first; k < last; ++k)
      {
        x[indices[k]] = Scalar(0);
      }
    });
}

/// The first number per index of a loop from the count of each: [0, c0, c0 + c1, ...].
/// \param counts on entry [anything, c0, c1, ...]; on exit the offsets, one more than counts.
/// \return the total.
/// \throw InvalidInput the total does not fit 32 bits.
int OffsetsFromCounts(int* counts, int size);
inline int OffsetsFromCounts(std::vector<int>& counts)
{
  return OffsetsFromCounts(counts.data(), static_cast<int>(counts.size()));
}

/// Room for sizeOf(row) entries in every row of a matrix: its offsets. Entries are not written yet.
/// \throw InvalidInput more than 2^31 non-zeros.
template <class Scalar, class SizeOf>
void MakeRoom(SparseMatrix<Scalar>& A, const ExecutionContext& context, const SizeOf& sizeOf)
{
  constexpr int RowGrain = 8192;
  const int rows = static_cast<int>(A.rows());
  int* const offsets = A.outerIndexPtr();
  context.ParallelFor(0, rows, RowGrain,
    [&sizeOf, offsets](int first, int last)
    {
      for (int row = first; row < last; ++row)
      {
        offsets[row + 1] = sizeOf(row);
      }
    });
  A.resizeNonZeros(OffsetsFromCounts(offsets, rows + 1));
}

/// y = A x.
template <class Scalar>
void Multiply(
  const SparseMatrix<Scalar>& A, const Vector<Scalar>& x, Vector<Scalar>& y, const ExecutionContext& context);

/// x^H y.
template <class Scalar>
Scalar Dot(const Vector<Scalar>& x, const Vector<Scalar>& y, const ExecutionContext& context);

/// |x|^2.
template <class Scalar>
double SquaredNorm(const Vector<Scalar>& x, const ExecutionContext& context);

/// The conjugate transpose A^H. Also for single precision.
template <class Scalar>
SparseMatrix<Scalar> Adjoint(const SparseMatrix<Scalar>& A, const ExecutionContext& context);

/// A symmetric or Hermitian matrix from its lower triangle, columns ascending.
template <class Scalar>
SparseMatrix<Scalar> SymmetricFromLower(const SparseMatrix<Scalar>& lower, const ExecutionContext& context);

/// A += B, in place.
/// \pre B has entries only where A has some; columns ascend in both.
template <class Scalar>
void AddInPattern(SparseMatrix<Scalar>& A, const SparseMatrix<Scalar>& B, const ExecutionContext& context)
{
  assert(A.rows() == B.rows() && A.cols() == B.cols());
  constexpr int RowGrain = 4096;
  context.ParallelFor(0, static_cast<int>(A.rows()), RowGrain,
    [&](int first, int last)
    {
      for (int i = first; i < last; ++i)
      {
        int place = A.outerIndexPtr()[i];
        for (int e = B.outerIndexPtr()[i]; e < B.outerIndexPtr()[i + 1]; ++e)
        {
          while (A.innerIndexPtr()[place] < B.innerIndexPtr()[e])
          {
            ++place;
          }
          assert(place < A.outerIndexPtr()[i + 1] && A.innerIndexPtr()[place] == B.innerIndexPtr()[e]);
          A.valuePtr()[place] += B.valuePtr()[e];
        }
      }
    });
}

/// A with its rows and columns in another order.
/// \param rowOrder [k] is the row of A that becomes row k.
/// \param columnPlaces [j] is the new place of column j of A.
template <class Scalar>
SparseMatrix<Scalar> Permuted(const SparseMatrix<Scalar>& A, const std::vector<int>& rowOrder,
  const std::vector<int>& columnPlaces, const ExecutionContext& context);

/// A B, columns ascending.
template <class Scalar>
SparseMatrix<Complex> Product(
  const SparseMatrix<Scalar>& A, const SparseMatrix<Complex>& B, const ExecutionContext& context);

/// B^H B.
template <class Scalar>
SparseMatrix<Scalar> NormalMatrix(const SparseMatrix<Scalar>& B, const ExecutionContext& context);

/// R A P, columns ascending, with all structural non-zeros.
///
/// Row by row (Gustavson 1978), where each band of rows of R forms the rows of A P that it needs and
/// forgets them again: A P never exists as a whole.
/// \throw InvalidInput more than 2^31 non-zeros.
/// Cost: linear in the multiply-adds, if all three matrices are ordered so that neighbours have
/// near indices; several times as much in a random order.
template <class Scalar>
SparseMatrix<Scalar> TripleProduct(const SparseMatrix<Scalar>& R, const SparseMatrix<Scalar>& A,
  const SparseMatrix<Scalar>& P, const ExecutionContext& context);

}

#endif
