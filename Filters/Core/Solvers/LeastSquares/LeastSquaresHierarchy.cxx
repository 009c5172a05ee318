#include "Solvers/LeastSquares/LeastSquaresHierarchy.h"

#include "Solvers/Direct/ShiftedFactor.h"
#include "Solvers/Kernels/FirstOccurrences.h"
#include "Solvers/LeastSquares/BlockSmoother.h"
#include "Solvers/LeastSquares/LeastSquaresCycle.h"
#include "Support/CountingSort.h"
#include "Support/DisjointSets.h"
#include "Support/Errors.h"
#include "Support/FreedMemory.h"
#include "Support/Permutations.h"
#include "Support/SparseKernels.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

namespace dmg
{
namespace
{

constexpr int RowGrain = 8192;

template <class Scalar>
int FirstColumn(const SparseMatrix<Scalar>& A, int row, int otherwise)
{
  const int begin = A.outerIndexPtr()[row];
  return begin < A.outerIndexPtr()[row + 1] ? A.innerIndexPtr()[begin] : otherwise;
}

Vector<double> SquaredLengthsOfRows(const SparseMatrix<double>& M, const ExecutionContext& context)
{
  Vector<double> squared(M.rows());
  context.ParallelFor(0, static_cast<int>(M.rows()), RowGrain,
    [&](int first, int last)
    {
      for (int i = first; i < last; ++i)
      {
        squared[i] = 0.0;
        for (int e = M.outerIndexPtr()[i]; e < M.outerIndexPtr()[i + 1]; ++e)
        {
          squared[i] += M.valuePtr()[e] * M.valuePtr()[e];
        }
      }
    });
  return squared;
}

/// The divisors of the columns of B, with which B^T B has no eigenvalue above 1 (Gershgorin): their
/// lengths, which alone would give it a unit diagonal, times the roots of the sums of rows that |B|^T |B|
/// would then have. A sliver or a high valence makes a few sums large; a bound for all would be as large.
/// 1 where there is nothing.
Vector<double> ScalesOfColumns(
  const SparseMatrix<double>& B, const SparseMatrix<double>& Bt, const ExecutionContext& context)
{
  Vector<double> lengths = SquaredLengthsOfRows(Bt, context).cwiseSqrt();
  lengths = (lengths.array() > 0.0).select(lengths, 1.0);
  Vector<double> rowSums(B.rows());
  Vector<double> scales(Bt.rows());
  context.ParallelFor(0, static_cast<int>(B.rows()), RowGrain,
    [&](int first, int last)
    {
      for (int k = first; k < last; ++k)
      {
        rowSums[k] = 0.0;
        for (int e = B.outerIndexPtr()[k]; e < B.outerIndexPtr()[k + 1]; ++e)
        {
          rowSums[k] += std::abs(B.valuePtr()[e]) / lengths[B.innerIndexPtr()[e]];
        }
      }
    });
  context.ParallelFor(0, static_cast<int>(Bt.rows()), RowGrain,
    [&](int first, int last)
    {
      for (int i = first; i < last; ++i)
      {
        double sum = 0.0;
        for (int e = Bt.outerIndexPtr()[i]; e < Bt.outerIndexPtr()[i + 1]; ++e)
        {
          sum += std::abs(Bt.valuePtr()[e]) * rowSums[Bt.innerIndexPtr()[e]];
        }
        scales[i] = sum > 0.0 ? std::sqrt(sum * lengths[i]) : 1.0;
      }
    });
  return scales;
}

/// Multiplies rows by \p rowFactor(row) and columns by \p columnFactor(column).
template <class Scalar, class RowFactor, class ColumnFactor>
void Scale(SparseMatrix<Scalar>& A, const RowFactor& rowFactor, const ColumnFactor& columnFactor,
  const ExecutionContext& context)
{
  context.ParallelFor(0, static_cast<int>(A.rows()), RowGrain,
    [&](int first, int last)
    {
      for (int i = first; i < last; ++i)
      {
        for (int e = A.outerIndexPtr()[i]; e < A.outerIndexPtr()[i + 1]; ++e)
        {
          A.valuePtr()[e] *= rowFactor(i) * columnFactor(A.innerIndexPtr()[e]);
        }
      }
    });
}

/// Throws unless the sizes of levels chain and the blocks are small enough.
void CheckLevels(const LeastSquaresLevels& levels, Eigen::Index unknowns)
{
  for (int k = 0; k < levels.Blocks.Size(); ++k)
  {
    const int size = levels.Blocks.SizeOf(k);
    if (size > UnknownBlocks::LargestBlock)
    {
      throw InvalidInput("block " + std::to_string(k) + " holds " + std::to_string(size) +
        " unknowns; split it into blocks of at most " + std::to_string(UnknownBlocks::LargestBlock));
    }
  }
  if (levels.Prolongation.rows() != unknowns)
  {
    throw InvalidInput("the prolongation to level 0 has " + std::to_string(levels.Prolongation.rows()) +
      " rows instead of " + std::to_string(unknowns) + "; use the operators of this surface");
  }
  long long size = 2 * levels.Prolongation.cols();
  for (std::size_t l = 0; l < levels.Coarser.size(); ++l)
  {
    if (levels.Coarser[l].rows() != size)
    {
      throw InvalidInput("the prolongation to level " + std::to_string(l + 1) + " has " +
        std::to_string(levels.Coarser[l].rows()) + " rows instead of " + std::to_string(size) +
        "; use the operators of this surface");
    }
    size = levels.Coarser[l].cols();
  }
}

/// Sorts tiles such that the rows of B of a tile make a few runs.
void SortTilesByLength(const SparseMatrix<double>& B, std::vector<int>& rowOrder, const ExecutionContext& context)
{
  const auto length = [&B](int row) { return B.outerIndexPtr()[row + 1] - B.outerIndexPtr()[row]; };
  const int rows = static_cast<int>(rowOrder.size());
  context.ParallelFor(0, (rows + RowTiles::RowsOfTile - 1) / RowTiles::RowsOfTile, 1,
    [&](int firstTile, int lastTile)
    {
      for (int tile = firstTile; tile < lastTile; ++tile)
      {
        std::stable_sort(rowOrder.begin() + tile * RowTiles::RowsOfTile,
          rowOrder.begin() + std::min((tile + 1) * RowTiles::RowsOfTile, rows),
          [&length](int a, int b) { return length(a) < length(b); });
      }
    });
}

/// Blocks by the coarse unknowns that they belong to; unknowns as the blocks come to them, and rows of B as the
/// unknowns do.
/// \return the order of the unknowns.
std::vector<int> RenumberHierarchically(
  SparseMatrix<double>& B, LeastSquaresLevels& levels, const ExecutionContext& context)
{
  PlanarProlongation& P = levels.Prolongation;
  UnknownBlocks& blocks = levels.Blocks;
  const int unknowns = static_cast<int>(B.cols());
  const int rows = static_cast<int>(B.rows());
  const SortedItems byCoarse = SortByKey(
    Identity(blocks.Size()), std::max(1, static_cast<int>(P.cols())),
    [&](int k) { return FirstColumn(P, blocks.Unknowns[blocks.Offsets[k]], 0); }, context);
  SparseMatrix<double> Bt = Adjoint(B, context);
  blocks = OrderedByColours(Bt, blocks.InOrder(byCoarse.Items), context);
  FirstOccurrences ofUnknowns(unknowns);
  ofUnknowns.Add(blocks.Unknowns.begin(), blocks.Unknowns.end());
  const std::vector<int> order = ofUnknowns.Complete();
  FirstOccurrences ofRows(rows);
  {
    const SparseMatrix<double> rowsOfUnknowns = Permuted(Bt, order, Identity(rows), context);
    ofRows.Add(rowsOfUnknowns.innerIndexPtr(), rowsOfUnknowns.innerIndexPtr() + rowsOfUnknowns.nonZeros());
  }
  std::vector<int> rowOrder = ofRows.Complete();
  SortTilesByLength(B, rowOrder, context);
  const std::vector<int> places = Inverse(order, context);
  for (int& unknown : blocks.Unknowns)
  {
    unknown = places[unknown];
  }
  // An assignment would copy.
  SparseMatrix<double> permuted = Permuted(B, rowOrder, places, context);
  B.swap(permuted);
  PlanarProlongation permutedP = Permuted(P, order, Identity(static_cast<int>(P.cols())), context);
  P.swap(permutedP);
  return order;
}

double Dropped(const LeastSquaresHierarchyOptions& options, Eigen::Index unknowns)
{
  constexpr double largest = 3e5;
  return options.Dropped * std::sqrt(std::min(1.0, largest / static_cast<double>(unknowns)));
}

}

LeastSquaresHierarchy CoarsenLeastSquares(SparseMatrix<double> B, LeastSquaresLevels levels,
  const LeastSquaresHierarchyOptions& options, const ExecutionContext& context)
{
  CheckLevels(levels, B.cols());
  std::vector<int> order = RenumberHierarchically(B, levels, context);
  SparseMatrix<double> Bt = Adjoint(B, context);
  Vector<double> scales = ScalesOfColumns(B, Bt, context);
  const auto one = [](int) { return 1.0; };
  Scale(
    B, one, [&scales](int column) { return 1.0 / scales[column]; }, context);
  Scale(
    Bt, [&scales](int row) { return 1.0 / scales[row]; }, one, context);
  // An unknown that no row of B touches is left to its block: the coarse matrix has no place for it.
  const auto isTouched = [&Bt](int i) { return Bt.outerIndexPtr()[i] < Bt.outerIndexPtr()[i + 1]; };
  Scale(
    levels.Prolongation, [&scales, &isTouched](int row) { return isTouched(row) ? scales[row] : 0.0; }, one, context);
  context.Checkpoint(0.1);

  // The interpolation takes most memory while it is smoothed; blocks come after it.
  SparseMatrix<Complex32> restriction = Joined(SmoothedRestriction(B, Bt, std::move(levels.Prolongation),
                                                 options.ProlongationDegree, Dropped(options, B.cols()), context),
    context);
  GiveBackFreedMemory();
  SingleProlongation prolongation(Adjoint(restriction, context));
  context.Checkpoint(0.6);
  SparseMatrix<double> lower = CoarseStiffness(B, Bt, prolongation.Matrix(), restriction, {}, context);
  SparseMatrix<Complex32>().swap(restriction);
  GiveBackFreedMemory();
  context.Checkpoint(0.8);

  LeastSquaresHierarchy hierarchy;
  hierarchy.Blocks = std::move(levels.Blocks);
  hierarchy.Prolongation = std::move(prolongation);
  hierarchy.CoarseLower.swap(lower); // an assignment would copy
  hierarchy.SetComponents(ConnectedColumns(B));
  hierarchy.Order = std::move(order);
  hierarchy.Scales = std::move(scales);
  hierarchy.Diagonal = SquaredLengthsOfRows(Bt, context).cast<float>();
  hierarchy.Tiles = RowTiles(B);
  hierarchy.B.swap(B);
  hierarchy.Coarser = std::move(levels.Coarser);
  context.Checkpoint(1.0);
  return hierarchy;
}

LeastSquaresHierarchy::LeastSquaresHierarchy(LeastSquaresHierarchy&& other) noexcept
  : StiffnessHierarchy(std::move(other))
  , Scales(std::move(other.Scales))
  , Diagonal(std::move(other.Diagonal))
  , Tiles(std::move(other.Tiles))
  , Blocks(std::move(other.Blocks))
  , Prolongation(std::move(other.Prolongation))
  , Coarser(std::move(other.Coarser))
{
  this->B.swap(other.B);
  this->CoarseLower.swap(other.CoarseLower);
}

long long LeastSquaresHierarchy::Bytes() const
{
  long long sum = BytesOf(this->B) + this->Prolongation.Bytes() + BytesOf(this->CoarseLower) + this->BytesOfUnknowns() +
    this->Scales.size() * static_cast<long long>(sizeof(double) + sizeof(float)) +
    static_cast<long long>((this->Blocks.Offsets.size() + this->Blocks.Unknowns.size()) * sizeof(int));
  for (const SparseMatrix<double>& P : this->Coarser)
  {
    sum += BytesOf(P);
  }
  return sum;
}

SparseMatrix<double> LeastSquaresHierarchy::RealMatrix(const ExecutionContext& context) const
{
  SparseMatrix<double> unscaled = this->B;
  Scale(
    unscaled, [](int) { return 1.0; }, [this](int column) { return this->Scales[column]; }, context);
  return NormalMatrix(unscaled, context);
}

std::unique_ptr<StiffnessOperator> LeastSquaresHierarchy::Operator() const
{
  return std::make_unique<LeastSquaresOperator>(*this);
}

std::unique_ptr<StiffnessCycle> LeastSquaresHierarchy::Cycle(
  const Vector<double>& D, const StiffnessCycleOptions& options, const ExecutionContext& context) const
{
  return std::make_unique<LeastSquaresCycle>(*this, D, options, context);
}

std::unique_ptr<Preconditioner<double>> LeastSquaresHierarchy::Factor(
  const Vector<double>& D, const ExecutionContext& context) const
{
  SparseMatrix<double> unscaled = this->B;
  const auto one = [](int) { return 1.0; };
  Scale(
    unscaled, one, [&](int column) { return std::isfinite(D[column]) ? this->Scales[column] : 0.0; }, context);
  SparseMatrix<double> A = NormalMatrix(unscaled, context);
  A += SparseMatrix<double>(D.array().isFinite().select(D, 0.0).matrix().asDiagonal());
  A.makeCompressed();
  return std::make_unique<ShiftedFactor<double>>(A);
}

LeastSquaresOperator::LeastSquaresOperator(const LeastSquaresHierarchy& hierarchy)
  : Hierarchy(hierarchy)
  , B(hierarchy.B)
  , Scaled(hierarchy.NumberOfUnknowns())
  , SquaresOfTiles(hierarchy.Tiles.Size())
{
}

void LeastSquaresOperator::SetDiagonal(const Vector<double>& diagonal, const ExecutionContext& context)
{
  this->D = SparseDiagonal(diagonal, context);
}

/// One pass over B: as soon as a row of B x is known, it is given to all columns.
double LeastSquaresOperator::Apply(const Vector<double>& x, Vector<double>& y, const ExecutionContext& context) const
{
  const Vector<double>& scales = this->Hierarchy.Scales;
  y.resize(this->Size());
  context.ParallelFor(0, this->Size(), RowGrain,
    [&](int first, int last)
    {
      const int count = last - first;
      this->Scaled.segment(first, count) = scales.segment(first, count).cwiseProduct(x.segment(first, count));
      y.segment(first, count).setZero();
    });
  this->Hierarchy.Tiles.ForTiles(context,
    [&](int tile, int firstRow, int lastRow)
    { this->SquaresOfTiles[tile] = this->B.AddGram(firstRow, lastRow, this->Scaled.data(), y.data()); });
  context.ParallelFor(0, this->Size(), RowGrain,
    [&](int first, int last)
    {
      const int count = last - first;
      y.segment(first, count).array() *= scales.segment(first, count).array();
    });
  double product = this->D.AddProduct(x, y, context);
  for (const double squares : this->SquaresOfTiles)
  {
    product += squares;
  }
  return product;
}

}
