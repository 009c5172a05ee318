#ifndef dmgQuantitiesFromArrays_h
#define dmgQuantitiesFromArrays_h

#include "Adapters/View/HiddenGaps.h"
#include "Adapters/View/VectorArrays.h"

#include <string>
#include <vector>

class vtkAlgorithm;
class vtkDataSet;

namespace dmg
{

/// A flow, and the name that results are called by.
struct NamedFlowArrays
{
  std::string Name;
  VectorArrays Arrays;
};

/// The arrays of a dataset that are filtered.
struct QuantityArrays
{
  std::vector<ChosenArray> Functions;
  std::vector<NamedFlowArrays> Flows;

  /// Whether a flow has eastward and northward components, so that the surface lies around the origin.
  bool AreComponents() const;
  /// All, for HiddenGaps.
  std::vector<ArraysWithGaps> WithGaps() const;
};

/// The quantities that are chosen by name, each of points or else of cells, numbers or vectors. Eastward and northward components are one more
/// flow, chosen with indices 1 and 2 of SetInputArrayToProcess. Without any choice, the active scalars and the active vectors (index 0), of
/// points or else of cells; without these, the only array of numbers or vectors.
/// \param axis of components.
/// \throw WrongChoice nothing is chosen and nothing is active.
/// \throw InvalidInput an array is not there, or holds neither numbers nor vectors.
QuantityArrays FindQuantities(
  vtkAlgorithm* algorithm, const std::vector<std::string>& names, vtkDataSet* dataset, const Vector3& axis);

}

#endif
