#ifndef dmgReportToArrays_h
#define dmgReportToArrays_h

#include "Solvers/Krylov/SolveReport.h"

class vtkFieldData;
class vtkTable;

namespace dmg
{

/// Makes \p table the history of the iterations.
void MakeConvergenceTable(const SolveReport& report, vtkTable* table);

/// Adds sizes, cost and convergence to \p fieldData.
void AddReport(const SolveReport& report, int N, double setupSeconds, vtkFieldData* fieldData);

}

#endif
