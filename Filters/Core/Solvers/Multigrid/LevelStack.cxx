#include "Solvers/Multigrid/LevelStack.h"

#include "Solvers/Kernels/ArrangedMatrix.h"
#include "Solvers/Kernels/SweepOrder.h"
#include "Support/Permutations.h"
#include "Support/SparseKernels.h"

#include <cmath>
#include <complex>

namespace dmg
{
namespace
{

constexpr int RowGrain = 1024;

double Reciprocal(double x)
{
  return x > 0.0 ? 1.0 / x : 0.0;
}

/// D^{-1/2}; zero for inactive unknowns.
Vector<double> Scaling(const Vector<double>& diagonal)
{
  return diagonal.unaryExpr([](double entry) { return Reciprocal(std::sqrt(entry)); });
}

}

template <class Scalar, class Value>
LevelStack<Scalar, Value>::LevelStack(GalerkinHierarchy<Scalar>& hierarchy,
  const std::optional<SmootherOptions>& sweeps, int finestFactor, const ExecutionContext& context)
  : Hierarchy(hierarchy)
  , Sweeps(sweeps)
  , FinestFactor(finestFactor)
  , Levels(hierarchy.NumberOfLevels())
{
  const int coarsest = hierarchy.NumberOfLevels() - 1;
  context.Checkpoint(0.0);
  // Greedy colours come one after the other, but levels do not wait for each other.
  context.ParallelFor(0, coarsest + 1, 1,
    [this, &hierarchy, coarsest](int first, int last)
    {
      for (int l = first; l < last; ++l)
      {
        const int size = hierarchy.NumberOfUnknowns(l);
        SweepOrder order = l < coarsest && this->Sweeps ? OrderForSweeps(hierarchy.Matrix(l)) : SingleColour(size);
        Level& level = this->Levels[l];
        level.A.Begins = std::move(order.Begins);
        level.A.ColoursOfTiles = std::move(order.ColoursOfTiles);
        level.Order = std::move(order.Unknowns);
        level.x.resize(size);
        level.b.resize(size);
      }
    });
  this->CallersOrder.reserve(this->Levels[0].Order.size());
  for (const int i : this->Levels[0].Order)
  {
    this->CallersOrder.push_back(hierarchy.FinestOrder()[i]);
  }
  this->Update(context);
}

template <class Scalar, class Value>
void LevelStack<Scalar, Value>::Update(const ExecutionContext& context)
{
  const int coarsest = this->NumberOfLevels() - 1;
  std::vector<int> places = Inverse(this->Levels[0].Order);
  Vector<double> scale = Scaling(this->Hierarchy.Diagonal(0));
  this->LoadScaling(scale);
  for (int l = 0; l < coarsest; ++l)
  {
    context.Checkpoint((l + 1.0) / (coarsest + 1.0));
    Level& level = this->Levels[l];
    const std::vector<int>& order = level.Order;
    std::vector<int> coarsePlaces = Inverse(this->Levels[l + 1].Order);
    Vector<double> coarseScale = Scaling(this->Hierarchy.Diagonal(l + 1));

    if (this->Sweeps)
    {
      const SparseMatrix<Scalar>& A = this->Hierarchy.Matrix(l);
      TriangularParts<Value>& parts = level.A;
      parts.HavePairs = parts.HaveTiles() && HasPairs(A);
      if (parts.HavePairs)
      {
        ArrangePairs(A, order, places, scale, parts.Lower, parts.Upper, context);
      }
      else
      {
        ArrangeLower(A, order, places, scale, parts.Lower, context);
        ArrangeUpper(A, order, places, scale, parts.Upper, context);
      }
    }
    Arrange(this->Hierarchy.Prolongation(l), order, coarsePlaces, scale.unaryExpr(&Reciprocal), coarseScale,
      EveryEntry(), level.P, context);
    SparseMatrix<Value> R = Adjoint(level.P, context);
    level.R.swap(R); // an assignment would copy

    places = std::move(coarsePlaces);
    scale = std::move(coarseScale);
  }
  this->MakeSmoothers();
  context.Checkpoint(1.0);
}

template <class Scalar, class Value>
void LevelStack<Scalar, Value>::MakeSmoothers()
{
  this->Smoothers.clear();
  for (int l = 0; this->Sweeps && l + 1 < this->NumberOfLevels(); ++l)
  {
    const int factor = l == 0 ? this->FinestFactor : 1;
    const SmootherOptions sweeps = { factor * this->Sweeps->PreSweeps, factor * this->Sweeps->PostSweeps };
    this->Smoothers.push_back(Smoother<Value>::New(this->Levels[l].A, sweeps));
  }
}

template <class Scalar, class Value>
void LevelStack<Scalar, Value>::LoadScaling(const Vector<double>& scale)
{
  const std::vector<int>& order = this->Levels[0].Order;
  this->FinestScale.resize(scale.size());
  for (std::size_t k = 0; k < order.size(); ++k)
  {
    this->FinestScale[k] = static_cast<Real>(scale[order[k]]);
  }
}

template <class Scalar, class Value>
void LevelStack<Scalar, Value>::Load(const Vector<Scalar>& b, const ExecutionContext& context)
{
  context.ParallelFor(0, static_cast<int>(b.size()), RowGrain,
    [this, &b](int first, int last)
    {
      Vector<Value>& scaled = this->Levels[0].b;
      for (int k = first; k < last; ++k)
      {
        const double scale = this->FinestScale[k];
        scaled[k] = static_cast<Value>(b[this->CallersOrder[k]] * scale);
      }
    });
}

template <class Scalar, class Value>
void LevelStack<Scalar, Value>::Store(Vector<Scalar>& x, const ExecutionContext& context) const
{
  x.resize(this->Levels[0].x.size());
  context.ParallelFor(0, static_cast<int>(x.size()), RowGrain,
    [this, &x](int first, int last)
    {
      const Vector<Value>& scaled = this->Levels[0].x;
      for (int k = first; k < last; ++k)
      {
        const double scale = this->FinestScale[k];
        x[this->CallersOrder[k]] = static_cast<Scalar>(scaled[k]) * scale;
      }
    });
}

template <class Scalar, class Value>
void LevelStack<Scalar, Value>::Restrict(int level, const Vector<Value>& r, const ExecutionContext& context)
{
  const SparseMatrix<Value>& R = this->Levels[level].R;
  Vector<Value>& b = this->Levels[level + 1].b;
  context.ParallelFor(0, static_cast<int>(b.size()), RowGrain / 4,
    [&R, &r, &b](int first, int last)
    {
      for (int i = first; i < last; ++i)
      {
        b[i] = RowTimes(R, i, r.data());
      }
    });
}

template <class Scalar, class Value>
void LevelStack<Scalar, Value>::Prolong(int level, const ExecutionContext& context)
{
  this->Levels[level].x.setZero();
  this->Correct(level, context);
}

template <class Scalar, class Value>
void LevelStack<Scalar, Value>::Correct(int level, const ExecutionContext& context)
{
  Level& fine = this->Levels[level];
  const Vector<Value>& coarse = this->Levels[level + 1].x;
  context.ParallelFor(0, static_cast<int>(fine.x.size()), RowGrain,
    [&fine, &coarse](int first, int last)
    {
      for (int i = first; i < last; ++i)
      {
        fine.x[i] += RowTimes(fine.P, i, coarse.data());
      }
    });
}

template <class Scalar, class Value>
void LevelStack<Scalar, Value>::ProlongToFinest(int level, const ExecutionContext& context)
{
  while (level-- > 0)
  {
    this->Prolong(level, context);
  }
}

template <class Scalar, class Value>
void LevelStack<Scalar, Value>::SolveCoarsest()
{
  Level& coarsest = this->Levels.back();
  this->CoarsestRightHandSide = coarsest.b.template cast<Scalar>();
  this->Hierarchy.CoarsestSolver().Solve(this->CoarsestRightHandSide, this->CoarsestSolution);
  coarsest.x = this->CoarsestSolution.template cast<Value>();
}

template <class Scalar, class Value>
void LevelStack<Scalar, Value>::Sweep(int level, const ExecutionContext& context)
{
  this->Smoothers[level]->PostSmooth(this->Levels[level].b, this->Levels[level].x, context);
}

template <class Scalar, class Value>
void LevelStack<Scalar, Value>::Cycle(int level, const ExecutionContext& context)
{
  const int coarsest = this->NumberOfLevels() - 1;
  for (int l = level; l < coarsest; ++l)
  {
    this->Restrict(l, this->Smoothers[l]->PreSmooth(this->Levels[l].b, this->Levels[l].x, context), context);
  }
  this->SolveCoarsest();
  for (int l = coarsest; l-- > level;)
  {
    this->Correct(l, context);
    this->Sweep(l, context);
  }
}

template <class Scalar, class Value>
long long LevelStack<Scalar, Value>::Bytes() const
{
  long long bytes = static_cast<long long>(this->CallersOrder.size() * sizeof(int)) +
    this->FinestScale.size() * static_cast<long long>(sizeof(Real));
  for (const Level& level : this->Levels)
  {
    bytes += BytesOf(level.A.Lower) + BytesOf(level.A.Upper) + BytesOf(level.P) + BytesOf(level.R) +
      static_cast<long long>(level.Order.size() * sizeof(int)) +
      (level.x.size() + level.b.size()) * static_cast<long long>(sizeof(Value));
  }
  for (const auto& smoother : this->Smoothers)
  {
    bytes += smoother->Bytes();
  }
  return bytes;
}

template class LevelStack<double, float>;
template class LevelStack<double, double>;
template class LevelStack<Complex, std::complex<float>>;
template class LevelStack<Complex, Complex>;

}
