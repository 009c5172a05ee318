#ifndef dmgExactOrder_h
#define dmgExactOrder_h

#include <cstdint>
#include <utility>

namespace dmg
{

/// The product of two numbers, as its upper and its lower 64 bits, which no compiler lacks.
inline std::pair<std::uint64_t, std::uint64_t> WideProduct(std::uint64_t a, std::uint64_t b)
{
  constexpr std::uint64_t Lower = 0xffffffffu;
  const std::uint64_t low = (a & Lower) * (b & Lower);
  const std::uint64_t middle = (a >> 32) * (b & Lower) + (low >> 32);
  const std::uint64_t other = (a & Lower) * (b >> 32) + (middle & Lower);
  return { (a >> 32) * (b >> 32) + (middle >> 32) + (other >> 32), (other << 32) | (low & Lower) };
}

/// The sign of a b - c d.
inline int SignOfDifference(long long a, long long b, long long c, long long d)
{
  const auto sign = [](long long x, long long y) {
    return (x > 0 ? 1 : x < 0 ? -1 : 0) * (y > 0 ? 1 : y < 0 ? -1 : 0);
  };
  const auto magnitude = [](long long x)
  { return x < 0 ? ~static_cast<std::uint64_t>(x) + 1 : static_cast<std::uint64_t>(x); };
  const int left = sign(a, b), right = sign(c, d);
  if (left != right)
  {
    return left > right ? 1 : -1;
  }
  const auto first = WideProduct(magnitude(a), magnitude(b)), second = WideProduct(magnitude(c), magnitude(d));
  return first == second ? 0 : (first > second ? left : -left);
}

}

#endif
