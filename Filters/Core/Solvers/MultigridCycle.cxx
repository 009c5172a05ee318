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

std::vector<int> Inverse(const std::vector<int>& permutation)
{
  std::vector<int> inverse(permutation.size());
  for (std::size_t i = 0; i < permutation.size(); ++i)
  {
    inverse[permutation[i]] = static_cast<int>(i);
  }
  return inverse;
}

double Reciprocal(double x)
{
  return x > 0.0 ? 1.0 / x : 0.0;
}

/// The entries of A with keep(place of row, place of column), in another order and scaled: entry
/// (i, j) becomes rowScale_i a_ij columnScale_j.
template <class Value, class Scalar, class Keep>
void Arrange(const SparseMatrix<Scalar>& A, const std::vector<int>& rowOrder,
  const std::vector<int>& columnPlaces, const Vector<double>& rowScale,
  const Vector<double>& columnScale, const Keep& keep, SparseMatrix<Value>& result, const ExecutionContext& context)
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
            values[to] = static_cast<Value>(valuesOfA[m] * (rowScale[i] * columnScale[j]));
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
      level.Order = std::move(colours.Unknowns);
      level.x.resize(size);
      level.b.resize(size);
      level.r.resize(l < coarsest ? size : 0);
    }
    this->CallersOrder.reserve(this->Levels[0].Order.size());
    for (const int i : this->Levels[0].Order)
    {
      this->CallersOrder.push_back(hierarchy.FinestOrder()[i]);
    }
    this->Update(context);
  }

  void Update(const ExecutionContext& context) override
  {
    const int coarsest = this->Hierarchy.NumberOfLevels() - 1;
    std::vector<int> places = Inverse(this->Levels[0].Order);
    Vector<double> scale = Scaling(this->Hierarchy.Diagonal(0));
    this->LoadScaling(scale);
    for (int l = 0; l < coarsest; ++l)
    {
      context.Checkpoint(0.5 + 0.5 * l / (coarsest + 1.0));
      Level& level = this->Levels[l];
      const std::vector<int>& order = level.Order;
      std::vector<int> coarsePlaces = Inverse(this->Levels[l + 1].Order);
      Vector<double> coarseScale = Scaling(this->Hierarchy.Diagonal(l + 1));

      const SparseMatrix<Scalar>& A = this->Hierarchy.Matrix(l);
      Arrange(A, order, places, scale, scale,
        [](int row, int column) { return column < row; }, level.A.Lower, context);
      Arrange(A, order, places, scale, scale,
        [](int row, int column) { return column > row; }, level.A.Upper, context);
      Arrange(this->Hierarchy.Prolongation(l), order, coarsePlaces, scale.unaryExpr(&Reciprocal),
        coarseScale, [](int, int) { return true; }, level.P, context);
      SparseMatrix<Value> R = Adjoint(level.P, context);
      level.R.swap(R); // an assignment would copy
      SmootherOptions smoothing = this->Options.Smoothing;
      smoothing.PreSweeps *= l == 0 ? this->Options.FinestFactor : 1;
      smoothing.PostSweeps *= l == 0 ? this->Options.FinestFactor : 1;
      level.Smoothing = Smoother<Value>::New(level.A, smoothing, context);

      places = std::move(coarsePlaces);
      scale = std::move(coarseScale);
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
    long long bytes = static_cast<long long>(this->CallersOrder.size() * sizeof(int)) +
      this->FinestScale.size() * static_cast<long long>(sizeof(Real));
    for (const Level& level : this->Levels)
    {
      bytes += BytesOf(level.A.Lower) + BytesOf(level.A.Upper) + BytesOf(level.P) +
        BytesOf(level.R) + static_cast<long long>(level.Order.size() * sizeof(int)) +
        (level.x.size() + level.b.size() + level.r.size()) * static_cast<long long>(sizeof(Value));
    }
    return bytes;
  }

private:
  /// Scaled, and sorted by colours; on the coarsest level only Order, b and x.
  struct Level
  {
    std::vector<int> Order; ///< [k] is the unknown of the hierarchy at place k
    UnitDiagonalMatrix<Value> A;
    SparseMatrix<Value> P; ///< from the next coarser level to this
    SparseMatrix<Value> R; ///< P^H
    std::unique_ptr<Smoother<Value>> Smoothing;
    Vector<Value> b;
    Vector<Value> x;
    Vector<Value> r;
  };

  /// D^{-1/2}; zero for inactive unknowns.
  static Vector<double> Scaling(const Vector<double>& diagonal)
  {
    return diagonal.unaryExpr([](double entry) { return Reciprocal(std::sqrt(entry)); });
  }

  void LoadScaling(const Vector<double>& scale)
  {
    const std::vector<int>& order = this->Levels[0].Order;
    this->FinestScale.resize(scale.size());
    for (std::size_t k = 0; k < order.size(); ++k)
    {
      this->FinestScale[k] = static_cast<Real>(scale[order[k]]);
    }
  }

  /// b of the finest level from a residual.
  void Load(const Vector<Scalar>& r, const ExecutionContext& context)
  {
    context.ParallelFor(0, static_cast<int>(r.size()), RowGrain,
      [this, &r](int first, int last)
      {
        Vector<Value>& b = this->Levels[0].b;
        for (int k = first; k < last; ++k)
        {
          const double scale = this->FinestScale[k];
          b[k] = static_cast<Value>(r[this->CallersOrder[k]] * scale);
        }
      });
  }

  void Store(Vector<Scalar>& z, const ExecutionContext& context) const
  {
    z.resize(this->Levels[0].x.size());
    context.ParallelFor(0, static_cast<int>(z.size()), RowGrain,
      [this, &z](int first, int last)
      {
        const Vector<Value>& x = this->Levels[0].x;
        for (int k = first; k < last; ++k)
        {
          const double scale = this->FinestScale[k];
          z[this->CallersOrder[k]] = static_cast<Scalar>(x[k]) * scale;
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
  std::vector<int> CallersOrder; ///< [k] is the caller's index of place k on the finest level
  Vector<Real> FinestScale;      ///< D^{-1/2} by place
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
