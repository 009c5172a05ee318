#include "Adapters/Output/QuadsToPolyData.h"

#include "Adapters/Output/CarriedArrays.h"
#include "Adapters/Output/DrawingToPolyData.h"
#include "Adapters/Surface/ArrayNames.h"
#include "Adapters/Surface/ElementArrays.h"

#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkDataSet.h"
#include "vtkDataSetAttributes.h"
#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkIdList.h"
#include "vtkIntArray.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"

#include <algorithm>
#include <array>
#include <map>
#include <tuple>
#include <vector>

namespace dmg
{

namespace
{

vtkSmartPointer<vtkPoints> NewPoints(vtkIdType number)
{
  auto points = vtkSmartPointer<vtkPoints>::New();
  points->SetDataTypeToDouble();
  points->SetNumberOfPoints(number);
  return points;
}

/// An array of integers.
vtkSmartPointer<vtkIntArray> NewIntegers(const char* name, vtkIdType tuples)
{
  auto array = vtkSmartPointer<vtkIntArray>::New();
  array->SetName(name);
  array->SetNumberOfTuples(tuples);
  return array;
}

void CarryPoints(const QuadMesh& quads, const SurfaceView& view, vtkPointData* to)
{
  const vtkIdType size = quads.Positions.rows();
  CarriedPoints carried(view, to, size);
  const auto normals = NewArray("Normals", 3, size);
  for (vtkIdType vertex = 0; vertex < size; ++vertex)
  {
    const SurfacePlace& place = quads.Places[vertex];
    Vector3 normal = Vector3::Zero();
    for (int k = 0; k < 3; ++k)
    {
      const int corner = view.Mesh().Tail(3 * place.Face + k);
      normal += place.Weights[k] * view.Surface().Geometry.Vertices.Normal(corner);
    }
    carried.Set(vertex, place);
    normals->SetTuple(vertex,
      (normal.norm() > 0.0 ? normal.normalized() : view.Surface().Geometry.Faces.Normal(place.Face)).eval().data());
  }
  carried.Finish();
  if (!to->GetNormals())
  {
    to->SetNormals(normals);
  }
  else if (!to->HasArray("Normals"))
  {
    to->AddArray(normals);
  }
}

void AddReport(const QuadReport& report, vtkFieldData* fieldData)
{
  const auto add = [fieldData](const char* name, int value)
  {
    const auto array = NewIntegers(name, 1);
    array->SetValue(0, value);
    AddHidden(fieldData, array);
  };
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
  add("InvertedQuads", report.InvertedQuads);
  add("EdgesAgainstField", static_cast<int>(report.AgainstField.size()));
  add("EulerCharacteristicOfSurface", report.EulerOfSurface);
  add("EulerCharacteristic", report.EulerOfMesh);
  add("RefinedTriangles", static_cast<int>(report.RefinedFaces.size()));
  add("SplitTriangles", report.SplitFaces);
  const QuadDistances& distances = report.Distances;
  addNumbers("DistanceFromQuads", { distances.LargestFromQuads, distances.MeanFromQuads });
  addNumbers("DistanceFromSurface", { distances.LargestFromSurface, distances.MeanFromSurface });
  const Vector3& place = distances.FarthestPlace;
  addNumbers("FarthestPlace", { place[0], place[1], place[2] });
  addNumbers("AreaShares", report.AreaShares);
  addNumbers("RatioOfSizes", { report.AskedRatio, report.ReachedRatio });
}

/// Valence less 4; 0 on the boundary.
int IrregularityOf(const QuadMesh& quads, int vertex)
{
  return quads.IsOnBoundary[vertex] ? 0 : quads.Valences[vertex] - 4;
}

}

void QuadsToPolyData(const QuadMesh& quads, const SurfaceView& view, vtkPolyData* output)
{
  const auto points = NewPoints(quads.Positions.rows());
  const auto irregular = NewIntegers("Irregular", quads.Positions.rows());
  for (int vertex = 0; vertex < quads.Positions.rows(); ++vertex)
  {
    points->SetPoint(vertex, quads.Positions(vertex, 0), quads.Positions(vertex, 1), quads.Positions(vertex, 2));
    irregular->SetValue(vertex, IrregularityOf(quads, vertex));
  }
  const vtkIdType size = static_cast<vtkIdType>(quads.Quads.size());
  const auto jacobians = NewArray("ScaledJacobian", 1, size);
  vtkNew<vtkCellArray> cells;
  vtkCellData* const ofCells = output->GetCellData();
  const auto givenToCells = StartCarryingCells(view, ofCells, size);
  for (vtkIdType quad = 0; quad < size; ++quad)
  {
    const auto& corners = quads.Quads[quad];
    cells->InsertNextCell({ corners[0], corners[1], corners[2], corners[3] });
    ofCells->CopyData(givenToCells, view.Relation().CellOf(quads.Faces[quad]), quad);
    jacobians->SetValue(quad, quads.ScaledJacobians[quad]);
  }
  output->SetPoints(points);
  output->SetPolys(cells);
  CarryPoints(quads, view, output->GetPointData());
  output->GetPointData()->AddArray(irregular);
  ofCells->AddArray(jacobians);
  AddReport(quads.Report, output->GetFieldData());
}

void MapToPolyData(const QuadMesh& quads, const SurfaceView& view, vtkPolyData* output)
{
  const TriangleMesh& mesh = quads.Finer ? quads.Finer->Geometry.Mesh : view.Mesh();
  std::map<std::tuple<int, FixedPoint, FixedPoint>, vtkIdType> numbers; // of corners with the same coordinates
  std::vector<int> halfedges;                                           // one for each of these
  vtkNew<vtkCellArray> cells;
  vtkCellData* const ofCells = output->GetCellData();
  const auto givenToCells = StartCarryingCells(view, ofCells, mesh.NumberOfFaces());
  for (int face = 0; face < mesh.NumberOfFaces(); ++face)
  {
    std::array<vtkIdType, 3> corners{};
    for (int k = 0; k < 3; ++k)
    {
      const int h = 3 * face + k;
      const auto [number, isNew] = numbers.emplace(
        std::make_tuple(mesh.Tail(h), quads.Map[h][0], quads.Map[h][1]), static_cast<vtkIdType>(halfedges.size()));
      if (isNew)
      {
        halfedges.push_back(h);
      }
      corners[k] = number->second;
    }
    cells->InsertNextCell({ corners[0], corners[1], corners[2] });
    ofCells->CopyData(givenToCells, view.Relation().CellOf(quads.Finer ? quads.Finer->Parents[face] : face), face);
  }
  const vtkIdType size = static_cast<vtkIdType>(halfedges.size());
  const auto points = NewPoints(size);
  const auto coordinates = NewArray(ArrayNames::TextureCoordinates, 2, size);
  vtkPointData* const ofPoints = output->GetPointData();
  CarriedPoints carried(view, ofPoints, size);
  for (vtkIdType point = 0; point < size; ++point)
  {
    const int h = halfedges[point];
    const SurfacePlace place = quads.Finer ? quads.Finer->InParent(AtTail(h)) : AtTail(h);
    points->SetPoint(point, mesh.Position(mesh.Tail(h)).eval().data());
    carried.Set(point, place);
    for (int c = 0; c < 2; ++c)
    {
      coordinates->SetComponent(point, c, static_cast<double>(quads.Map[h][c]) / static_cast<double>(FixedOne));
    }
  }
  output->SetPoints(points);
  output->SetPolys(cells);
  carried.Finish();
  ofPoints->SetTCoords(coordinates);
}

void IrregularToPolyData(const QuadMesh& quads, double radius, vtkPolyData* output)
{
  std::vector<int> vertices;
  for (int vertex = 0; vertex < quads.Positions.rows(); ++vertex)
  {
    if (IrregularityOf(quads, vertex) != 0)
    {
      vertices.push_back(vertex);
    }
  }
  const vtkIdType size = static_cast<vtkIdType>(vertices.size());
  const auto points = NewPoints(size);
  const auto irregular = NewIntegers("Irregular", size);
  const auto indices = NewArray("Index", 1, size);
  for (vtkIdType k = 0; k < size; ++k)
  {
    points->SetPoint(k, Vector3(quads.Positions.row(vertices[k]).transpose()).data());
    irregular->SetValue(k, IrregularityOf(quads, vertices[k]));
    indices->SetValue(k, -0.25 * irregular->GetValue(k));
  }
  vtkNew<vtkPolyData> places;
  places->SetPoints(points);
  places->GetPointData()->AddArray(irregular);
  places->GetPointData()->AddArray(indices);
  SpheresToPolyData(places, radius * quads.Report.LengthOfEdges, output);
}

}
