#ifndef dmgShortText_h
#define dmgShortText_h

#include <sstream>
#include <string>

namespace dmg
{

/// A number as messages say it, to six digits.
inline std::string ShortText(double number)
{
  std::ostringstream text;
  text << number;
  return text.str();
}

}

#endif
