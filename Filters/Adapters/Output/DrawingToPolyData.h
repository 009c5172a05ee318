#ifndef dmgDrawingToPolyData_h
#define dmgDrawingToPolyData_h

#include "Adapters/Input/FieldFromArrays.h"
#include "Directions/FieldTopology.h"
#include "Drawing/ArrowHeads.h"
#include "Drawing/EvenlySpacedLines.h"
#include "Drawing/FieldGlyphs.h"
#include "Mesh/FramedMesh.h"
#include "Support/ExecutionContext.h"

#include <vector>

class vtkPolyData;

namespace dmg
{

/// Drawings of a field as vtkPolyData; the headers of the filters define the arrays.

/// Polylines with the arrays of vtkFieldLines, and after them their heads, lines of three points.
/// \param lift along the normals of the faces, in the unit of the points.
/// \throw Cancelled
void LinesToPolyData(const LinesOnSurface& lines, const std::vector<ArrowHead>& heads, const FramedMesh& surface,
  double lift, vtkPolyData* output, const ExecutionContext& context);

/// Polylines or polygons with the arrays of vtkFieldGlyphs.
/// \param families of the field, of which branch k belongs to number k modulo this.
/// \param areStrokes whether the cells are lines.
/// \param lift of the glyphs off the surface, in the unit of the points.
/// \throw Cancelled
void GlyphsToPolyData(const GlyphsOnSurface& glyphs, int families, bool areStrokes, const FramedMesh& surface,
  double lift, vtkPolyData* output, const ExecutionContext& context);

/// The outputs of vtkFieldSingularities.
/// \param given the surface, of which \p topology is made.
void SingularitiesToPolyData(const SurfaceWithField& given, const FieldTopology& topology, vtkPolyData* output);
/// Spheres at singularities, in the colours of their signs. Where these are many, spheres have fewer triangles: 1,056 down to 16 each, four
/// million in all as far as that goes.
/// \param radius in the unit of the points.
void SpheresToPolyData(vtkPolyData* singularities, double radius, vtkPolyData* output);
void CutsToPolyData(const SurfaceWithField& given, const FieldTopology& topology, vtkPolyData* output);
void BoundaryLoopsToPolyData(const SurfaceWithField& given, const FieldTopology& topology, vtkPolyData* output);

}

#endif
