#include "Solvers/Multigrid/HierarchicalOrder.h"

#include "Support/CountingSort.h"
#include "Support/Errors.h"
#include "Support/Permutations.h"
#include "Support/SparseKernels.h"

#include <string>
#include <utility>

namespace dmg
{
namespace
{

constexpr int RowGrain = 4096;

/// For each row the column of its largest entry; rows without entries follow the row before them.
template <class Scalar>
std::vector<int> Parents(const SparseMatrix<Scalar>& P, const ExecutionContext& context)
{
  constexpr int none = -1;
  std::vector<int> parents(P.rows(), none);
  context.ParallelFor(0, static_cast<int>(P.rows()), RowGrain,
    [&P, &parents](int first, int last)
    {
      for (int i = first; i < last; ++i)
      {
        double largest = 0.0;
        for (typename SparseMatrix<Scalar>::InnerIterator entry(P, i); entry; ++entry)
        {
          // Entries that are equal up to rounding must not let rounding decide.
          const double size = Eigen::numext::abs2(entry.value());
          if (size > largest * (1.0 + 1e-6))
          {
            largest = size;
            parents[i] = static_cast<int>(entry.col());
          }
        }
      }
    });
  int former = 0;
  for (int& parent : parents)
  {
    parent = parent == none ? former : parent;
    former = parent;
  }
  if (parents.size() % 2 == 0 && HasPairs(P))
  {
    for (std::size_t i = 0; i < parents.size(); i += 2)
    {
      parents[i + 1] = parents[i];
    }
  }
  return parents;
}

/// Children that follow each other in the order of their parents' places.
std::vector<int> InOrderOfParents(
  const std::vector<int>& parents, const std::vector<int>& placesOfParents, const ExecutionContext& context)
{
  return SortByKey(
    Identity(static_cast<int>(parents.size())), static_cast<int>(placesOfParents.size()),
    [&](int child) { return placesOfParents[parents[child]]; }, context)
    .Items;
}

}

template <class Scalar>
void CheckChain(long long size, const std::vector<SparseMatrix<Scalar>>& prolongations)
{
  for (std::size_t level = 0; level < prolongations.size(); ++level)
  {
    if (prolongations[level].rows() != size)
    {
      throw InvalidInput("the prolongation to level " + std::to_string(level) + " has " +
        std::to_string(prolongations[level].rows()) + " rows instead of " + std::to_string(size) +
        "; use the operators of this surface");
    }
    size = prolongations[level].cols();
  }
}

template <class Scalar>
std::vector<int> RenumberHierarchically(
  std::vector<SparseMatrix<Scalar>>& prolongations, int size, const ExecutionContext& context)
{
  std::vector<int> order = Identity(prolongations.empty() ? size : static_cast<int>(prolongations.back().cols()));
  for (std::size_t level = prolongations.size(); level-- > 0;)
  {
    context.Checkpoint(0.0);
    SparseMatrix<Scalar>& P = prolongations[level];
    const std::vector<int> placesOfParents = Inverse(order, context);
    order = InOrderOfParents(Parents(P, context), placesOfParents, context);
    SparseMatrix<Scalar> permuted = Permuted(P, order, placesOfParents, context);
    P.swap(permuted); // an assignment would copy
  }
  return order;
}

template void CheckChain(long long, const std::vector<SparseMatrix<double>>&);
template void CheckChain(long long, const std::vector<SparseMatrix<Complex>>&);
template std::vector<int> RenumberHierarchically(std::vector<SparseMatrix<double>>&, int, const ExecutionContext&);
template std::vector<int> RenumberHierarchically(std::vector<SparseMatrix<Complex>>&, int, const ExecutionContext&);

}
