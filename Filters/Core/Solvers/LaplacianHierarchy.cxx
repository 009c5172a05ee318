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

/// Per row a number that it shares with all that it is connected with.
std::vector<int> ComponentsOf(const SparseMatrix<Complex>& L)
{
  std::vector<int> components(L.rows(), -1);
  std::vector<int> stack;
  int number = 0;
  for (int seed = 0; seed < L.rows(); ++seed)
  {
    if (components[seed] >= 0)
    {
      continue;
    }
    components[seed] = number;
    stack.push_back(seed);
    while (!stack.empty())
    {
      const int row = stack.back();
      stack.pop_back();
      for (SparseMatrix<Complex>::InnerIterator entry(L, row); entry; ++entry)
      {
        if (components[entry.col()] < 0 && entry.value() != Complex(0.0))
        {
          components[entry.col()] = number;
          stack.push_back(static_cast<int>(entry.col()));
        }
      }
    }
    ++number;
  }
  return components;
}

/// 0 where it is empty.
Vector<double> RootsOfDiagonal(const SparseMatrix<Complex>& L)
{
  Vector<double> roots(L.rows());
  for (int k = 0; k < L.rows(); ++k)
  {
    roots[k] = std::sqrt(std::max(0.0, L.coeff(k, k).real()));
  }
  return roots;
}

template <class Number>
std::vector<Number> Doubled(const std::vector<Number>& numbers)
{
  std::vector<Number> doubled;
  doubled.reserve(2 * numbers.size());
  for (const Number& number : numbers)
  {
    doubled.push_back(number);
    doubled.push_back(number);
  }
  return doubled;
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

LaplacianHierarchy CoarsenLaplacian(const SparseMatrix<Complex>& laplacian,
  std::vector<SparseMatrix<Complex>> prolongations, int smoothingSteps,
  const ExecutionContext& context)
{
  CheckChain(laplacian.rows(), prolongations);
  const int size = static_cast<int>(laplacian.rows());

  // Sorted by parents, products are fast; sweeps want colours.
  const std::vector<int> byParents = BringIntoOrder(prolongations, size, context);
  SparseMatrix<Complex> L = Permuted(laplacian, byParents, Inverse(byParents), context);
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
  Vector<double> roots = RootsOfDiagonal(L);
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

  std::vector<int> order(size);
  for (int k = 0; k < size; ++k)
  {
    order[k] = byParents[byColours[k]];
  }
  hierarchy.Order = PairsOf(order);
  hierarchy.Components = Doubled(ComponentsOf(hierarchy.L));
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
