#ifndef dmgReportToArrays_h
#define dmgReportToArrays_h

#include "Field.h"

#include <string>

class vtkFieldData;
class vtkTable;

namespace dmg
{

/// Makes \p table the history of the iterations.
void MakeConvergenceTable(const SolveReport& report, vtkTable* table);

/// Adds the words of WhatIsFollowed.
void AddFollowed(const std::string& text, vtkFieldData* fieldData);

/// Adds sizes, cost and convergence to \p fieldData.
void AddReport(const Field& field, double setupSeconds, vtkFieldData* fieldData);

}

#endif
