#ifndef dmgDistanceInputs_h
#define dmgDistanceInputs_h

#include "Adapters/View/ChosenArrays.h"
#include "Adapters/View/SurfaceView.h"
#include "Geodesics/DistanceSources.h"
#include "Support/Types.h"

#include <vector>

class vtkDataObject;

namespace dmg
{

/// Adds the sources that datasets are, dataset by dataset: each vertex cell a point, each polyline a line, and the outline of polygons a closed line,
/// with these to its left seen from the positive side of the surface (PositiveSide.h). Lines of two points that follow each other by their numbers are one, as those of Slice. All points
/// of a dataset that has none of these, as of closed polygons.
/// \throw InvalidInput something is no dataset, or a point is not finite.
void AddSourcesFrom(const std::vector<vtkDataObject*>& datasets, const SurfaceView& view, DistanceSources& sources);

/// Adds the elements for which an array is neither zero nor NaN. Cells are the region. Of points, faces with three of them are the region, and
/// those of no such face are sources on their own.
/// \param mask an array of 1 component, or none.
/// \return whether there is one.
/// \throw InvalidInput as FindArray.
bool AddMaskedSources(const ChosenArray& mask, const SurfaceView& view, DistanceSources& sources);

/// Adds the place of the surface that is nearest to a point, however far.
/// \throw InvalidInput the point is not finite.
void AddNearestSource(const Vector3& point, const SurfaceView& view, DistanceSources& sources);

/// All points of datasets, as targets.
/// \throw InvalidInput as AddSourcesFrom.
std::vector<Vector3> TargetsFrom(const std::vector<vtkDataObject*>& datasets, const SurfaceView& view);

}

#endif
