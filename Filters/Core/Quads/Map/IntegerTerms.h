#ifndef dmgIntegerTerms_h
#define dmgIntegerTerms_h

#include <utility>
#include <vector>

namespace dmg
{

/// A sum of integer variables with integer coefficients: (variable, coefficient), by ascending variable and without zeros.
using IntegerTerms = std::vector<std::pair<int, long long>>;

/// a + factor b.
inline IntegerTerms Sum(const IntegerTerms& a, const IntegerTerms& b, long long factor)
{
  IntegerTerms sum;
  sum.reserve(a.size() + b.size());
  auto left = a.begin(), right = b.begin();
  while (left != a.end() || right != b.end())
  {
    if (right == b.end() || (left != a.end() && left->first < right->first))
    {
      sum.push_back(*left++);
    }
    else if (left == a.end() || right->first < left->first)
    {
      sum.emplace_back(right->first, factor * right->second);
      ++right;
    }
    else
    {
      const long long coefficient = left->second + factor * right->second;
      if (coefficient != 0)
      {
        sum.emplace_back(left->first, coefficient);
      }
      ++left;
      ++right;
    }
  }
  return sum;
}

}

#endif
