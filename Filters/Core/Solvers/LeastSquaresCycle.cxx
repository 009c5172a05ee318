#include "Solvers/LeastSquaresCycle.h"

#include "Support/Errors.h"
#include "Support/Permutations.h"
#include "Support/SparseKernels.h"

#include <cmath>
#include <complex>
#include <string>

namespace dmg
{
namespace
{

constexpr int RowGrain = 8192;

/// Numbers 0, 1, ... of items in ascending order of their keys; equal keys keep their order.
template <class Key>
std::vector<int> SortedByKey(int size, int numberOfKeys, const Key& key)
{
  std::vector<int> next(numberOfKeys + 1, 0);
  for (int i = 0; i < size; ++i)
  {
    ++next[key(i) + 1];
  }
  OffsetsFromCounts(next);
  std::vector<int> order(size);
  for (int i = 0; i < size; ++i)
  {
    order[next[key(i)]++] = i;
  }
  return order;
}

template <class Scalar>
int FirstColumn(const SparseMatrix<Scalar>& A, int row, int otherwise)
{
  const int begin = A.outerIndexPtr()[row];
  return begin < A.outerIndexPtr()[row + 1] ? A.innerIndexPtr()[begin] : otherwise;
}

UnknownBlocks Permuted(const UnknownBlocks& blocks, const std::vector<int>& order,
  const std::vector<int>& placesOfUnknowns)
{
  UnknownBlocks permuted;
  permuted.Unknowns.reserve(blocks.Unknowns.size());
  for (const int k : order)
  {
    for (int s = blocks.Offsets[k]; s < blocks.Offsets[k + 1]; ++s)
    {
      permuted.Unknowns.push_back(placesOfUnknowns[blocks.Unknowns[s]]);
    }
    permuted.EndBlock();
  }
  return permuted;
}

/// Lengths of the columns of B, each the row of a transpose; 1 where there is nothing.
Vector<double> ColumnLengths(const SparseMatrix<double>& Bt, const ExecutionContext& context)
{
  Vector<double> lengths(Bt.rows());
  context.ParallelFor(0, static_cast<int>(Bt.rows()), RowGrain, [&](int first, int last) {
    for (int i = first; i < last; ++i)
    {
      double squared = 0.0;
      for (int e = Bt.outerIndexPtr()[i]; e < Bt.outerIndexPtr()[i + 1]; ++e)
      {
        squared += Bt.valuePtr()[e] * Bt.valuePtr()[e];
      }
      lengths[i] = squared > 0.0 ? std::sqrt(squared) : 1.0;
    }
  });
  return lengths;
}

/// Multiplies rows by \p rowFactor(row) and columns by \p columnFactor(column).
template <class Scalar, class RowFactor, class ColumnFactor>
void Scale(SparseMatrix<Scalar>& A, const RowFactor& rowFactor, const ColumnFactor& columnFactor,
  const ExecutionContext& context)
{
  context.ParallelFor(0, static_cast<int>(A.rows()), RowGrain, [&](int first, int last) {
    for (int i = first; i < last; ++i)
    {
      for (int e = A.outerIndexPtr()[i]; e < A.outerIndexPtr()[i + 1]; ++e)
      {
        A.valuePtr()[e] *= rowFactor(i) * columnFactor(A.innerIndexPtr()[e]);
      }
    }
  });
}

}

/// The finest level: its smoother and its transfers, in an order of its own and scaled such that the
/// columns of B have length 1.
class LeastSquaresCycle::FineLevel
{
public:
  virtual ~FineLevel() = default;
  /// Smooths from zero. \param coarse on exit the residual, restricted.
  virtual void Down(
    const Vector<double>& r, Vector<double>& coarse, const ExecutionContext& context) = 0;
  /// Corrects and smooths.
  virtual void Up(
    const Vector<double>& coarse, Vector<double>& z, const ExecutionContext& context) = 0;
  virtual long long Bytes() const = 0;
};

template <class Value>
class LeastSquaresCycle::FineLevelOf : public LeastSquaresCycle::FineLevel
{
  using Plane = std::complex<Value>;

public:
  FineLevelOf(const SparseMatrix<double>& B, const UnknownBlocks& blocks,
    const PlanarProlongation& prolongation, std::vector<int> order, const Vector<double>& lengths,
    int sweeps, const ExecutionContext& context)
    : Order(std::move(order))
    , Factors(lengths.cwiseInverse().template cast<Value>())
    , Smoother(B, blocks, sweeps, context)
    , P(prolongation.cast<Plane>())
    , b(B.cols())
    , x(B.cols())
    , Residual(B.cols())
    , CoarsePlane(P.cols())
  {
    SparseMatrix<Plane> restriction = Adjoint(this->P, context);
    this->R.swap(restriction);
  }

  void Down(
    const Vector<double>& r, Vector<double>& coarse, const ExecutionContext& context) override
  {
    context.ParallelFor(0, static_cast<int>(r.size()), RowGrain, [&](int first, int last) {
      for (int k = first; k < last; ++k)
      {
        this->b[k] = static_cast<Value>(r[this->Order[k]]) * this->Factors[k];
      }
    });
    this->Smoother.PreSmooth(this->b, this->x, this->Residual, context);
    coarse.resize(2 * this->R.rows());
    context.ParallelFor(0, static_cast<int>(this->R.rows()), RowGrain / 16, [&](int first, int last) {
      for (int j = first; j < last; ++j)
      {
        Plane sum(0);
        for (int e = this->R.outerIndexPtr()[j]; e < this->R.outerIndexPtr()[j + 1]; ++e)
        {
          sum += this->R.valuePtr()[e] * this->Residual[this->R.innerIndexPtr()[e]];
        }
        coarse[2 * j] = sum.real();
        coarse[2 * j + 1] = -sum.imag(); // R is the conjugate of the transpose
      }
    });
  }

  void Up(const Vector<double>& coarse, Vector<double>& z, const ExecutionContext& context) override
  {
    for (Eigen::Index j = 0; j < this->CoarsePlane.size(); ++j)
    {
      this->CoarsePlane[j] =
        Plane(static_cast<Value>(coarse[2 * j]), static_cast<Value>(coarse[2 * j + 1]));
    }
    context.ParallelFor(0, static_cast<int>(this->x.size()), RowGrain / 4, [&](int first, int last) {
      for (int i = first; i < last; ++i)
      {
        Value sum(0);
        for (int e = this->P.outerIndexPtr()[i]; e < this->P.outerIndexPtr()[i + 1]; ++e)
        {
          const Plane p = this->P.valuePtr()[e];
          const Plane c = this->CoarsePlane[this->P.innerIndexPtr()[e]];
          sum += p.real() * c.real() + p.imag() * c.imag();
        }
        this->x[i] += sum;
      }
    });
    this->Smoother.PostSmooth(this->b, this->x, context);
    z.resize(this->x.size());
    context.ParallelFor(0, static_cast<int>(z.size()), RowGrain, [&](int first, int last) {
      for (int k = first; k < last; ++k)
      {
        z[this->Order[k]] = this->x[k] * this->Factors[k];
      }
    });
  }

  long long Bytes() const override
  {
    return this->Smoother.Bytes() +
      (this->P.nonZeros() + this->R.nonZeros()) * static_cast<long long>(sizeof(Plane) + 4) +
      this->x.size() * static_cast<long long>(4 * sizeof(Value) + 4);
  }

private:
  const std::vector<int> Order;
  const Vector<Value> Factors;
  BlockSmoother<Value> Smoother;
  SparseMatrix<Plane> P;
  SparseMatrix<Plane> R; // P^H
  Vector<Value> b;
  Vector<Value> x;
  Vector<Value> Residual;
  Vector<Plane> CoarsePlane;
};

LeastSquaresCycle::LeastSquaresCycle(const SparseMatrix<double>& factor, LeastSquaresLevels levels,
  const LeastSquaresCycleOptions& options, const ExecutionContext& context)
{
  PlanarProlongation& P = levels.Prolongation;
  if (P.rows() != factor.cols())
  {
    throw InvalidInput("the prolongation to level 0 has " + std::to_string(P.rows()) +
      " rows instead of " + std::to_string(factor.cols()) + "; use the operators of this surface");
  }
  if (!levels.Coarser.empty() && levels.Coarser[0].rows() != 2 * P.cols())
  {
    throw InvalidInput("the prolongation to level 1 has " +
      std::to_string(levels.Coarser[0].rows()) + " rows instead of " +
      std::to_string(2 * P.cols()) + "; use the operators of this surface");
  }
  // Unknowns, blocks and rows of B by the coarse unknowns that they belong to.
  const int unknowns = static_cast<int>(factor.cols());
  const int keys = std::max(1, static_cast<int>(P.cols()));
  const auto keyOfUnknown = [&P](int i) { return FirstColumn(P, i, 0); };
  std::vector<int> order = SortedByKey(unknowns, keys, keyOfUnknown);
  const std::vector<int> places = Inverse(order);
  const std::vector<int> rowOrder = SortedByKey(static_cast<int>(factor.rows()), keys,
    [&](int row) { return unknowns > 0 ? keyOfUnknown(FirstColumn(factor, row, 0)) : 0; });
  const std::vector<int> blockOrder = SortedByKey(levels.Blocks.Size(), keys, [&](int k) {
    return keyOfUnknown(levels.Blocks.Unknowns[levels.Blocks.Offsets[k]]);
  });
  SparseMatrix<double> B = Permuted(factor, rowOrder, places, context);
  const UnknownBlocks blocks = Permuted(levels.Blocks, blockOrder, places);
  {
    PlanarProlongation permuted = Permuted(P, order, Identity(static_cast<int>(P.cols())), context);
    P.swap(permuted);
  }
  const Vector<double> lengths = ColumnLengths(Adjoint(B, context), context);
  const auto one = [](int) { return 1.0; };
  Scale(B, one, [&lengths](int column) { return 1.0 / lengths[column]; }, context);
  Scale(P, [&lengths](int row) { return lengths[row]; }, one, context);
  context.Checkpoint(0.1);

  P = SmoothedPlanar(B, std::move(P), options.ProlongationDegree, options.Dropped, context);
  context.Checkpoint(0.5);
  const SparseMatrix<double> coarse = GramOfPlanar(Product(B, P, context), context);
  context.Checkpoint(0.7);
  GalerkinOptions coarsening;
  if (coarse.rows() <= options.LargestFactor)
  {
    coarsening.CoarsestLevel = 0;
  }
  this->Hierarchy = std::make_unique<GalerkinHierarchy<double>>(
    coarse, std::move(levels.Coarser), coarsening, PartOfContext(context, 0.7, 0.8));
  this->Coarse = std::make_unique<MultigridCycle<double>>(
    *this->Hierarchy, options.Coarse, PartOfContext(context, 0.8, 0.9));
  if (this->Hierarchy->CoarsestSolver().ReciprocalCondition() < 1e-5)
  {
    this->Fine = std::make_unique<FineLevelOf<double>>(
      B, blocks, P, std::move(order), lengths, options.Sweeps, context);
  }
  else
  {
    this->Fine = std::make_unique<FineLevelOf<float>>(
      B, blocks, P, std::move(order), lengths, options.Sweeps, context);
  }
  this->Reports = { { unknowns, static_cast<long long>(B.nonZeros()) } };
  this->Reports.insert(
    this->Reports.end(), this->Hierarchy->Levels().begin(), this->Hierarchy->Levels().end());
  this->Hierarchy->ForgetMatrices();
  this->Hierarchy->ForgetProlongations();
  context.Checkpoint(1.0);
}

LeastSquaresCycle::~LeastSquaresCycle() = default;

void LeastSquaresCycle::Apply(
  const Vector<double>& r, Vector<double>& z, const ExecutionContext& context)
{
  this->Fine->Down(r, this->CoarseResidual, context);
  this->Coarse->Apply(this->CoarseResidual, this->CoarseCorrection, context);
  this->Fine->Up(this->CoarseCorrection, z, context);
}

long long LeastSquaresCycle::Bytes() const
{
  return this->Fine->Bytes() + this->Hierarchy->Bytes() + this->Coarse->Bytes();
}

}
