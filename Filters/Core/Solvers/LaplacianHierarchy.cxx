#include "Solvers/LaplacianHierarchy.h"

#include "Solvers/ArrangedMatrix.h"
#include "Solvers/HierarchicalOrder.h"
#include "Solvers/LaplacianCycle.h"
#include "Solvers/SmoothedProlongation.h"
#include "Support/Errors.h"
#include "Support/Permutations.h"
#include "Support/SparseAssembly.h"
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
  ShiftedLaplacian(const SparseMatrix<Complex>& matrix, Vector<double> diagonal)
    : L(matrix)
    , D(std::move(diagonal))
  {
  }

  int Size() const override { return static_cast<int>(this->D.size()); }

  double Apply(
    const Vector<double>& x, Vector<double>& y, const ExecutionContext& context) const override
  {
    y.resize(this->Size());
    const auto* const from = reinterpret_cast<const Complex*>(x.data());
    auto* const to = reinterpret_cast<Complex*>(y.data());
    return SumOverBlocks<double>(
      static_cast<int>(this->L.rows()), context, [this, from, to](int first, int last) {
        double product = 0.0;
        for (int k = first; k < last; ++k)
        {
          const double shift = this->D[2 * k];
          to[k] =
            std::isfinite(shift) ? RowTimes(this->L, k, from) + shift * from[k] : Complex(0.0);
          product += from[k].real() * to[k].real() + from[k].imag() * to[k].imag();
        }
        return product;
      });
  }

private:
  const SparseMatrix<Complex>& L;
  const Vector<double> D;
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

Vector<double> Doubled(const Vector<double>& numbers)
{
  Vector<double> doubled(2 * numbers.size());
  for (Eigen::Index k = 0; k < numbers.size(); ++k)
  {
    doubled[2 * k] = doubled[2 * k + 1] = numbers[k];
  }
  return doubled;
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
  const SparseMatrix<Complex> P =
    SmoothedProlongation(L, prolongations[0], smoothingSteps, context);
  context.Checkpoint(0.5);
  SparseMatrix<Complex> coarse = TripleProduct(Adjoint(P, context), L, P, context);
  context.Checkpoint(0.7);

  LaplacianHierarchy hierarchy;
  ColourOrder colours = Colouring(L);
  const std::vector<int>& byColours = colours.Unknowns;
  const std::vector<int> places = Inverse(byColours);
  Vector<double> roots = RootsOfDiagonal(L, context);
  for (int k = 0; k < size; ++k)
  {
    if (roots[byColours[k]] == 0.0)
    {
      hierarchy.Isolated.push_back(k);
      roots[byColours[k]] = 1.0;
    }
  }
  const Vector<double> scale = roots.cwiseInverse();
  ArrangeLower(L, byColours, places, scale, hierarchy.A.Lower, context);
  ArrangeUpper(L, byColours, places, scale, hierarchy.A.Upper, context);
  Arrange(P, byColours, Identity(static_cast<int>(P.cols())), roots,
    Vector<double>(Vector<double>::Ones(P.cols())),
    [&isolated = hierarchy.Isolated](
      int row, int) { return !std::binary_search(isolated.begin(), isolated.end(), row); },
    hierarchy.Prolongation, context);
  SparseMatrix<LaplacianHierarchy::Single> restriction = Adjoint(hierarchy.Prolongation, context);
  hierarchy.Restriction.swap(restriction); // an assignment would copy
  SparseMatrix<Complex> inOrder = Permuted(L, byColours, places, context);
  hierarchy.L.swap(inOrder);
  hierarchy.CoarseMatrix.swap(coarse);
  hierarchy.A.Begins = std::move(colours.Begins);
  prolongations.erase(prolongations.begin());
  hierarchy.Coarser = std::move(prolongations);

  // Both in the order of the parents so far.
  const std::vector<int> components = ComponentsOf(L);
  std::vector<int> order(size);
  hierarchy.Components.resize(2 * size);
  for (int k = 0; k < size; ++k)
  {
    order[k] = byParents[byColours[k]];
    hierarchy.Components[2 * k] = hierarchy.Components[2 * k + 1] = components[byColours[k]];
  }
  hierarchy.Order = PairsOf(order);
  hierarchy.Scales = Doubled(Vector<double>(roots(byColours)));
  context.Checkpoint(1.0);
  return hierarchy;
}

LaplacianHierarchy::LaplacianHierarchy(LaplacianHierarchy&& other) noexcept
  : RoughnessHierarchy(std::move(other))
  , Coarser(std::move(other.Coarser))
  , Isolated(std::move(other.Isolated))
{
  this->L.swap(other.L);
  this->A.Begins.swap(other.A.Begins);
  this->A.Lower.swap(other.A.Lower);
  this->A.Upper.swap(other.A.Upper);
  this->Prolongation.swap(other.Prolongation);
  this->Restriction.swap(other.Restriction);
  this->CoarseMatrix.swap(other.CoarseMatrix);
}

std::unique_ptr<LinearOperator<double>> LaplacianHierarchy::Operator(Vector<double> D) const
{
  return std::make_unique<ShiftedLaplacian>(this->L, std::move(D));
}

std::unique_ptr<RoughnessCycle> LaplacianHierarchy::Cycle(const Vector<double>& D,
  const RoughnessCycleOptions& options, const ExecutionContext& context) const
{
  return std::make_unique<LaplacianCycle>(*this, D, options, context);
}

long long LaplacianHierarchy::Bytes() const
{
  long long bytes = BytesOf(this->L) + BytesOf(this->A.Lower) + BytesOf(this->A.Upper) +
    BytesOf(this->Prolongation) + BytesOf(this->Restriction) + BytesOf(this->CoarseMatrix) +
    this->NumberOfUnknowns() * static_cast<long long>(2 * sizeof(int) + sizeof(double));
  for (const SparseMatrix<Complex>& P : this->Coarser)
  {
    bytes += BytesOf(P);
  }
  return bytes;
}

}
