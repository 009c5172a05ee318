#include "Adapters/DrawingToPolyData.h"

#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkDoubleArray.h"
#include "vtkIdTypeArray.h"
#include "vtkIntArray.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"

#include <algorithm>
#include <numeric>
#include <vector>

namespace dmg
{

namespace
{

/// An array of values, one after the other.
template <class Array, class Value>
vtkSmartPointer<Array> NewArray(
  const char* name, int components, const Value* values, vtkIdType tuples)
{
  auto array = vtkSmartPointer<Array>::New();
  array->SetName(name);
  array->SetNumberOfComponents(components);
  array->SetNumberOfTuples(tuples);
  std::copy_n(values, components * tuples, array->GetPointer(0));
  return array;
}

vtkSmartPointer<vtkPoints> NewPoints(const std::vector<Vector3>& positions)
{
  auto points = vtkSmartPointer<vtkPoints>::New();
  points->SetData(NewArray<vtkDoubleArray>("Points", 3,
    positions.empty() ? nullptr : positions.front().data(), static_cast<vtkIdType>(positions.size())));
  return points;
}

}

void LinesToPolyData(const LinesOnSurface& lines, const TangentFrames& faceFrames, double lift,
  vtkPolyData* output)
{
  const std::size_t numberOfPoints = lines.Positions.size();
  std::vector<Vector3> positions(numberOfPoints);
  std::vector<Vector3> normals(numberOfPoints);
  for (std::size_t i = 0; i < numberOfPoints; ++i)
  {
    normals[i] = faceFrames.Normal(lines.Faces[i]);
    positions[i] = lines.Positions[i] + lift * normals[i];
  }
  vtkNew<vtkCellArray> cells;
  std::vector<vtkIdType> ids;
  const int numberOfLines = lines.NumberOfLines();
  for (int line = 0; line < numberOfLines; ++line)
  {
    ids.resize(lines.Offsets[line + 1] - lines.Offsets[line]);
    std::iota(ids.begin(), ids.end(), lines.Offsets[line]);
    if (lines.IsClosed[line])
    {
      ids.push_back(ids.front());
    }
    cells->InsertNextCell(static_cast<vtkIdType>(ids.size()), ids.data());
  }
  output->SetPoints(NewPoints(positions));
  output->SetLines(cells);

  std::vector<int> seeds(numberOfLines);
  std::iota(seeds.begin(), seeds.end(), 0);
  vtkCellData* const ofLines = output->GetCellData();
  ofLines->AddArray(NewArray<vtkDoubleArray>("Length", 1, lines.Lengths.data(), numberOfLines));
  ofLines->AddArray(NewArray<vtkIntArray>("Branch", 1, lines.Families.data(), numberOfLines));
  ofLines->AddArray(NewArray<vtkIntArray>("Seed", 1, seeds.data(), numberOfLines));
  vtkPointData* const ofPoints = output->GetPointData();
  ofPoints->AddArray(NewArray<vtkDoubleArray>(
    "Magnitude", 1, lines.Magnitudes.data(), static_cast<vtkIdType>(numberOfPoints)));
  ofPoints->SetNormals(NewArray<vtkDoubleArray>("Normals", 3,
    normals.empty() ? nullptr : normals.front().data(), static_cast<vtkIdType>(numberOfPoints)));
}

}
