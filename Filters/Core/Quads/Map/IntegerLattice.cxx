#include "Quads/Map/IntegerLattice.h"

#include "Support/Errors.h"

#include <algorithm>
#include <cstdlib>
#include <numeric>

namespace dmg
{

namespace
{

class Elimination
{
public:
  explicit Elimination(int size)
    : Rows(size)
    , Uses(size)
    , IsFree(size, 1)
  {
    for (int k = 0; k < size; ++k)
    {
      this->Rows[k] = { { k, 1 } };
      this->Uses[k] = { k };
    }
  }

  void Satisfy(const IntegerTerms& equation)
  {
    IntegerTerms terms = this->InParameters(equation);
    while (!terms.empty())
    {
      DivideByCommonFactor(terms);
      if (const int unit = this->LeastUsedUnit(terms); unit >= 0)
      {
        this->Express(unit, terms);
        return;
      }
      this->ReduceByLeast(terms);
    }
  }

  IntegerLattice Result() const
  {
    IntegerLattice lattice;
    std::vector<int> numbers(this->Rows.size(), -1);
    for (std::size_t k = 0; k < numbers.size(); ++k)
    {
      numbers[k] = this->IsFree[k] ? lattice.Dimension++ : -1;
    }
    lattice.Rows = this->Rows;
    for (IntegerTerms& row : lattice.Rows)
    {
      for (auto& [parameter, coefficient] : row)
      {
        parameter = numbers[parameter];
      }
    }
    return lattice;
  }

private:
  IntegerTerms InParameters(const IntegerTerms& equation) const
  {
    IntegerTerms terms;
    for (const auto& [unknown, coefficient] : equation)
    {
      terms = Sum(terms, this->Rows[unknown], coefficient);
    }
    return terms;
  }

  static void DivideByCommonFactor(IntegerTerms& terms)
  {
    long long factor = 0;
    for (const auto& [parameter, coefficient] : terms)
    {
      factor = std::gcd(factor, coefficient);
    }
    for (auto& [parameter, coefficient] : terms)
    {
      coefficient /= factor;
    }
  }

  /// The parameter with coefficient 1 or -1 that fewest unknowns use; -1 if there is none.
  int LeastUsedUnit(const IntegerTerms& terms) const
  {
    int unit = -1;
    for (const auto& [parameter, coefficient] : terms)
    {
      if (std::abs(coefficient) == 1 && (unit < 0 || this->Uses[parameter].size() < this->Uses[unit].size()))
      {
        unit = parameter;
      }
    }
    return unit;
  }

  static long long CoefficientOf(const IntegerTerms& terms, int parameter)
  {
    const auto term = std::lower_bound(terms.begin(), terms.end(), std::make_pair(parameter, 0LL),
      [](const auto& a, const auto& b) { return a.first < b.first; });
    return term != terms.end() && term->first == parameter ? term->second : 0;
  }

  /// Eliminates a parameter by terms = 0, in which its coefficient is 1 or -1.
  void Express(int parameter, const IntegerTerms& terms)
  {
    const long long unit = CoefficientOf(terms, parameter);
    this->Replace(parameter, Sum({ { parameter, 1 } }, terms, -unit));
    this->IsFree[parameter] = 0;
  }

  /// Takes y_p + sum of q_j y_j in place of y_p, the parameter of the least coefficient c_p, q_j = c_j / c_p rounded towards zero.
  void ReduceByLeast(IntegerTerms& terms)
  {
    const auto least = *std::min_element(
      terms.begin(), terms.end(), [](const auto& a, const auto& b) { return std::abs(a.second) < std::abs(b.second); });
    IntegerTerms former{ { least.first, 1 } };
    IntegerTerms rest;
    for (const auto& [parameter, coefficient] : terms)
    {
      const long long quotient = parameter == least.first ? 0 : coefficient / least.second;
      former = quotient == 0 ? former : Sum(former, { { parameter, 1 } }, -quotient);
      const long long remainder = coefficient - quotient * least.second;
      if (remainder != 0)
      {
        rest.emplace_back(parameter, remainder);
      }
    }
    this->Replace(least.first, former);
    terms = rest;
  }

  /// Puts a sum of parameters in the place of one.
  void Replace(int parameter, const IntegerTerms& sum)
  {
    std::vector<int> users;
    users.swap(this->Uses[parameter]);
    for (const int user : users)
    {
      IntegerTerms& row = this->Rows[user];
      const long long coefficient = CoefficientOf(row, parameter);
      if (coefficient != 0)
      {
        row = Sum(Sum(row, { { parameter, 1 } }, -coefficient), sum, coefficient);
        this->Register(user, sum);
      }
    }
  }

  void Register(int user, const IntegerTerms& sum)
  {
    for (const auto& [parameter, coefficient] : sum)
    {
      if (CoefficientOf(this->Rows[user], parameter) != 0)
      {
        std::vector<int>& uses = this->Uses[parameter];
        const auto place = std::lower_bound(uses.begin(), uses.end(), user);
        if (place == uses.end() || *place != user)
        {
          uses.insert(place, user);
        }
      }
    }
    constexpr long long Largest = 1LL << 30;
    for (const auto& [parameter, coefficient] : this->Rows[user])
    {
      if (std::abs(coefficient) > Largest)
      {
        throw UnexpectedFailure("the conditions of the integers have coefficients that are too large");
      }
    }
  }

  std::vector<IntegerTerms> Rows;     ///< each unknown in the parameters
  std::vector<std::vector<int>> Uses; ///< by parameter: the unknowns in whose rows it stands, or stood; ascending
  std::vector<char> IsFree;           ///< by parameter: not eliminated
};

}

IntegerLattice SolveOverIntegers(int size, std::vector<IntegerTerms> equations)
{
  std::stable_sort(equations.begin(), equations.end(),
    [](const IntegerTerms& a, const IntegerTerms& b) { return a.size() < b.size(); });
  Elimination elimination(size);
  for (const IntegerTerms& equation : equations)
  {
    elimination.Satisfy(equation);
  }
  return elimination.Result();
}

}
