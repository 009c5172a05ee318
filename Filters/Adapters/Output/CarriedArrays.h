#ifndef dmgCarriedArrays_h
#define dmgCarriedArrays_h

#include "Adapters/View/SurfaceView.h"
#include "Places/SurfacePlace.h"

#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkSmartPointer.h"
#include "vtkType.h"

#include <vector>

class vtkCellData;

namespace dmg
{

/// The arrays of the points of a surface, carried to places on it.
///
/// Numbers and colours are interpolated. Labels, which are arrays of integers and of texts, are those of the nearest corner. Of points that were
/// joined, as along the seam of a texture, each face has those of its own cell. Active arrays stay active. Global ids and ghosts, which mean nothing
/// elsewhere, are left out.
class CarriedPoints
{
public:
  /// \param to has no arrays.
  CarriedPoints(const SurfaceView& view, vtkPointData* to, vtkIdType size);
  ~CarriedPoints();

  void Set(vtkIdType point, const SurfacePlace& place);
  /// Hands the arrays over to the point data. Normals are unit vectors again.
  void Finish();

private:
  const SurfaceView& View;
  vtkPointData* const To;
  std::vector<vtkIdType> OfCorners; ///< empty: each vertex has one point
  vtkNew<vtkPointData> Given, GivenLabels, Labels;
};

/// Makes arrays of cells ready for copies of those of the surface: all but normals, global ids and ghosts.
/// \return the arrays to copy from.
vtkSmartPointer<vtkCellData> StartCarryingCells(const SurfaceView& view, vtkCellData* to, vtkIdType size);

}

#endif
