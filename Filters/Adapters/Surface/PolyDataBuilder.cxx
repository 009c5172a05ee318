#include "Adapters/Surface/PolyDataBuilder.h"

#include "vtkPoints.h"

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

void SetNormals(vtkPolyData* output, const std::vector<Vector3>& normals)
{
  std::vector<double> numbers;
  numbers.reserve(3 * normals.size());
  for (const Vector3& normal : normals)
  {
    numbers.insert(numbers.end(), normal.begin(), normal.end());
  }
  output->GetPointData()->SetNormals(NewArray<vtkDoubleArray>("Normals", 3, numbers));
}

}
