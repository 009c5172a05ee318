#ifndef dmgGlobeLayout_h
#define dmgGlobeLayout_h

#include "Adapters/View/SurfaceStep.h"

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace dmg
{

/// A global grid as readers lay it out becomes one that covers the globe once. Cells around values at the poles reach over these and lie upon
/// each other: the points beyond a pole are moved to it. Columns of cells may be there twice, as those at 0 and at 360 degrees: of cells
/// at the same place all but the first are hidden. On the way back, points beyond poles, and points and cells that are there twice, have
/// the numbers of the others at their places. The user's vectors are eastward and northward.
class GlobeLayout : public SurfaceStep
{
public:
  /// \param globe a surface around the origin. \param axis from there to the north pole, of any length.
  /// \throw InvalidInput as UnitAxis.
  /// Cost: linear; n log n where the cells have more area than the globe.
  GlobeLayout(vtkDataSet* globe, const Vector3& axis);

  bool IsPole(const Vector3& place) const override;
  /// The mean of the given corners of a cell around a pole.
  std::optional<Vector3> PlaceOfCell(vtkIdType cell) const override;
  void ArrayBack(const AddedArray& array, const SurfaceRelation& relation) const override;
  /// A slit along a meridian (WarningOfSlit).
  std::string Warning(const TriangleMesh& mesh) const override;

private:
  using Pairs = std::vector<std::pair<vtkIdType, vtkIdType>>;

  void MovePointsBeyondPoles();
  void HideTwins();

  const Vector3 Axis;
  Pairs TwinPoints, TwinCells; ///< each with the one whose numbers it takes
  std::vector<std::pair<vtkIdType, Vector3>>
    CellsOverPoles; ///< with the means of their corners, as far off as these; ascending
};

}

#endif
