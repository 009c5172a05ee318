#include "Adapters/Output/DistanceToArrays.h"

#include "Adapters/Output/ContoursToPolyData.h"
#include "Adapters/Pipeline/FiniteArrays.h"
#include "Adapters/Surface/ArrayNames.h"
#include "Adapters/Surface/ElementArrays.h"

#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkIntArray.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkTable.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace dmg
{
namespace
{

constexpr double NotANumber = std::numeric_limits<double>::quiet_NaN();

vtkSmartPointer<vtkIntArray> NewIntegers(const char* name)
{
  auto array = vtkSmartPointer<vtkIntArray>::New();
  array->SetName(name);
  return array;
}

/// Numbers of sources are integers, which have no NaN: -1 where there is none.
vtkSmartPointer<vtkIntArray> AsIntegers(vtkDataArray* numbers)
{
  auto integers = NewIntegers(numbers->GetName());
  for (vtkIdType tuple = 0; tuple < numbers->GetNumberOfTuples(); ++tuple)
  {
    const double number = numbers->GetComponent(tuple, 0);
    integers->InsertNextValue(std::isnan(number) ? -1 : static_cast<int>(number));
  }
  return integers;
}

/// Collects paths and the rows of their table.
class PathCollector
{
public:
  explicit PathCollector(double scale)
    : Scale(scale)
  {
    this->Places->SetDataTypeToDouble();
  }

  void Add(int target, const SurfacePath& path)
  {
    const bool isAny = !path.Points.empty();
    this->OfTable.Target->InsertNextValue(target);
    this->OfTable.Source->InsertNextValue(path.Source);
    this->OfTable.Distance->InsertNextValue(this->Scale * path.Distance);
    this->OfTable.PathLength->InsertNextValue(isAny ? this->Scale * path.Length : NotANumber);
    this->OfTable.StraightLength->InsertNextValue(
      isAny ? this->Scale * (path.Points.back() - path.Points.front()).norm() : NotANumber);
    if (path.Points.size() > 1)
    {
      this->Lines->InsertNextCell(static_cast<int>(path.Points.size()));
      for (const Vector3& point : path.Points)
      {
        this->Lines->InsertCellPoint(this->Places->InsertNextPoint(point.data()));
      }
      const vtkIdType row = this->OfTable.Target->GetNumberOfTuples() - 1;
      this->OfPaths.Target->InsertNextValue(target);
      this->OfPaths.Source->InsertNextValue(path.Source);
      this->OfPaths.Distance->InsertNextValue(this->OfTable.Distance->GetValue(row));
      this->OfPaths.PathLength->InsertNextValue(this->OfTable.PathLength->GetValue(row));
      this->OfPaths.StraightLength->InsertNextValue(this->OfTable.StraightLength->GetValue(row));
    }
  }

  void Write(vtkPolyData* paths, vtkTable* table) const
  {
    if (this->Lines->GetNumberOfCells() > 0)
    {
      paths->SetPoints(this->Places);
      paths->SetLines(this->Lines);
      this->OfPaths.AddTo(paths->GetCellData());
    }
    this->OfTable.AddTo(table->GetRowData());
    for (const auto& array : { this->OfTable.Distance, this->OfTable.PathLength, this->OfTable.StraightLength })
    {
      AllowNaN(array); // where no path leads
    }
  }

private:
  struct Columns
  {
    vtkSmartPointer<vtkIntArray> Target = NewIntegers(ArrayNames::Target), Source = NewIntegers(ArrayNames::Source);
    vtkSmartPointer<vtkDoubleArray> Distance = NewArray(ArrayNames::Distance, 1, 0);
    vtkSmartPointer<vtkDoubleArray> PathLength = NewArray(ArrayNames::PathLength, 1, 0);
    vtkSmartPointer<vtkDoubleArray> StraightLength = NewArray(ArrayNames::StraightLength, 1, 0);

    void AddTo(vtkFieldData* data) const
    {
      data->AddArray(this->Target);
      data->AddArray(this->Source);
      data->AddArray(this->Distance);
      data->AddArray(this->PathLength);
      data->AddArray(this->StraightLength);
    }
  };

  const double Scale;
  vtkNew<vtkPoints> Places;
  vtkNew<vtkCellArray> Lines;
  Columns OfTable, OfPaths;
};

}

void DistanceOutput::AddArrays() const
{
  const DistanceField& field = this->Distance.Field();
  const Vector<double> distances = this->Scale * field.Distances;
  Vector<double> sources(distances.size());
  for (int vertex = 0; vertex < sources.size(); ++vertex)
  {
    sources[vertex] = field.Sources[vertex] >= 0 ? field.Sources[vertex] : NotANumber;
  }
  const ArraysOfPoints arrays = this->View.OfPoints(this->Context, NotANumber);
  arrays.Add(ArrayNames::Distance, 1, distances.data());
  arrays.Add(ArrayNames::NearestSource, 1, sources.data());
  this->View.OfPoints(this->Context).AddVectors(ArrayNames::DirectionFromSource, field.Directions.data());
  vtkPointData* const ofPoints = this->View.Output()->GetPointData();
  ofPoints->AddArray(AsIntegers(ofPoints->GetArray(ArrayNames::NearestSource)));
  AllowNaN(ofPoints->GetArray(ArrayNames::Distance)); // where no path leads
  ofPoints->SetActiveScalars(ArrayNames::Distance);

  vtkFieldData* const fieldData = this->View.Output()->GetFieldData();
  AddNumber(fieldData, ArrayNames::SourcesTaken, field.Taken);
  AddNumber(fieldData, ArrayNames::SourcesTooFar, field.TooFar);
  AddNumber(fieldData, ArrayNames::PointsWithoutSource, field.Unreached);
  AddNumber(fieldData, ArrayNames::LargestDistance, this->Scale * field.Largest);
  AddNumber(fieldData, ArrayNames::DistanceIsSigned, field.IsSigned ? 1.0 : 0.0);
}

void DistanceOutput::MakeOffsetLines(std::vector<double> distances, int levels, vtkPolyData* lines) const
{
  const Vector<double>& known = this->Distance.Field().Distances;
  double least = 0.0, largest = 0.0;
  for (const double distance : known)
  {
    least = distance < least ? distance : least; // NaN does not count
    largest = distance > largest ? distance : largest;
  }
  const bool areGiven = !distances.empty();
  for (int k = 0; k < levels && !areGiven && largest > least; ++k)
  {
    distances.push_back(least + (k + 0.5) * (largest - least) / levels);
  }
  std::transform(distances.begin(), distances.end(), distances.begin(),
    [&](double distance) { return areGiven ? distance / this->Scale : distance; });
  std::sort(distances.begin(), distances.end());
  const ContourLines contours = this->Distance.OffsetLines(distances, this->Context);
  for (double& distance : distances)
  {
    distance *= this->Scale;
  }
  ContoursToPolyData(contours, ArrayNames::Distance, distances, lines);
  this->View.LinesBack(lines);
}

void DistanceOutput::MakePaths(const std::vector<Vector3>& targets, vtkPolyData* paths, vtkTable* table) const
{
  PathCollector collector(this->Scale);
  const auto size = static_cast<double>(targets.size());
  for (std::size_t target = 0; target < targets.size(); ++target)
  {
    const auto done = static_cast<double>(target);
    this->Context.Checkpoint(done / size);
    const PartOfContext part(this->Context, done / size, (done + 1.0) / size);
    collector.Add(static_cast<int>(target), this->Distance.PathTo(targets[target], part));
  }
  if (!targets.empty())
  {
    collector.Write(paths, table);
    this->View.LinesBack(paths);
  }
}

}
