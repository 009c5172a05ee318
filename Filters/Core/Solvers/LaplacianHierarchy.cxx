#include "Solvers/LaplacianHierarchy.h"

#include "Solvers/ArrangedMatrix.h"
#include "Solvers/HierarchicalOrder.h"
#include "Solvers/LaplacianCycle.h"
#include "Solvers/SmoothedProlongation.h"
#include "Solvers/SparseDiagonal.h"
#include "Support/CountingSort.h"
#include "Support/Errors.h"
#include "Support/Permutations.h"
#include "Support/RowRuns.h"
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

/// L + D as operator on pairs.
class ShiftedLaplacian : public LinearOperator<double>
{
public:
  ShiftedLaplacian(const SparseMatrix<Complex>& matrix, const Vector<double>& diagonal)
    : L(matrix)
    , D(diagonal)
  {
  }

  int Size() const override { return this->D.Size(); }

  double Apply(
    const Vector<double>& x, Vector<double>& y, const ExecutionContext& context) const override
  {
    y.resize(this->Size());
    const auto* const from = reinterpret_cast<const Complex*>(x.data());
    auto* const to = reinterpret_cast<Complex*>(y.data());
    const double ofL = SumOverBlocks<double>(
      this->Size() / 2, context, [this, from, to](int first, int last) {
        double product = 0.0;
        this->L.Multiply(first, last, from, [from, to, &product](int k, Complex sum) {
          to[k] = sum;
          product += from[k].real() * sum.real() + from[k].imag() * sum.imag();
        });
        return product;
      });
    return ofL + this->D.AddProduct(x, y);
  }

private:
  const RowRuns<Complex> L;
  const SparseDiagonal D;
};

/// Per row a number that it shares with all that it is connected with: the first of them.
std::vector<int> ComponentsOf(const SparseMatrix<Complex>& L)
{
  std::vector<int> parents = Identity(static_cast<int>(L.rows()));
  const auto root = [&parents](int i) {
    while (parents[i] != i)
    {
      parents[i] = parents[parents[i]];
      i = parents[i];
    }
    return i;
  };
  for (int i = 0; i < L.rows(); ++i)
  {
    for (SparseMatrix<Complex>::InnerIterator entry(L, i); entry && entry.col() < i; ++entry)
    {
      if (entry.value() != Complex(0.0))
      {
        const int a = root(i);
        const int b = root(static_cast<int>(entry.col()));
        parents[std::max(a, b)] = std::min(a, b);
      }
    }
  }
  for (int i = 0; i < L.rows(); ++i)
  {
    parents[i] = parents[parents[i]]; // parents come first
  }
  return parents;
}

/// 0 where it is empty.
Vector<double> RootsOfDiagonal(const SparseMatrix<Complex>& L, const ExecutionContext& context)
{
  Vector<double> roots(L.rows());
  context.ParallelFor(0, static_cast<int>(L.rows()), RowGrain, [&](int first, int last) {
    for (int k = first; k < last; ++k)
    {
      roots[k] = std::sqrt(std::max(0.0, L.coeff(k, k).real()));
    }
  });
  return roots;
}

/// What is known of each unknown, two for each row. Components and roots are in the order of the parents.
void SetUnknowns(LaplacianHierarchy& hierarchy, const std::vector<int>& byParents,
  const std::vector<int>& byColours, const std::vector<int>& components,
  const Vector<double>& roots, const ExecutionContext& context)
{
  const int unknowns = 2 * static_cast<int>(byColours.size());
  hierarchy.Order.resize(unknowns);
  std::vector<int> ofUnknowns(unknowns);
  hierarchy.Scales.resize(unknowns);
  context.ParallelFor(0, unknowns, RowGrain, [&](int first, int last) {
    for (int i = first; i < last; ++i)
    {
      const int k = byColours[i / 2];
      hierarchy.Order[i] = 2 * byParents[k] + i % 2;
      ofUnknowns[i] = components[k];
      hierarchy.Scales[i] = roots[k];
    }
  });
  hierarchy.SetComponents(std::move(ofUnknowns));
}

/// L by colours, and what sweeps read of it, scaled.
void SetMatrix(LaplacianHierarchy& hierarchy, const SparseMatrix<Complex>& L,
  const std::vector<int>& byColours, const ExecutionContext& context)
{
  const int size = static_cast<int>(byColours.size());
  SparseMatrix<Complex> inOrder = Permuted(L, byColours, Inverse(byColours, context), context);
  hierarchy.L.swap(inOrder); // an assignment would copy
  const std::vector<int> same = Identity(size);
  const Vector<double> scale = hierarchy.Scales(Eigen::seqN(0, size, 2)).cwiseInverse();
  ArrangeLower(hierarchy.L, same, same, scale, hierarchy.A.Lower, context);
  ArrangeUpper(hierarchy.L, same, same, scale, hierarchy.A.Upper, context);
}

/// The restriction on scaled unknowns by colours.
/// \param isolated unknowns that it leaves out, ascending.
RowBands<LaplacianHierarchy::Single> InColours(const SparseMatrix<Complex>& restriction,
  const std::vector<int>& byColours, const Vector<double>& roots, const std::vector<int>& isolated,
  const ExecutionContext& context)
{
  using Entry = std::pair<int, LaplacianHierarchy::Single>;
  const std::vector<int> places = Inverse(byColours, context);
  const auto makeWorker = [&] {
    return [&, entries = std::vector<Entry>()](
             int firstRow, int lastRow, SparseRows<LaplacianHierarchy::Single>& rows) mutable {
      for (int j = firstRow; j < lastRow; ++j)
      {
        entries.clear();
        for (SparseMatrix<Complex>::InnerIterator entry(restriction, j); entry; ++entry)
        {
          const int place = places[entry.col()];
          if (!std::binary_search(isolated.begin(), isolated.end(), place))
          {
            entries.emplace_back(
              place, static_cast<LaplacianHierarchy::Single>(entry.value() * roots[entry.col()]));
          }
        }
        std::sort(entries.begin(), entries.end(),
          [](const Entry& a, const Entry& b) { return a.first < b.first; });
        for (const auto& [place, value] : entries)
        {
          rows.Columns.push_back(place);
          rows.Values.push_back(value);
        }
        rows.EndRow();
      }
    };
  };
  return AssembleBands<LaplacianHierarchy::Single>(static_cast<int>(restriction.rows()),
    static_cast<int>(restriction.cols()), makeWorker, context);
}

}

LaplacianHierarchy CoarsenLaplacian(const MatrixInOrder& makeL,
  std::vector<SparseMatrix<Complex>> prolongations, int smoothingSteps,
  const ExecutionContext& context)
{
  const int size = static_cast<int>(prolongations[0].rows());
  CheckChain(size, prolongations);

  // Sorted by parents, products are fast; sweeps want colours.
  const std::vector<int> byParents = BringIntoOrder(prolongations, size, context);
  const SparseMatrix<Complex> L = makeL(byParents, context);
  CheckChain(L.rows(), prolongations);
  context.Checkpoint(0.2);
  SparseMatrix<Complex> P = SmoothedProlongation(L, prolongations[0], smoothingSteps, context);
  context.Checkpoint(0.5);
  CompactProlongation::Round(P, context); // so that the coarse matrix is that of the packed one
  const SparseMatrix<Complex> R = Adjoint(P, context);
  SparseMatrix<Complex> coarse = TripleProduct(R, L, P, context);
  SparseMatrix<Complex>().swap(P);
  context.Checkpoint(0.7);

  LaplacianHierarchy hierarchy;
  // Greedy colours come one after the other, and so do components; but they do not wait for each other.
  ColourOrder colours;
  std::vector<int> components;
  context.ParallelFor(0, 2, 1, [&](int first, int last) {
    for (int task = first; task < last; ++task)
    {
      if (task == 0)
      {
        colours = Colouring(L);
      }
      else
      {
        components = ComponentsOf(L);
      }
    }
  });
  const std::vector<int>& byColours = colours.Unknowns;
  Vector<double> roots = RootsOfDiagonal(L, context);
  hierarchy.Isolated =
    Choose(size, [&](int k) { return roots[byColours[k]] == 0.0; }, context);
  for (const int k : hierarchy.Isolated)
  {
    roots[byColours[k]] = 1.0;
  }
  SetUnknowns(hierarchy, byParents, byColours, components, roots, context);
  SetMatrix(hierarchy, L, byColours, context);
  hierarchy.Prolongation =
    CompactProlongation(InColours(R, byColours, roots, hierarchy.Isolated, context), context);
  hierarchy.CoarseMatrix.swap(coarse);
  hierarchy.A.Begins = std::move(colours.Begins);
  prolongations.erase(prolongations.begin());
  hierarchy.Coarser = std::move(prolongations);
  context.Checkpoint(1.0);
  return hierarchy;
}

LaplacianHierarchy::LaplacianHierarchy(LaplacianHierarchy&& other) noexcept
  : RoughnessHierarchy(std::move(other))
  , Prolongation(std::move(other.Prolongation))
  , Coarser(std::move(other.Coarser))
  , Isolated(std::move(other.Isolated))
{
  this->L.swap(other.L);
  this->A.Begins.swap(other.A.Begins);
  this->A.Lower.swap(other.A.Lower);
  this->A.Upper.swap(other.A.Upper);
  this->CoarseMatrix.swap(other.CoarseMatrix);
}

std::unique_ptr<LinearOperator<double>> LaplacianHierarchy::Operator(const Vector<double>& D) const
{
  return std::make_unique<ShiftedLaplacian>(this->L, D);
}

std::unique_ptr<RoughnessCycle> LaplacianHierarchy::Cycle(const Vector<double>& D,
  const RoughnessCycleOptions& options, const ExecutionContext& context) const
{
  return std::make_unique<LaplacianCycle>(*this, D, options, context);
}

long long LaplacianHierarchy::Bytes() const
{
  long long bytes = BytesOf(this->L) + BytesOf(this->A.Lower) + BytesOf(this->A.Upper) +
    this->Prolongation.Bytes() + BytesOf(this->CoarseMatrix) +
    this->BytesOfUnknowns();
  for (const SparseMatrix<Complex>& P : this->Coarser)
  {
    bytes += BytesOf(P);
  }
  return bytes;
}

}
