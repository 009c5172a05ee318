#include "Solvers/LeastSquares/PlanarProlongation.h"

#include "Support/SparseRows.h"
#include "Support/Unfilled.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace dmg
{
namespace
{

/// A sum of products of two plane vectors, all with all: the 2 x 2 matrix sum of a b^T.
struct OuterProducts
{
  OuterProducts() = default;
  explicit OuterProducts(int) {}
  double XX = 0.0;
  double XY = 0.0;
  double YX = 0.0;
  double YY = 0.0;
};

template <class Other>
inline void AddProduct(OuterProducts& sum, Complex a, std::complex<Other> b)
{
  sum.XX += a.real() * b.real();
  sum.XY += a.real() * b.imag();
  sum.YX += a.imag() * b.real();
  sum.YY += a.imag() * b.imag();
}

/// Appends two rows, of the components of the first factors, columns ascending.
/// \param last column of the first row; the second has one more.
void AppendPair(const SparseSum<OuterProducts>& sum, std::vector<int>& members, int last, SparseRows<double>& rows)
{
  members.assign(sum.Indices(), sum.Indices() + sum.Size());
  SortIndices(members.data(), static_cast<int>(members.size()));
  for (const bool isY : { false, true })
  {
    const auto append = [&](int column, double value)
    {
      if (column <= last + isY)
      {
        rows.Columns.push_back(column);
        rows.Values.push_back(value);
      }
    };
    for (const int j : members)
    {
      const OuterProducts& products = sum[j];
      append(2 * j, isY ? products.YX : products.XX);
      append(2 * j + 1, isY ? products.YY : products.XY);
    }
    rows.EndRow();
  }
}

/// A vector of few non-zeros, with room for all.
template <class Real>
class SparseVector
{
public:
  explicit SparseVector(int size)
    : Elements(size)
    , Members(size + 1)
  {
  }

  int Size() const { return this->Count; }
  const int* Indices() const { return this->Members.data(); }
  std::complex<Real> operator[](int index) const { return { this->Elements[index].X, this->Elements[index].Y }; }

  /// Adds factor times row \p row of a matrix. What changes stands in local variables, and nothing
  /// branches, as in SparseSum.
  void AddRow(std::complex<Real> factor, const SparseMatrix<double>& A, int row)
  {
    const int* const indices = A.innerIndexPtr();
    const double* const entries = A.valuePtr();
    Element* const elements = this->Elements.data();
    int* const members = this->Members.data();
    int count = this->Count;
    const int end = A.outerIndexPtr()[row + 1];
    for (int e = A.outerIndexPtr()[row]; e < end; ++e)
    {
      const int index = indices[e];
      Element& element = elements[index];
      members[count] = index;
      count += 1 - element.IsMember;
      element.IsMember = 1;
      const auto entry = static_cast<Real>(entries[e]);
      element.X += entry * factor.real();
      element.Y += entry * factor.imag();
    }
    this->Count = count;
  }

  /// \pre index is no member.
  void Append(int index, std::complex<Real> value)
  {
    this->Members[this->Count++] = index;
    this->Elements[index] = { value.real(), value.imag(), 1 };
  }

  /// Leaves out entries that are at most \p share of their own one of \p sizes.
  void Truncate(float share, const std::vector<float>& sizes)
  {
    int kept = 0;
    for (int k = 0; k < this->Count; ++k)
    {
      const int index = this->Members[k];
      const float smallest = share * sizes[index];
      if (std::norm((*this)[index]) > smallest * smallest)
      {
        this->Members[kept++] = index;
      }
      else
      {
        this->Remove(index);
      }
    }
    this->Count = kept;
  }

  void Sort() { std::sort(this->Members.data(), this->Members.data() + this->Count); }

  void Clear()
  {
    for (int k = 0; k < this->Count; ++k)
    {
      this->Remove(this->Members[k]);
    }
    this->Count = 0;
  }

private:
  struct Element
  {
    Real X;
    Real Y;
    int IsMember;
  };

  void Remove(int index) { this->Elements[index] = { 0, 0, 0 }; }

  LazyZeros<Element> Elements; ///< zero but for members
  LazyZeros<int> Members;
  int Count = 0;
};

/// p - factor B^T B p. Inlined it would run out of registers.
[[gnu::noinline]] void Smooth(const SparseMatrix<double>& B, const SparseMatrix<double>& Bt, float factor,
  SparseVector<float>& p, SparseVector<float>& Bp)
{
  Bp.Clear();
  for (int k = 0; k < p.Size(); ++k)
  {
    Bp.AddRow(p[p.Indices()[k]], Bt, p.Indices()[k]);
  }
  for (int k = 0; k < Bp.Size(); ++k)
  {
    p.AddRow(-factor * Bp[Bp.Indices()[k]], B, Bp.Indices()[k]);
  }
}

/// The largest entry of each row.
std::vector<float> LargestOfRows(const PlanarProlongation& P, const ExecutionContext& context)
{
  std::vector<float> largest(P.rows());
  constexpr int grain = 8192;
  context.ParallelFor(0, static_cast<int>(P.rows()), grain,
    [&](int first, int last)
    {
      for (int i = first; i < last; ++i)
      {
        double squared = 0.0;
        for (int e = P.outerIndexPtr()[i]; e < P.outerIndexPtr()[i + 1]; ++e)
        {
          squared = std::max(squared, std::norm(P.valuePtr()[e]));
        }
        largest[i] = static_cast<float>(std::sqrt(squared));
      }
    });
  return largest;
}

}

RowBands<Complex32> SmoothedRestriction(const SparseMatrix<double>& B, const SparseMatrix<double>& Bt,
  PlanarProlongation&& P, int degree, double dropped, const ExecutionContext& context)
{
  const PlanarProlongation adjoint = Adjoint(P, context);
  const std::vector<float> sizes = LargestOfRows(P, context);
  PlanarProlongation().swap(P);
  std::vector<float> factors;
  for (int k = 1; k <= degree; ++k)
  {
    const double sine = std::sin(Pi * k / (2.0 * degree + 1.0));
    factors.push_back(static_cast<float>(1.0 / (sine * sine)));
  }
  const auto makeWorker = [&]
  {
    return
      [&, p = SparseVector<float>(static_cast<int>(B.cols())), Bp = SparseVector<float>(static_cast<int>(B.rows()))](
        int firstRow, int lastRow, SparseRows<Complex32>& rows) mutable
    {
      for (int j = firstRow; j < lastRow; ++j)
      {
        p.Clear();
        for (int e = adjoint.outerIndexPtr()[j]; e < adjoint.outerIndexPtr()[j + 1]; ++e)
        {
          p.Append(adjoint.innerIndexPtr()[e], Complex32(adjoint.valuePtr()[e]));
        }
        for (const float factor : factors)
        {
          Smooth(B, Bt, factor, p, Bp);
          p.Truncate(static_cast<float>(dropped), sizes);
        }
        p.Sort();
        for (int k = 0; k < p.Size(); ++k)
        {
          rows.Columns.push_back(p.Indices()[k]);
          rows.Values.push_back(p[p.Indices()[k]]);
        }
        rows.EndRow();
      }
    };
  };
  return AssembleBands<Complex32>(
    static_cast<int>(adjoint.rows()), static_cast<int>(adjoint.cols()), makeWorker, context);
}

SparseMatrix<double> CoarseStiffness(const SparseMatrix<double>& B, const SparseMatrix<double>& Bt,
  const SparseMatrix<Complex32>& P, const SparseMatrix<Complex32>& adjoint, const std::vector<int>& held,
  const ExecutionContext& context)
{
  std::vector<float> weights(P.rows(), 1.0f);
  for (const int i : held)
  {
    weights[i] = 0.0f;
  }
  const int columns = static_cast<int>(P.cols());
  const auto makeWorker = [&, columns]
  {
    return [&, Bp = SparseVector<double>(static_cast<int>(B.rows())),
             AP = SparseVector<double>(static_cast<int>(B.cols())), sum = SparseSum<OuterProducts>(columns),
             members = std::vector<int>()](int firstRow, int lastRow, SparseRows<double>& rows) mutable
    {
      for (int j = firstRow / 2; j < lastRow / 2; ++j)
      {
        Bp.Clear();
        for (int e = adjoint.outerIndexPtr()[j]; e < adjoint.outerIndexPtr()[j + 1]; ++e)
        {
          const int i = adjoint.innerIndexPtr()[e];
          Bp.AddRow(std::conj(Complex(weights[i] * adjoint.valuePtr()[e])), Bt, i);
        }
        AP.Clear();
        for (int k = 0; k < Bp.Size(); ++k)
        {
          AP.AddRow(Bp[Bp.Indices()[k]], B, Bp.Indices()[k]);
        }
        sum.Clear();
        for (int k = 0; k < AP.Size(); ++k)
        {
          const int i = AP.Indices()[k];
          const int begin = P.outerIndexPtr()[i];
          int end = P.outerIndexPtr()[i + 1];
          while (end > begin && P.innerIndexPtr()[end - 1] > j)
          {
            --end;
          }
          sum.Add(
            static_cast<double>(weights[i]) * AP[i], P.innerIndexPtr() + begin, P.valuePtr() + begin, end - begin);
        }
        AppendPair(sum, members, 2 * j, rows);
      }
    };
  };
  return AssembleInBands<double>(2 * columns, 2 * columns, makeWorker, context);
}

SparseMatrix<double> GramOfPlanar(const SparseMatrix<Complex32>& Q, const ExecutionContext& context)
{
  const SparseMatrix<Complex32> conjugate = Adjoint(Q, context); // its entries turn the other way
  const int columns = static_cast<int>(Q.cols());
  const auto makeWorker = [&, columns]
  {
    return [&, sum = SparseSum<OuterProducts>(columns), members = std::vector<int>()](
             int firstRow, int lastRow, SparseRows<double>& rows) mutable
    {
      for (int i = firstRow / 2; i < lastRow / 2; ++i)
      {
        sum.Clear();
        for (int e = conjugate.outerIndexPtr()[i]; e < conjugate.outerIndexPtr()[i + 1]; ++e)
        {
          const int row = conjugate.innerIndexPtr()[e];
          const int begin = Q.outerIndexPtr()[row];
          sum.Add(std::conj(Complex(conjugate.valuePtr()[e])), Q.innerIndexPtr() + begin, Q.valuePtr() + begin,
            Q.outerIndexPtr()[row + 1] - begin);
        }
        AppendPair(sum, members, 2 * columns, rows);
      }
    };
  };
  return AssembleInBands<double>(2 * columns, 2 * columns, makeWorker, context);
}

}
