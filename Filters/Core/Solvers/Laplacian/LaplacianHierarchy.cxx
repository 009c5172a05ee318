#include "Solvers/Laplacian/LaplacianHierarchy.h"

#include "Solvers/Direct/ShiftedFactor.h"
#include "Solvers/Kernels/ArrangedMatrix.h"
#include "Solvers/Kernels/Packs.h"
#include "Solvers/Laplacian/LaplacianCycle.h"
#include "Solvers/Multigrid/HierarchicalOrder.h"
#include "Solvers/Multigrid/MatrixPlusDiagonal.h"
#include "Solvers/Multigrid/SmoothedProlongation.h"
#include "Support/CountingSort.h"
#include "Support/DisjointSets.h"
#include "Support/Errors.h"
#include "Support/FreedMemory.h"
#include "Support/Permutations.h"
#include "Support/SparseKernels.h"
#include "Support/SparseRows.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

namespace dmg
{
namespace
{

constexpr int RowGrain = 8192;

/// A factor of a complex matrix as preconditioner on pairs.
class FactorOnPairs : public Preconditioner<double>
{
public:
  explicit FactorOnPairs(const SparseMatrix<Complex>& A)
    : Factor(A)
    , OnPairs(this->Factor)
  {
  }

  void Apply(const Vector<double>& r, Vector<double>& z, const ExecutionContext& context) override
  {
    this->OnPairs.Apply(r, z, context);
  }

private:
  ShiftedFactor<Complex> Factor;
  PreconditionerOnPairs OnPairs;
};

/// Sets the numbers of each unknown, two for each row.
/// \param components in the order of the parents.
void SetUnknowns(LaplacianHierarchy& hierarchy, const std::vector<int>& byParents, const std::vector<int>& byColours,
  const std::vector<int>& components, const ExecutionContext& context)
{
  const int unknowns = 2 * static_cast<int>(byColours.size());
  hierarchy.Order.resize(unknowns);
  std::vector<int> ofUnknowns(unknowns);
  context.ParallelFor(0, unknowns, RowGrain,
    [&](int first, int last)
    {
      for (int i = first; i < last; ++i)
      {
        const int k = byColours[i / 2];
        hierarchy.Order[i] = 2 * byParents[k] + i % 2;
        ofUnknowns[i] = components[k];
      }
    });
  hierarchy.SetComponents(std::move(ofUnknowns));
}

/// Rounds to single precision, so that the coarse matrix is that of the prolongation that cycles read.
void Round(SparseMatrix<Complex>& P, const ExecutionContext& context)
{
  context.ParallelFor(0, static_cast<int>(P.nonZeros()), RowGrain,
    [&P](int first, int last)
    {
      for (int e = first; e < last; ++e)
      {
        // Packs are written out, because GCC 12 takes a number for its rounded one when it makes packs of this itself.
        const auto entry = LoadPack<DoublePack>(P.valuePtr() + e);
        StorePack(Widened(Rounded(entry)), P.valuePtr() + e);
      }
    });
}

/// The prolongation to unknowns by colours; nothing to those that L says nothing of.
SparseMatrix<LaplacianHierarchy::Single> InColours(const SparseMatrix<Complex>& P, const SparseMatrix<Complex>& L,
  const std::vector<int>& byColours, const ExecutionContext& context)
{
  using Single = LaplacianHierarchy::Single;
  const auto makeWorker = [&]
  {
    return [&](int firstRow, int lastRow, SparseRows<Single>& rows)
    {
      for (int k = firstRow; k < lastRow; ++k)
      {
        const int row = byColours[k];
        if (L.coeff(row, row) != Complex(0.0))
        {
          for (SparseMatrix<Complex>::InnerIterator entry(P, row); entry; ++entry)
          {
            rows.Columns.push_back(static_cast<int>(entry.col()));
            rows.Values.push_back(static_cast<Single>(entry.value()));
          }
        }
        rows.EndRow();
      }
    };
  };
  return AssembleInBands<Single>(static_cast<int>(P.rows()), static_cast<int>(P.cols()), makeWorker, context);
}

}

LaplacianHierarchy CoarsenLaplacian(const MatrixInOrder& makeL, std::vector<SparseMatrix<Complex>> prolongations,
  int smoothingSteps, const ExecutionContext& context)
{
  const int size = static_cast<int>(prolongations[0].rows());
  CheckChain(size, prolongations);

  // Sorted by parents, products are fast; sweeps want colours.
  const std::vector<int> byParents = RenumberHierarchically(prolongations, size, context);
  SparseMatrix<Complex> L = makeL(byParents, context);
  CheckChain(L.rows(), prolongations);
  // The next arrays are large, and would not fit where smaller ones were; here and below.
  GiveBackFreedMemory();
  context.Checkpoint(0.2);
  SparseMatrix<Complex>& P = prolongations[0];
  SmoothProlongation(L, P, smoothingSteps, context);
  GiveBackFreedMemory();
  context.Checkpoint(0.5);
  Round(P, context);

  LaplacianHierarchy hierarchy;
  hierarchy.CoarseLower = TripleProduct(Adjoint(P, context), L, P, context).triangularView<Eigen::Lower>();
  GiveBackFreedMemory();
  context.Checkpoint(0.7);

  // Greedy colours come one after the other, and so do components; but they do not wait for each other.
  SweepOrder colours;
  std::vector<int> components;
  context.ParallelFor(0, 2, 1,
    [&](int first, int last)
    {
      for (int task = first; task < last; ++task)
      {
        if (task == 0)
        {
          colours = Colouring(L);
        }
        else
        {
          components = ConnectedColumns(L);
        }
      }
    });
  hierarchy.Prolongation = SingleProlongation(InColours(P, L, colours.Unknowns, context));
  SparseMatrix<Complex>().swap(P);
  hierarchy.SetMatrix(L, colours, context);
  SparseMatrix<Complex>().swap(L);
  SetUnknowns(hierarchy, byParents, colours.Unknowns, components, context);
  hierarchy.Coarser.reserve(prolongations.size()); // growth would copy
  for (std::size_t level = 1; level < prolongations.size(); ++level)
  {
    hierarchy.Coarser.emplace_back().swap(prolongations[level]);
  }
  context.Checkpoint(1.0);
  return hierarchy;
}

LaplacianHierarchy::LaplacianHierarchy(LaplacianHierarchy&& other) noexcept
  : StiffnessHierarchy(std::move(other))
  , Prolongation(std::move(other.Prolongation))
  , Coarser(std::move(other.Coarser))
{
  this->L.swap(other.L);
  this->Sweeps.Begins.swap(other.Sweeps.Begins);
  this->Sweeps.Lower.swap(other.Sweeps.Lower);
  this->Sweeps.Upper.swap(other.Sweeps.Upper);
  this->CoarseLower.swap(other.CoarseLower);
}

void LaplacianHierarchy::SetMatrix(
  const SparseMatrix<Complex>& matrix, const SweepOrder& colours, const ExecutionContext& context)
{
  const std::vector<int>& order = colours.Unknowns;
  const std::vector<int> places = Inverse(order, context);
  const Vector<double> unscaled = Vector<double>::Ones(matrix.rows());
  this->Sweeps.Begins = colours.Begins;
  ArrangeLower(matrix, order, places, unscaled, this->Sweeps.Lower, context);
  ArrangeUpper(matrix, order, places, unscaled, this->Sweeps.Upper, context);
  SparseMatrix<Complex> inColours = Permuted(matrix, order, places, context);
  this->L.swap(inColours); // Eigen 3.4 would copy what is moved
}

SparseMatrix<double> LaplacianHierarchy::RealMatrix(const ExecutionContext& context) const
{
  return OnRealUnknowns(this->L, context);
}

std::unique_ptr<StiffnessOperator> LaplacianHierarchy::Operator() const
{
  return std::make_unique<MatrixPlusDiagonal<Complex>>(this->L);
}

std::unique_ptr<StiffnessCycle> LaplacianHierarchy::Cycle(
  const Vector<double>& D, const StiffnessCycleOptions& options, const ExecutionContext& context) const
{
  return std::make_unique<LaplacianCycle>(*this, D, options, context);
}

std::unique_ptr<Preconditioner<double>> LaplacianHierarchy::Factor(
  const Vector<double>& D, const ExecutionContext&) const
{
  SparseMatrix<Complex> A = this->L;
  for (int k = 0; k < A.rows(); ++k)
  {
    for (SparseMatrix<Complex>::InnerIterator entry(A, k); entry; ++entry)
    {
      const bool isHeld = !std::isfinite(D[2 * k]) || !std::isfinite(D[2 * entry.col()]);
      entry.valueRef() = isHeld ? 0.0 : entry.value() + (entry.col() == k ? D[2 * k] : 0.0);
    }
  }
  return std::make_unique<FactorOnPairs>(A);
}

long long LaplacianHierarchy::Bytes() const
{
  long long bytes = BytesOf(this->L) + BytesOf(this->Sweeps.Lower) + BytesOf(this->Sweeps.Upper) +
    this->Prolongation.Bytes() + BytesOf(this->CoarseLower) + this->BytesOfUnknowns();
  for (const SparseMatrix<Complex>& P : this->Coarser)
  {
    bytes += BytesOf(P);
  }
  return bytes;
}

}
