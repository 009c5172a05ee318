#ifndef dmgFreedMemory_h
#define dmgFreedMemory_h

#include <cstddef>

#ifdef __GLIBC__
#include <malloc.h>
#endif

namespace dmg
{

/// Returns freed memory to the system if there is much of it. glibc keeps the gaps between blocks that are in use, which are many
/// after a large set-up.
/// Cost: linear in the memory returned, and several times as much when it is needed again. Smaller amounts, which a
/// set-up frees and needs again and again, are therefore kept.
inline void GiveBackFreedMemory()
{
#ifdef __GLIBC__
  constexpr std::size_t much = 110 << 20;
  if (mallinfo2().fordblks > much)
  {
    malloc_trim(0);
  }
#endif
}

}

#endif
