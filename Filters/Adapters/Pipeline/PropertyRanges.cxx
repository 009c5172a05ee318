#include "Adapters/Pipeline/PropertyRanges.h"

#include "Support/Errors.h"

#include <cmath>
#include <iomanip>
#include <sstream>

namespace dmg
{

void CheckRanges(std::initializer_list<PropertyRange> properties)
{
  for (const auto& [label, value, least, most] : properties)
  {
    if (value >= least && value <= most) // false for NaN
    {
      continue;
    }
    std::ostringstream message;
    message << std::setprecision(10) << label << " is " << value << "; choose a value ";
    if (std::isinf(most))
    {
      message << "of at least " << least;
    }
    else
    {
      message << "from " << least << " to " << most;
    }
    throw InvalidInput(message.str());
  }
}

}
