#ifndef dmgNoteOfShear_h
#define dmgNoteOfShear_h

#include <algorithm>
#include <string>
#include <vector>

namespace dmg::test
{

/// Warnings but for the note of power fields on faces that triangles are sheared, as the grids of some tests are.
inline std::vector<std::string> WithoutNoteOfShear(std::vector<std::string> warnings)
{
  const auto isNote = [](const std::string& text) { return text.find("sheared triangles") != std::string::npos; };
  warnings.erase(std::remove_if(warnings.begin(), warnings.end(), isNote), warnings.end());
  return warnings;
}

}

#endif
