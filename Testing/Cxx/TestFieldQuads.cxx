#include "vtkFieldQuads.h"

#include "TestTools.h"

#include "Quads/QuadOptions.h"

#include "vtkCellData.h"
#include "vtkDataObject.h"
#include "vtkFieldData.h"
#include "vtkHarmonicFieldSolver.h"
#include "vtkIntArray.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace
{

using namespace dmg::test;
using dmg::Vector3;

int ReportOf(vtkPolyData* quads, const char* name)
{
  auto* const array = vtkIntArray::SafeDownCast(quads->GetFieldData()->GetAbstractArray(name));
  return array ? array->GetValue(0) : -1000;
}

/// Vertices less edges plus quads, of quads alone.
int EulerOf(vtkPolyData* quads)
{
  std::set<std::pair<vtkIdType, vtkIdType>> edges;
  std::set<vtkIdType> used;
  for (vtkIdType cell = 0; cell < quads->GetNumberOfCells(); ++cell)
  {
    EXPECT_EQ(quads->GetCellType(cell), VTK_QUAD);
    vtkNew<vtkIdList> points;
    quads->GetCellPoints(cell, points);
    for (int k = 0; k < 4; ++k)
    {
      edges.insert(std::minmax(points->GetId(k), points->GetId((k + 1) % 4)));
      used.insert(points->GetId(k));
    }
  }
  EXPECT_EQ(static_cast<vtkIdType>(used.size()), quads->GetNumberOfPoints());
  return static_cast<int>(used.size()) - static_cast<int>(edges.size()) + static_cast<int>(quads->GetNumberOfCells());
}

/// A square of 12 by 12, with the sum of both coordinates at its points and the number of cells on them.
vtkSmartPointer<vtkPolyData> SquareWithArrays()
{
  const auto square = PolyDataOf(PlaneGrid(12, 12));
  const auto sums = Zeros("Sum", square->GetNumberOfPoints(), 1);
  for (vtkIdType point = 0; point < square->GetNumberOfPoints(); ++point)
  {
    sums->SetValue(point, square->GetPoint(point)[0] + square->GetPoint(point)[1]);
  }
  square->GetPointData()->AddArray(sums);
  const auto halves = Zeros("Half", square->GetNumberOfCells(), 1);
  for (vtkIdType cell = 0; cell < square->GetNumberOfCells(); ++cell)
  {
    double bounds[6];
    square->GetCellBounds(cell, bounds);
    halves->SetValue(cell, bounds[0] < 5.5 ? 1.0 : 2.0);
  }
  square->GetCellData()->AddArray(halves);
  return square;
}

}

TEST(FieldQuads, DefaultsAreThoseOfTheCore)
{
  vtkNew<vtkFieldQuads> filter;
  const dmg::QuadOptions expected;
  EXPECT_EQ(filter->GetNumberOfQuads(), expected.NumberOfQuads);
  EXPECT_EQ(filter->GetEdgeLength(), expected.EdgeLength);
  EXPECT_EQ(filter->GetAlignBoundary(), expected.AlignBoundary);
  EXPECT_EQ(filter->GetAlignSharpEdges(), expected.AlignSharpEdges);
  EXPECT_EQ(filter->GetFeatureAngle(), expected.FeatureAngle);
  EXPECT_EQ(filter->GetSmoothingSteps(), expected.SmoothingSteps);
}

TEST(FieldQuads, OfBareSquareAreGridWithItsArrays)
{
  const auto square = SquareWithArrays();
  vtkNew<vtkFieldQuads> filter;
  filter->SetInputData(square);
  filter->SetNumberOfQuads(100);
  Messages messages(filter);
  filter->Update();
  EXPECT_TRUE(messages.Silent());
  vtkPolyData* const quads = filter->GetOutput();
  EXPECT_EQ(quads->GetNumberOfCells(), 100);
  EXPECT_EQ(quads->GetNumberOfPoints(), 121);
  EXPECT_EQ(EulerOf(quads), 1);
  EXPECT_EQ(ReportOf(quads, "EulerCharacteristic"), 1);
  EXPECT_EQ(ReportOf(quads, "EulerCharacteristicOfSurface"), 1);
  EXPECT_EQ(ReportOf(quads, "IrregularVertices"), 0);
  EXPECT_EQ(ReportOf(quads, "InvertedQuads"), 0);
  EXPECT_EQ(quads->GetPointData()->GetNormals(), nullptr);
  EXPECT_STREQ(filter->GetSummary(), "100 quads, 0 irregular vertices, 0 inverted");
  for (vtkIdType point = 0; point < quads->GetNumberOfPoints(); ++point)
  {
    const double* const place = quads->GetPoint(point);
    EXPECT_NEAR(quads->GetPointData()->GetArray("Sum")->GetComponent(point, 0), place[0] + place[1], 1e-9);
    EXPECT_EQ(quads->GetPointData()->GetArray("Irregular")->GetComponent(point, 0), 0.0);
  }
  for (vtkIdType cell = 0; cell < quads->GetNumberOfCells(); ++cell)
  {
    double bounds[6];
    quads->GetCellBounds(cell, bounds);
    const double expected = bounds[1] < 5.5 ? 1.0 : bounds[0] > 6.5 ? 2.0 : 0.0;
    const double half = quads->GetCellData()->GetArray("Half")->GetComponent(cell, 0);
    EXPECT_TRUE(expected == 0.0 || half == expected);
    EXPECT_GT(quads->GetCellData()->GetArray("ScaledJacobian")->GetComponent(cell, 0), 0.999);
  }
}

TEST(FieldQuads, HaveMapWithIntegersAtTheirPoints)
{
  vtkNew<vtkFieldQuads> filter;
  filter->SetInputData(SquareWithArrays());
  filter->SetNumberOfQuads(36);
  filter->Update();
  auto* const map = vtkPolyData::SafeDownCast(filter->GetOutputDataObject(1));
  ASSERT_TRUE(map->GetPointData()->GetTCoords());
  EXPECT_STREQ(map->GetPointData()->GetTCoords()->GetName(), "TextureCoordinates");
  EXPECT_EQ(map->GetNumberOfCells(), 288);
  EXPECT_TRUE(map->GetPointData()->HasArray("Sum"));
  for (vtkIdType cell = 0; cell < map->GetNumberOfCells(); ++cell)
  {
    vtkNew<vtkIdList> points;
    map->GetCellPoints(cell, points);
    double area = 0.0; // of the triangle in the map: half of a quad
    for (int k = 0; k < 3; ++k)
    {
      const auto u = [&](int corner, int c)
      { return map->GetPointData()->GetTCoords()->GetComponent(points->GetId(corner % 3), c); };
      area += 0.5 * (u(k, 0) * u(k + 1, 1) - u(k, 1) * u(k + 1, 0));
    }
    EXPECT_NEAR(area, 0.125, 1e-3); // quads have sides of 2, triangles of 1
  }
}

TEST(FieldQuads, HaveMapOfTheSurfaceWithItsArraysWhereLongEdgesWereHalved)
{
  vtkNew<vtkFieldQuads> filter;
  filter->SetInputData(SquareWithArrays());
  filter->SetNumberOfQuads(900);
  filter->Update();
  auto* const map = vtkPolyData::SafeDownCast(filter->GetOutputDataObject(1));
  EXPECT_GT(map->GetNumberOfCells(), 900); // no edge is longer than those of quads
  auto* const sums = map->GetPointData()->GetArray("Sum");
  ASSERT_TRUE(sums);
  for (vtkIdType point = 0; point < map->GetNumberOfPoints(); ++point)
  {
    EXPECT_NEAR(sums->GetComponent(point, 0), map->GetPoint(point)[0] + map->GetPoint(point)[1], 1e-9);
  }
  for (vtkIdType cell = 0; cell < map->GetNumberOfCells(); ++cell)
  {
    double bounds[6];
    map->GetCellBounds(cell, bounds);
    EXPECT_EQ(map->GetCellData()->GetArray("Half")->GetComponent(cell, 0), bounds[0] + bounds[1] < 12.0 ? 1.0 : 2.0);
  }
}

TEST(FieldQuads, FollowFieldOfTheSolver)
{
  const auto square = SquareWithArrays();
  const double angle = 0.5; // to the sides
  vtkNew<vtkHarmonicFieldSolver> solver;
  AddCellVectors(square, "Wish", { { 0, Vector3(std::cos(angle), std::sin(angle), 0.0) } });
  solver->SetInputData(square);
  solver->SetNumberOfDirections(4);
  solver->SetInputArrayToProcess(1, 0, 0, vtkDataObject::FIELD_ASSOCIATION_CELLS, "Wish");
  vtkNew<vtkFieldQuads> filter;
  filter->SetInputConnection(solver->GetOutputPort());
  filter->SetNumberOfQuads(400);
  filter->AlignBoundaryOff();
  Messages messages(filter);
  filter->Update();
  EXPECT_EQ(messages.Error(), "");
  vtkPolyData* const quads = filter->GetOutput();
  EXPECT_EQ(EulerOf(quads), 1);
  int inside = 0, along = 0;
  for (vtkIdType cell = 0; cell < quads->GetNumberOfCells(); ++cell)
  {
    vtkNew<vtkIdList> points;
    quads->GetCellPoints(cell, points);
    const Vector3 a(quads->GetPoint(points->GetId(0))), b(quads->GetPoint(points->GetId(1)));
    const Vector3 middle = 0.5 * (a + b) - Vector3(6.0, 6.0, 0.0);
    if (middle.norm() < 4.0)
    {
      ++inside;
      const double deviation = std::remainder(std::atan2((b - a)[1], (b - a)[0]) - angle, dmg::Pi / 2.0);
      along += std::abs(deviation) < 0.1 ? 1 : 0;
    }
  }
  EXPECT_GT(inside, 50);
  EXPECT_EQ(along, inside);
}

TEST(FieldQuads, HaveBallAtEachIrregularVertex)
{
  vtkNew<vtkFieldQuads> filter;
  filter->SetInputData(PolyDataOf(Icosphere(3)));
  filter->SetNumberOfQuads(400);
  filter->Update();
  EXPECT_EQ(EulerOf(filter->GetOutput()), 2);
  int sum = 0, irregular = 0;
  auto* const points = filter->GetOutput()->GetPointData()->GetArray("Irregular");
  for (vtkIdType point = 0; point < points->GetNumberOfTuples(); ++point)
  {
    sum += static_cast<int>(points->GetComponent(point, 0));
    irregular += points->GetComponent(point, 0) != 0.0 ? 1 : 0;
  }
  EXPECT_EQ(sum, -8); // 4 times the Euler characteristic, less
  EXPECT_EQ(ReportOf(filter->GetOutput(), "IrregularVertices"), irregular);
  auto* const balls = vtkPolyData::SafeDownCast(filter->GetOutputDataObject(2));
  EXPECT_GT(balls->GetNumberOfCells(), 0);
  EXPECT_EQ(balls->GetNumberOfCells() % irregular, 0);
}

TEST(FieldQuads, AreSymmetricAboutAPlane)
{
  vtkNew<vtkFieldQuads> filter;
  filter->SetInputData(PolyDataOf(IrregularSphere(3, 5)));
  filter->SetNumberOfQuads(300);
  filter->SetSymmetry(vtkFieldQuads::Plane);
  filter->SetSymmetryOrigin(0.1, 0.2, 0.0);
  filter->SetSymmetryNormal(0.0, 0.0, 2.0);
  filter->Update();
  vtkPolyData* const output = filter->GetOutput();
  const std::vector<double> plane = Values(output->GetFieldData(), "SymmetryPlane");
  EXPECT_EQ(plane, (std::vector<double>{ 0.1, 0.2, 0.0, 0.0, 0.0, 1.0 }));
  std::multiset<std::array<double, 3>> places, images;
  for (vtkIdType point = 0; point < output->GetNumberOfPoints(); ++point)
  {
    const double* const x = output->GetPoint(point);
    places.insert({ x[0], x[1], x[2] });
    images.insert({ x[0], x[1], -x[2] });
  }
  EXPECT_GT(output->GetNumberOfCells(), 200);
  EXPECT_EQ(places, images);
}

TEST(FieldQuads, TellHowFarASurfaceIsFromSymmetric)
{
  vtkNew<vtkFieldQuads> filter;
  filter->SetInputData(PolyDataOf(IrregularSphere(3, 5)));
  filter->SetNumberOfQuads(300);
  filter->SetSymmetry(vtkFieldQuads::Plane);
  filter->SetSymmetryOrigin(0.5, 0.0, 0.0);
  const Messages messages(filter);
  filter->Update();
  ASSERT_EQ(messages.GetWarnings().size(), 1U); // 1 of the diagonal of 2 sqrt 3
  EXPECT_NE(messages.GetWarnings()[0].find("quads are not symmetric, as the surface is off its mirror image by 2"),
    std::string::npos);
  EXPECT_EQ(filter->GetOutput()->GetFieldData()->GetArray("SymmetryPlane"), nullptr);
  EXPECT_GT(filter->GetOutput()->GetNumberOfCells(), 200);
  filter->SetSymmetryNormal(0.0, 0.0, 0.0);
  filter->Update();
  EXPECT_NE(messages.Error().find("Symmetry Normal has no direction"), std::string::npos);
  EXPECT_EQ(filter->GetOutput()->GetNumberOfCells(), 0);
}

TEST(FieldQuads, HaveTextureCoordinatesOfTheGridWhereTheyAreCut)
{
  const auto sphere = PolyDataOf(IrregularSphere(3, 5));
  vtkNew<vtkFieldQuads> filter;
  filter->SetInputData(sphere);
  filter->SetNumberOfQuads(300);
  filter->Update();
  const vtkIdType vertices = filter->GetOutput()->GetNumberOfPoints();
  EXPECT_EQ(filter->GetOutput()->GetPointData()->GetTCoords(), nullptr);
  filter->CutForTexturesOn();
  filter->Update();
  vtkPolyData* const quads = filter->GetOutput();
  EXPECT_GT(quads->GetNumberOfPoints(), vertices);
  EXPECT_LT(quads->GetNumberOfPoints(), 1.5 * static_cast<double>(vertices));
  auto* const coordinates = quads->GetPointData()->GetTCoords();
  ASSERT_TRUE(coordinates);
  EXPECT_STREQ(coordinates->GetName(), "GridCoordinates");
  auto* const corners = quads->GetCellData()->GetArray("CornersOnGrid");
  for (vtkIdType cell = 0; cell < quads->GetNumberOfCells(); ++cell)
  {
    vtkNew<vtkIdList> points;
    quads->GetCellPoints(cell, points);
    double area = 0.0; // of the quad as a texture is laid on it
    for (int k = 0; k < 4; ++k)
    {
      const auto u = [&](int corner, int c) { return coordinates->GetComponent(points->GetId(corner % 4), c); };
      area += 0.5 * (u(k, 0) * u(k + 1, 1) - u(k, 1) * u(k + 1, 0));
      EXPECT_EQ(u(k, 0), corners->GetComponent(cell, 2 * k));
      EXPECT_EQ(u(k, 1), corners->GetComponent(cell, 2 * k + 1));
    }
    EXPECT_EQ(area, 1.0);
  }
  const auto own = Zeros("Own", sphere->GetNumberOfPoints(), 2);
  sphere->GetPointData()->SetTCoords(own);
  sphere->Modified();
  filter->Update();
  EXPECT_STREQ(filter->GetOutput()->GetPointData()->GetTCoords()->GetName(), "Own");
  EXPECT_TRUE(filter->GetOutput()->GetPointData()->HasArray("GridCoordinates"));
}

TEST(FieldQuads, TakeSizesFromArray)
{
  const auto square = SquareWithArrays();
  vtkNew<vtkFieldQuads> filter;
  filter->SetInputData(square);
  filter->SetNumberOfQuads(1000);
  filter->SetInputArrayToProcess(1, 0, 0, vtkDataObject::FIELD_ASSOCIATION_CELLS, "Half");
  filter->Update();
  int left = 0, right = 0;
  for (vtkIdType point = 0; point < filter->GetOutput()->GetNumberOfPoints(); ++point)
  {
    const double x = filter->GetOutput()->GetPoint(point)[0];
    left += x < 5.0 ? 1 : 0;
    right += x > 7.0 ? 1 : 0;
  }
  EXPECT_GT(left, 1.3 * right);
  filter->SetInputArrayToProcess(1, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "Missing");
  Messages messages(filter);
  filter->Update();
  EXPECT_NE(messages.Error().find("Missing"), std::string::npos);
  EXPECT_EQ(filter->GetOutput()->GetNumberOfCells(), 0);
}

TEST(FieldQuads, AreSmallerWhereTheSurfaceBends)
{
  Surface shape = IrregularSphere(4, 5);
  shape.V.col(2) *= 3.0;
  vtkNew<vtkFieldQuads> filter;
  filter->SetInputData(PolyDataOf(shape));
  filter->SetNumberOfQuads(800);
  const auto atTips = [&filter]
  {
    filter->Update();
    int count = 0;
    for (vtkIdType point = 0; point < filter->GetOutput()->GetNumberOfPoints(); ++point)
    {
      count += std::abs(filter->GetOutput()->GetPoint(point)[2]) > 2.7 ? 1 : 0;
    }
    return count;
  };
  const int even = atTips();
  EXPECT_EQ(Values(filter->GetOutput()->GetFieldData(), "RatioOfSizes"), (std::vector<double>{ 1.0, 1.0 }));
  filter->SetAdaptivity(1.0);
  EXPECT_GT(atTips(), 1.4 * even);
  const std::vector<double> ratios = Values(filter->GetOutput()->GetFieldData(), "RatioOfSizes");
  EXPECT_GT(ratios[0], 1.5);
  EXPECT_GT(ratios[1], 1.3);
  filter->SetAdaptivity(2.0);
  const Messages messages(filter);
  filter->Update();
  EXPECT_NE(messages.Error().find("Adaptivity"), std::string::npos);
}

TEST(FieldQuads, RefuseRegionsOfPoints)
{
  const auto square = SquareWithArrays();
  vtkNew<vtkFieldQuads> filter;
  filter->SetInputData(square);
  filter->SetInputArrayToProcess(2, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "Sum");
  const Messages messages(filter);
  filter->Update();
  EXPECT_NE(messages.Error().find("choose one of cells"), std::string::npos);
}

TEST(FieldQuads, HaveEdgesAlongBordersOfRegions)
{
  const auto square = SquareWithArrays();
  const auto material = Zeros("Material", square->GetNumberOfCells(), 1);
  for (vtkIdType cell = 0; cell < square->GetNumberOfCells(); ++cell)
  {
    double bounds[6];
    square->GetCellBounds(cell, bounds);
    material->SetValue(cell, bounds[0] > 4.5 ? 7.5 : std::nan(""));
  }
  square->GetCellData()->AddArray(material);
  vtkNew<vtkFieldQuads> filter;
  filter->SetInputData(square);
  filter->SetNumberOfQuads(100);
  filter->SetInputArrayToProcess(2, 0, 0, vtkDataObject::FIELD_ASSOCIATION_CELLS, "Material");
  filter->Update();
  vtkPolyData* const quads = filter->GetOutput();
  EXPECT_NEAR(static_cast<double>(quads->GetNumberOfCells()), 100.0, 15.0);
  for (vtkIdType cell = 0; cell < quads->GetNumberOfCells(); ++cell)
  {
    double bounds[6];
    quads->GetCellBounds(cell, bounds);
    const bool isRight = quads->GetCellData()->GetArray("Material")->GetComponent(cell, 0) == 7.5;
    EXPECT_TRUE(isRight ? bounds[0] > 5.0 - 1e-6 : bounds[1] < 5.0 + 1e-6) << bounds[0] << " to " << bounds[1];
  }
}

// Data of a user: cells where nothing was measured, and an array of another dataset.
TEST(FieldQuads, HandArraysOnThatAreNotFiniteAndLeaveOutShortOnes)
{
  const auto square = SquareWithArrays();
  for (vtkDataSetAttributes* const attributes : { static_cast<vtkDataSetAttributes*>(square->GetPointData()),
         static_cast<vtkDataSetAttributes*>(square->GetCellData()) })
  {
    const auto measured = Zeros("Measured", square->GetNumberOfCells(), 1);
    measured->SetValue(7, std::nan(""));
    measured->SetValue(8, HUGE_VAL);
    attributes->AddArray(measured);
    attributes->AddArray(Zeros("Short", 3, 1));
  }
  vtkNew<vtkFieldQuads> filter;
  filter->SetInputData(square);
  Messages messages(filter);
  filter->Update();
  EXPECT_TRUE(messages.Silent()) << messages.Error();
  EXPECT_GT(filter->GetOutput()->GetNumberOfCells(), 0);
  for (const int port : { 0, 1 })
  {
    auto* const output = vtkPolyData::SafeDownCast(filter->GetOutputDataObject(port));
    EXPECT_TRUE(output->GetPointData()->HasArray("Measured") && output->GetCellData()->HasArray("Measured"));
    EXPECT_FALSE(output->GetPointData()->HasArray("Short") || output->GetCellData()->HasArray("Short"));
  }
}

TEST(FieldQuads, RefuseFieldOfSixDirections)
{
  vtkNew<vtkHarmonicFieldSolver> solver;
  solver->SetInputData(PolyDataOf(Icosphere(2)));
  solver->SetNumberOfDirections(6);
  vtkNew<vtkFieldQuads> filter;
  filter->SetInputConnection(solver->GetOutputPort());
  Messages messages(filter);
  filter->Update();
  EXPECT_NE(messages.Error().find("6 directions"), std::string::npos);
  EXPECT_EQ(filter->GetOutput()->GetNumberOfPoints(), 0);
}
