#include "Adapters/Surface/ArrayNames.h"

namespace dmg
{

std::string ArrayNames::Direction(int k)
{
  return "Direction" + std::to_string(k);
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
