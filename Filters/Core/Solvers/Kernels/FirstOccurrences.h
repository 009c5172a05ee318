#ifndef dmgFirstOccurrences_h
#define dmgFirstOccurrences_h

#include <utility>
#include <vector>

namespace dmg
{

/// An order of the numbers 0 to size - 1: as they are first said, and then those that are not.
class FirstOccurrences
{
public:
  explicit FirstOccurrences(int size)
    : HaveOccurred(size, 0)
  {
    this->Order.reserve(size);
  }

  template <class Iterator>
  void Say(Iterator begin, Iterator end)
  {
    for (; begin != end; ++begin)
    {
      this->Say(*begin);
    }
  }
  void Say(int number)
  {
    if (!std::exchange(this->HaveOccurred[number], 1))
    {
      this->Order.push_back(number);
    }
  }

  /// Nothing can be said after it.
  std::vector<int> Complete()
  {
    for (int number = 0; number < static_cast<int>(this->HaveOccurred.size()); ++number)
    {
      this->Say(number);
    }
    return std::move(this->Order);
  }

private:
  std::vector<char> HaveOccurred;
  std::vector<int> Order;
};

}

#endif
