#ifndef dmgTestFailingRequests_h
#define dmgTestFailingRequests_h

#include <cerrno>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <link.h>
#include <new>

// Replaces malloc and its like, and operator new, so that requests for memory fail where a test wants. For one source of a program.

namespace dmg::test
{

/// The machine code of a library, or of the program.
struct CodeRange
{
  const char* Name; ///< a part of the library's; "": the program
  std::uintptr_t Begin = 0, End = 0;

  bool Contains(const void* caller) const
  {
    const auto address = reinterpret_cast<std::uintptr_t>(caller);
    return address >= this->Begin && address < this->End;
  }
};

inline CodeRange CodeOf(const char* name)
{
  CodeRange code = { name };
  dl_iterate_phdr(
    [](dl_phdr_info* library, std::size_t, void* found)
    {
      auto& range = *static_cast<CodeRange*>(found);
      const bool isIt = *range.Name ? std::strstr(library->dlpi_name, range.Name) != nullptr : !*library->dlpi_name;
      for (int k = 0; isIt && k < library->dlpi_phnum; ++k)
      {
        const auto& segment = library->dlpi_phdr[k];
        if (segment.p_type == PT_LOAD && (segment.p_flags & PF_X))
        {
          range.Begin = library->dlpi_addr + segment.p_vaddr;
          range.End = range.Begin + segment.p_memsz;
        }
      }
      return 0;
    },
    &code);
  return code;
}

/// Whether a request fails; the source that includes this says so. It must not ask for memory.
/// \param caller the code that the request comes from.
bool Fails(const void* caller);

}

extern "C"
{
  void* __libc_malloc(std::size_t);
  void* __libc_calloc(std::size_t, std::size_t);
  void* __libc_realloc(void*, std::size_t);
  void* __libc_memalign(std::size_t, std::size_t);
  void __libc_free(void*);

  void* malloc(std::size_t size)
  {
    return dmg::test::Fails(__builtin_return_address(0)) ? nullptr : __libc_malloc(size);
  }
  void* calloc(std::size_t number, std::size_t size)
  {
    return dmg::test::Fails(__builtin_return_address(0)) ? nullptr : __libc_calloc(number, size);
  }
  void* realloc(void* memory, std::size_t size)
  {
    return dmg::test::Fails(__builtin_return_address(0)) ? nullptr : __libc_realloc(memory, size);
  }
  void* memalign(std::size_t alignment, std::size_t size)
  {
    return dmg::test::Fails(__builtin_return_address(0)) ? nullptr : __libc_memalign(alignment, size);
  }
  void* aligned_alloc(std::size_t alignment, std::size_t size)
  {
    return dmg::test::Fails(__builtin_return_address(0)) ? nullptr : __libc_memalign(alignment, size);
  }
  int posix_memalign(void** memory, std::size_t alignment, std::size_t size) noexcept
  {
    *memory = dmg::test::Fails(__builtin_return_address(0)) ? nullptr : __libc_memalign(alignment, size);
    return *memory ? 0 : ENOMEM;
  }
}

void* operator new(std::size_t size)
{
  void* const memory = dmg::test::Fails(__builtin_return_address(0)) ? nullptr : __libc_malloc(size);
  return memory ? memory : throw std::bad_alloc();
}
void operator delete(void* memory) noexcept
{
  __libc_free(memory);
}
void operator delete(void* memory, std::size_t) noexcept
{
  __libc_free(memory);
}

#endif
