#include "Adapters/View/FillValues.h"

#include "Support/Errors.h"
#include "Support/ShortText.h"

#include "vtkDataArray.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <limits>
#include <utility>

namespace dmg
{
namespace
{

/// The largest number of each tuple, but for zeros. Rounding errors in the other components do not count.
std::vector<double> SizesOf(const std::vector<vtkDataArray*>& arrays, const std::vector<char>& isLeftOut)
{
  std::vector<double> sizes(isLeftOut.size(), 0.0);
  for (vtkDataArray* const array : arrays)
  {
    std::vector<double> numbers(array->GetNumberOfComponents());
    for (std::size_t tuple = 0; tuple < sizes.size(); ++tuple)
    {
      array->GetTuple(static_cast<vtkIdType>(tuple), numbers.data());
      for (const double x : numbers)
      {
        sizes[tuple] = isLeftOut[tuple] ? 0.0 : std::max(sizes[tuple], std::abs(x));
      }
    }
  }
  sizes.erase(std::remove(sizes.begin(), sizes.end(), 0.0), sizes.end());
  return sizes;
}

/// Whether files are known to have a number of this size where nothing was measured: netCDF, GRIB, models, powers of ten, nines.
bool IsOfFiles(double size)
{
  constexpr double Rounding = 1e-5, SmallestPower = 0.99e4, Largest = 1e39; // of single precision
  const double power = size > SmallestPower && size < Largest ? std::pow(10.0, std::round(std::log10(size))) : -1.0;
  const double known[] = { power, 9.96921e36, 9.999e20, std::numeric_limits<float>::max(),
    std::numeric_limits<double>::max(), 99.0, 99.9, 999.0, 999.9, 9999.0, 9999.9, 99999.0, 99999.9, 999999.0, 32767.0,
    32768.0, 2147483647.0 };
  return std::any_of(
    std::begin(known), std::end(known), [size](double fill) { return std::abs(size / fill - 1.0) < Rounding; });
}

/// \pre not empty.
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
  constexpr double Impossible = 1e8, Suspicious = 1e3; // times the median of the others
  std::vector<double> sizes = SizesOf(arrays, isLeftOut);
  const double largest = sizes.empty() ? 0.0 : *std::max_element(sizes.begin(), sizes.end());
  const auto number = std::count(sizes.begin(), sizes.end(), largest);
  const std::string values = std::to_string(number) + (number == 1 ? " value" : " values") + " of the " + what +
    (number == 1 ? " has" : " have") + " the size " + ShortText(largest);
  const std::string remedy = "switch on Replace Fill Value With Nan in the reader, or make them NaN";
  const std::string refusal = values + ", as fill values have where nothing was measured; " + remedy;
  if (!std::isfinite(largest))
  {
    throw InvalidInput(refusal);
  }
  if (!IsOfFiles(largest)) // as mostly
  {
    return "";
  }
  sizes.erase(std::remove_if(sizes.begin(), sizes.end(), IsOfFiles), sizes.end());
  if (sizes.empty())
  {
    return "";
  }
  const double median = MedianOf(std::move(sizes));
  if (largest > Impossible * median)
  {
    throw InvalidInput(refusal);
  }
  return number > 1 && largest > Suspicious * median ? values + ". If that is a fill value, " + remedy + "." : "";
}

std::string SuspectedFillValues(const std::vector<vtkDataArray*>& arrays, vtkIdType tuples, const std::string& what)
{
  return SuspectedFillValues(arrays, TuplesWith([](double x) { return !std::isfinite(x); }, arrays, tuples), what);
}

bool MayHaveGaps(const std::vector<vtkDataArray*>& arrays, vtkIdType tuples)
{
  const auto isSuch = [](double x) { return !std::isfinite(x) || IsOfFiles(std::abs(x)); };
  const std::vector<char> have = TuplesWith(isSuch, arrays, tuples);
  return std::find(have.begin(), have.end(), 1) != have.end();
}

std::vector<char> TuplesWith(bool (*isSuch)(double), const std::vector<vtkDataArray*>& arrays, vtkIdType tuples)
{
  std::vector<char> have(tuples, 0);
  for (vtkDataArray* const array : arrays)
  {
    std::vector<double> numbers(array->GetNumberOfComponents());
    for (vtkIdType tuple = 0; tuple < tuples; ++tuple)
    {
      array->GetTuple(tuple, numbers.data());
      have[tuple] |= std::any_of(numbers.begin(), numbers.end(), isSuch) ? 1 : 0;
    }
  }
  return have;
}

}
