#ifndef dmgQuadsToPolyData_h
#define dmgQuadsToPolyData_h

#include "Adapters/Input/CrossesOfSurface.h"
#include "Quads/QuadMesh.h"

class vtkDataSet;
class vtkPolyData;

namespace dmg
{

/// Quad meshes as vtkPolyData; vtkFieldQuads defines the arrays.

/// The quads, with the arrays of the surface.
/// \param input the surface.
void QuadsToPolyData(const QuadMesh& quads, const CrossesOfSurface& surface, vtkDataSet* input, vtkPolyData* output);

/// The triangles of the surface with the map as texture coordinates; points are there once on each side of a cut.
void MapToPolyData(const QuadMesh& quads, const CrossesOfSurface& surface, vtkDataSet* input, vtkPolyData* output);

/// Balls at vertices inside of the mesh that have not four quads.
/// \param radius over the length of edges.
void IrregularToPolyData(const QuadMesh& quads, double radius, vtkPolyData* output);

}

#endif
