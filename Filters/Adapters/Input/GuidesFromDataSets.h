#ifndef dmgGuidesFromDataSets_h
#define dmgGuidesFromDataSets_h

#include "Adapters/View/ChosenArrays.h"
#include "Constraints/Guides.h"

#include <string>
#include <vector>

class vtkDataObject;
class vtkFieldData;
class vtkInformationVector;
class vtkPolyData;

namespace dmg
{

/// Datasets that a field shall follow, and how they are read; the rules are those of vtkHarmonicFieldSolver.h.
struct GuideInput
{
  std::vector<vtkDataObject*> Data; ///< datasets, or composite ones, each once
  std::vector<int> Slots;           ///< of each, the place of its number where weights are typed
  std::size_t Repeated = 0;         ///< connections to one of Data that comes before
  std::size_t UsedSlots = 0;        ///< up to the last guide
  ConstraintArrays Choices;
  double MaximumDistance = Guides().MaximumDistance;
};

/// The data of all connections of an input port.
std::vector<vtkDataObject*> DataOf(vtkInformationVector* port);

/// The guides of some input ports, in their order. Each connection has a slot, and so has a port without any, so that guides after it
/// keep theirs.
GuideInput GuidesOf(vtkInformationVector** inputs, const std::vector<int>& ports, const ConstraintArrays& choices,
  double maximumDistance);

/// The lines and vectors of all datasets.
/// \throw InvalidInput a guide is no dataset, or has neither lines nor vectors; a choice that no guide has; as FindArray and
/// VisitPrescribed; a point that is not finite; a weight that is negative or infinite.
/// \param unusable counts the vectors that VisitPrescribed passes over.
Guides GuidesFrom(const GuideInput& input, UnusableDirections& unusable);

/// Sentences on a guide that is chosen twice, and on weights that are typed for no guide.
std::vector<std::string> WarningsOf(const GuideInput& input);

}

#endif
