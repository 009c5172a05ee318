#ifndef dmgGuidesFromDataSets_h
#define dmgGuidesFromDataSets_h

#include "Adapters/Input/ChosenArrays.h"
#include "Constraints/Guides.h"

#include <vector>

class vtkDataObject;
class vtkFieldData;
class vtkInformationVector;

namespace dmg
{

/// Datasets that a field shall follow, and how they are read; the rules are those of vtkHarmonicFieldSolver.h.
struct GuideInput
{
  std::vector<vtkDataObject*> Data; ///< datasets, or composite ones
  ConstraintArrays Choices;
  double MaximumDistance = Guides().MaximumDistance;
};

/// The data of all connections of some input ports.
std::vector<vtkDataObject*> DataOf(vtkInformationVector** inputs, const std::vector<int>& ports);

/// The lines and vectors of all datasets.
/// \throw InvalidInput a guide is no dataset, or has neither lines nor vectors; a choice that no guide has; as FindArray and
/// VisitPrescribed; a point that is not finite; a weight that is negative or infinite.
/// \param unusable counts the vectors that VisitPrescribed passes over.
Guides GuidesFrom(const GuideInput& input, UnusableDirections& unusable);

/// Adds the report to \p fieldData.
void AddGuidesReport(const GuidesReport& report, vtkFieldData* fieldData);

}

#endif
