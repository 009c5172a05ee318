#include "Solvers/Multigrid/Smoother.h"

#include "Solvers/Kernels/PartColouring.h"
#include "Solvers/Kernels/RowRuns.h"
#include "Support/SparseKernels.h"

#include <algorithm>
#include <cmath>

namespace dmg
{
namespace
{

constexpr int RowGrain = 256;

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

/// Sweeps and products by colours: threads share the rows of each.
template <class Value>
class ColourSweeps
{
public:
  static constexpr bool ReadsOwnPlaces = false;

  explicit ColourSweeps(const TriangularParts<Value>& matrix)
    : Begins(matrix.Begins)
    , Lower(matrix.Lower)
    , Upper(matrix.Upper)
  {
  }

  /// Calls visit(i, product of row i of the lower or the upper part with x).
  template <class Visit>
  void Multiply(
    bool isLower, const Vector<Value>& x, const Visit& visit, const ExecutionContext& context)
  {
    const RowRuns<Value>& part = isLower ? this->Lower : this->Upper;
    context.ParallelFor(0, static_cast<int>(x.size()), RowGrain,
      [&part, &x, &visit](int first, int last) { part.Multiply(first, last, x.data(), visit); });
  }

  /// The same row by row in the order of a sweep, which changes x. The colour that it turns around at would not
  /// change and is left out.
  /// \param turns after a sweep the other way.
  /// \param leave called for ranges of rows that are left out.
  template <class Visit, class Leave>
  void Sweep(bool up, bool turns, const Vector<Value>& x, const Visit& visit, const Leave& leave,
    const ExecutionContext& context)
  {
    const RowRuns<Value>& part = up ? this->Lower : this->Upper;
    const int colours = static_cast<int>(this->Begins.size()) - 1;
    for (int k = 0; k < colours; ++k)
    {
      const int colour = up ? k : colours - 1 - k;
      const int begin = this->Begins[colour];
      const int end = this->Begins[colour + 1];
      if (turns && k == 0)
      {
        leave(begin, end);
        continue;
      }
      context.ParallelFor(begin, end, RowGrain, [&part, &x, &visit](int first, int last) {
        part.Multiply(first, last, x.data(), visit);
      });
    }
  }

private:
  const std::vector<int>& Begins;
  const RowRuns<Value> Lower;
  const RowRuns<Value> Upper;
};

/// The same by tiles, which threads take as wholes, colour by colour.
template <class Value>
class TileSweeps
{
public:
  static constexpr bool ReadsOwnPlaces = true; ///< of x, times zero

  explicit TileSweeps(const TriangularParts<Value>& matrix)
    : A(matrix)
  {
  }

  template <class Visit>
  void Multiply(
    bool isLower, const Vector<Value>& x, const Visit& visit, const ExecutionContext& context)
  {
    const int tiles = static_cast<int>(this->A.Begins.size()) - 1;
    context.ParallelFor(0, tiles, 1, [&](int first, int last) {
      for (int i = this->A.Begins[first]; i < this->A.Begins[last]; ++i)
      {
        visit(i, this->Product(isLower, i, x));
      }
    });
  }

  template <class Visit, class Leave>
  void Sweep(bool up, bool, const Vector<Value>& x, const Visit& visit, const Leave&,
    const ExecutionContext& context)
  {
    ForColours(this->A.ColoursOfTiles, !up, context, [this, up, &x, &visit](int tile) {
      const int begin = this->A.Begins[tile];
      const int end = this->A.Begins[tile + 1];
      for (int k = begin; k < end; ++k)
      {
        const int i = up ? k : begin + end - 1 - k;
        visit(i, this->Product(up, i, x));
      }
    });
  }

private:
  Value Product(bool isLower, int i, const Vector<Value>& x) const
  {
    return isLower ? this->A.LowerTimes(i, x.data()) : this->A.UpperTimes(i, x.data());
  }

  const TriangularParts<Value>& A;
};

/// Sweeps go to and fro. Where a sweep up has just been, the sums over earlier unknowns are those that the
/// next one down wants, and the other way round, so each sweep after the first costs half a product
/// (Conrad and Wallach 1979).
/// \tparam Sweeps ColourSweeps or TileSweeps.
template <class Value, class Diagonal, class Sweeps>
class GaussSeidelSmoother : public Smoother<Value>
{
public:
  GaussSeidelSmoother(const TriangularParts<Value>& matrix, Diagonal diagonal,
    const SmootherOptions& options)
    : Parts(matrix)
    , Solved(diagonal)
    , PreSweeps(options.PreSweeps)
    , PostSweeps(options.PostSweeps)
    , Sums(matrix.Lower.rows())
  {
  }

  Vector<Value>& PreSmooth(
    const Vector<Value>& b, Vector<Value>& x, const ExecutionContext& context) override
  {
    if (Sweeps::ReadsOwnPlaces)
    {
      x.setZero();
    }
    if (this->PreSweeps == 0)
    {
      x.setZero();
      this->Sums = b;
      return this->Sums;
    }
    this->Sums.setZero(); // over later unknowns; the first sweep needs x of earlier ones only
    constexpr bool keepsSums = true;
    const bool endsUp = this->Sweep(true, this->PreSweeps, b, x, keepsSums, context);
    // The last sweep has solved each row with the sums that were there before it.
    this->Parts.Multiply(
      !endsUp, x, [this](int i, Value sum) { this->Sums[i] -= sum; }, context);
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
    this->Parts.Multiply(
      !up, x, [this](int i, Value sum) { this->Sums[i] = sum; }, context);
    this->Sweep(up, this->PostSweeps, b, x, false, context);
  }

  long long Bytes() const override
  {
    return this->Sums.size() * static_cast<long long>(sizeof(Value));
  }

private:
  /// \pre Sums are those over later unknowns where the first sweep goes up, else over earlier ones.
  /// \param keepsSums the last sweep leaves Sums as they were.
  /// \return whether the last sweep went up; then Sums, if not kept, are those over earlier unknowns.
  bool Sweep(bool up, int count, const Vector<Value>& b, Vector<Value>& x, bool keepsSums,
    const ExecutionContext& context)
  {
    for (int sweep = 0; sweep < count; ++sweep, up = !up)
    {
      const bool isKept = keepsSums && sweep + 1 == count;
      const auto relax = [this, &b, &x, isKept](int i, Value sum) {
        x[i] = this->Solved(i, b[i] - this->Sums[i] - sum);
        if (!isKept)
        {
          this->Sums[i] = sum;
        }
      };
      const auto leave = [this, isKept](int begin, int end) {
        if (!isKept)
        {
          this->Sums.segment(begin, end - begin).setZero();
        }
      };
      this->Parts.Sweep(up, sweep > 0, x, relax, leave, context);
    }
    return !up;
  }

  Sweeps Parts;
  const Diagonal Solved;
  const int PreSweeps;
  const int PostSweeps;
  Vector<Value> Sums; ///< over earlier or over later unknowns, whichever the last sweep added up; or residuals
};

template <class Value, class Diagonal>
std::unique_ptr<Smoother<Value>> NewGaussSeidel(const TriangularParts<Value>& A,
  const Diagonal& diagonal, const SmootherOptions& options)
{
  if (A.HaveTiles())
  {
    return std::make_unique<GaussSeidelSmoother<Value, Diagonal, TileSweeps<Value>>>(A, diagonal, options);
  }
  return std::make_unique<GaussSeidelSmoother<Value, Diagonal, ColourSweeps<Value>>>(A, diagonal, options);
}

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

template <class Value>
std::unique_ptr<Smoother<Value>> Smoother<Value>::New(
  const TriangularParts<Value>& A, const SmootherOptions& options,
  const ExecutionContext& context)
{
  if (options.Kind == SmootherKind::Chebyshev)
  {
    return std::make_unique<ChebyshevSmoother<Value>>(A, options, context);
  }
  return NewGaussSeidel(A, UnitDiagonal<Value>(), options);
}

template <class Value>
std::unique_ptr<Smoother<Value>> Smoother<Value>::NewWithDiagonal(const TriangularParts<Value>& A,
  const Vector<Real>& inverseDiagonal, const SmootherOptions& options)
{
  return NewGaussSeidel(A, GivenDiagonal<Value>{ inverseDiagonal }, options);
}

template class Smoother<float>;
template class Smoother<double>;
template class Smoother<std::complex<float>>;
template class Smoother<std::complex<double>>;

}
