#ifndef dmgDrawingToPolyData_h
#define dmgDrawingToPolyData_h

#include "Drawing/EvenlySpacedLines.h"
#include "Mesh/TangentFrames.h"

class vtkPolyData;

namespace dmg
{

/// What is drawn of a field as vtkPolyData; the headers of the filters tell the meaning of the arrays.

/// Polylines with the arrays of vtkFieldLines.
/// \param lift along the normals of the faces, in the unit of the points.
void LinesToPolyData(const LinesOnSurface& lines, const TangentFrames& faceFrames, double lift,
  vtkPolyData* output);

}

#endif
