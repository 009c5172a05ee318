#ifndef dmgGatheringMemory_h
#define dmgGatheringMemory_h

#include <string>

namespace dmg
{

/// The memory of the first rank that it takes to gather a surface there, and to work on it.
struct GatheringMemory
{
  int Ranks = 1;           ///< that have a piece
  long long Cells = 0;     ///< of the whole surface
  double SentBytes = 0.0;  ///< of the pieces of other ranks
  double WholeBytes = 0.0; ///< of the whole, with its arrays

  /// The peak: while pieces are joined, or while a field is solved for.
  double NeededBytes() const;
};

/// The memory that is free on this machine, in bytes: a limit on the whole machine's memory, in KiB, may be set in the environment
/// variable DMG_MEMORY_LIMIT, for containers and batch systems. Infinite where the system does not tell.
double FreeMemory();

/// \throw InvalidInput there is not enough; the message has the numbers and a remedy.
void CheckFits(const GatheringMemory& memory, double freeBytes);

/// A number of bytes with a unit.
std::string TextOfBytes(double bytes);

}

#endif
