#include "Solvers/MultigridCycle.h"

#include "Support/Errors.h"
#include "Support/SparseKernels.h"

#include <cmath>
#include <type_traits>
#include <vector>

namespace dmg
{
namespace
{

constexpr int RowGrain = 4096;

/// Rows and columns of a level in another order and scale.
struct Arrangement
{
  std::vector<int> Order;  ///< [k] is the unknown of the hierarchy at place k
  std::vector<int> Places; ///< its inverse
  Vector<double> Scale;    ///< D^{-1/2} in the order of the hierarchy; zero for inactive unknowns
};

Arrangement MakeArrangement(std::vector<int> order)
{
  Arrangement arrangement;
  arrangement.Places.resize(order.size());
  for (std::size_t k = 0; k < order.size(); ++k)
  {
    arrangement.Places[order[k]] = static_cast<int>(k);
  }
  arrangement.Order = std::move(order);
  return arrangement;
}

double Reciprocal(double x)
{
  return x > 0.0 ? 1.0 / x : 0.0;
}

/// The entries of A with keep(place of row, place of column), arranged and scaled: entry (i, j)
/// becomes rowScale(i) a_ij columnScale(j).
template <class Value, class Scalar, class RowScale, class ColumnScale, class Keep>
void Arrange(const SparseMatrix<Scalar>& A, const std::vector<int>& rowOrder,
  const std::vector<int>& columnPlaces, const RowScale& rowScale, const ColumnScale& columnScale,
  const Keep& keep, SparseMatrix<Value>& result, const ExecutionContext& context)
{
  const int rows = static_cast<int>(A.rows());
  const int* offsetsOfA = A.outerIndexPtr();
  const int* columnsOfA = A.innerIndexPtr();
  const Scalar* valuesOfA = A.valuePtr();
  std::vector<int> offsets(rows + 1, 0);
  context.ParallelFor(0, rows, RowGrain,
    [offsetsOfA, columnsOfA, &rowOrder, &columnPlaces, &keep, &offsets](int first, int last)
    {
      for (int k = first; k < last; ++k)
      {
        const int i = rowOrder[k];
        int count = 0;
        for (int m = offsetsOfA[i]; m < offsetsOfA[i + 1]; ++m)
        {
          count += keep(k, columnPlaces[columnsOfA[m]]) ? 1 : 0;
        }
        offsets[k + 1] = count;
      }
    });
  result.resize(rows, A.cols());
  result.resizeNonZeros(OffsetsFromCounts(offsets));
  std::copy(offsets.begin(), offsets.end(), result.outerIndexPtr());
  int* columns = result.innerIndexPtr();
  Value* values = result.valuePtr();
  context.ParallelFor(0, rows, RowGrain,
    [offsetsOfA, columnsOfA, valuesOfA, columns, values, &rowOrder, &columnPlaces, &rowScale,
      &columnScale, &keep, &offsets](int first, int last)
    {
      for (int k = first; k < last; ++k)
      {
        const int i = rowOrder[k];
        int to = offsets[k];
        for (int m = offsetsOfA[i]; m < offsetsOfA[i + 1]; ++m)
        {
          const int j = columnsOfA[m];
          if (keep(k, columnPlaces[j]))
          {
            columns[to] = columnPlaces[j];
            values[to] = static_cast<Value>(valuesOfA[m] * (rowScale(i) * columnScale(j)));
            ++to;
          }
        }
      }
    });
}

template <class Value>
long long BytesOf(const SparseMatrix<Value>& A)
{
  return A.nonZeros() * static_cast<long long>(sizeof(Value) + sizeof(int)) +
    A.outerSize() * static_cast<long long>(sizeof(int));
}

}

template <class Scalar>
class MultigridCycle<Scalar>::Internals
{
public:
  virtual ~Internals() = default;
  virtual void Update(const ExecutionContext& context) = 0;
  virtual void Apply(
    const Vector<Scalar>& r, Vector<Scalar>& z, const ExecutionContext& context) = 0;
  virtual long long Bytes() const = 0;
};

template <class Scalar>
template <class Value>
class MultigridCycle<Scalar>::InternalsOf : public MultigridCycle<Scalar>::Internals
{
  using Real = typename Eigen::NumTraits<Value>::Real;

public:
  InternalsOf(GalerkinHierarchy<Scalar>& hierarchy, const CycleOptions& options,
    const ExecutionContext& context)
    : Hierarchy(hierarchy)
    , Options(options)
    , Levels(hierarchy.NumberOfLevels())
  {
    const int coarsest = hierarchy.NumberOfLevels() - 1;
    for (int l = 0; l <= coarsest; ++l)
    {
      context.Checkpoint(0.5 * l / (coarsest + 1.0));
      const int size = hierarchy.NumberOfUnknowns(l);
      const bool byColours =
        l < coarsest && options.Smoothing.Kind == SmootherKind::GaussSeidel;
      ColourOrder colours = byColours ? Colouring(hierarchy.Matrix(l)) : SingleColour(size);
      Level& level = this->Levels[l];
      level.A.Begins = std::move(colours.Begins);
      level.Arranged = MakeArrangement(std::move(colours.Unknowns));
      level.x.resize(size);
      level.b.resize(size);
      level.r.resize(l < coarsest ? size : 0);
    }
    this->Update(context);
  }

  void Update(const ExecutionContext& context) override
  {
    const int coarsest = this->Hierarchy.NumberOfLevels() - 1;
    const auto all = [](int, int) { return true; };
    for (int l = 0; l <= coarsest; ++l)
    {
      Vector<double>& scale = this->Levels[l].Arranged.Scale;
      scale = this->Hierarchy.Diagonal(l).unaryExpr(
        [](double entry) { return Reciprocal(std::sqrt(entry)); });
    }
    for (int l = 0; l < coarsest; ++l)
    {
      context.Checkpoint(0.5 + 0.5 * l / (coarsest + 1.0));
      Level& level = this->Levels[l];
      const Arrangement& fine = level.Arranged;
      const Arrangement& coarse = this->Levels[l + 1].Arranged;
      const auto fineScale = [&fine](int i) { return fine.Scale[i]; };
      const auto inverseFineScale = [&fine](int i) { return Reciprocal(fine.Scale[i]); };
      const auto coarseScale = [&coarse](int i) { return coarse.Scale[i]; };

      Arrange(this->Hierarchy.Matrix(l), fine.Order, fine.Places, fineScale, fineScale,
        [](int row, int column) { return column < row; }, level.A.Lower, context);
      Arrange(this->Hierarchy.Matrix(l), fine.Order, fine.Places, fineScale, fineScale,
        [](int row, int column) { return column > row; }, level.A.Upper, context);
      Arrange(this->Hierarchy.Prolongation(l), fine.Order, coarse.Places, inverseFineScale,
        coarseScale, all, level.P, context);
      Arrange(this->Hierarchy.Restriction(l), coarse.Order, fine.Places, coarseScale,
        inverseFineScale, all, level.R, context);
      SmootherOptions smoothing = this->Options.Smoothing;
      smoothing.PreSweeps *= l == 0 ? this->Options.FinestFactor : 1;
      smoothing.PostSweeps *= l == 0 ? this->Options.FinestFactor : 1;
      level.Smoothing = Smoother<Value>::New(level.A, smoothing, context);
    }
    context.Checkpoint(1.0);
  }

  void Apply(
    const Vector<Scalar>& r, Vector<Scalar>& z, const ExecutionContext& context) override
  {
    this->Load(r, context);
    const std::size_t coarsest = this->Levels.size() - 1;
    for (std::size_t l = 0; l < coarsest; ++l)
    {
      Level& level = this->Levels[l];
      level.Smoothing->PreSmooth(level.b, level.x, level.r, context);
      this->Restrict(level, this->Levels[l + 1], context);
    }
    this->SolveCoarsest(this->Levels[coarsest]);
    for (std::size_t l = coarsest; l-- > 0;)
    {
      Level& level = this->Levels[l];
      this->Correct(level, this->Levels[l + 1], context);
      level.Smoothing->PostSmooth(level.b, level.x, context);
    }
    this->Store(z, context);
  }

  long long Bytes() const override
  {
    long long bytes = 0;
    for (const Level& level : this->Levels)
    {
      const long long size = level.x.size();
      bytes += BytesOf(level.A.Lower) + BytesOf(level.A.Upper) + BytesOf(level.P) + BytesOf(level.R);
      bytes += size * static_cast<long long>(3 * sizeof(Value) + sizeof(double) + 2 * sizeof(int));
    }
    return bytes;
  }

private:
  struct Level
  {
    Arrangement Arranged;
    // The rest is scaled and in the order of the arrangement; empty on the coarsest level.
    UnitDiagonalMatrix<Value> A;
    SparseMatrix<Value> P; ///< from the next coarser level to this
    SparseMatrix<Value> R; ///< P^H
    std::unique_ptr<Smoother<Value>> Smoothing;
    Vector<Value> b;
    Vector<Value> x;
    Vector<Value> r;
  };

  /// b of the finest level from a residual.
  void Load(const Vector<Scalar>& r, const ExecutionContext& context)
  {
    Level& finest = this->Levels[0];
    context.ParallelFor(0, static_cast<int>(r.size()), RowGrain,
      [&finest, &r](int first, int last)
      {
        for (int k = first; k < last; ++k)
        {
          const int i = finest.Arranged.Order[k];
          finest.b[k] = static_cast<Value>(r[i] * finest.Arranged.Scale[i]);
        }
      });
  }

  void Store(Vector<Scalar>& z, const ExecutionContext& context) const
  {
    const Level& finest = this->Levels[0];
    z.resize(finest.x.size());
    context.ParallelFor(0, static_cast<int>(z.size()), RowGrain,
      [&finest, &z](int first, int last)
      {
        for (int i = first; i < last; ++i)
        {
          z[i] = static_cast<Scalar>(finest.x[finest.Arranged.Places[i]]) *
            finest.Arranged.Scale[i];
        }
      });
  }

  static void Restrict(const Level& fine, Level& coarse, const ExecutionContext& context)
  {
    context.ParallelFor(0, static_cast<int>(coarse.b.size()), RowGrain / 4,
      [&fine, &coarse](int first, int last)
      {
        for (int i = first; i < last; ++i)
        {
          coarse.b[i] = RowTimes(fine.R, i, fine.r.data());
        }
      });
  }

  static void Correct(Level& fine, const Level& coarse, const ExecutionContext& context)
  {
    context.ParallelFor(0, static_cast<int>(fine.x.size()), RowGrain,
      [&fine, &coarse](int first, int last)
      {
        for (int i = first; i < last; ++i)
        {
          fine.x[i] += RowTimes(fine.P, i, coarse.x.data());
        }
      });
  }

  void SolveCoarsest(Level& coarsest)
  {
    this->CoarsestRightHandSide = coarsest.b.template cast<Scalar>();
    this->Hierarchy.CoarsestSolver().Solve(this->CoarsestRightHandSide, this->CoarsestSolution);
    coarsest.x = this->CoarsestSolution.template cast<Value>();
  }

  GalerkinHierarchy<Scalar>& Hierarchy;
  const CycleOptions Options;
  std::vector<Level> Levels;
  Vector<Scalar> CoarsestRightHandSide;
  Vector<Scalar> CoarsestSolution;
};

template <class Scalar>
MultigridCycle<Scalar>::MultigridCycle(GalerkinHierarchy<Scalar>& hierarchy,
  const CycleOptions& options, const ExecutionContext& context)
  : Hierarchy(hierarchy)
  , Options(options)
{
  if (options.Smoothing.PreSweeps < 0 || options.Smoothing.PostSweeps < 0)
  {
    throw InvalidInput("the number of smoothing sweeps must not be negative");
  }
  this->Build(context);
}

template <class Scalar>
MultigridCycle<Scalar>::~MultigridCycle() = default;

template <class Scalar>
bool MultigridCycle<Scalar>::NeedsDoublePrecision() const
{
  return this->Options.Precision == CyclePrecision::Double ||
    (this->Options.Precision == CyclePrecision::Automatic &&
      this->Hierarchy.CoarsestSolver().ReciprocalCondition() < 1e-5);
}

template <class Scalar>
void MultigridCycle<Scalar>::Build(const ExecutionContext& context)
{
  using SingleScalar =
    std::conditional_t<std::is_same<Scalar, double>::value, float, std::complex<float>>;
  this->IsDouble = this->NeedsDoublePrecision();
  if (this->IsDouble)
  {
    this->Internal =
      std::make_unique<InternalsOf<Scalar>>(this->Hierarchy, this->Options, context);
  }
  else
  {
    this->Internal =
      std::make_unique<InternalsOf<SingleScalar>>(this->Hierarchy, this->Options, context);
  }
}

template <class Scalar>
void MultigridCycle<Scalar>::Update(const ExecutionContext& context)
{
  if (this->NeedsDoublePrecision() == this->IsDouble)
  {
    this->Internal->Update(context);
  }
  else
  {
    this->Build(context);
  }
}

template <class Scalar>
void MultigridCycle<Scalar>::Apply(
  const Vector<Scalar>& r, Vector<Scalar>& z, const ExecutionContext& context)
{
  this->Internal->Apply(r, z, context);
}

template <class Scalar>
long long MultigridCycle<Scalar>::Bytes() const
{
  return this->Internal->Bytes();
}

template class MultigridCycle<double>;
template class MultigridCycle<Complex>;

}
