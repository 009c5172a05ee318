#ifndef dmgUnfilled_h
#define dmgUnfilled_h

#include <memory>
#include <new>
#include <type_traits>
#include <utility>
#include <vector>

/// Memory that holds nothing before it is written. Large arrays are written by parallel loops; to fill
/// them with zeros before would take one thread alone, which also waits for all their pages.
namespace dmg
{

template <class T>
class UnfilledAllocator : public std::allocator<T>
{
public:
  template <class U>
  struct rebind
  {
    using other = UnfilledAllocator<U>;
  };

  UnfilledAllocator() = default;
  template <class U>
  UnfilledAllocator(const UnfilledAllocator<U>&) noexcept
  {
  }

  template <class U>
  void construct(U*) noexcept
  {
    static_assert(std::is_trivially_copyable<U>::value, "is written as a whole");
  }
  template <class U, class... Arguments>
  void construct(U* place, Arguments&&... arguments)
  {
    ::new (static_cast<void*>(place)) U(std::forward<Arguments>(arguments)...);
  }
};

/// A vector whose resize writes nothing into the new elements.
template <class T>
using Unfilled = std::vector<T, UnfilledAllocator<T>>;

}

#endif
