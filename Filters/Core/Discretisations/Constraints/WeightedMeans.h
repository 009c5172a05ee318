#ifndef dmgWeightedMeans_h
#define dmgWeightedMeans_h

#include "Discretisations/Constraints/FieldConstraints.h"

#include <algorithm>
#include <vector>

namespace dmg
{

/// A value that a constraint asks of an element.
/// \tparam Value double, or Complex for elements of two unknowns.
template <class Value>
struct WeightedValue
{
  int Element;
  Value Asked;
  double Weight; ///< > 0
};

/// The mean by weight of the values of each element. The weights of an element add up. Cost: n log n, linear where values are sorted by
/// element.
template <class Value>
FieldConstraints MeansByElement(std::vector<WeightedValue<Value>> values)
{
  const auto isBefore = [](const auto& a, const auto& b) { return a.Element < b.Element; };
  if (!std::is_sorted(values.begin(), values.end(), isBefore))
  {
    std::stable_sort(values.begin(), values.end(), isBefore);
  }
  FieldConstraints constraints;
  std::vector<Value> means;
  for (const auto& [element, asked, weight] : values)
  {
    if (constraints.Elements.empty() || constraints.Elements.back() != element)
    {
      constraints.Elements.push_back(element);
      constraints.Weights.push_back(0.0);
      means.emplace_back(0.0);
    }
    constraints.Weights.back() += weight;
    means.back() += weight * asked;
  }
  for (std::size_t b = 0; b < means.size(); ++b)
  {
    means[b] /= constraints.Weights[b];
  }
  constexpr Eigen::Index Parts = sizeof(Value) / sizeof(double);
  constraints.Values = Eigen::Map<const Vector<double>>(
    reinterpret_cast<const double*>(means.data()), Parts * static_cast<Eigen::Index>(means.size()));
  return constraints;
}

}

#endif
