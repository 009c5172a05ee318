#ifndef dmgGlobeLayout_h
#define dmgGlobeLayout_h

#include "Mesh/TriangleMesh.h" // For Vector3

#include "vtkSmartPointer.h"
#include "vtkType.h"

#include <string>
#include <utility>
#include <vector>

class vtkDataSet;

namespace dmg
{

/// A global grid as readers lay it out: with cells around values at the poles, which reach over these and lie upon each other; and with columns
/// of cells that are there twice, as those at 0 and at 360 degrees.
class GlobeLayout
{
public:
  /// \param globe a surface around the origin. \param axis from there to the north pole, not zero.
  /// Cost: linear; n log n where the cells have more area than the globe.
  GlobeLayout(vtkDataSet* globe, const Vector3& axis);

  /// The globe to work on. The points beyond a pole stand on it, and of cells at the same place all but the first are hidden. The given one
  /// where there are neither.
  vtkDataSet* Globe() const { return this->Result; }

  /// Gives points beyond poles, and points and cells that are there twice, what others at their places have.
  /// \param names of arrays of the output.
  void CopyToTwins(vtkDataSet* output, const std::vector<std::string>& names) const;

private:
  using Pairs = std::vector<std::pair<vtkIdType, vtkIdType>>;

  void MovePointsBeyondPoles(const Vector3& axis);
  void HideTwins();

  vtkSmartPointer<vtkDataSet> Result;
  Pairs TwinPoints, TwinCells; ///< each with the one whose numbers it takes
};

}

#endif
