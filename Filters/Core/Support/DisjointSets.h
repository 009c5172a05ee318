#ifndef dmgDisjointSets_h
#define dmgDisjointSets_h

#include "Support/Types.h"

#include <algorithm>
#include <numeric>
#include <vector>

namespace dmg
{

/// Numbers 0 to size - 1 in sets, which grow together: each in one of its own at first. A set is called by
/// its smallest number (Tarjan 1975, with paths halved).
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

  /// Of the set that i is in.
  int Smallest(int i)
  {
    while (this->Parents[i] != i)
    {
      this->Parents[i] = this->Parents[this->Parents[i]];
      i = this->Parents[i];
    }
    return i;
  }

  /// Of the sets of all numbers.
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
  std::vector<int> Parents; ///< never larger
};

/// Per column the first of those that it is connected with, through rows that have entries in both.
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
