#include "Adapters/Ranks/GatheringMemory.h"

#include "Support/Errors.h"
#include "Support/ShortText.h"

#include "vtksys/SystemInformation.hxx"

#include <algorithm>
#include <cmath>
#include <limits>

namespace dmg
{

namespace
{

/// A solver's memory per triangle, or that of the filters that draw, which is less.
constexpr double WorkPerCell = 1000.0;

}

double GatheringMemory::NeededBytes() const
{
  const double whileJoining = this->SentBytes + 2.0 * this->WholeBytes; // received, appended, points joined
  const double whileWorking = this->WholeBytes + WorkPerCell * static_cast<double>(this->Cells);
  return std::max(whileJoining, whileWorking);
}

double FreeMemory()
{
  vtksys::SystemInformation system;
  const auto limit = static_cast<double>(system.GetHostMemoryAvailable("DMG_MEMORY_LIMIT"));
  const auto used = static_cast<double>(system.GetHostMemoryUsed());
  return limit > 0.0 ? 1024.0 * std::max(0.0, limit - used) : std::numeric_limits<double>::infinity();
}

void CheckFits(const GatheringMemory& memory, double freeBytes)
{
  if (memory.NeededBytes() > freeBytes)
  {
    throw InvalidInput("the surface is in pieces on " + std::to_string(memory.Ranks) +
      " ranks; gathered on the first one, its " + std::to_string(memory.Cells) + " cells take some " +
      TextOfBytes(memory.NeededBytes()) + " of memory, and " + TextOfBytes(freeBytes) +
      " are free there; start the first rank where there is more memory, or reduce the number of triangles with "
      "Decimate (vtkDecimatePro)");
  }
}

std::string TextOfBytes(double bytes)
{
  constexpr double Mega = 1e6;
  constexpr double Giga = 1e9;
  return bytes < Giga ? ShortText(std::max(1.0, std::round(bytes / Mega))) + " MB"
                      : ShortText(std::round(10.0 * bytes / Giga) / 10.0) + " GB";
}

}
