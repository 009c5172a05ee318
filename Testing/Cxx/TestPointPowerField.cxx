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

// Prescribed singularities are those of a power field, whichever of both is asked for.
TEST(PointPowerField, TakesPrescribedSingularities)
{
  const auto input = Sphere();
  const auto points = vtkSmartPointer<vtkPolyData>::New();
  const auto positions = vtkSmartPointer<vtkPoints>::New();
  for (const double z : { -1.0, 1.0 })
  {
    positions->InsertNextPoint(0.0, 0.0, z);
  }
  points->SetPoints(positions);
  const auto indices = vtkSmartPointer<vtkDoubleArray>::New();
  indices->SetName("Index");
  indices->InsertNextValue(1.0);
  indices->InsertNextValue(1.0);
  points->GetPointData()->AddArray(indices);
  const auto solver = NewPointSolver(input);
  solver->SetInputData(2, points);
  solver->SetNumberOfDirections(1);
  Messages messages(solver);
  solver->Update();
  EXPECT_TRUE(messages.Error().empty()) << messages.Error();
  EXPECT_EQ(NumberOfNonZeros(Values(solver->GetOutput()->GetPointData(), "SingularityIndex")), 2);
}
