#include "Adapters/Output/ContoursToPolyData.h"

#include "Adapters/Surface/PolyDataBuilder.h"

#include "vtkDoubleArray.h"

namespace dmg
{

void ContoursToPolyData(
  const ContourLines& lines, const std::string& name, const std::vector<double>& values, vtkPolyData* output)
{
  if (lines.Order.empty())
  {
    return;
  }
  PolyDataBuilder drawing(PolyDataBuilder::Cells::Lines);
  for (Eigen::Index point = 0; point < lines.Positions.rows(); ++point)
  {
    drawing.AddPoint(lines.Positions.row(point).transpose());
  }
  for (std::size_t line = 0; line + 1 < lines.Offsets.size(); ++line)
  {
    drawing.AddCell({ lines.Order.begin() + lines.Offsets[line], lines.Order.begin() + lines.Offsets[line + 1] });
  }
  std::vector<double> ofPoints;
  for (const int value : lines.Values)
  {
    ofPoints.push_back(values[value]);
  }
  drawing.Finish(output);
  AddToPoints<vtkDoubleArray>(output, name, ofPoints);
}

}
