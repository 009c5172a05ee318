#include "Solvers/Smoother.h"

#include "Support/CountingSort.h"
#include "Support/Permutations.h"
#include "Support/RowRuns.h"
#include "Support/SparseKernels.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace dmg
{
namespace
{

constexpr int RowGrain = 4096;

/// Solves the diagonal for one unknown.
template <class Value>
struct UnitDiagonal
{
  Value operator()(int, Value value) const { return value; }
};
template <class Value>
struct GivenDiagonal
{
  const Vector<typename Eigen::NumTraits<Value>::Real>& Inverse;
  Value operator()(int i, Value value) const { return this->Inverse[i] * value; }
};

/// Sweeps go to and fro. Where a sweep up has just been, the sums over earlier colours are those that the
/// next one down wants, and the other way round, so each sweep after the first costs half a product
/// (Conrad and Wallach 1979). The colour that it turns around at would not change and is left out.
template <class Value, class Diagonal>
class GaussSeidelSmoother : public Smoother<Value>
{
public:
  GaussSeidelSmoother(const TriangularParts<Value>& matrix, Diagonal diagonal,
    const SmootherOptions& options)
    : Begins(matrix.Begins)
    , Lower(matrix.Lower)
    , Upper(matrix.Upper)
    , Solved(diagonal)
    , PreSweeps(options.PreSweeps)
    , PostSweeps(options.PostSweeps)
    , Sums(matrix.Lower.rows())
  {
  }

  Vector<Value>& PreSmooth(
    const Vector<Value>& b, Vector<Value>& x, const ExecutionContext& context) override
  {
    if (this->PreSweeps == 0)
    {
      x.setZero();
      this->Sums = b;
      return this->Sums;
    }
    this->Sums.setZero(); // over later colours; the first sweep needs x of earlier ones only
    constexpr bool keepsSums = true;
    const bool endsUp = this->Sweep(true, this->PreSweeps, b, x, keepsSums, context);
    // The last sweep has solved each row with the sums that were there before it.
    const RowRuns<Value>& changed = endsUp ? this->Upper : this->Lower;
    context.ParallelFor(0, static_cast<int>(b.size()), RowGrain,
      [this, &changed, &x](int first, int last)
      {
        changed.Multiply(
          first, last, x.data(), [this](int i, Value sum) { this->Sums[i] -= sum; });
      });
    return this->Sums;
  }

  void PostSmooth(
    const Vector<Value>& b, Vector<Value>& x, const ExecutionContext& context) override
  {
    if (this->PostSweeps == 0)
    {
      return;
    }
    const bool up = this->PostSweeps % 2 == 0; // the adjoint ends with a sweep down
    const RowRuns<Value>& other = up ? this->Upper : this->Lower;
    context.ParallelFor(0, static_cast<int>(b.size()), RowGrain,
      [this, &other, &x](int first, int last)
      {
        other.Multiply(
          first, last, x.data(), [this](int i, Value sum) { this->Sums[i] = sum; });
      });
    this->Sweep(up, this->PostSweeps, b, x, false, context);
  }

  long long Bytes() const override
  {
    return this->Sums.size() * static_cast<long long>(sizeof(Value));
  }

private:
  /// \pre Sums are those over later colours where the first sweep goes up, else over earlier ones.
  /// \param keepsSums the last sweep leaves Sums as they were.
  /// \return whether the last sweep went up; then Sums, if not kept, are those over earlier colours.
  bool Sweep(bool up, int count, const Vector<Value>& b, Vector<Value>& x, bool keepsSums,
    const ExecutionContext& context)
  {
    const int colours = static_cast<int>(this->Begins.size()) - 1;
    for (int sweep = 0; sweep < count; ++sweep, up = !up)
    {
      const RowRuns<Value>& part = up ? this->Lower : this->Upper;
      const bool isKept = keepsSums && sweep + 1 == count;
      for (int k = 0; k < colours; ++k)
      {
        const int colour = up ? k : colours - 1 - k;
        const int begin = this->Begins[colour];
        const int end = this->Begins[colour + 1];
        if (sweep > 0 && k == 0)
        {
          if (!isKept)
          {
            this->Sums.segment(begin, end - begin).setZero();
          }
          continue;
        }
        context.ParallelFor(begin, end, RowGrain,
          [this, &part, &b, &x, isKept](int first, int last)
          {
            part.Multiply(first, last, x.data(),
              [this, &b, &x, isKept](int i, Value sum)
              {
                x[i] = this->Solved(i, b[i] - this->Sums[i] - sum);
                if (!isKept)
                {
                  this->Sums[i] = sum;
                }
              });
          });
      }
    }
    return !up;
  }

  const std::vector<int>& Begins;
  const RowRuns<Value> Lower;
  const RowRuns<Value> Upper;
  const Diagonal Solved;
  const int PreSweeps;
  const int PostSweeps;
  Vector<Value> Sums; ///< over earlier or over later colours, whichever the last sweep added up; or residuals
};

/// J. Lottes, Optimal polynomial smoothers for multigrid V-cycles, 2023: the polynomial of degree k
/// that needs no lower bound of the spectrum.
template <class Value>
class ChebyshevSmoother : public Smoother<Value>
{
  using Real = typename Eigen::NumTraits<Value>::Real;

public:
  ChebyshevSmoother(const TriangularParts<Value>& matrix, const SmootherOptions& options,
    const ExecutionContext& context)
    : A(matrix)
    , PreDegree(options.PreSweeps)
    , PostDegree(options.PostSweeps)
    , Residual(this->A.Lower.rows())
    , Step(this->A.Lower.rows())
    , LargestEigenvalue(this->EstimateLargestEigenvalue(context))
  {
  }

  Vector<Value>& PreSmooth(
    const Vector<Value>& b, Vector<Value>& x, const ExecutionContext& context) override
  {
    x.setZero();
    this->Residual = b;
    this->Smooth(this->PreDegree, x, this->Residual, context);
    return this->Residual;
  }

  void PostSmooth(
    const Vector<Value>& b, Vector<Value>& x, const ExecutionContext& context) override
  {
    this->Residual = b;
    this->Subtract(x, this->Residual, context);
    this->Smooth(this->PostDegree, x, this->Residual, context);
  }

  long long Bytes() const override
  {
    return (this->Residual.size() + this->Step.size()) * static_cast<long long>(sizeof(Value));
  }

private:
  /// x += p(A) r and r -= A p(A) r.
  void Smooth(
    int degree, Vector<Value>& x, Vector<Value>& r, const ExecutionContext& context)
  {
    for (int k = 1; k <= degree; ++k)
    {
      const Real ofStep = k == 1 ? Real(0) : Real(2 * k - 3) / Real(2 * k + 1);
      const Real ofResidual = Real(8 * k - 4) / Real(2 * k + 1) / this->LargestEigenvalue;
      context.ParallelFor(0, static_cast<int>(x.size()), RowGrain,
        [this, k, ofStep, ofResidual, &x, &r](int first, int last)
        {
          for (int i = first; i < last; ++i)
          {
            const Value old = k == 1 ? Value(0) : this->Step[i] * ofStep;
            this->Step[i] = old + r[i] * ofResidual;
            x[i] += this->Step[i];
          }
        });
      this->Subtract(this->Step, r, context);
    }
  }

  /// r -= A x.
  void Subtract(const Vector<Value>& x, Vector<Value>& r, const ExecutionContext& context) const
  {
    context.ParallelFor(0, static_cast<int>(x.size()), RowGrain,
      [this, &x, &r](int first, int last)
      {
        for (int i = first; i < last; ++i)
        {
          r[i] -= x[i] + RowTimes(this->A.Lower, i, x.data()) +
            RowTimes(this->A.Upper, i, x.data());
        }
      });
  }

  /// Power iterations and a margin, but never above the bound by row sums.
  Real EstimateLargestEigenvalue(const ExecutionContext& context)
  {
    const int size = static_cast<int>(this->A.Lower.rows());
    double bound = 1.0;
    for (int i = 0; i < size; ++i)
    {
      double rowSum = 1.0;
      for (const SparseMatrix<Value>* part : { &this->A.Lower, &this->A.Upper })
      {
        for (int k = part->outerIndexPtr()[i]; k < part->outerIndexPtr()[i + 1]; ++k)
        {
          rowSum += std::abs(part->valuePtr()[k]);
        }
      }
      bound = std::max(bound, rowSum);
    }
    // A start with all frequencies: the fractional parts of multiples of the golden ratio.
    Vector<Value> x(size);
    for (int i = 0; i < size; ++i)
    {
      x[i] = Value(static_cast<Real>(std::fmod(i * 0.6180339887498949, 1.0) - 0.5));
    }
    double estimate = 1.0;
    for (int iteration = 0; iteration < 15; ++iteration)
    {
      const double norm = std::sqrt(this->SquaredNormOf(x, context));
      if (!(norm > 0.0))
      {
        break;
      }
      x *= static_cast<Real>(1.0 / norm);
      Vector<Value> negative = Vector<Value>::Zero(size);
      this->Subtract(x, negative, context);
      x = -negative;
      estimate = std::sqrt(this->SquaredNormOf(x, context));
    }
    return static_cast<Real>(std::min(1.1 * estimate, bound));
  }

  static double SquaredNormOf(const Vector<Value>& x, const ExecutionContext& context)
  {
    return SumOverBlocks<double>(static_cast<int>(x.size()), context,
      [&x](int first, int last)
      { return static_cast<double>(x.segment(first, last - first).squaredNorm()); });
  }

  const TriangularParts<Value>& A;
  const int PreDegree;
  const int PostDegree;
  Vector<Value> Residual;
  Vector<Value> Step;
  const Real LargestEigenvalue;
};

}

template <class Scalar>
ColourOrder Colouring(const SparseMatrix<Scalar>& A)
{
  const int size = static_cast<int>(A.rows());
  const int* offsets = A.outerIndexPtr();
  const int* columns = A.innerIndexPtr();
  std::vector<int> colours(size, -1);
  std::vector<int> seenBy; // of each colour: the unknown that saw it last among its neighbours
  int longestRow = 0;
  for (int i = 0; i < size; ++i)
  {
    for (int k = offsets[i]; k < offsets[i + 1]; ++k)
    {
      const int colour = colours[columns[k]];
      if (colour >= 0)
      {
        seenBy[colour] = i;
      }
    }
    const auto free =
      std::find_if(seenBy.begin(), seenBy.end(), [i](int last) { return last != i; });
    colours[i] = static_cast<int>(free - seenBy.begin());
    if (free == seenBy.end())
    {
      seenBy.push_back(-1);
    }
    longestRow = std::max(longestRow, offsets[i + 1] - offsets[i]);
  }

  std::vector<int> earlier(size, 0);
  for (int i = 0; i < size; ++i)
  {
    for (int k = offsets[i]; k < offsets[i + 1]; ++k)
    {
      earlier[i] += colours[columns[k]] < colours[i] ? 1 : 0;
    }
  }
  const SerialContext serial;
  const auto length = [offsets](int i) { return offsets[i + 1] - offsets[i]; };
  const auto byLength = SortByKey(Identity(size), longestRow + 1, length, serial);
  const auto byEarlier = SortByKey(
    byLength.Items, longestRow + 1, [&earlier](int i) { return earlier[i]; }, serial);
  SortedItems byColours = SortByKey(byEarlier.Items, static_cast<int>(seenBy.size()),
    [&colours](int i) { return colours[i]; }, serial);
  return { std::move(byColours.Items), std::move(byColours.Begins) };
}

ColourOrder SingleColour(int size)
{
  return { Identity(size), { 0, size } };
}

template <class Value>
std::unique_ptr<Smoother<Value>> Smoother<Value>::New(
  const TriangularParts<Value>& A, const SmootherOptions& options,
  const ExecutionContext& context)
{
  if (options.Kind == SmootherKind::Chebyshev)
  {
    return std::make_unique<ChebyshevSmoother<Value>>(A, options, context);
  }
  return std::make_unique<GaussSeidelSmoother<Value, UnitDiagonal<Value>>>(
    A, UnitDiagonal<Value>(), options);
}

template <class Value>
std::unique_ptr<Smoother<Value>> Smoother<Value>::NewWithDiagonal(const TriangularParts<Value>& A,
  const Vector<Real>& inverseDiagonal, const SmootherOptions& options)
{
  return std::make_unique<GaussSeidelSmoother<Value, GivenDiagonal<Value>>>(
    A, GivenDiagonal<Value>{ inverseDiagonal }, options);
}

template ColourOrder Colouring(const SparseMatrix<double>&);
template ColourOrder Colouring(const SparseMatrix<Complex>&);
template class Smoother<float>;
template class Smoother<double>;
template class Smoother<std::complex<float>>;
template class Smoother<std::complex<double>>;

}
