#ifndef dmgChoices_h
#define dmgChoices_h

#include <limits>
#include <random>

namespace dmg::test
{

/// Choices from a seed, the same with every standard library.
class Choices
{
public:
  explicit Choices(unsigned long long seed)
    : Bits(seed)
  {
  }

  int Below(int n) { return static_cast<int>(this->Bits() % static_cast<unsigned>(n)); }
  bool OneIn(int n) { return this->Below(n) == 0; }
  double Unit() { return static_cast<double>(this->Bits() >> 11) / 9007199254740992.0; }

  /// Mostly ordinary.
  double Number()
  {
    const double special[] = { 0.0, -0.0, 1.0, -1.0, 1e-300, -1e300, 1e-45, 1e39, 1e-39, 1e20, 1e-20, 5e-324, 1e308,
      std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity() };
    return this->OneIn(12) ? special[this->Below(15)] : 2.0 * this->Unit() - 1.0;
  }

private:
  std::mt19937_64 Bits;
};

}

#endif
