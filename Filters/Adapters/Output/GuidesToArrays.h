#ifndef dmgGuidesToArrays_h
#define dmgGuidesToArrays_h

#include "Constraints/Guides.h"

class vtkFieldData;
class vtkPolyData;

namespace dmg
{

/// Makes \p output the paths of guides as lines.
void PathsToPolyData(const GuidePaths& paths, vtkPolyData* output);

/// Adds how many guides were taken, and how far the farthest lies.
void AddGuidesReport(const GuidesReport& report, vtkFieldData* fieldData);

}

#endif
