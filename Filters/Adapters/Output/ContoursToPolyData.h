#ifndef dmgContoursToPolyData_h
#define dmgContoursToPolyData_h

#include "Drawing/ContourLines.h"

#include <string>
#include <vector>

class vtkPolyData;

namespace dmg
{

/// Contour lines, with the array \p name of their values at points.
void ContoursToPolyData(
  const ContourLines& lines, const std::string& name, const std::vector<double>& values, vtkPolyData* output);

}

#endif
