#ifndef dmgFreedMemory_h
#define dmgFreedMemory_h

#ifdef __GLIBC__
#include <malloc.h>
#endif

namespace dmg
{

/// Gives the system what was freed. glibc keeps the gaps between blocks that are in use, and after a large
/// set-up these are a third of what is in use.
/// Cost: 10 us for each MB in gaps, and as much when they are used again.
inline void GiveBackFreedMemory()
{
#ifdef __GLIBC__
  malloc_trim(0);
#endif
}

}

#endif
