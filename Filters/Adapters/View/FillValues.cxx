#include "Adapters/View/FillValues.h"

#include "Support/Errors.h"
#include "Support/ShortText.h"

#include "vtkDataArray.h"

#include <algorithm>
#include <cmath>

namespace dmg
{
namespace
{

/// The absolute values of all numbers but zeros.
std::vector<double> SizesOf(const std::vector<vtkDataArray*>& arrays, const std::vector<char>& isLeftOut)
{
  std::vector<double> sizes;
  for (vtkDataArray* const array : arrays)
  {
    std::vector<double> numbers(array->GetNumberOfComponents());
    for (vtkIdType tuple = 0; tuple < static_cast<vtkIdType>(isLeftOut.size()); ++tuple)
    {
      array->GetTuple(tuple, numbers.data());
      for (const double x : numbers)
      {
        if (x != 0.0 && !isLeftOut[tuple])
        {
          sizes.push_back(std::abs(x));
        }
      }
    }
  }
  return sizes;
}

/// The median of the sizes below the largest one, or that one where all are equal.
double MedianOfOthers(std::vector<double>& sizes, double largest)
{
  const auto rest = std::partition(sizes.begin(), sizes.end(), [largest](double size) { return size < largest; });
  if (rest == sizes.begin())
  {
    return largest;
  }
  const auto middle = sizes.begin() + (rest - sizes.begin()) / 2;
  std::nth_element(sizes.begin(), middle, rest);
  return *middle;
}

}

std::string SuspectedFillValues(
  const std::vector<vtkDataArray*>& arrays, const std::vector<char>& isLeftOut, const std::string& what)
{
  constexpr double Impossible = 1e8, Suspicious = 1e3; // times the median
  std::vector<double> sizes = SizesOf(arrays, isLeftOut);
  if (sizes.empty())
  {
    return "";
  }
  const double largest = *std::max_element(sizes.begin(), sizes.end());
  const auto number = std::count(sizes.begin(), sizes.end(), largest);
  const double median = MedianOfOthers(sizes, largest);
  const std::string values = std::to_string(number) + (number == 1 ? " number" : " numbers") + " of the " + what +
    (number == 1 ? " has" : " have") + " the size " + ShortText(largest);
  const std::string remedy = "switch on Replace Fill Value With Nan in the reader, or make them NaN";
  if (!std::isfinite(largest) || largest > Impossible * median)
  {
    throw InvalidInput(values + ", as fill values have where there is no " + what + "; " + remedy);
  }
  return number > 1 && largest > Suspicious * median ? values + ". If that is a fill value, " + remedy + "." : "";
}

}
