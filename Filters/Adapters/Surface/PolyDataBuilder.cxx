#include "Adapters/Surface/PolyDataBuilder.h"

#include "vtkFloatArray.h"
#include "vtkPoints.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace dmg
{

void PolyDataBuilder::AddLine(vtkIdType first, vtkIdType end, bool isClosed)
{
  std::vector<vtkIdType> points(end - first);
  std::iota(points.begin(), points.end(), first);
  if (isClosed)
  {
    points.push_back(first);
  }
  this->AddCell(points);
}

void PolyDataBuilder::Finish(vtkPolyData* output) const
{
  vtkNew<vtkPoints> points;
  points->SetData(NewArray<vtkDoubleArray>("Points", 3, this->Positions));
  output->SetPoints(points);
  switch (this->Kind)
  {
    case Cells::None:
      break;
    case Cells::Vertices:
      output->SetVerts(this->CellsOnPoints);
      break;
    case Cells::Lines:
      output->SetLines(this->CellsOnPoints);
      break;
    case Cells::Polygons:
      output->SetPolys(this->CellsOnPoints);
      break;
  }
}

vtkSmartPointer<vtkDataArray> AsTextureCoordinates(vtkDataArray* array)
{
  const auto copy = vtkSmartPointer<vtkFloatArray>::New();
  copy->DeepCopy(array);
  float* const numbers = copy->GetPointer(0);
  std::replace(numbers, numbers + copy->GetNumberOfValues(), -1.0f, std::nextafter(-1.0f, 0.0f));
  return copy;
}

void SetNormals(vtkPolyData* output, const std::vector<Vector3>& normals)
{
  std::vector<float> numbers;
  numbers.reserve(3 * normals.size());
  for (const Vector3& normal : normals)
  {
    for (const double number : normal)
    {
      numbers.push_back(static_cast<float>(number));
    }
  }
  output->GetPointData()->SetNormals(NewArray<vtkFloatArray>("Normals", 3, numbers));
}

}
