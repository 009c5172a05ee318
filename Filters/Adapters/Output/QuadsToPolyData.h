#ifndef dmgQuadsToPolyData_h
#define dmgQuadsToPolyData_h

#include "Adapters/View/SurfaceView.h"
#include "Quads/QuadMesh.h"

class vtkPolyData;

namespace dmg
{

/// Quad meshes as vtkPolyData; vtkFieldQuads defines the arrays.

/// The quads, with the arrays of the surface.
/// \param areCut whether points are there once on each side of a cut of the grid.
void QuadsToPolyData(const QuadMesh& quads, const SurfaceView& view, bool areCut, vtkPolyData* output);

/// The triangles of the surface with the map as texture coordinates; points are there once on each side of a cut.
void MapToPolyData(const QuadMesh& quads, const SurfaceView& view, vtkPolyData* output);

/// Balls at vertices inside of the mesh that have not four quads.
/// \param radius over the length of edges.
void IrregularToPolyData(const QuadMesh& quads, double radius, vtkPolyData* output);

}

#endif
