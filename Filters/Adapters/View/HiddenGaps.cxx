#include "Adapters/View/HiddenGaps.h"

#include "Adapters/Data/HiddenCells.h"
#include "Adapters/Pipeline/FiniteArrays.h"
#include "Adapters/View/FillValues.h"
#include "Support/Errors.h"

#include "vtkIdList.h"
#include "vtkNew.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

namespace dmg
{
namespace
{

/// The cells that have one of these points.
std::vector<char> CellsWith(const std::vector<char>& isPoint, vtkDataSet* dataset)
{
  std::vector<char> isCell(dataset->GetNumberOfCells(), 0);
  if (std::find(isPoint.begin(), isPoint.end(), 1) == isPoint.end())
  {
    return isCell;
  }
  vtkNew<vtkIdList> points;
  for (vtkIdType cell = 0; cell < dataset->GetNumberOfCells(); ++cell)
  {
    dataset->GetCellPoints(cell, points);
    isCell[cell] =
      std::any_of(points->begin(), points->end(), [&](vtkIdType point) { return isPoint[point] != 0; }) ? 1 : 0;
  }
  return isCell;
}

/// Makes tuples NaN.
void Erase(vtkDataArray* array, const std::vector<vtkIdType>& tuples)
{
  for (const vtkIdType tuple : tuples)
  {
    for (int component = 0; component < array->GetNumberOfComponents(); ++component)
    {
      array->SetComponent(tuple, component, std::numeric_limits<double>::quiet_NaN());
    }
  }
  AllowNaN(tuples.empty() ? nullptr : array);
}

}

HiddenGaps::HiddenGaps(vtkDataSet* dataset, const VectorArrays& vectors, const std::string& what)
  : HiddenGaps(dataset, std::vector<ArraysWithGaps>{ { vectors.Arrays(), vectors.AreOnPoints(), what } }, what)
{
}

HiddenGaps::HiddenGaps(vtkDataSet* dataset, const ChosenArray& numbers, const std::string& what)
  : HiddenGaps(dataset, std::vector<ArraysWithGaps>{ { { numbers.Array }, numbers.OnPoints(), what } }, what)
{
}

HiddenGaps::HiddenGaps(vtkDataSet* dataset, const std::vector<ArraysWithGaps>& all, const std::string& what)
  : What(what)
{
  std::vector<char> isHidden(dataset->GetNumberOfCells(), 0);
  for (const ArraysWithGaps& each : all)
  {
    const vtkIdType tuples = each.AreOnPoints ? dataset->GetNumberOfPoints() : dataset->GetNumberOfCells();
    const std::vector<char> isNaN = TuplesWith([](double x) { return std::isnan(x); }, each.Arrays, tuples);
    const std::string suspicion = SuspectedFillValues(each.Arrays, isNaN, each.What);
    this->Suspicion = this->Suspicion.empty() ? suspicion : this->Suspicion;
    const std::vector<char> isCell = each.AreOnPoints ? CellsWith(isNaN, dataset) : isNaN;
    std::transform(isCell.begin(), isCell.end(), isHidden.begin(), isHidden.begin(),
      [](char a, char b) { return static_cast<char>(a != 0 || b != 0); });
    if (!isHidden.empty() && std::find(isHidden.begin(), isHidden.end(), 0) == isHidden.end())
    {
      throw InvalidInput("the " + each.What +
        " is NaN at each cell or at one of its points, so nothing is left; choose another array or time");
    }
  }
  this->Hide(dataset, isHidden);
}

HiddenGaps::HiddenGaps(vtkDataSet* dataset, const std::vector<char>& isHidden)
{
  this->Hide(dataset, isHidden);
}

void HiddenGaps::Hide(vtkDataSet* dataset, const std::vector<char>& isHidden)
{
  for (vtkIdType cell = 0; cell < dataset->GetNumberOfCells(); ++cell)
  {
    if (isHidden[cell])
    {
      this->Cells.push_back(cell);
    }
  }
  this->Result = this->Cells.empty() ? dataset : WithHidden(dataset, isHidden).Get();
}

std::vector<vtkIdType> HiddenGaps::PointsBeside(const SurfaceRelation& relation) const
{
  std::vector<vtkIdType> points;
  vtkNew<vtkIdList> corners;
  for (const vtkIdType cell : this->Cells)
  {
    this->Result->GetCellPoints(cell, corners);
    std::copy_if(corners->begin(), corners->end(), std::back_inserter(points),
      [&relation](vtkIdType point) { return relation.VerticesOf(point).empty(); });
  }
  return points;
}

void HiddenGaps::ArrayBack(const AddedArray& added, const SurfaceRelation& relation) const
{
  Erase(added.Array, added.IsOfPoints ? this->PointsBeside(relation) : this->Cells);
}

void HiddenGaps::Report(vtkFieldData* fieldData) const
{
  if (!this->What.empty())
  {
    AddNumber(fieldData, ArrayNames::CellsWithout(this->What), static_cast<double>(this->Cells.size()));
  }
}

}
