#ifndef dmgTestRandom_h
#define dmgTestRandom_h

#include "Support/Types.h"

#include <random>

namespace dmg::test
{

/// Random numbers that are the same on every platform (the standard fixes the engine, not its
/// distributions). Tests name their seed in a failure through SCOPED_TRACE or their parameter.
class Random
{
public:
  explicit Random(unsigned seed)
    : Engine(seed)
  {
  }

  /// Uniform in [0, 1).
  double Uniform() { return this->Engine() / 4294967296.0; }
  double Uniform(double low, double high) { return low + (high - low) * this->Uniform(); }
  /// Uniform in [0, bound).
  int Index(int bound) { return static_cast<int>(this->Uniform() * bound); }
  /// Uniform in the square [-1, 1) + i [-1, 1).
  Complex Number() { return { this->Uniform(-1.0, 1.0), this->Uniform(-1.0, 1.0) }; }

  Vector<Complex> Numbers(int size)
  {
    Vector<Complex> numbers(size);
    for (Complex& number : numbers)
    {
      number = this->Number();
    }
    return numbers;
  }

private:
  std::mt19937 Engine;
};

}

#endif
