#include "Adapters/Surface/ArrayNames.h"

#include <cctype>

namespace dmg
{

std::string ArrayNames::Direction(int k)
{
  return "Direction" + std::to_string(k);
}

std::string ArrayNames::CellsWithout(const std::string& what)
{
  std::string name = what;
  name.front() = static_cast<char>(std::toupper(static_cast<unsigned char>(name.front())));
  return "CellsWithout" + name;
}

std::string ArrayNames::BelowWavelength(const std::string& name, const std::string& wavelength)
{
  return name + " below " + wavelength;
}

std::string ArrayNames::AboveWavelength(const std::string& name, const std::string& wavelength)
{
  return name + " above " + wavelength;
}

std::string ArrayNames::HarmonicBasis(int k)
{
  return HarmonicBasisPrefix + std::to_string(k);
}

std::string ArrayNames::Prolongation(const std::string& name, int level, const std::string& part)
{
  return ProlongationPrefix + name + "." + std::to_string(level) + "." + part;
}

}
