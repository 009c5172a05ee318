#ifndef dmgDisjointSets_h
#define dmgDisjointSets_h

#include "Support/Types.h"

#include <algorithm>
#include <numeric>
#include <vector>

namespace dmg
{

/// Union-find (Tarjan 1975, with path halving) on the numbers 0 to size - 1. At first each number is a set of its own. A set
/// is named by its smallest number.
class DisjointSets
{
public:
  explicit DisjointSets(int size)
    : Parents(size)
  {
    std::iota(this->Parents.begin(), this->Parents.end(), 0);
  }

  void Unite(int a, int b)
  {
    a = this->Smallest(a);
    b = this->Smallest(b);
    this->Parents[std::max(a, b)] = std::min(a, b);
  }

  /// The smallest number of the set that contains i.
  int Smallest(int i)
  {
    while (this->Parents[i] != i)
    {
      this->Parents[i] = this->Parents[this->Parents[i]];
      i = this->Parents[i];
    }
    return i;
  }

  /// The smallest numbers of the sets of all numbers.
  std::vector<int> AllSmallest() const
  {
    std::vector<int> smallest(this->Parents);
    for (int& parent : smallest)
    {
      parent = smallest[parent]; // parents are smaller, and come first
    }
    return smallest;
  }

private:
  std::vector<int> Parents; ///< never larger than the number itself
};

/// Connected components of the columns, which a row connects if it has entries in them: per column, the first of its component.
/// Cost: hardly more than one pass over the entries.
template <class Scalar>
std::vector<int> ConnectedColumns(const SparseMatrix<Scalar>& A)
{
  DisjointSets sets(static_cast<int>(A.cols()));
  for (int row = 0; row < A.rows(); ++row)
  {
    int first = -1;
    for (typename SparseMatrix<Scalar>::InnerIterator entry(A, row); entry; ++entry)
    {
      if (entry.value() != Scalar(0))
      {
        first = first < 0 ? static_cast<int>(entry.col()) : first;
        sets.Unite(first, static_cast<int>(entry.col()));
      }
    }
  }
  return sets.AllSmallest();
}

}

#endif
