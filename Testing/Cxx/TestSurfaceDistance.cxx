#include "vtkSurfaceDistance.h"

#include "TestTools.h"

#include "vtkCellArray.h"
#include "vtkCellType.h"
#include "vtkImageData.h"
#include "vtkIntArray.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkTable.h"
#include "vtkUnstructuredGrid.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <set>
#include <string>
#include <vector>

namespace
{

using namespace dmg::test;
using dmg::Vector3;

constexpr int OnPoints = vtkDataObject::FIELD_ASSOCIATION_POINTS;
constexpr int OnCells = vtkDataObject::FIELD_ASSOCIATION_CELLS;
constexpr double Degree = dmg::Pi / 180.0;

vtkDataSet* OutputOf(vtkSurfaceDistance* filter, int port = 0)
{
  return vtkDataSet::SafeDownCast(filter->GetOutputDataObject(port));
}

std::vector<double> Distances(vtkSurfaceDistance* filter)
{
  return Values(OutputOf(filter)->GetPointData(), "Distance");
}

double FieldNumber(vtkSurfaceDistance* filter, const std::string& name)
{
  return Values(OutputOf(filter)->GetFieldData(), name).at(0);
}

int SourceAt(vtkSurfaceDistance* filter, vtkIdType point)
{
  return vtkIntArray::SafeDownCast(OutputOf(filter)->GetPointData()->GetArray("NearestSource"))->GetValue(point);
}

/// Points without cells.
vtkSmartPointer<vtkPolyData> PointsAt(const std::vector<Vector3>& places)
{
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  for (const Vector3& place : places)
  {
    points->InsertNextPoint(place.data());
  }
  auto data = vtkSmartPointer<vtkPolyData>::New();
  data->SetPoints(points);
  return data;
}

vtkSmartPointer<vtkPolyData> LineThrough(const std::vector<Vector3>& places)
{
  const auto data = PointsAt(places);
  vtkNew<vtkCellArray> lines;
  lines->InsertNextCell(static_cast<int>(places.size()));
  for (std::size_t k = 0; k < places.size(); ++k)
  {
    lines->InsertCellPoint(static_cast<vtkIdType>(k));
  }
  data->SetLines(lines);
  return data;
}

/// A polygon on the plane, counter-clockwise.
vtkSmartPointer<vtkPolyData> PolygonThrough(const std::vector<Vector3>& places)
{
  const auto data = LineThrough(places);
  data->SetPolys(data->GetLines());
  data->SetLines(vtkNew<vtkCellArray>());
  return data;
}

void ExpectDistances(vtkSurfaceDistance* filter, double tolerance, const std::function<double(const Vector3&)>& exact)
{
  const std::vector<double> distances = Distances(filter);
  ASSERT_EQ(static_cast<vtkIdType>(distances.size()), OutputOf(filter)->GetNumberOfPoints());
  for (std::size_t k = 0; k < distances.size(); ++k)
  {
    const Vector3 place(OutputOf(filter)->GetPoint(static_cast<vtkIdType>(k)));
    EXPECT_NEAR(distances[k], exact(place), tolerance) << place.transpose();
  }
}

/// Of a point of a square from [0, side] in each direction to its boundary.
double ToSquare(const Vector3& place, double side)
{
  return std::min({ place.x(), place.y(), side - place.x(), side - place.y() });
}

}

TEST(SurfaceDistanceFilter, WithNothingSaidStartsInTheMiddleOfAPlane)
{
  const auto plane = PolyDataOf(IrregularPlane(10, 8, 3));
  vtkNew<vtkSurfaceDistance> filter;
  filter->SetInputData(plane);
  Messages messages(filter);
  filter->Update();
  EXPECT_TRUE(messages.Silent());
  const Vector3 from(filter->GetPointOnSurface());
  EXPECT_LE((from - Vector3(5.0, 4.0, 0.0)).norm(), 1.0);
  ExpectDistances(filter, 1e-7, [&](const Vector3& place) { return (place - from).norm(); });
  vtkPointData* const ofPoints = OutputOf(filter)->GetPointData();
  EXPECT_STREQ(ofPoints->GetScalars()->GetName(), "Distance");
  for (vtkIdType point = 0; point < plane->GetNumberOfPoints(); ++point)
  {
    const Vector3 away = Vector3(plane->GetPoint(point)) - from;
    const Vector3 direction = away.norm() > 0.0 ? away.normalized() : Vector3::Zero();
    EXPECT_LE((Tuple(ofPoints, "DirectionFromSource", point) - direction).norm(), 1e-6);
    EXPECT_EQ(SourceAt(filter, point), 0);
  }
  std::set<double> levels;
  auto* const lines = vtkPolyData::SafeDownCast(OutputOf(filter, 1));
  for (const double distance : Values(lines->GetPointData(), "Distance"))
  {
    levels.insert(distance);
  }
  EXPECT_EQ(levels.size(), 20u);
  EXPECT_EQ(OutputOf(filter, 2)->GetNumberOfCells(), 0);
  EXPECT_EQ(vtkTable::SafeDownCast(filter->GetOutputDataObject(3))->GetNumberOfRows(), 0);

  const std::vector<double> chosen = Distances(filter);
  filter->SetPoint(from.data());
  filter->Update();
  EXPECT_EQ(Distances(filter), chosen);
  EXPECT_TRUE(std::isnan(filter->GetPointOnSurface()[0])); // it has chosen none
}

TEST(SurfaceDistanceFilter, TakesAPointInsideOfAFace)
{
  vtkNew<vtkSurfaceDistance> filter;
  filter->SetInputData(PolyDataOf(IrregularPlane(10, 10, 5)));
  const Vector3 place(3.3, 4.6, 0.0);
  filter->SetPoint(place.x(), place.y(), 77.0); // however far
  filter->Update();
  ExpectDistances(filter, 1e-7, [&](const Vector3& at) { return (at - place).norm(); });
}

TEST(SurfaceDistanceFilter, TakesPointsLinesAndPolygons)
{
  vtkNew<vtkSurfaceDistance> filter;
  filter->SetInputData(PolyDataOf(IrregularPlane(12, 12, 5)));
  const Vector3 a(2.2, 2.7, 0.1), b(9.1, 8.8, -0.1), up(0.0, 0.0, 1.0);
  const auto inPlane = [&](const Vector3& p) { return Vector3(p - p.dot(up) * up); };
  filter->AddInputDataObject(1, PointsAt({ a, b }));
  filter->Update();
  EXPECT_EQ(FieldNumber(filter, "SourcesTaken"), 2.0);
  const auto toPoints = [&](const Vector3& at) { return std::min((at - inPlane(a)).norm(), (at - inPlane(b)).norm()); };
  ExpectDistances(filter, 1e-7, toPoints);
  for (vtkIdType point = 0; point < OutputOf(filter)->GetNumberOfPoints(); ++point)
  {
    const Vector3 at(OutputOf(filter)->GetPoint(point));
    const double difference = (at - inPlane(a)).norm() - (at - inPlane(b)).norm();
    if (std::abs(difference) > 1e-6)
    {
      EXPECT_EQ(SourceAt(filter, point), difference < 0.0 ? 0 : 1);
    }
  }

  filter->RemoveAllSources();
  filter->AddInputDataObject(1, LineThrough({ Vector3(4.3, -0.01, 0.0), Vector3(4.3, 12.01, 0.0) }));
  filter->Update();
  ExpectDistances(filter, 1e-6, [](const Vector3& at) { return std::abs(at.x() - 4.3); });

  filter->AddInputDataObject(1, PointsAt({ Vector3(9.5, 6.5, 0.0) })); // a line and a point: points come first
  filter->Update();
  ExpectDistances(filter, 0.02, // of an edge, where the nearest source changes

    [](const Vector3& at) { return std::min(std::abs(at.x() - 4.3), (at - Vector3(9.5, 6.5, 0.0)).norm()); });
  EXPECT_EQ(SourceAt(filter, 0), 1);
}

TEST(SurfaceDistanceFilter, DistancesInsideOfAPolygonAreNegative)
{
  // The outline of two cells: the side between them is none.
  const auto square =
    PolygonThrough({ Vector3(3.0, 3.0, 0.0), Vector3(9.0, 3.0, 0.0), Vector3(9.0, 9.0, 0.0), Vector3(3.0, 9.0, 0.0) });
  vtkNew<vtkCellArray> halves;
  halves->InsertNextCell({ 0, 1, 2 });
  halves->InsertNextCell({ 0, 2, 3 });
  square->SetPolys(halves);
  vtkNew<vtkSurfaceDistance> filter;
  filter->SetInputData(PolyDataOf(PlaneGrid(12, 12)));
  filter->AddInputDataObject(1, square);
  filter->SignedOn();
  filter->AddOffsetDistance(-1.5);
  filter->AddOffsetDistance(1.5);
  Messages messages(filter);
  filter->Update();
  EXPECT_TRUE(messages.Silent());
  EXPECT_EQ(FieldNumber(filter, "DistanceIsSigned"), 1.0);
  EXPECT_EQ(FieldNumber(filter, "SourcesTaken"), 1.0);
  const auto exact = [](const Vector3& at)
  {
    const Vector3 beyond = (at - Vector3(6.0, 6.0, 0.0)).cwiseAbs() - Vector3(3.0, 3.0, 0.0);
    const double inside = std::max(beyond.x(), beyond.y());
    return inside < 0.0 ? inside : std::hypot(std::max(beyond.x(), 0.0), std::max(beyond.y(), 0.0));
  };
  ExpectDistances(filter, 0.1, exact); // where fronts of two sides meet, a tenth of an edge
  const std::vector<double> ofLines = Values(OutputOf(filter, 1)->GetPointData(), "Distance");
  EXPECT_EQ(std::set<double>(ofLines.begin(), ofLines.end()), std::set<double>({ -1.5, 1.5 }));
  for (std::size_t k = 0; k < ofLines.size(); ++k)
  {
    EXPECT_NEAR(exact(Vector3(OutputOf(filter, 1)->GetPoint(static_cast<vtkIdType>(k)))), ofLines[k], 0.1);
  }
}

TEST(SurfaceDistanceFilter, LinesOfTwoPointsThatFollowEachOtherAreOneSource)
{
  const auto line =
    LineThrough({ Vector3(0.0, 3.5, 0.0), Vector3(2.0, 3.5, 0.0), Vector3(5.0, 3.5, 0.0), Vector3(8.0, 3.5, 0.0) });
  vtkNew<vtkCellArray> segments;
  segments->InsertNextCell({ 1, 2 }); // in any order
  segments->InsertNextCell({ 2, 3 });
  segments->InsertNextCell({ 0, 1 });
  line->SetLines(segments);
  vtkNew<vtkSurfaceDistance> filter;
  filter->SetInputData(PolyDataOf(PlaneGrid(8, 8)));
  filter->AddInputDataObject(1, line);
  filter->Update();
  EXPECT_EQ(FieldNumber(filter, "SourcesTaken"), 1.0);
  ExpectDistances(filter, 1e-6, [](const Vector3& at) { return std::abs(at.y() - 3.5); });
}

TEST(SurfaceDistanceFilter, TakesTheBoundaryAndSharpEdges)
{
  vtkNew<vtkSurfaceDistance> filter;
  filter->SetInputData(PolyDataOf(PlaneGrid(8, 8)));
  filter->BoundaryOn();
  filter->Update();
  ExpectDistances(filter, 0.1, [](const Vector3& at) { return ToSquare(at, 8.0); });
  EXPECT_EQ(SourceAt(filter, 40), 1); // after the region

  Surface folded = PlaneGrid(8, 8); // at x = 3, by 45 degrees
  for (int k = 0; k < folded.V.rows(); ++k)
  {
    const double beyond = std::max(folded.V(k, 0) - 3.0, 0.0);
    folded.V(k, 0) -= beyond * (1.0 - std::sqrt(0.5));
    folded.V(k, 2) += beyond * std::sqrt(0.5);
  }
  const auto exact = [](const Vector3& at) { return std::hypot(at.x() - 3.0, at.z()); };
  filter->SetInputData(PolyDataOf(folded));
  filter->BoundaryOff();
  filter->SharpEdgesOn();
  filter->Update();
  ExpectDistances(filter, 1e-7, exact);
  EXPECT_EQ(SourceAt(filter, 40), 2);
  filter->SetFeatureAngle(50.0); // then there are none
  Messages messages(filter);
  filter->Update();
  EXPECT_NE(messages.Error().find("there is no source of distances"), std::string::npos) << messages.Error();
}

TEST(SurfaceDistanceFilter, TakesAMaskOfCellsOrPoints)
{
  const auto plane = PolyDataOf(PlaneGrid(9, 6));
  const auto mask = Zeros("Mask", plane->GetNumberOfPoints(), 1);
  const auto cells = Zeros("Cells", plane->GetNumberOfCells(), 1);
  for (vtkIdType point = 0; point < plane->GetNumberOfPoints(); ++point)
  {
    mask->SetValue(point, plane->GetPoint(point)[0] < 2.5 ? 1.0 : 0.0);
  }
  vtkIdType size;
  const vtkIdType* corners;
  for (vtkIdType cell = 0; cell < plane->GetNumberOfCells(); ++cell)
  {
    plane->GetPolys()->GetCellAtId(cell, size, corners);
    cells->SetValue(cell,
      std::all_of(corners, corners + size, [&](vtkIdType point) { return mask->GetValue(point) > 0.0; })
        ? -5.0
        : std::numeric_limits<double>::quiet_NaN());
  }
  plane->GetPointData()->AddArray(mask);
  plane->GetCellData()->AddArray(cells);
  vtkNew<vtkSurfaceDistance> filter;
  filter->SetInputData(plane);
  for (const bool onPoints : { true, false })
  {
    filter->SetInputArrayToProcess(0, 0, 0, onPoints ? OnPoints : OnCells, onPoints ? "Mask" : "Cells");
    filter->SignedOff();
    filter->Update();
    ExpectDistances(filter, 1e-7, [](const Vector3& at) { return std::max(at.x() - 2.0, 0.0); });
    filter->SignedOn();
    filter->Update();
    ExpectDistances(filter, 1e-7, [](const Vector3& at) { return at.x() - 2.0; });
  }
  mask->Fill(0.0);
  mask->SetValue(25, 1.0); // a point on its own
  mask->Modified();
  filter->SignedOff();
  filter->SetInputArrayToProcess(0, 0, 0, OnPoints, "Mask");
  filter->Update();
  const Vector3 alone(plane->GetPoint(25));
  ExpectDistances(filter, 1e-7, [&](const Vector3& at) { return (at - alone).norm(); });
  filter->AddPointOn();
  filter->SetPoint(9.0, 6.0, 0.0);
  filter->Update();
  ExpectDistances(filter, 1e-7,
    [&](const Vector3& at) { return std::min((at - alone).norm(), (at - Vector3(9.0, 6.0, 0.0)).norm()); });
}

TEST(SurfaceDistanceFilter, EndsAtTheMaximumDistance)
{
  vtkNew<vtkSurfaceDistance> filter;
  filter->SetInputData(PolyDataOf(PlaneGrid(10, 10)));
  filter->SetPoint(5.0, 5.0, 0.0);
  filter->SetMaximumDistance(3.0);
  filter->Update();
  int unreached = 0;
  const std::vector<double> distances = Distances(filter);
  for (std::size_t k = 0; k < distances.size(); ++k)
  {
    const Vector3 at(OutputOf(filter)->GetPoint(static_cast<vtkIdType>(k)));
    const double exact = (at - Vector3(5.0, 5.0, 0.0)).norm();
    EXPECT_TRUE(exact > 3.0 + 1e-6 ? std::isnan(distances[k]) : std::abs(distances[k] - exact) < 1e-7 || exact > 3.0);
    EXPECT_EQ(SourceAt(filter, static_cast<vtkIdType>(k)), std::isnan(distances[k]) ? -1 : 0);
    unreached += std::isnan(distances[k]) ? 1 : 0;
  }
  EXPECT_GT(unreached, 50);
  EXPECT_EQ(FieldNumber(filter, "PointsWithoutSource"), unreached);
  EXPECT_NEAR(FieldNumber(filter, "LargestDistance"), 3.0, 1e-7);
  filter->SetMaximumDistance(0.0); // no limit
  filter->Update();
  EXPECT_EQ(FieldNumber(filter, "PointsWithoutSource"), 0.0);
}

TEST(SurfaceDistanceFilter, FindsShortestPathsToTargets)
{
  const Surface plane = IrregularPlane(12, 12, 7);
  vtkNew<vtkSurfaceDistance> filter;
  filter->SetInputData(PolyDataOf(Union(plane, plane, Vector3(0.0, 0.0, 5.0))));
  const Vector3 from(1.2, 2.3, 0.0);
  filter->AddInputDataObject(1, PointsAt({ from }));
  const std::vector<Vector3> targets = { Vector3(10.4, 7.7, 0.0), from, Vector3(6.0, 3.0, 5.0), Vector3(0.0, 12.0, 0.0),
    Vector3(0.0, 0.0, 90.0) };
  filter->AddInputDataObject(2, PointsAt(targets));
  filter->Update();
  auto* const table = vtkTable::SafeDownCast(filter->GetOutputDataObject(3));
  ASSERT_EQ(table->GetNumberOfRows(), 5);
  auto* const paths = vtkPolyData::SafeDownCast(OutputOf(filter, 2));
  ASSERT_EQ(paths->GetNumberOfCells(), 2); // none to the source itself, to another sheet, or to nowhere
  for (const int target : { 0, 1, 2, 3, 4 })
  {
    const double length = (targets[target] - from).norm();
    EXPECT_EQ(table->GetValueByName(target, "Target").ToInt(), target);
    EXPECT_EQ(table->GetValueByName(target, "Source").ToInt(), target % 4 == 2 || target == 4 ? -1 : 0);
    for (const char* const name : { "Distance", "PathLength", "StraightLength" })
    {
      const double value = table->GetValueByName(target, name).ToDouble();
      EXPECT_TRUE(target == 2 || target == 4 ? std::isnan(value) : std::abs(value - length) < 1e-6) << name << target;
    }
  }
  for (const int path : { 0, 1 })
  {
    const int target = path == 0 ? 0 : 3;
    EXPECT_EQ(paths->GetCellData()->GetArray("Target")->GetComponent(path, 0), target);
    EXPECT_NEAR(
      paths->GetCellData()->GetArray("PathLength")->GetComponent(path, 0), (targets[target] - from).norm(), 1e-6);
    vtkIdType size;
    const vtkIdType* line;
    paths->GetLines()->GetCellAtId(path, size, line);
    EXPECT_LE((Vector3(paths->GetPoint(line[0])) - from).norm(), 1e-9);
    EXPECT_LE((Vector3(paths->GetPoint(line[size - 1])) - targets[target]).norm(), 1e-9);
    for (vtkIdType k = 0; k < size; ++k) // it is straight
    {
      const Vector3 at(paths->GetPoint(line[k])), along = (targets[target] - from).normalized();
      EXPECT_LE((at - from - along.dot(at - from) * along).norm(), 1e-5);
    }
  }
}

TEST(SurfaceDistanceFilter, MeasuresOnTheGlobeOfAMap)
{
  // The whole globe, its last column at the place of the first.
  vtkNew<vtkImageData> map;
  map->SetDimensions(73, 37, 1);
  map->SetOrigin(0.0, -90.0, 0.0);
  map->SetSpacing(5.0, 5.0, 1.0);
  const Vector3 from(352.5, 12.0, 0.0), target(20.0, 30.0, 0.0);
  vtkNew<vtkSurfaceDistance> filter;
  filter->SetInputData(map);
  filter->AddInputDataObject(1, PointsAt({ from }));
  filter->AddInputDataObject(2, PointsAt({ target }));
  filter->SetCoordinates(vtkSurfaceDistance::LongitudeAndLatitude);
  filter->SetLengthScale(6371.0);
  filter->Update();
  const auto onSphere = [](const Vector3& at)
  {
    return Vector3(std::cos(Degree * at.y()) * std::cos(Degree * at.x()),
      std::cos(Degree * at.y()) * std::sin(Degree * at.x()), std::sin(Degree * at.y()));
  };
  const auto exact = [&](const Vector3& at)
  { return 6371.0 * std::acos(std::clamp(onSphere(at).dot(onSphere(from)), -1.0, 1.0)); };
  ExpectDistances(filter, 0.005 * 6371.0 * dmg::Pi, exact);
  auto* const paths = vtkPolyData::SafeDownCast(OutputOf(filter, 2));
  ASSERT_EQ(paths->GetNumberOfCells(), 2); // over the side of the map
  EXPECT_NEAR(paths->GetCellData()->GetArray("PathLength")->GetComponent(0, 0), exact(target), 0.005 * exact(target));
  for (const double longitude : { 0.0, 360.0 }) // lines lie on the map
  {
    EXPECT_LE(std::abs(OutputOf(filter, 1)->GetBounds()[longitude > 0.0 ? 1 : 0] - longitude), 5.0);
  }
}

TEST(SurfaceDistanceFilter, GoesAroundGaps)
{
  const int columns = 10;
  const auto plane = PolyDataOf(PlaneGrid(columns, columns));
  const auto depth = Zeros("Depth", plane->GetNumberOfCells(), 1);
  depth->Fill(100.0);
  vtkIdType size;
  const vtkIdType* corners;
  for (vtkIdType cell = 0; cell < plane->GetNumberOfCells(); ++cell) // an island of 4 x 4
  {
    plane->GetPolys()->GetCellAtId(cell, size, corners);
    if (std::all_of(corners, corners + size,
          [&](vtkIdType point)
          { return (Vector3(plane->GetPoint(point)) - Vector3(5.0, 5.0, 0.0)).cwiseAbs().maxCoeff() < 2.5; }))
    {
      depth->SetValue(cell, std::numeric_limits<double>::quiet_NaN());
    }
  }
  plane->GetCellData()->AddArray(depth);
  vtkNew<vtkSurfaceDistance> filter;
  filter->SetInputData(plane);
  filter->SetInputArrayToProcess(1, 0, 0, OnCells, "Depth");
  filter->SetPoint(0.0, 5.0, 0.0);
  filter->Update();
  EXPECT_EQ(FieldNumber(filter, "CellsWithoutData"), 32.0);
  const std::vector<double> distances = Distances(filter);
  const vtkIdType middle = 5 * (columns + 1) + 5, opposite = 5 * (columns + 1) + 10;
  EXPECT_TRUE(std::isnan(distances[middle]));
  EXPECT_EQ(SourceAt(filter, middle), -1);
  // To a corner of the island, along its side, and from its other corner; exact to a small part of an edge.
  EXPECT_NEAR(distances[opposite], 2.0 * std::hypot(3.0, 2.0) + 4.0, 0.05);
}

TEST(SurfaceDistanceFilter, BlocksAreSurfacesOfTheirOwn)
{
  vtkNew<vtkMultiBlockDataSet> blocks;
  blocks->SetBlock(0, PolyDataOf(PlaneGrid(4, 4)));
  Surface away = PlaneGrid(4, 4);
  away.V.col(2).array() += 50.0;
  blocks->SetBlock(1, PolyDataOf(away));
  vtkNew<vtkSurfaceDistance> filter;
  filter->SetInputData(blocks);
  filter->AddInputDataObject(1, PointsAt({ Vector3(1.0, 1.0, 0.0) }));
  filter->Update();
  auto* const output = vtkMultiBlockDataSet::SafeDownCast(filter->GetOutputDataObject(0));
  const auto unreached = [&](int block)
  { return Values(vtkDataSet::SafeDownCast(output->GetBlock(block))->GetFieldData(), "PointsWithoutSource").at(0); };
  EXPECT_EQ(unreached(0), 0.0);
  EXPECT_EQ(unreached(1), 25.0);
  filter->RemoveAllSources();
  filter->Update();
  EXPECT_EQ(unreached(0) + unreached(1), 0.0);
  EXPECT_TRUE(std::isnan(filter->GetPointOnSurface()[0])); // each has its own
}

TEST(SurfaceDistanceFilter, TakesQuadrilateralsOfAnyDataSet)
{
  vtkNew<vtkUnstructuredGrid> grid;
  vtkNew<vtkPoints> points;
  for (int k = 0; k < 49; ++k)
  {
    points->InsertNextPoint(k % 7, k / 7, 0.0);
  }
  points->InsertNextPoint(0.0, 0.0, 9.0); // of no surface
  grid->SetPoints(points);
  for (int k = 0; k < 36; ++k)
  {
    const vtkIdType first = 7 * (k / 6) + k % 6;
    const vtkIdType corners[] = { first, first + 1, first + 8, first + 7 };
    grid->InsertNextCell(VTK_QUAD, 4, corners);
  }
  vtkNew<vtkSurfaceDistance> filter;
  filter->SetInputData(grid);
  filter->SetPoint(3.0, 3.0, 0.0);
  filter->Update();
  ASSERT_TRUE(OutputOf(filter)->IsA("vtkUnstructuredGrid"));
  EXPECT_NEAR(Distances(filter)[0], std::hypot(3.0, 3.0), 1e-9);
  EXPECT_TRUE(std::isnan(Distances(filter)[49]));
}

TEST(SurfaceDistanceFilter, SaysWhatHasNoSignAndWhatIsTooFar)
{
  vtkNew<vtkSurfaceDistance> filter;
  filter->SetInputData(PolyDataOf(Torus(24, 16)));
  filter->AddInputDataObject(1, PointsAt({ Vector3(1.4, 0.0, 0.0), Vector3(9.0, 0.0, 0.0) }));
  filter->SignedOn();
  Messages messages(filter);
  filter->Update();
  ASSERT_EQ(messages.GetWarnings().size(), 2u);
  EXPECT_NE(messages.GetWarnings()[0].find("points have no inside"), std::string::npos);
  EXPECT_NE(
    messages.GetWarnings()[1].find("1 points, or segments of lines, of Sources are left out"), std::string::npos);
  EXPECT_EQ(FieldNumber(filter, "SourcesTooFar"), 1.0);
  EXPECT_EQ(FieldNumber(filter, "DistanceIsSigned"), 0.0);
  filter->SetMaximumSourceDistance(10.0);
  filter->SignedOff();
  messages.Forget();
  filter->Update();
  EXPECT_TRUE(messages.Silent());
  EXPECT_EQ(FieldNumber(filter, "SourcesTaken"), 2.0);
}

TEST(SurfaceDistanceFilter, WhatIsWrongIsToldWithARemedy)
{
  const auto expectError = [](const std::string& part, const auto& prepare)
  {
    vtkNew<vtkSurfaceDistance> filter;
    filter->SetInputData(PolyDataOf(Icosphere(1)));
    prepare(filter.Get());
    Messages messages(filter);
    filter->Update();
    EXPECT_NE(messages.Error().find(part), std::string::npos) << messages.Error();
    EXPECT_EQ(OutputOf(filter)->GetNumberOfCells(), 0);
  };
  expectError("Maximum Distance is -1", [](vtkSurfaceDistance* filter) { filter->SetMaximumDistance(-1.0); });
  expectError("Feature Angle is 0", [](vtkSurfaceDistance* filter) { filter->SetFeatureAngle(0.0); });
  expectError("Number Of Levels is -1", [](vtkSurfaceDistance* filter) { filter->SetNumberOfLevels(-1); });
  expectError("Length Scale is 0", [](vtkSurfaceDistance* filter) { filter->SetLengthScale(0.0); });
  expectError("Point is not finite", [](vtkSurfaceDistance* filter) { filter->SetPoint(0.0, std::nan(""), 0.0); });
  expectError(
    "is not among", [](vtkSurfaceDistance* filter) { filter->SetInputArrayToProcess(0, 0, 0, OnPoints, "Region"); });
  expectError("raise Maximum Source Distance",
    [](vtkSurfaceDistance* filter) { filter->AddInputDataObject(1, PointsAt({ Vector3(9.0, 0.0, 0.0) })); });
  expectError("point 1 of the source lies at",
    [](vtkSurfaceDistance* filter) {
      filter->AddInputDataObject(1, PointsAt({ Vector3(1.0, 0.0, 0.0), Vector3(std::nan(""), 0.0, 0.0) }));
    });
  expectError("point 0 of the target lies at",
    [](vtkSurfaceDistance* filter) { filter->AddInputDataObject(2, PointsAt({ Vector3(std::nan(""), 0.0, 0.0) })); });
  expectError("the source is a vtkTable, which is no dataset",
    [](vtkSurfaceDistance* filter) { filter->AddInputDataObject(1, vtkNew<vtkTable>()); });
  expectError("there is no source of distances",
    [](vtkSurfaceDistance* filter) { filter->AddInputDataObject(1, vtkNew<vtkPolyData>()); });
  expectError(
    "there is no source of distances", [](vtkSurfaceDistance* filter) { filter->BoundaryOn(); }); // it is closed
  expectError("there is no offset line at the distance 3",
    [](vtkSurfaceDistance* filter)
    {
      filter->AddOffsetDistance(3.0);
      filter->SetMaximumDistance(2.0);
    });
}

TEST(SurfaceDistanceFilter, FindsDistancesOnceForOtherTargetsAndLevels)
{
  const auto sphere = PolyDataOf(Icosphere(3));
  const auto set = [&](vtkSurfaceDistance* filter)
  {
    filter->SetInputData(sphere);
    filter->SetPoint(1.0, 0.1, 0.2);
  };
  vtkNew<vtkSurfaceDistance> filter;
  set(filter);
  filter->Update();
  const std::vector<double> distances = Values(OutputOf(filter)->GetPointData(), "Distance");
  filter->SetNumberOfLevels(3);
  filter->AddInputDataObject(2, PolyDataOf(Icosphere(0)));
  filter->Update();
  filter->AddOffsetDistance(0.5);
  filter->SetLengthScale(2.0);
  filter->Update();
  EXPECT_EQ(filter->GetNumberOfSetups(), 1);
  vtkNew<vtkSurfaceDistance> fresh;
  set(fresh);
  fresh->AddInputDataObject(2, PolyDataOf(Icosphere(0)));
  fresh->AddOffsetDistance(0.5);
  fresh->SetLengthScale(2.0);
  fresh->Update();
  for (const int port : { 1, 2 })
  {
    vtkDataSet* const lines = OutputOf(fresh, port);
    ASSERT_GT(lines->GetNumberOfPoints(), 0);
    ASSERT_EQ(OutputOf(filter, port)->GetNumberOfPoints(), lines->GetNumberOfPoints());
    for (vtkIdType point = 0; point < lines->GetNumberOfPoints(); ++point)
    {
      EXPECT_EQ(Vector3(OutputOf(filter, port)->GetPoint(point)), Vector3(lines->GetPoint(point)));
    }
  }
  filter->SetLengthScale(1.0);
  filter->Update();
  EXPECT_EQ(Values(OutputOf(filter)->GetPointData(), "Distance"), distances);
  EXPECT_EQ(filter->GetNumberOfSetups(), 1);
  filter->SetPoint(0.0, 1.0, 0.0);
  filter->Update();
  EXPECT_EQ(filter->GetNumberOfSetups(), 2);
  filter->SetMaximumDistance(1.0);
  filter->Update();
  EXPECT_EQ(filter->GetNumberOfSetups(), 3);
  filter->SetInputData(PolyDataOf(Icosphere(2)));
  filter->Update();
  EXPECT_EQ(filter->GetNumberOfSetups(), 4);
}
