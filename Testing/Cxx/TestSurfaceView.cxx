#include "TestTools.h"

#include "Adapters/Surface/PolygonsFromDataSet.h"
#include "Adapters/View/FlatMap.h"
#include "Adapters/View/GlobeLayout.h"
#include "Adapters/View/HiddenGaps.h"
#include "Adapters/View/SurfaceView.h"
#include "Support/Types.h"

#include "vtkImageData.h"
#include "vtkStructuredGrid.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

namespace
{

using dmg::Vector3;

constexpr double NotANumber = std::numeric_limits<double>::quiet_NaN();
constexpr double Degree = dmg::Pi / 180.0;

/// A map with points every so many degrees.
vtkSmartPointer<vtkImageData> Map(double west, double south, int columns, int rows, double step)
{
  auto map = vtkSmartPointer<vtkImageData>::New();
  map->SetOrigin(west, south, 0.0);
  map->SetSpacing(step, step, 1.0);
  map->SetDimensions(columns, rows, 1);
  return map;
}

/// The same on the unit sphere.
vtkSmartPointer<vtkStructuredGrid> Globe(double west, double south, int columns, int rows, double step)
{
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  for (int point = 0; point < columns * rows; ++point)
  {
    const double longitude = Degree * (west + step * (point % columns));
    const double latitude = Degree * (south + step * (point / columns));
    points->InsertNextPoint(
      std::cos(latitude) * std::cos(longitude), std::cos(latitude) * std::sin(longitude), std::sin(latitude));
  }
  auto globe = vtkSmartPointer<vtkStructuredGrid>::New();
  globe->SetDimensions(columns, rows, 1);
  globe->SetPoints(points);
  return globe;
}

/// Adds an array of which a function gives the number of a tuple and a component.
template <class Number>
void AddArray(vtkFieldData* data, const char* name, int components, vtkIdType tuples, const Number& number)
{
  vtkNew<vtkDoubleArray> array;
  array->SetName(name);
  array->SetNumberOfComponents(components);
  array->SetNumberOfTuples(tuples);
  for (vtkIdType value = 0; value < components * tuples; ++value)
  {
    array->SetValue(value, number(value / components, static_cast<int>(value % components)));
  }
  data->AddArray(array);
}

dmg::VectorArrays ArraysOf(vtkDataSet* dataset, const char* name)
{
  const dmg::ChosenArray choice{ name, -1, vtkDataObject::FIELD_ASSOCIATION_POINTS_THEN_CELLS };
  return dmg::VectorArrays({ choice }, dataset, "flow", "the surface");
}

/// The number of each vertex of a view: that of its point.
std::vector<double> NumbersOfPoints(const dmg::SurfaceView& view)
{
  std::vector<double> numbers;
  for (int vertex = 0; vertex < view.Mesh().NumberOfVertices(); ++vertex)
  {
    numbers.push_back(view.Relation().PointOf(vertex));
  }
  return numbers;
}

TEST(SurfaceView, PutsAMapOnTheUnitSphereWithItsVectorsEastwardNorthwardAndUpward)
{
  const auto map = Map(-30.0, 20.0, 5, 4, 10.0);
  const double given[] = { 2.0, -3.0, 0.5 };
  AddArray(map->GetPointData(), "wind", 3, 20, [&](vtkIdType, int k) { return given[k]; });
  dmg::SurfaceView view(map);
  view.TakeIf<dmg::FlatMap>(true);
  view.Prepare({}, dmg::SerialContext());
  const dmg::VectorsOnSurface wind = view.Vectors(ArraysOf(map, "wind"));
  ASSERT_TRUE(wind.AreAtVertices);
  for (int vertex = 0; vertex < view.Mesh().NumberOfVertices(); ++vertex)
  {
    double at[3];
    map->GetPoint(view.Relation().PointOf(vertex), at);
    const double c = std::cos(Degree * at[0]), s = std::sin(Degree * at[0]);
    const double cosine = std::cos(Degree * at[1]), sine = std::sin(Degree * at[1]);
    const Vector3 up(cosine * c, cosine * s, sine), east(-s, c, 0.0), north(-sine * c, -sine * s, cosine);
    EXPECT_LT((view.Mesh().Position(vertex) - up).norm(), 1e-14);
    EXPECT_LT((wind.Values.row(vertex).transpose() - (2.0 * east - 3.0 * north + 0.5 * up)).norm(), 1e-14);
  }
}

TEST(SurfaceView, VectorsOfAMapComeBackAsTheyWent)
{
  const auto map = Map(-30.0, 20.0, 5, 4, 10.0);
  AddArray(map->GetPointData(), "wind", 3, 20, [](vtkIdType point, int k) { return std::sin(7.0 * point + k); });
  dmg::SurfaceView view(map);
  view.TakeIf<dmg::FlatMap>(true);
  view.Prepare({}, dmg::SerialContext());
  vtkNew<vtkImageData> output;
  view.StartOutput(output);
  view.OfPoints(dmg::SerialContext()).AddVectors("back", view.Vectors(ArraysOf(map, "wind")).Values.data());
  view.OfPoints(dmg::SerialContext()).Add("numbers", 1, NumbersOfPoints(view).data());
  for (vtkIdType point = 0; point < 20; ++point)
  {
    for (int k = 0; k < 3; ++k)
    {
      EXPECT_NEAR(output->GetPointData()->GetArray("back")->GetComponent(point, k), std::sin(7.0 * point + k), 1e-14);
    }
    EXPECT_EQ(output->GetPointData()->GetArray("numbers")->GetComponent(point, 0), point);
  }
}

TEST(SurfaceView, CutsLinesAtTheSidesOfAMap)
{
  const auto map = Map(0.0, -20.0, 37, 5, 10.0);
  dmg::SurfaceView view(map);
  view.TakeIf<dmg::FlatMap>(true);
  view.Prepare({}, dmg::SerialContext());
  vtkNew<vtkPolyData> lines;
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  vtkNew<vtkCellArray> cells;
  const double longitudes[] = { 340.0, 350.0, 10.0, 20.0 };
  cells->InsertNextCell(4);
  for (const double longitude : longitudes)
  {
    cells->InsertCellPoint(points->InsertNextPoint(std::cos(Degree * longitude), std::sin(Degree * longitude), 0.0));
  }
  lines->SetPoints(points);
  lines->SetLines(cells);
  AddArray(lines->GetCellData(), "line", 1, 1, [](vtkIdType, int) { return 5.0; });
  view.LinesBack(lines);
  ASSERT_EQ(lines->GetNumberOfCells(), 2);
  for (vtkIdType point = 0; point < 4; ++point)
  {
    EXPECT_NEAR(lines->GetPoint(point)[0], longitudes[point], 1e-12);
    EXPECT_NEAR(lines->GetPoint(point)[1], 0.0, 1e-12);
    EXPECT_EQ(lines->GetCellData()->GetArray("line")->GetComponent(point / 2, 0), 5.0);
  }
}

TEST(SurfaceView, NumbersAreMissingWhereTheDataWere)
{
  // Point 0 has no flow, so cell 0 has none, and no other cell has that point.
  const auto map = Map(0.0, 0.0, 4, 3, 1.0);
  AddArray(map->GetPointData(), "flow", 3, 12, [](vtkIdType point, int) { return point == 0 ? NotANumber : 1.0; });
  dmg::SurfaceView view(map);
  view.TakeIf<dmg::HiddenGaps>(true, ArraysOf(map, "flow"), "flow");
  view.Prepare({}, dmg::SerialContext());
  EXPECT_EQ(view.Mesh().NumberOfFaces(), 10);
  vtkNew<vtkImageData> output;
  view.StartOutput(output);
  view.OfPoints(dmg::SerialContext()).Add("numbers", 1, NumbersOfPoints(view).data());
  const std::vector<double> ones(view.Mesh().NumberOfFaces(), 1.0);
  view.OfCells(dmg::SerialContext()).Add("ones", 1, ones.data());
  for (vtkIdType point = 0; point < 12; ++point)
  {
    const double number = output->GetPointData()->GetArray("numbers")->GetComponent(point, 0);
    EXPECT_TRUE(point == 0 ? std::isnan(number) : number == static_cast<double>(point)) << point;
  }
  for (vtkIdType cell = 0; cell < 6; ++cell)
  {
    const double one = output->GetCellData()->GetArray("ones")->GetComponent(cell, 0);
    EXPECT_TRUE(cell == 0 ? std::isnan(one) : one == 1.0) << cell;
  }
  EXPECT_EQ(output->GetFieldData()->GetArray("CellsWithoutFlow")->GetComponent(0, 0), 1.0);
}

TEST(SurfaceView, CountsColumnsThatAreThereTwiceOnceAndGivesBothTheSameNumbers)
{
  // Cells from -5 to 365 degrees: those around 0 and around 360 lie upon each other.
  const int columns = 38, rows = 18;
  const auto globe = Globe(-5.0, -85.0, columns, rows, 10.0);
  dmg::SurfaceView view(globe);
  view.TakeIf<dmg::GlobeLayout>(true, Vector3::UnitZ());
  view.Prepare({}, dmg::SerialContext());
  EXPECT_EQ(view.Mesh().NumberOfVertices(), (columns - 2) * rows);
  EXPECT_EQ(view.Mesh().NumberOfFaces(), 2 * (columns - 2) * (rows - 1));
  vtkNew<vtkStructuredGrid> output;
  view.StartOutput(output);
  view.OfPoints(dmg::SerialContext()).Add("numbers", 1, NumbersOfPoints(view).data());
  vtkDataArray* const numbers = output->GetPointData()->GetArray("numbers");
  for (vtkIdType row = 0; row < rows; ++row)
  {
    for (const vtkIdType column : { 0, 1 })
    {
      const vtkIdType first = columns * row + column;
      EXPECT_EQ(numbers->GetComponent(first, 0), first);
      EXPECT_EQ(numbers->GetComponent(first + columns - 2, 0), first);
    }
  }
}

TEST(SurfaceView, GivesTwinsBesideAGapTheSameNumbersToo)
{
  // The same columns, and land on the first and the last cell of row 8, which are the same place: beside it is the sea of both sides.
  const int columns = 38, rows = 18;
  const auto globe = Globe(-5.0, -85.0, columns, rows, 10.0);
  const vtkIdType land = 8 * (columns - 1);
  AddArray(globe->GetCellData(), "flow", 3, globe->GetNumberOfCells(),
    [=](vtkIdType cell, int) { return cell == land || cell == land + columns - 2 ? NotANumber : 1.0; });
  dmg::SurfaceView view(globe);
  view.TakeIf<dmg::GlobeLayout>(true, Vector3::UnitZ());
  view.TakeIf<dmg::HiddenGaps>(true, ArraysOf(globe, "flow"), "flow");
  view.Prepare({}, dmg::SerialContext());
  vtkNew<vtkStructuredGrid> output;
  view.StartOutput(output);
  view.OfPoints(dmg::SerialContext()).Add("numbers", 1, NumbersOfPoints(view).data());
  const std::vector<double> ones(view.Mesh().NumberOfFaces(), 1.0);
  view.OfCells(dmg::SerialContext()).Add("ones", 1, ones.data());
  vtkDataArray* const numbers = output->GetPointData()->GetArray("numbers");
  for (vtkIdType row = 0; row < rows; ++row)
  {
    for (const vtkIdType column : { 0, 1 })
    {
      const vtkIdType first = columns * row + column;
      EXPECT_EQ(numbers->GetComponent(first, 0), first);
      EXPECT_EQ(numbers->GetComponent(first + columns - 2, 0), first) << row << " " << column;
    }
  }
  vtkDataArray* const isSea = output->GetCellData()->GetArray("ones");
  EXPECT_TRUE(std::isnan(isSea->GetComponent(land, 0)) && std::isnan(isSea->GetComponent(land + columns - 2, 0)));
}

TEST(SurfaceView, WithoutStepsAndRepairHandsNumbersOn)
{
  const auto globe = Globe(0.0, -20.0, 4, 4, 10.0);
  dmg::SurfaceView view(globe);
  EXPECT_EQ(view.Data(), globe.Get());
  view.Prepare({}, dmg::SerialContext());
  EXPECT_FALSE(view.Repair().IsChanged());
  EXPECT_TRUE(view.Warnings().empty());
  vtkNew<vtkStructuredGrid> output;
  view.StartOutput(output);
  view.OfPoints(dmg::SerialContext()).Add("numbers", 1, NumbersOfPoints(view).data());
  for (vtkIdType point = 0; point < 16; ++point)
  {
    EXPECT_EQ(output->GetPointData()->GetArray("numbers")->GetComponent(point, 0), point);
  }
}

}
