// Power fields at points, as a user of the filters has them.

#include "vtkFieldAngles.h"
#include "vtkFieldGlyphs.h"
#include "vtkFieldLines.h"
#include "vtkFieldSingularities.h"
#include "vtkHarmonicFieldSolver.h"

#include "SolverTools.h"

#include "vtkDoubleArray.h"
#include "vtkIntArray.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

using namespace dmg;
using namespace dmg::test;

namespace
{

vtkSmartPointer<Solver> NewPointSolver(vtkPolyData* input)
{
  return NewSolver(input, Solver::PointPowerField);
}

double FieldNumber(vtkPolyData* data, const char* name)
{
  return vtkDataArray::SafeDownCast(data->GetFieldData()->GetAbstractArray(name))->GetComponent(0, 0);
}

int NumberOfNonZeros(const std::vector<double>& values)
{
  return static_cast<int>(std::count_if(values.begin(), values.end(), [](double value) { return value != 0.0; }));
}

}

TEST(PointPowerField, HasItsPowersOnPointsAndSingularitiesOnCells)
{
  const auto solver = NewPointSolver(Sphere());
  solver->Update();
  ASSERT_EQ(Converged(solver), 1);
  vtkPolyData* const output = solver->GetPolyDataOutput();
  for (vtkDataSetAttributes* const attributes : { static_cast<vtkDataSetAttributes*>(output->GetPointData()),
         static_cast<vtkDataSetAttributes*>(output->GetCellData()) })
  {
    EXPECT_TRUE(attributes->HasArray("Direction3"));
    EXPECT_TRUE(attributes->HasArray("PowerField"));
  }
  EXPECT_TRUE(output->GetPointData()->HasArray("Prescribed"));
  EXPECT_FALSE(output->GetCellData()->HasArray("Prescribed"));
  EXPECT_FALSE(output->GetPointData()->HasArray("SingularityIndex"));
  const std::vector<double> indices = CellValues(solver, "SingularityIndex");
  double sum = 0.0;
  for (const double index : indices)
  {
    sum += index;
  }
  EXPECT_NEAR(sum, 2.0, 1e-12);
  EXPECT_GE(NumberOfNonZeros(indices), 8);
}

// What the solver writes and what Field Singularities reads from the arrays is the same.
TEST(PointPowerField, FieldSingularitiesFindsThoseOfTheSolver)
{
  for (const Surface& shape :
    { IrregularSphere(4, 3), IrregularTorus(40, 24, 5), IrregularPlane(30, 20, 5), Annulus(60, 8) })
  {
    const auto input = PolyDataOf(shape);
    AddCellVectors(
      input, "Given", { { 10, { 1.0, 0.5, 0.25 } }, { 200, { -0.5, 0.25, 0.3 } }, { 333, { 0.7, 0.1, 0.3 } } });
    const auto solver = NewPointSolver(input);
    const auto singularities = vtkSmartPointer<vtkFieldSingularities>::New();
    singularities->SetInputConnection(solver->GetOutputPort());
    singularities->Update();
    const std::vector<double> indices = CellValues(solver, "SingularityIndex");
    vtkPolyData* const found = singularities->GetOutput(0);
    ASSERT_EQ(found->GetNumberOfPoints(), NumberOfNonZeros(indices));
    vtkDataArray* const cells = found->GetPointData()->GetArray("CellId");
    ASSERT_TRUE(cells || found->GetNumberOfPoints() == 0);
    for (vtkIdType i = 0; i < found->GetNumberOfPoints(); ++i)
    {
      EXPECT_EQ(found->GetPointData()->GetArray("Index")->GetComponent(i, 0),
        indices[static_cast<std::size_t>(cells->GetComponent(i, 0))]);
    }
    EXPECT_NEAR(FieldNumber(found, "SumOfIndices"), FieldNumber(found, "EulerCharacteristic"), 1e-9);
  }
}

TEST(PointPowerField, CombedFieldsHaveFewCutsThatRunFromTriangleToTriangle)
{
  const auto solver = NewPointSolver(Sphere(4));
  const auto singularities = vtkSmartPointer<vtkFieldSingularities>::New();
  singularities->SetInputConnection(solver->GetOutputPort());
  solver->CombingOff();
  singularities->Update();
  const vtkIdType uncombed = singularities->GetOutput(1)->GetNumberOfCells();
  solver->CombingOn();
  singularities->Update();
  vtkPolyData* const cuts = singularities->GetOutput(1);
  EXPECT_LT(cuts->GetNumberOfCells(), uncombed / 4);
  for (vtkIdType cut = 0; cut < cuts->GetNumberOfCells(); ++cut)
  {
    const double jump = cuts->GetCellData()->GetArray("Jump")->GetComponent(cut, 0);
    EXPECT_TRUE(jump >= 1.0 && jump <= 3.0);
    EXPECT_EQ(cuts->GetCell(cut)->GetNumberOfPoints(), 3);
  }
}

TEST(PointPowerField, IsDrawn)
{
  const auto solver = NewPointSolver(Sphere());
  const auto lines = vtkSmartPointer<vtkFieldLines>::New();
  const auto glyphs = vtkSmartPointer<vtkFieldGlyphs>::New();
  const auto angles = vtkSmartPointer<vtkFieldAngles>::New();
  for (vtkAlgorithm* const filter :
    { static_cast<vtkAlgorithm*>(lines), static_cast<vtkAlgorithm*>(glyphs), static_cast<vtkAlgorithm*>(angles) })
  {
    Messages messages(filter);
    filter->SetInputConnection(solver->GetOutputPort());
    filter->Update();
    EXPECT_TRUE(messages.Silent()) << messages.Error();
    EXPECT_GT(vtkPolyData::SafeDownCast(filter->GetOutputDataObject(0))->GetNumberOfCells(), 20);
  }
}

TEST(PointPowerField, RepeatsWhatAChangeConcerns)
{
  const auto solver = NewPointSolver(Sphere(4));
  solver->Update();
  EXPECT_EQ(CountsOf(solver), (Counts{ 1, 1, 1 }));
  solver->UnitLengthOff();
  solver->Update();
  EXPECT_EQ(CountsOf(solver), (Counts{ 1, 1, 1 }));
  solver->SetTolerance(1e-9);
  solver->Update();
  EXPECT_EQ(CountsOf(solver), (Counts{ 1, 1, 2 }));
  solver->SetAlignment(2.0);
  solver->Update();
  EXPECT_EQ(CountsOf(solver), (Counts{ 1, 2, 3 }));
}

// Directions on cells and the same at points mean the same to a field at points.
TEST(PointPowerField, FollowsDirectionsOfPoints)
{
  const auto input = PolyDataOf(IrregularPlane(20, 15, 3));
  const auto vectors = vtkSmartPointer<vtkDoubleArray>::New();
  vectors->SetName("AtPoints");
  vectors->SetNumberOfComponents(3);
  vectors->SetNumberOfTuples(input->GetNumberOfPoints());
  vectors->Fill(0.0);
  vectors->SetTuple3(17, 0.6, 0.8, 0.0);
  input->GetPointData()->AddArray(vectors);
  const auto solver = NewPointSolver(input);
  solver->SetInputArrayToProcess(1, 0, 0, OnPoints, "AtPoints");
  solver->Update();
  ASSERT_EQ(Converged(solver), 1);
  const std::vector<double> prescribed = Values(solver->GetOutput()->GetPointData(), "Prescribed");
  EXPECT_EQ(NumberOfNonZeros(prescribed), 1);
  EXPECT_EQ(prescribed[17], 1.0);
  // One direction in a plane is followed everywhere.
  for (vtkIdType cell = 0; cell < input->GetNumberOfCells(); ++cell)
  {
    double largest = 0.0;
    for (int k = 0; k < 4; ++k)
    {
      const Vector3 direction = Tuple(solver->GetOutput()->GetCellData(), "Direction" + std::to_string(k), cell);
      largest = std::max(largest, direction.dot(Vector3(0.6, 0.8, 0.0)));
    }
    EXPECT_NEAR(largest, 1.0, 1e-6);
  }
}

// Of many directions at points, those in the mask count, with their weights.
TEST(PointPowerField, TakesMaskAndWeightsOfPoints)
{
  const auto input = PolyDataOf(IrregularPlane(20, 15, 3));
  const auto addToPoints = [&input](const char* name, int components)
  {
    const auto array = vtkSmartPointer<vtkDoubleArray>::New();
    array->SetName(name);
    array->SetNumberOfComponents(components);
    array->SetNumberOfTuples(input->GetNumberOfPoints());
    array->Fill(components == 3 ? 0.6 : 0.0);
    input->GetPointData()->AddArray(array);
    return array;
  };
  addToPoints("AtPoints", 3);
  const auto mask = addToPoints("Mask", 1);
  const auto weights = addToPoints("Weight", 1);
  for (const auto& [point, weight] : { std::pair(17, 2.0), std::pair(40, 0.5), std::pair(99, 3.0) })
  {
    mask->SetValue(point, 1.0);
    weights->SetValue(point, weight);
  }
  weights->SetValue(200, 7.0); // not in the mask
  const auto solver = NewPointSolver(input);
  solver->SetInputArrayToProcess(0, 0, 0, OnPoints, "Mask");
  solver->SetInputArrayToProcess(1, 0, 0, OnPoints, "AtPoints");
  solver->SetInputArrayToProcess(2, 0, 0, OnPoints, "Weight");
  solver->Update();
  ASSERT_EQ(Converged(solver), 1);
  std::vector<double> expected(input->GetNumberOfPoints(), 0.0);
  expected[17] = 2.0;
  expected[40] = 0.5;
  expected[99] = 3.0;
  EXPECT_EQ(Values(solver->GetOutput()->GetPointData(), "Prescribed"), expected);
}

namespace
{

/// The poles of the unit sphere, of an index of 1 each.
vtkSmartPointer<vtkPolyData> Poles()
{
  const auto poles = vtkSmartPointer<vtkPolyData>::New();
  const auto positions = vtkSmartPointer<vtkPoints>::New();
  const auto indices = vtkSmartPointer<vtkDoubleArray>::New();
  indices->SetName("Index");
  for (const double z : { -1.0, 1.0 })
  {
    positions->InsertNextPoint(0.0, 0.0, z);
    indices->InsertNextValue(1.0);
  }
  poles->SetPoints(positions);
  poles->GetPointData()->AddArray(indices);
  return poles;
}

}

// A point that has a direction cannot be singular: the field is that of PowerField, and singular points have no direction.
TEST(PointPowerField, TakesPrescribedSingularities)
{
  const auto solver = NewPointSolver(Sphere());
  solver->Update();
  const std::vector<double> onItsOwn = CellValues(solver, "Direction0");
  const auto poles = Poles();
  solver->SetInputData(2, poles);
  solver->SetNumberOfDirections(1);
  Messages messages(solver);
  solver->Update();
  EXPECT_TRUE(messages.Error().empty()) << messages.Error();
  const std::vector<double> indices = Values(solver->GetOutput()->GetPointData(), "SingularityIndex");
  EXPECT_EQ(NumberOfNonZeros(indices), 2);
  EXPECT_FALSE(solver->GetOutput()->GetCellData()->HasArray("SingularityIndex"));
  for (std::size_t point = 0; point < indices.size(); ++point)
  {
    EXPECT_NEAR(Tuple(solver->GetOutput()->GetPointData(), "Direction0", static_cast<vtkIdType>(point)).norm(),
      indices[point] == 0.0 ? 1.0 : 0.0, 1e-12);
  }
  const std::vector<double> atPoints = CellValues(solver, "Direction0");
  solver->SetDiscretisation(Solver::PowerField);
  solver->Update();
  EXPECT_EQ(CellValues(solver, "Direction0"), atPoints);

  // Without them, it is a field at points again.
  solver->SetDiscretisation(Solver::PointPowerField);
  solver->SetNumberOfDirections(4);
  solver->RemoveAllSingularities();
  solver->Update();
  EXPECT_FALSE(solver->GetOutput()->GetPointData()->HasArray("SingularityIndex"));
  EXPECT_EQ(CellValues(solver, "Direction0"), onItsOwn);
}

// All that draws and measures fields goes on from there, also where the surface came from a field at points.
TEST(PointPowerField, PrescribedSingularitiesAreDrawn)
{
  const auto before = NewPointSolver(Sphere());
  before->Update();
  const auto solver = NewPointSolver(before->GetPolyDataOutput());
  const auto poles = Poles();
  solver->SetInputData(2, poles);
  solver->SetNumberOfDirections(1);
  const auto singularities = vtkSmartPointer<vtkFieldSingularities>::New();
  const auto lines = vtkSmartPointer<vtkFieldLines>::New();
  const auto glyphs = vtkSmartPointer<vtkFieldGlyphs>::New();
  const auto angles = vtkSmartPointer<vtkFieldAngles>::New();
  for (vtkAlgorithm* const filter : { static_cast<vtkAlgorithm*>(singularities), static_cast<vtkAlgorithm*>(lines),
         static_cast<vtkAlgorithm*>(glyphs), static_cast<vtkAlgorithm*>(angles) })
  {
    Messages messages(filter);
    filter->SetInputConnection(solver->GetOutputPort());
    filter->Update();
    EXPECT_TRUE(messages.Silent()) << messages.Error();
    EXPECT_GT(vtkPolyData::SafeDownCast(filter->GetOutputDataObject(0))->GetNumberOfCells(), 1);
  }
  vtkPolyData* const found = singularities->GetOutput(0);
  ASSERT_EQ(found->GetNumberOfPoints(), 2);
  for (vtkIdType pole = 0; pole < 2; ++pole)
  {
    EXPECT_EQ(found->GetPointData()->GetArray("Index")->GetComponent(pole, 0), 1.0);
    EXPECT_TRUE(found->GetPointData()->HasArray("PointId"));
    EXPECT_GT(std::abs(found->GetPoint(pole)[2]), 0.9);
  }
}
