#include "Adapters/View/FlatMap.h"

#include "Mesh/Globe.h"
#include "Support/Errors.h"
#include "Support/ShortText.h"

#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkDataSet.h"
#include "vtkIdList.h"
#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPointSet.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkRectilinearGrid.h"
#include "vtkStructuredGrid.h"

#include <algorithm>
#include <cmath>

namespace dmg
{
namespace
{

constexpr double Rounding = 1e-4; // degrees, in single precision

Vector3 PointOf(vtkDataSet* dataset, vtkIdType point)
{
  Vector3 place;
  dataset->GetPoint(point, place.data());
  return place;
}

/// A latitude that is that of a pole up to rounding.
double AtPole(double latitude)
{
  return std::abs(std::abs(latitude) - 90.0) < Rounding ? std::copysign(90.0, latitude) : latitude;
}

void CheckIsMap(vtkDataSet* map)
{
  constexpr double LargestLatitude = 100.0; // cells around values at a pole reach over it
  const std::string remedy = "; set Coordinates to Space, or give x and y as longitude and latitude";
  double bounds[6];
  map->GetBounds(bounds);
  if (map->GetNumberOfPoints() > 0 && bounds[5] - bounds[4] > Rounding * (1.0 + std::abs(bounds[5])))
  {
    throw InvalidInput(
      "the surface is not flat: z is from " + ShortText(bounds[4]) + " to " + ShortText(bounds[5]) + remedy);
  }
  for (vtkIdType point = 0; point < map->GetNumberOfPoints(); ++point)
  {
    const double latitude = PointOf(map, point).y();
    if (!(std::abs(latitude) <= LargestLatitude))
    {
      throw InvalidInput("point " + std::to_string(point) + " has the latitude " + ShortText(latitude) + remedy);
    }
  }
}

/// A dataset with the cells of a grid or of a point set, and no points yet.
vtkSmartPointer<vtkPointSet> CellsOf(vtkDataSet* map)
{
  if (auto* const pointSet = vtkPointSet::SafeDownCast(map))
  {
    auto cells = vtk::TakeSmartPointer(pointSet->NewInstance());
    cells->ShallowCopy(pointSet);
    return cells;
  }
  int dimensions[3] = { 0, 0, 0 };
  if (auto* const image = vtkImageData::SafeDownCast(map))
  {
    image->GetDimensions(dimensions);
  }
  else if (auto* const grid = vtkRectilinearGrid::SafeDownCast(map))
  {
    grid->GetDimensions(dimensions);
  }
  else
  {
    throw InvalidInput(
      "a map of class " + std::string(map->GetClassName()) + " is not known; convert it to a vtkUnstructuredGrid");
  }
  vtkNew<vtkStructuredGrid> grid;
  grid->SetDimensions(dimensions);
  grid->GetPointData()->ShallowCopy(map->GetPointData());
  grid->GetCellData()->ShallowCopy(map->GetCellData());
  grid->GetFieldData()->ShallowCopy(map->GetFieldData());
  return { grid.Get() };
}

Vector3 OnMap(const Vector3& place, const Vector3& vector)
{
  const GlobeDirections at = DirectionsAt(place.x(), place.y());
  return { vector.dot(at.East), vector.dot(at.North), vector.dot(at.Up) };
}

Vector3 CentreOf(vtkDataSet* map, vtkIdType cell, vtkIdList* points)
{
  map->GetCellPoints(cell, points);
  Vector3 sum = Vector3::Zero();
  for (const vtkIdType point : *points)
  {
    sum += PointOf(map, point);
  }
  return sum / std::max<double>(1.0, static_cast<double>(points->GetNumberOfIds()));
}

}

FlatMap::FlatMap(vtkDataSet* map)
  : Map(map)
{
  CheckIsMap(map);
  const vtkSmartPointer<vtkPointSet> globe = CellsOf(map);
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  points->SetNumberOfPoints(map->GetNumberOfPoints());
  for (vtkIdType point = 0; point < map->GetNumberOfPoints(); ++point)
  {
    points->SetPoint(point, this->PlaceForth(PointOf(map, point)).data());
  }
  globe->SetPoints(points);
  this->Result = globe;
}

Vector3 FlatMap::PlaceForth(const Vector3& place) const
{
  return OnUnitSphere(place.x(), AtPole(place.y()));
}

Vector3 FlatMap::VectorForth(const Vector3& vector, const Vector3& place) const
{
  const GlobeDirections at = DirectionsOnGlobe(Vector3::UnitZ(), place);
  return vector[0] * at.East + vector[1] * at.North + vector[2] * at.Up;
}

void FlatMap::ArrayBack(const AddedArray& added, const SurfaceRelation&) const
{
  vtkNew<vtkIdList> points;
  for (vtkIdType tuple = 0; added.AreVectors && tuple < added.Array->GetNumberOfTuples(); ++tuple)
  {
    Vector3 vector;
    added.Array->GetTuple(tuple, vector.data());
    vector = OnMap(added.IsOfPoints ? PointOf(this->Map, tuple) : CentreOf(this->Map, tuple, points), vector);
    added.Array->SetTuple(tuple, vector.data());
  }
}

void FlatMap::LinesBack(vtkPolyData* lines) const
{
  vtkPoints* const points = lines->GetPoints();
  if (!points)
  {
    return;
  }
  double bounds[6];
  this->Map->GetBounds(bounds);
  const double middle = 0.5 * (bounds[0] + bounds[1]);
  for (vtkIdType point = 0; point < points->GetNumberOfPoints(); ++point)
  {
    Vector3 place;
    points->GetPoint(point, place.data());
    const double longitude = std::atan2(place.y(), place.x()) * 180.0 / Pi;
    const double latitude = std::atan2(place.z(), place.head<2>().norm()) * 180.0 / Pi;
    points->SetPoint(point, middle + std::remainder(longitude - middle, 360.0), latitude, bounds[4]);
  }
  vtkNew<vtkCellArray> cut;
  vtkNew<vtkCellData> ofCut;
  ofCut->CopyAllOn();
  ofCut->CopyAllocate(lines->GetCellData());
  const auto add = [&](vtkIdList* part, vtkIdType cell)
  { ofCut->CopyData(lines->GetCellData(), cell, cut->InsertNextCell(part)); };
  vtkNew<vtkIdList> line;
  for (vtkIdType cell = 0; cell < lines->GetLines()->GetNumberOfCells(); ++cell)
  {
    lines->GetLines()->GetCellAtId(cell, line);
    vtkNew<vtkIdList> part;
    for (vtkIdType k = 0; k < line->GetNumberOfIds(); ++k)
    {
      const bool isFirst = part->GetNumberOfIds() == 0;
      double here[3], last[3] = { 0.0, 0.0, 0.0 };
      points->GetPoint(line->GetId(k), here);
      points->GetPoint(isFirst ? line->GetId(k) : line->GetId(k - 1), last);
      if (std::abs(here[0] - last[0]) > 180.0)
      {
        add(part, cell);
        part->Reset();
      }
      part->InsertNextId(line->GetId(k));
    }
    add(part, cell);
  }
  lines->SetLines(cut);
  lines->GetCellData()->ShallowCopy(ofCut);
}

}
