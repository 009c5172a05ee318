#include "Adapters/Output/QuadsToPolyData.h"

#include "Adapters/Output/CarriedArrays.h"
#include "Adapters/Output/DrawingToPolyData.h"
#include "Adapters/Surface/ArrayNames.h"
#include "Adapters/Surface/PolyDataBuilder.h"

#include "vtkCellData.h"
#include "vtkDataSet.h"
#include "vtkDataSetAttributes.h"
#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkIdList.h"
#include "vtkIntArray.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"

#include <algorithm>
#include <array>
#include <map>
#include <numeric>
#include <tuple>
#include <vector>

namespace dmg
{

namespace
{

/// The points that corners of quads become.
struct PointsOfQuads
{
  std::vector<int> Vertices;                     ///< by point
  std::vector<std::array<int, 2>> Places;        ///< by point, on the grid; empty if vertices are not doubled
  std::vector<std::vector<vtkIdType>> OfCorners; ///< by quad
};

PointsOfQuads OnePerVertex(const QuadMesh& quads)
{
  PointsOfQuads points;
  points.Vertices.resize(quads.Places.size());
  std::iota(points.Vertices.begin(), points.Vertices.end(), 0);
  for (const auto& corners : quads.Quads)
  {
    points.OfCorners.emplace_back(corners.begin(), corners.end());
  }
  return points;
}

/// A point for each vertex and place on the grid.
PointsOfQuads OnePerPlace(const QuadMesh& quads)
{
  PointsOfQuads points;
  std::map<std::tuple<int, int, int>, vtkIdType> numbers;
  for (std::size_t quad = 0; quad < quads.Quads.size(); ++quad)
  {
    points.OfCorners.emplace_back(4);
    for (int k = 0; k < 4; ++k)
    {
      const std::array<int, 2>& place = quads.Grid[quad][k];
      const auto [number, isNew] = numbers.emplace(
        std::make_tuple(quads.Quads[quad][k], place[0], place[1]), static_cast<vtkIdType>(points.Vertices.size()));
      if (isNew)
      {
        points.Vertices.push_back(quads.Quads[quad][k]);
        points.Places.push_back(place);
      }
      points.OfCorners.back()[k] = number->second;
    }
  }
  return points;
}

void CarryPoints(const QuadMesh& quads, const std::vector<int>& vertices, const SurfaceView& view, vtkPointData* to)
{
  const vtkIdType size = static_cast<vtkIdType>(vertices.size());
  CarriedPoints carried(view, to, size);
  for (vtkIdType point = 0; point < size; ++point)
  {
    carried.Set(point, quads.Places[vertices[point]]);
  }
  carried.Finish();
}

/// Places on the grid: of the corners of quads, and of points, where these have one each; the latter as texture coordinates, if the surface has none.
void AddGrid(const QuadMesh& quads, const std::vector<std::array<int, 2>>& places, vtkPolyData* output)
{
  int least = 0; // so that all are positive
  for (const auto& corners : quads.Grid)
  {
    for (const auto& [u, v] : corners)
    {
      least = std::min({ least, u, v });
    }
  }
  const auto ofCorners = NewArray("CornersOnGrid", 8, static_cast<vtkIdType>(quads.Grid.size()));
  for (vtkIdType number = 0; number < ofCorners->GetNumberOfValues(); ++number)
  {
    ofCorners->SetValue(number, quads.Grid[number / 8][number % 8 / 2][number % 2] - least);
  }
  output->GetCellData()->AddArray(ofCorners);
  if (places.empty())
  {
    return;
  }
  const auto ofPoints = NewArray("GridCoordinates", 2, static_cast<vtkIdType>(places.size()));
  for (vtkIdType number = 0; number < ofPoints->GetNumberOfValues(); ++number)
  {
    ofPoints->SetValue(number, places[number / 2][number % 2] - least);
  }
  vtkPointData* const pointData = output->GetPointData();
  if (pointData->GetTCoords())
  {
    pointData->AddArray(AsTextureCoordinates(ofPoints));
  }
  else
  {
    pointData->SetTCoords(AsTextureCoordinates(ofPoints));
  }
}

void AddReport(const QuadReport& report, vtkFieldData* fieldData)
{
  const auto add = [fieldData](const char* name, int value)
  { AddHidden(fieldData, NewValue<vtkIntArray>(name, value)); };
  const auto addNumbers = [fieldData](const char* name, const std::vector<double>& values)
  {
    const auto array = NewArray(name, 1, static_cast<vtkIdType>(values.size()));
    std::copy(values.begin(), values.end(), array->GetPointer(0));
    AddHidden(fieldData, array);
  };
  add("Singularities", report.Singularities);
  add("IrregularVertices", report.IrregularVertices);
  add("IrregularWithoutSingularity", report.IrregularWithoutSingularity);
  add("FlippedTriangles", report.FlippedFaces);
  add("TrianglesWithoutArea", report.FacesWithoutArea);
  add("InvertedQuads", report.InvertedQuads);
  add("EdgesAgainstField", static_cast<int>(report.AgainstField.size()));
  add("LostRegions", report.LostRegions);
  add("EulerCharacteristicOfSurface", report.EulerOfSurface);
  add("EulerCharacteristic", report.EulerOfMesh);
  add("RefinedTriangles", static_cast<int>(report.RefinedFaces.size()));
  add("SplitTriangles", report.SplitFaces);
  const QuadDistances& distances = report.Distances;
  addNumbers("DistanceFromQuads", { distances.LargestFromQuads, distances.MeanFromQuads });
  addNumbers("DistanceFromSurface", { distances.LargestFromSurface, distances.MeanFromSurface });
  const Vector3& place = distances.FarthestPlace;
  addNumbers("FarthestPlace", { place[0], place[1], place[2] });
  if (report.IsSymmetric)
  {
    const Vector3 &origin = report.Mirror.Origin, &normal = report.Mirror.Normal;
    addNumbers("SymmetryPlane", { origin[0], origin[1], origin[2], normal[0], normal[1], normal[2] });
  }
  addNumbers("AreaShares", report.AreaShares);
  addNumbers("RatioOfSizes", { report.AskedRatio, report.ReachedRatio });
}

/// Valence less 4; 0 on the boundary.
int IrregularityOf(const QuadMesh& quads, int vertex)
{
  return quads.IsOnBoundary[vertex] ? 0 : quads.Valences[vertex] - 4;
}

}

void QuadsToPolyData(const QuadMesh& quads, const SurfaceView& view, bool areCut, vtkPolyData* output)
{
  const PointsOfQuads points = areCut ? OnePerPlace(quads) : OnePerVertex(quads);
  PolyDataBuilder drawing(PolyDataBuilder::Cells::Polygons);
  std::vector<int> irregular;
  for (const int vertex : points.Vertices)
  {
    drawing.AddPoint(quads.Positions.row(vertex).transpose());
    irregular.push_back(IrregularityOf(quads, vertex));
  }
  const vtkIdType size = static_cast<vtkIdType>(quads.Quads.size());
  vtkCellData* const ofCells = output->GetCellData();
  const auto givenToCells = StartCarryingCells(view, ofCells, size);
  for (vtkIdType quad = 0; quad < size; ++quad)
  {
    drawing.AddCell(points.OfCorners[quad]);
    ofCells->CopyData(givenToCells, view.Relation().CellOf(quads.Faces[quad]), quad);
  }
  drawing.Finish(output);
  CarryPoints(quads, points.Vertices, view, output->GetPointData());
  AddToPoints<vtkIntArray>(output, "Irregular", irregular);
  AddToCells<vtkDoubleArray>(output, "ScaledJacobian", quads.ScaledJacobians);
  AddGrid(quads, points.Places, output);
  AddReport(quads.Report, output->GetFieldData());
}

void MapToPolyData(const QuadMesh& quads, const SurfaceView& view, vtkPolyData* output)
{
  const TriangleMesh& mesh = quads.Finer ? quads.Finer->Geometry.Mesh : view.Mesh();
  std::map<std::tuple<int, FixedPoint, FixedPoint>, vtkIdType> numbers; // of corners with the same coordinates
  std::vector<int> halfedges;                                           // one for each of these
  PolyDataBuilder drawing(PolyDataBuilder::Cells::Polygons);
  vtkCellData* const ofCells = output->GetCellData();
  const auto givenToCells = StartCarryingCells(view, ofCells, mesh.NumberOfFaces());
  for (int face = 0; face < mesh.NumberOfFaces(); ++face)
  {
    std::vector<vtkIdType> corners(3);
    for (int k = 0; k < 3; ++k)
    {
      const int h = 3 * face + k;
      const auto [number, isNew] = numbers.emplace(
        std::make_tuple(mesh.Tail(h), quads.Map[h][0], quads.Map[h][1]), static_cast<vtkIdType>(halfedges.size()));
      if (isNew)
      {
        halfedges.push_back(h);
        drawing.AddPoint(mesh.Position(mesh.Tail(h)));
      }
      corners[k] = number->second;
    }
    drawing.AddCell(corners);
    ofCells->CopyData(givenToCells, view.Relation().CellOf(quads.Finer ? quads.Finer->Parents[face] : face), face);
  }
  const vtkIdType size = static_cast<vtkIdType>(halfedges.size());
  const auto coordinates = NewArray(ArrayNames::TextureCoordinates, 2, size);
  vtkPointData* const ofPoints = output->GetPointData();
  CarriedPoints carried(view, ofPoints, size);
  for (vtkIdType point = 0; point < size; ++point)
  {
    const int h = halfedges[point];
    const SurfacePlace place = quads.Finer ? quads.Finer->InParent(AtTail(h)) : AtTail(h);
    carried.Set(point, place);
    for (int c = 0; c < 2; ++c)
    {
      coordinates->SetComponent(point, c, static_cast<double>(quads.Map[h][c]) / static_cast<double>(FixedOne));
    }
  }
  drawing.Finish(output);
  carried.Finish();
  ofPoints->SetTCoords(AsTextureCoordinates(coordinates));
}

void IrregularToPolyData(const QuadMesh& quads, double radius, vtkPolyData* output)
{
  PolyDataBuilder drawing(PolyDataBuilder::Cells::None);
  std::vector<int> irregular;
  std::vector<double> indices;
  for (int vertex = 0; vertex < quads.Positions.rows(); ++vertex)
  {
    if (const int irregularity = IrregularityOf(quads, vertex); irregularity != 0)
    {
      drawing.AddPoint(quads.Positions.row(vertex).transpose());
      irregular.push_back(irregularity);
      indices.push_back(-0.25 * irregularity);
    }
  }
  vtkNew<vtkPolyData> places;
  drawing.Finish(places);
  AddToPoints<vtkIntArray>(places, "Irregular", irregular);
  AddToPoints<vtkDoubleArray>(places, "Index", indices);
  SpheresToPolyData(places, radius * quads.Report.LengthOfEdges, output);
}

}
