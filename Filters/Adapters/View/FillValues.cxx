#include "Adapters/View/FillValues.h"

#include "Support/Errors.h"
#include "Support/ShortText.h"

#include "vtkDataArray.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <limits>

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

/// Whether files are known to have a number of this size where nothing was measured: netCDF, GRIB, models and their integers.
bool IsOfFiles(double size)
{
  constexpr double Rounding = 1e-5, SmallestPower = 0.99e15;
  const double decade = std::round(std::log10(size));
  const double known[] = { 9.96921e36, 9.999e20, std::numeric_limits<float>::max(), std::numeric_limits<double>::max(),
    9999.0, 99999.0, 999999.0, 32767.0, 32768.0, 2147483647.0, size >= SmallestPower ? std::pow(10.0, decade) : 0.0 };
  return std::any_of(
    std::begin(known), std::end(known), [size](double fill) { return std::abs(size / fill - 1.0) < Rounding; });
}

/// The sizes below the largest one that are not known as fill values.
std::vector<double> OthersOf(std::vector<double> sizes, double largest)
{
  sizes.erase(
    std::remove_if(sizes.begin(), sizes.end(), [largest](double size) { return size >= largest || IsOfFiles(size); }),
    sizes.end());
  return sizes;
}

double MedianOf(std::vector<double> sizes)
{
  const auto middle = sizes.begin() + static_cast<std::ptrdiff_t>(sizes.size() / 2);
  std::nth_element(sizes.begin(), middle, sizes.end());
  return *middle;
}

}

std::string SuspectedFillValues(
  const std::vector<vtkDataArray*>& arrays, const std::vector<char>& isLeftOut, const std::string& what)
{
  constexpr double Impossible = 1e8, Suspicious = 1e3; // times others
  const std::vector<double> sizes = SizesOf(arrays, isLeftOut);
  const double largest = sizes.empty() ? 0.0 : *std::max_element(sizes.begin(), sizes.end());
  const auto number = std::count(sizes.begin(), sizes.end(), largest);
  const std::string values = std::to_string(number) + (number == 1 ? " number" : " numbers") + " of the " + what +
    (number == 1 ? " has" : " have") + " the size " + ShortText(largest);
  const std::string remedy = "switch on Replace Fill Value With Nan in the reader, or make them NaN";
  const std::string refusal = values + ", as fill values have where nothing was measured; " + remedy;
  if (!std::isfinite(largest))
  {
    throw InvalidInput(refusal);
  }
  const std::vector<double> others = OthersOf(sizes, largest);
  if (others.empty())
  {
    return "";
  }
  const bool isKnown = IsOfFiles(largest);
  const double median = MedianOf(others), second = *std::max_element(others.begin(), others.end());
  if (isKnown && largest > Impossible * median)
  {
    throw InvalidInput(refusal);
  }
  const bool isFar = largest > Suspicious * (isKnown ? median : second);
  return (number > 1 && isFar) || largest > Impossible * second ? values + ". If that is a fill value, " + remedy + "."
                                                                : "";
}

}
