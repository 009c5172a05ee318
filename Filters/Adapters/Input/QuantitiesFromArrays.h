#ifndef dmgQuantitiesFromArrays_h
#define dmgQuantitiesFromArrays_h

#include "Adapters/View/HiddenGaps.h"
#include "Adapters/View/SurfaceView.h"
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
  ChosenArray RelativeWavelengths = {}; ///< of a wavelength that varies over the surface, or none

  /// Whether a flow has eastward and northward components, so that the surface lies around the origin.
  bool AreComponents() const;
  /// All, for HiddenGaps.
  std::vector<ArraysWithGaps> WithGaps() const;
  /// One per vertex of a view of the dataset; empty where there are none.
  std::vector<double> RelativeWavelengthsOn(const SurfaceView& view) const;
};

/// The quantities that are chosen by name, each of points or else of cells, numbers or vectors. Eastward and northward components are one more
/// flow, chosen with indices 1 and 2 of SetInputArrayToProcess. Without any choice, the active scalars and the active vectors (index 0), of
/// points or else of cells; without these, the only array of numbers or vectors.
/// Index 3 chooses relative wavelengths.
/// \param axis of components.
/// \throw WrongChoice nothing is chosen and nothing is active.
/// \throw InvalidInput an array is not there, or holds neither numbers nor vectors; a relative wavelength is zero or negative.
QuantityArrays FindQuantities(
  vtkAlgorithm* algorithm, const std::vector<std::string>& names, vtkDataSet* dataset, const Vector3& axis);

}

#endif
