#ifndef dmgUnfilled_h
#define dmgUnfilled_h

#include <cstddef>
#include <cstdlib>
#include <memory>
#include <new>
#include <type_traits>
#include <utility>
#include <vector>

/// An allocator that leaves new elements uninitialised. Large arrays are written by parallel loops; filling them with zeros before
/// would be serial, and commit all their pages.
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

/// Lazily zeroed memory (calloc): a page is committed when it is first written. So there is room for all indices, at
/// the cost of those that are used.
template <class T>
class LazyZeros
{
  static_assert(std::is_trivially_copyable<T>::value, "is all bits zero");

public:
  explicit LazyZeros(std::size_t size)
    : Begin(static_cast<T*>(std::calloc(size + 1, sizeof(T)))) // none of no bytes
  {
    if (!this->Begin)
    {
      throw std::bad_alloc();
    }
  }

  T* data() { return this->Begin.get(); }
  const T* data() const { return this->Begin.get(); }
  T& operator[](std::size_t index) { return this->Begin.get()[index]; }
  const T& operator[](std::size_t index) const { return this->Begin.get()[index]; }

private:
  struct Free
  {
    void operator()(T* begin) const { std::free(begin); }
  };
  std::unique_ptr<T, Free> Begin;
};

}

#endif
