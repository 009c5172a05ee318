#ifndef dmgFlatMap_h
#define dmgFlatMap_h

#include "vtkSmartPointer.h"

#include <string>
#include <vector>

class vtkDataSet;
class vtkPolyData;

namespace dmg
{

/// The surface of a map, whose x and y are longitudes and latitudes in degrees, on the unit sphere: the same cells, points and arrays. Points of
/// one place, as those of a pole or at 0 and 360 degrees, coincide there.
/// \throw InvalidInput a latitude is not between -90 and 90 degrees, or z is not constant.
vtkSmartPointer<vtkDataSet> GlobeOfMap(vtkDataSet* map);

/// Makes vectors in space on the globe, arrays of cells and points, vectors on the map: eastward, northward, upward.
/// \param names of the arrays; those that \p output lacks are passed over.
void TurnToMap(vtkDataSet* map, vtkDataSet* output, const std::vector<std::string>& names);

/// Takes lines from the globe to the map, and cuts them where they leave it at one side and come back at the other.
void TakeLinesToMap(vtkDataSet* map, vtkPolyData* lines);

}

#endif
