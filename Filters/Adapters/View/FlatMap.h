#ifndef dmgFlatMap_h
#define dmgFlatMap_h

#include "Adapters/View/SurfaceStep.h"

namespace dmg
{

/// A map, whose x and y are longitudes and latitudes in degrees, becomes a part of the unit sphere: the same cells, points and arrays. Points
/// of one place, as those of a pole or at 0 and 360 degrees, coincide there. Vectors of the map are eastward, northward and upward. On
/// the way back, lines are cut where they leave the map at one side and come back at the other.
class FlatMap : public SurfaceStep
{
public:
  /// \throw InvalidInput a latitude is not between -90 and 90 degrees, or z is not constant.
  explicit FlatMap(vtkDataSet* map);

  Vector3 PlaceForth(const Vector3& place) const override;
  Vector3 VectorForth(const Vector3& vector, const Vector3& place) const override;
  bool IsFromPlane() const override { return true; }
  void ArrayBack(const AddedArray& array, const SurfaceRelation& relation) const override;
  void LinesBack(vtkPolyData* lines) const override;

private:
  const vtkSmartPointer<vtkDataSet> Map;
};

}

#endif
