#ifndef dmgFirstOccurrences_h
#define dmgFirstOccurrences_h

#include <utility>
#include <vector>

namespace dmg
{

/// A permutation of the numbers 0 to size - 1 by first occurrence; numbers that never occur come last.
class FirstOccurrences
{
public:
  explicit FirstOccurrences(int size)
    : HaveOccurred(size, 0)
  {
    this->Order.reserve(size);
  }

  template <class Iterator>
  void Add(Iterator begin, Iterator end)
  {
    for (; begin != end; ++begin)
    {
      this->Add(*begin);
    }
  }
  void Add(int number)
  {
    if (!std::exchange(this->HaveOccurred[number], 1))
    {
      this->Order.push_back(number);
    }
  }

  /// The permutation. \pre the first call.
  std::vector<int> Complete()
  {
    for (int number = 0; number < static_cast<int>(this->HaveOccurred.size()); ++number)
    {
      this->Add(number);
    }
    return std::move(this->Order);
  }

private:
  std::vector<char> HaveOccurred;
  std::vector<int> Order;
};

}

#endif
