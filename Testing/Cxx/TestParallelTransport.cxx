#include "vtkParallelTransport.h"

#include "TestTools.h"

#include "Geodesics/ParallelTransport.h"

#include "vtkMultiBlockDataSet.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkUnstructuredGrid.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

namespace
{

using namespace dmg::test;
using dmg::Vector3;

constexpr int OnPoints = vtkDataObject::FIELD_ASSOCIATION_POINTS;
constexpr int OnCells = vtkDataObject::FIELD_ASSOCIATION_CELLS;

vtkDataSet* OutputOf(vtkParallelTransport* filter)
{
  return vtkDataSet::SafeDownCast(filter->GetOutputDataObject(0));
}

void ExpectEverywhere(vtkDataSet* output, const Vector3& vector)
{
  for (vtkIdType point = 0; point < output->GetNumberOfPoints(); ++point)
  {
    EXPECT_LE((Tuple(output->GetPointData(), "TransportedVectors", point) - vector).norm(), 1e-8) << point;
  }
  for (vtkIdType cell = 0; cell < output->GetNumberOfCells(); ++cell)
  {
    EXPECT_LE((Tuple(output->GetCellData(), "TransportedVectors", cell) - vector).norm(), 1e-8) << cell;
  }
}

}

TEST(ParallelTransportFilter, WithNothingSaidMapsTheMiddleOfAPlane)
{
  const auto plane = PolyDataOf(PlaneGrid(10, 8));
  vtkNew<vtkParallelTransport> filter;
  filter->SetInputData(plane);
  Messages messages(filter);
  filter->Update();
  EXPECT_TRUE(messages.Silent());
  vtkDataSet* const output = OutputOf(filter);
  ExpectEverywhere(output, Vector3::UnitX());
  EXPECT_STREQ(output->GetPointData()->GetTCoords()->GetName(), "TextureCoordinates");
  EXPECT_STREQ(output->GetPointData()->GetScalars()->GetName(), "GeodesicDistance");
  EXPECT_STREQ(output->GetPointData()->GetVectors()->GetName(), "TransportedVectors");
  const auto start = static_cast<vtkIdType>(Values(output->GetFieldData(), "MapPoint").at(0));
  const Vector3 middle(5.0, 4.0, 0.0);
  EXPECT_EQ(Vector3(plane->GetPoint(start)), middle);
  EXPECT_EQ(Vector3(filter->GetPointOnSurface()), middle);
  const double farthest = middle.norm();
  for (vtkIdType point = 0; point < output->GetNumberOfPoints(); ++point)
  {
    const Vector3 place = Vector3(plane->GetPoint(point)) - middle;
    double map[2], texture[2];
    output->GetPointData()->GetArray("LogarithmicMap")->GetTuple(point, map);
    output->GetPointData()->GetTCoords()->GetTuple(point, texture);
    for (const int axis : { 0, 1 })
    {
      EXPECT_NEAR(map[axis], place[axis], 1e-6);
      EXPECT_NEAR(texture[axis], 0.5 + place[axis] / (2.0 * farthest), 1e-6);
    }
    EXPECT_NEAR(output->GetPointData()->GetArray("GeodesicDistance")->GetComponent(point, 0), place.norm(), 1e-6);
    const double degrees = std::atan2(place.y(), place.x()) * 180.0 / dmg::Pi;
    EXPECT_NEAR(output->GetPointData()->GetArray("GeodesicAngle")->GetComponent(point, 0), degrees, 1e-5);
  }
}

TEST(ParallelTransportFilter, ChoosesAPointInFrontOnTheLargestComponent)
{
  Surface debris = Icosphere(0);
  debris.V *= 0.01;
  const auto scan = PolyDataOf(Union(debris, Icosphere(3), Vector3(0.0, 0.0, -2.0)));
  vtkNew<vtkParallelTransport> filter;
  filter->SetInputData(scan);
  Messages messages(filter);
  filter->Update();
  EXPECT_TRUE(messages.Silent());
  vtkDataSet* const output = OutputOf(filter);
  EXPECT_EQ(Values(output->GetFieldData(), "PointsWithoutMap"), std::vector<double>{ 12.0 });
  const auto start = static_cast<vtkIdType>(Values(output->GetFieldData(), "MapPoint").at(0));
  const Vector3 place(scan->GetPoint(start));
  EXPECT_EQ(Vector3(filter->GetPointOnSurface()), place);
  EXPECT_LE((place - Vector3(0.0, 0.0, -1.0)).norm(), 0.1); // and a vertex is near

  const std::vector<double> distances = Values(output->GetPointData(), "GeodesicDistance");
  filter->SetPoint(place.data());
  EXPECT_TRUE(filter->GetUsePoint());
  filter->Update();
  const std::vector<double> again = Values(OutputOf(filter)->GetPointData(), "GeodesicDistance");
  EXPECT_EQ(
    std::vector<double>(again.begin() + 12, again.end()), std::vector<double>(distances.begin() + 12, distances.end()));

  filter->SetPoint(0.0, 0.0, -3.0);
  filter->Update();
  EXPECT_LE((Vector3(filter->GetPointOnSurface()) - Vector3(0.0, 0.0, -3.0)).norm(), 0.1);
  filter->UsePointOff();
  filter->Update();
  EXPECT_EQ(Vector3(filter->GetPointOnSurface()), place);
  filter->SetTimeStep(0.0); // an error
  filter->Update();
  EXPECT_TRUE(std::isnan(filter->GetPointOnSurface()[0]));
}

TEST(ParallelTransportFilter, MapsFromAnyPointAndDirection)
{
  const auto plane = PolyDataOf(IrregularPlane(10, 8, 5));
  vtkNew<vtkParallelTransport> filter;
  filter->SetInputData(plane);
  filter->SetPoint(6.1, 3.9, 2.0);
  filter->SetDirection(0.0, 3.0, 4.0); // its part along the plane counts
  filter->SetTextureSize(5.0);
  filter->Update();
  vtkDataSet* const output = OutputOf(filter);
  ExpectEverywhere(output, Vector3(0.0, 3.0, 0.0));
  const auto start = static_cast<vtkIdType>(Values(output->GetFieldData(), "MapPoint").at(0));
  const Vector3 from(plane->GetPoint(start));
  EXPECT_LE((from - Vector3(6.0, 4.0, 0.0)).norm(), 0.5);
  for (vtkIdType point = 0; point < output->GetNumberOfPoints(); ++point)
  {
    const Vector3 offset = Vector3(plane->GetPoint(point)) - from;
    double texture[2];
    output->GetPointData()->GetTCoords()->GetTuple(point, texture);
    EXPECT_NEAR(texture[0], 0.5 + offset.y() / 5.0, 1e-6);
    EXPECT_NEAR(texture[1], 0.5 - offset.x() / 5.0, 1e-6);
  }
  filter->LogarithmicMapOff();
  filter->Update();
  EXPECT_FALSE(output->GetPointData()->HasArray("LogarithmicMap"));
  EXPECT_FALSE(output->GetPointData()->HasArray("GeodesicDistance"));
  EXPECT_TRUE(output->GetPointData()->HasArray("TransportedVectors"));
}

TEST(ParallelTransportFilter, CarriesVectorsOfPointsAndCells)
{
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const bool onPoints : { true, false })
  {
    const auto plane = PolyDataOf(PlaneGrid(8, 8));
    auto* const given = onPoints ? AddPointVectors(plane, "Given", { { 40, Vector3(1.0, 2.0, 5.0) } })
                                 : AddCellVectors(plane, "Given", { { 63, Vector3(1.0, 2.0, 5.0) } });
    given->SetTuple3(3, nan, nan, nan); // nothing is given there
    vtkNew<vtkParallelTransport> filter;
    filter->SetInputData(plane);
    filter->SetInputArrayToProcess(0, 0, 0, onPoints ? OnPoints : OnCells, "Given");
    Messages messages(filter);
    filter->Update();
    EXPECT_TRUE(messages.Silent());
    ExpectEverywhere(OutputOf(filter), Vector3(1.0, 2.0, 0.0));
  }
}

TEST(ParallelTransportFilter, TakesTheNearerOfPointAndArray)
{
  const int columns = 60;
  const auto plane = PolyDataOf(PlaneGrid(columns, 4));
  AddPointVectors(plane, "Given", { { 2 * (columns + 1), Vector3(0.0, 2.0, 0.0) } }); // in the middle of the left side
  vtkNew<vtkParallelTransport> filter;
  filter->SetInputData(plane);
  filter->SetInputArrayToProcess(0, 0, 0, OnPoints, "Given");
  filter->SetPoint(columns, 2.0, 0.0);
  filter->SetDirection(5.0, 0.0, 0.0);
  filter->Update();
  ExpectEverywhere(OutputOf(filter), Vector3(0.0, 2.0, 0.0)); // Direction does not count
  filter->AddPointOn();
  filter->Update();
  for (vtkIdType point = 0; point < plane->GetNumberOfPoints(); ++point)
  {
    const double x = plane->GetPoint(point)[0];
    if (std::abs(x - 0.5 * columns) > 8.0)
    {
      const Vector3 exact = x < 0.5 * columns ? Vector3(0.0, 2.0, 0.0) : Vector3(5.0, 0.0, 0.0);
      EXPECT_LE((Tuple(OutputOf(filter)->GetPointData(), "TransportedVectors", point) - exact).norm(), 0.02 * 5.0);
    }
  }
}

TEST(ParallelTransportFilter, TakesQuadrilateralsOfAnyDataSet)
{
  vtkNew<vtkUnstructuredGrid> grid;
  vtkNew<vtkPoints> points;
  for (int j = 0; j <= 6; ++j)
  {
    for (int i = 0; i <= 6; ++i)
    {
      points->InsertNextPoint(i, j, 0.0);
    }
  }
  points->InsertNextPoint(0.0, 0.0, 9.0); // of no surface
  grid->SetPoints(points);
  for (int j = 0; j < 6; ++j)
  {
    for (int i = 0; i < 6; ++i)
    {
      const vtkIdType first = 7 * j + i;
      const vtkIdType corners[] = { first, first + 1, first + 8, first + 7 };
      grid->InsertNextCell(VTK_QUAD, 4, corners);
    }
  }
  vtkNew<vtkParallelTransport> filter;
  filter->SetInputData(grid);
  filter->SetPoint(3.0, 3.0, 0.0);
  filter->Update();
  vtkDataSet* const output = OutputOf(filter);
  ASSERT_TRUE(output->IsA("vtkUnstructuredGrid"));
  ASSERT_EQ(output->GetNumberOfPoints(), 50);
  EXPECT_NEAR(output->GetPointData()->GetArray("GeodesicDistance")->GetComponent(0, 0), std::hypot(3.0, 3.0), 1e-6);
  EXPECT_TRUE(std::isnan(output->GetPointData()->GetArray("GeodesicDistance")->GetComponent(49, 0)));
  EXPECT_LE((Tuple(output->GetCellData(), "TransportedVectors", 35) - Vector3::UnitX()).norm(), 1e-8);
}

TEST(ParallelTransportFilter, SetsUpOnceForMovedPointsAndOtherVectors)
{
  const auto sphere = PolyDataOf(Icosphere(3));
  vtkNew<vtkParallelTransport> filter;
  filter->SetInputData(sphere);
  filter->SetPoint(1.0, 0.0, 0.0);
  filter->SetDirection(0.0, 0.0, 1.0);
  filter->Update();
  filter->SetPoint(0.0, 1.0, 0.0);
  filter->Update();
  EXPECT_EQ(filter->GetNumberOfSetups(), 1);
  EXPECT_EQ(filter->GetNumberOfSolves(), 4);
  const std::vector<double> moved = Values(OutputOf(filter)->GetPointData(), "LogarithmicMap");
  vtkNew<vtkParallelTransport> fresh;
  fresh->SetInputData(sphere);
  fresh->SetPoint(0.0, 1.0, 0.0);
  fresh->SetDirection(0.0, 0.0, 1.0);
  fresh->Update();
  EXPECT_EQ(moved, Values(OutputOf(fresh)->GetPointData(), "LogarithmicMap"));
  filter->SetTimeStep(9.0);
  filter->Update();
  EXPECT_EQ(filter->GetNumberOfSetups(), 2);
  EXPECT_NE(moved, Values(OutputOf(filter)->GetPointData(), "LogarithmicMap"));
  filter->SetInputData(PolyDataOf(Icosphere(2)));
  filter->Update();
  EXPECT_EQ(filter->GetNumberOfSetups(), 3);
}

TEST(ParallelTransportFilter, AppliedTwiceIsTheSame)
{
  vtkNew<vtkParallelTransport> first;
  first->SetInputData(PolyDataOf(Icosphere(2)));
  first->SetPoint(1.0, 0.0, 0.0);
  first->SetDirection(0.0, 1.0, 0.0);
  vtkNew<vtkParallelTransport> second;
  second->SetInputConnection(first->GetOutputPort());
  second->SetPoint(1.0, 0.0, 0.0);
  second->SetDirection(0.0, 1.0, 0.0);
  second->LogarithmicMapOff();
  second->Update();
  EXPECT_EQ(Values(OutputOf(first)->GetPointData(), "TransportedVectors"),
    Values(OutputOf(second)->GetPointData(), "TransportedVectors"));
  EXPECT_FALSE(OutputOf(second)->GetPointData()->HasArray("LogarithmicMap")); // of the point of another filter
}

TEST(ParallelTransportFilter, SaysWhatItDidNotReach)
{
  const Surface plane = PlaneGrid(4, 4);
  vtkNew<vtkParallelTransport> filter;
  filter->SetInputData(PolyDataOf(Union(plane, plane, Vector3(0.0, 0.0, 9.0))));
  Messages messages(filter);
  filter->Update();
  EXPECT_TRUE(messages.Silent());
  for (const char* const name : { "PointsWithoutSource", "PointsWithoutMap" })
  {
    EXPECT_EQ(Values(OutputOf(filter)->GetFieldData(), name), std::vector<double>{ 25.0 }) << name;
  }
  messages.Forget();
  filter->SetInputData(PolyDataOf(plane));
  filter->SetDirection(0.0, 0.0, 2.0);
  filter->Update();
  ASSERT_EQ(messages.GetWarnings().size(), 1u);
  EXPECT_NE(messages.GetWarnings()[0].find("Direction is perpendicular"), std::string::npos);
  EXPECT_NEAR(Tuple(OutputOf(filter)->GetPointData(), "TransportedVectors", 7).norm(), 2.0, 1e-9);
}

TEST(ParallelTransportFilter, WhatIsWrongIsToldWithARemedy)
{
  const auto expectError = [](const std::string& part, const auto& prepare)
  {
    vtkNew<vtkParallelTransport> filter;
    const auto surface = PolyDataOf(Icosphere(1));
    AddPointVectors(surface, "Zero", {});
    filter->SetInputData(surface);
    prepare(filter.Get());
    Messages messages(filter);
    filter->Update();
    EXPECT_NE(messages.Error().find(part), std::string::npos) << messages.Error();
    EXPECT_EQ(OutputOf(filter)->GetNumberOfCells(), 0);
  };
  expectError("Time Step is 0", [](vtkParallelTransport* filter) { filter->SetTimeStep(0.0); });
  expectError("Texture Size is -1", [](vtkParallelTransport* filter) { filter->SetTextureSize(-1.0); });
  expectError("Direction is zero", [](vtkParallelTransport* filter) { filter->SetDirection(0.0, 0.0, 0.0); });
  expectError("Point is not finite", [](vtkParallelTransport* filter) { filter->SetPoint(0.0, std::nan(""), 0.0); });
  expectError(
    "is not among", [](vtkParallelTransport* filter) { filter->SetInputArrayToProcess(0, 0, 0, OnPoints, "Wind"); });
  expectError("no vector of the array 'Zero'",
    [](vtkParallelTransport* filter) { filter->SetInputArrayToProcess(0, 0, 0, OnPoints, "Zero"); });
}

TEST(ParallelTransportFilter, KeepsTheFactorsOfEachLeafOfACompositeDataset)
{
  vtkNew<vtkMultiBlockDataSet> blocks;
  blocks->SetBlock(0, PolyDataOf(Icosphere(2)));
  blocks->SetBlock(1, PolyDataOf(Torus(16, 8)));
  vtkNew<vtkParallelTransport> filter;
  filter->SetInputDataObject(blocks);
  filter->Update();
  EXPECT_EQ(filter->GetNumberOfSetups(), 2);
  filter->SetDirection(0.0, 1.0, 0.5);
  filter->Update();
  EXPECT_EQ(filter->GetNumberOfSetups(), 2);
  filter->SetTimeStep(-1.0); // refused before a leaf is read
  Messages messages(filter);
  filter->Update();
  EXPECT_NE(messages.Error(), "");
  filter->SetTimeStep(dmg::TransportOptions().TimeStep);
  filter->Update();
  EXPECT_EQ(filter->GetNumberOfSetups(), 2);
}
