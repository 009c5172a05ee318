#include "Solvers/Multigrid/Smoother.h"

#include "Solvers/Kernels/PartColouring.h"
#include "Solvers/Kernels/RowRuns.h"

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
  void Multiply(bool isLower, const Vector<Value>& x, const Visit& visit, const ExecutionContext& context)
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
      context.ParallelFor(begin, end, RowGrain,
        [&part, &x, &visit](int first, int last) { part.Multiply(first, last, x.data(), visit); });
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
  void Multiply(bool isLower, const Vector<Value>& x, const Visit& visit, const ExecutionContext& context)
  {
    const int tiles = static_cast<int>(this->A.Begins.size()) - 1;
    context.ParallelFor(0, tiles, 1,
      [&](int first, int last)
      {
        for (int i = this->A.Begins[first]; i < this->A.Begins[last]; ++i)
        {
          visit(i, this->Product(isLower, i, x));
        }
      });
  }

  template <class Visit, class Leave>
  void Sweep(bool up, bool, const Vector<Value>& x, const Visit& visit, const Leave&, const ExecutionContext& context)
  {
    ForColours(this->A.ColoursOfTiles, !up, context,
      [this, up, &x, &visit](int tile)
      {
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

/// Symmetric Gauss-Seidel. The sums over earlier unknowns of a forward sweep are those that the next backward sweep needs, and
/// the other way round, so each sweep after the first costs half a product (Conrad and Wallach 1979).
/// \tparam Sweeps ColourSweeps or TileSweeps.
template <class Value, class Diagonal, class Sweeps>
class GaussSeidelSmoother : public Smoother<Value>
{
public:
  GaussSeidelSmoother(const TriangularParts<Value>& matrix, Diagonal diagonal, const SmootherOptions& options)
    : Parts(matrix)
    , DivisionByDiagonal(diagonal)
    , PreSweeps(options.PreSweeps)
    , PostSweeps(options.PostSweeps)
    , Sums(matrix.Lower.rows())
  {
  }

  Vector<Value>& PreSmooth(const Vector<Value>& b, Vector<Value>& x, const ExecutionContext& context) override
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

  void PostSmooth(const Vector<Value>& b, Vector<Value>& x, const ExecutionContext& context) override
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

  long long Bytes() const override { return this->Sums.size() * static_cast<long long>(sizeof(Value)); }

private:
  /// \pre Sums are those over later unknowns where the first sweep goes up, else over earlier ones.
  /// \param keepsSums the last sweep leaves Sums as they were.
  /// \return whether the last sweep went up; then Sums, if not kept, are those over earlier unknowns.
  bool Sweep(
    bool up, int count, const Vector<Value>& b, Vector<Value>& x, bool keepsSums, const ExecutionContext& context)
  {
    for (int sweep = 0; sweep < count; ++sweep, up = !up)
    {
      const bool isKept = keepsSums && sweep + 1 == count;
      const auto relax = [this, &b, &x, isKept](int i, Value sum)
      {
        x[i] = this->DivisionByDiagonal(i, b[i] - this->Sums[i] - sum);
        if (!isKept)
        {
          this->Sums[i] = sum;
        }
      };
      const auto leave = [this, isKept](int begin, int end)
      {
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
  const Diagonal DivisionByDiagonal;
  const int PreSweeps;
  const int PostSweeps;
  Vector<Value> Sums; ///< over earlier or over later unknowns, whichever the last sweep added up; or residuals
};

template <class Value, class Diagonal>
std::unique_ptr<Smoother<Value>> NewGaussSeidel(
  const TriangularParts<Value>& A, const Diagonal& diagonal, const SmootherOptions& options)
{
  if (A.HaveTiles())
  {
    return std::make_unique<GaussSeidelSmoother<Value, Diagonal, TileSweeps<Value>>>(A, diagonal, options);
  }
  return std::make_unique<GaussSeidelSmoother<Value, Diagonal, ColourSweeps<Value>>>(A, diagonal, options);
}

}

template <class Value>
std::unique_ptr<Smoother<Value>> Smoother<Value>::New(const TriangularParts<Value>& A, const SmootherOptions& options)
{
  return NewGaussSeidel(A, UnitDiagonal<Value>(), options);
}

template <class Value>
std::unique_ptr<Smoother<Value>> Smoother<Value>::NewWithDiagonal(
  const TriangularParts<Value>& A, const Vector<Real>& inverseDiagonal, const SmootherOptions& options)
{
  return NewGaussSeidel(A, GivenDiagonal<Value>{ inverseDiagonal }, options);
}

template class Smoother<float>;
template class Smoother<double>;
template class Smoother<std::complex<float>>;
template class Smoother<std::complex<double>>;

}
