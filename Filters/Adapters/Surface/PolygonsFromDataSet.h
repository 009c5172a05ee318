#ifndef dmgPolygonsFromDataSet_h
#define dmgPolygonsFromDataSet_h

#include "Preparation/PolygonSurface.h"

#include "vtkSmartPointer.h"

#include <variant>

class vtkDataSet;
class vtkInformationVector;
class vtkPoints;

namespace dmg
{

/// The cells of two dimensions: triangles, where there is nothing else.
using SurfaceCells = std::variant<CellTriangles, PolygonSurface>;

/// \throw InvalidInput as CheckCells and MeshFromDataSet, but for PrepareSurface.
SurfaceCells ReadSurfaceCells(vtkDataSet* surface);

/// The surface that comes in through a port. \pre it is a dataset.
vtkSmartPointer<vtkDataSet> SurfaceOf(vtkInformationVector* port);

/// The points of a dataset; new ones, where it has only coordinates along its axes.
vtkSmartPointer<vtkPoints> PointsOf(vtkDataSet* dataset);

}

#endif
