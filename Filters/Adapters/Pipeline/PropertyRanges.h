#ifndef dmgPropertyRanges_h
#define dmgPropertyRanges_h

#include <cstddef>
#include <initializer_list>
#include <limits>

namespace dmg
{

/// The value of a property, and its range. Setters keep any value, and RequestData refuses one out of range.
/// Takes no memory of the heap, so that it can be made where nothing may be thrown.
struct PropertyRange
{
  /// \param label what the window calls the property.
  template <class Number>
  PropertyRange(const char* label, Number value, double least, double most = std::numeric_limits<double>::infinity())
    : Label(label)
    , Value(static_cast<double>(value))
    , Least(least)
    , Most(most)
  {
  }

  const char* Label;
  double Value, Least, Most;
};

/// \throw InvalidInput one is out of its range, or not a number: the label of the first, its value and the range.
void CheckRanges(std::initializer_list<PropertyRange> properties);

/// The name of a value of an enumeration, for PrintSelf.
template <std::size_t Size>
const char* NameOf(const char* const (&names)[Size], int value)
{
  return value >= 0 && value < static_cast<int>(Size) ? names[value] : "(out of range)";
}

}

#endif
