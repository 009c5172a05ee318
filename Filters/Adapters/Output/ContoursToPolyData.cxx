#include "Adapters/Output/ContoursToPolyData.h"

#include "Adapters/Surface/ElementArrays.h"

#include "vtkCellArray.h"
#include "vtkIdTypeArray.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"

#include <algorithm>

namespace dmg
{

void ContoursToPolyData(
  const ContourLines& lines, const std::string& name, const std::vector<double>& values, vtkPolyData* output)
{
  if (lines.Order.empty())
  {
    return;
  }
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  points->SetNumberOfPoints(lines.Positions.rows());
  std::copy_n(lines.Positions.data(), lines.Positions.size(), static_cast<double*>(points->GetVoidPointer(0)));
  const auto ids = [](const std::vector<int>& numbers)
  {
    vtkNew<vtkIdTypeArray> array;
    array->SetNumberOfValues(static_cast<vtkIdType>(numbers.size()));
    std::copy(numbers.begin(), numbers.end(), array->GetPointer(0));
    return vtkSmartPointer<vtkIdTypeArray>(array);
  };
  vtkNew<vtkCellArray> cells;
  cells->SetData(ids(lines.Offsets), ids(lines.Order));
  const auto ofPoints = NewArray(name, 1, lines.Positions.rows());
  std::transform(
    lines.Values.begin(), lines.Values.end(), ofPoints->GetPointer(0), [&values](int value) { return values[value]; });
  output->SetPoints(points);
  output->SetLines(cells);
  output->GetPointData()->AddArray(ofPoints); // not active: in its colours no line would show on the surface
}

}
