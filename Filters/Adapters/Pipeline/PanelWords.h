#ifndef dmgPanelWords_h
#define dmgPanelWords_h

#include "Support/Remedy.h"

#include <string>

namespace dmg
{

/// A remedy in the words of a user of VTK or ParaView: labels of properties, and filters by label and class.
std::string PanelTextOf(Remedy remedy);

/// A message of the core with its remedies in these words.
std::string InPanelWords(std::string message);

}

#endif
