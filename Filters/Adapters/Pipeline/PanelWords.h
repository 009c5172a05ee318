#ifndef dmgPanelWords_h
#define dmgPanelWords_h

#include "Support/Remedy.h"

#include <string>
#include <vector>

class vtkAlgorithm;

namespace dmg
{

/// A remedy in the words of a user of VTK or ParaView: labels of properties, and filters by label and class.
std::string PanelTextOf(Remedy remedy);

/// A message of the core with its remedies in these words.
std::string InPanelWords(std::string message);

/// Warns of each text that is not empty, in these words.
void Warn(vtkAlgorithm* algorithm, const std::vector<std::string>& texts);

}

#endif
