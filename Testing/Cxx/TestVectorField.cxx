// Face fields and 1-forms, whose unknowns are vectors.

#include "vtkHarmonicFieldSolver.h"

#include "SolverTools.h"
#include "SurfaceEdges.h"

#include "vtkIdList.h"
#include "vtkIntArray.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

using namespace dmg;
using namespace dmg::test;

// The rim holds a constant field. Inside, that has neither divergence nor curl, and on a disc no
// other field shares its rim.
TEST_P(VectorField, ContinuesAConstantRimOverAPlate)
{
  const auto input = PolyDataOf(IrregularPlane(12, 9, 7));
  const Vector3 given(3.0, 4.0, 0.0);
  const auto onRim = [&input](vtkIdType point)
  {
    const Vector3 x(input->GetPoint(point));
    return x[0] == 0.0 || x[0] == 12.0 || x[1] == 0.0 || x[1] == 9.0;
  };
  Vectors rim;
  vtkNew<vtkIdList> ids;
  for (vtkIdType cell = 0; cell < input->GetNumberOfCells(); ++cell)
  {
    input->GetCellPoints(cell, ids);
    if (onRim(ids->GetId(0)) || onRim(ids->GetId(1)) || onRim(ids->GetId(2)))
    {
      rim.push_back({ cell, given });
    }
  }
  ASSERT_LT(static_cast<vtkIdType>(rim.size()), input->GetNumberOfCells() / 2);
  AddCellVectors(input, "Given", rim);
  const auto solver = NewSolver(input, GetParam());
  solver->SetConstraintType(Solver::Hard);
  solver->UnitLengthOff();
  solver->Update();
  vtkPolyData* const output = solver->GetPolyDataOutput();
  for (vtkDataSetAttributes* data : { static_cast<vtkDataSetAttributes*>(output->GetCellData()),
         static_cast<vtkDataSetAttributes*>(output->GetPointData()) })
  {
    EXPECT_STREQ(data->GetVectors()->GetName(), "Direction0");
    for (vtkIdType i = 0; i < data->GetNumberOfTuples(); ++i)
    {
      ASSERT_LT((Tuple(data, "Direction0", i) - given).norm(), 1e-10 * 5.0);
    }
  }
  if (GetParam() == Solver::OneForm)
  {
    const std::vector<double> form = Unknowns(solver);
    ASSERT_EQ(Edges(solver)->GetNumberOfCells(), static_cast<vtkIdType>(form.size()));
    for (vtkIdType edge = 0; edge < Edges(solver)->GetNumberOfCells(); ++edge)
    {
      Edges(solver)->GetCellPoints(edge, ids);
      const Edge ends(ids->GetId(0), ids->GetId(1));
      ASSERT_LT(ends.first, ends.second);
      ASSERT_NEAR(form[edge], given.dot(Along(input, ends)), 1e-10 * 5.0);
    }
  }
}

// On a flat torus parallel fields are harmonic, so that one prescribed face, soft, fills it.
TEST_P(VectorField, IsParallelOnAFlatTorus)
{
  const auto input = PolyDataOf(FlatTorus(8, 2));
  vtkNew<vtkIdList> ids;
  input->GetCellPoints(33, ids);
  const Vector3 given =
    2.5 * (Along(input, { ids->GetId(0), ids->GetId(1) }) + Along(input, { ids->GetId(0), ids->GetId(2) }));
  AddCellVectors(input, "Given", { { 33, given } });
  const auto solver = NewSolver(input, GetParam());
  solver->UnitLengthOff();
  solver->Update();
  for (double rotation : Values(Edges(solver)->GetCellData(), "Rotation"))
  {
    ASSERT_NEAR(rotation, 0.0, 1e-7);
  }
  for (double index : Values(solver->GetOutput()->GetPointData(), "SingularityIndex"))
  {
    ASSERT_NEAR(index, 0.0, 1e-9);
  }
  const std::vector<double> form = Unknowns(solver);
  const std::map<Edge, int> edges = EdgesOf(input);
  for (vtkIdType cell = 0; cell < input->GetNumberOfCells(); ++cell)
  {
    const Vector3 vector = Tuple(solver->GetOutput()->GetCellData(), "Direction0", cell);
    ASSERT_NEAR(vector.norm(), given.norm(), 1e-7 * given.norm());
    if (GetParam() == Solver::OneForm) // integrals of the vector along the sides
    {
      input->GetCellPoints(cell, ids);
      for (int k = 0; k < 3; ++k)
      {
        const Edge edge = std::minmax({ ids->GetId(k), ids->GetId((k + 1) % 3) });
        ASSERT_NEAR(form[edges.at(edge)], vector.dot(Along(input, edge)), 1e-7 * given.norm());
      }
    }
  }
  EXPECT_LT((Tuple(solver->GetOutput()->GetCellData(), "Direction0", 33) - given).norm(), 1e-7 * given.norm());
}

TEST_P(VectorField, HasIndicesThatSumToTheEulerCharacteristic)
{
  const std::pair<Surface, double> surfaces[] = { { IrregularSphere(3, 11), 2.0 }, { IrregularTorus(24, 16, 5), 0.0 },
    { DoubleTorus(3), -2.0 } };
  for (const auto& [surface, eulerCharacteristic] : surfaces)
  {
    SCOPED_TRACE(eulerCharacteristic);
    const auto input = PolyDataOf(surface);
    AddCellVectors(input, "Given", { { 3, { 1.0, 2.0, 3.0 } }, { 77, { 3.0, -1.0, 1.0 } } });
    const auto solver = NewSolver(input, GetParam());
    solver->Update();
    double sum = 0.0;
    for (double index : Values(solver->GetOutput()->GetPointData(), "SingularityIndex"))
    {
      EXPECT_NEAR(index, std::round(index), 1e-9);
      sum += index;
    }
    EXPECT_NEAR(sum, eulerCharacteristic, 1e-9);
    for (vtkIdType cell = 0; cell < input->GetNumberOfCells(); ++cell) // no zero
    {
      ASSERT_NEAR(Tuple(solver->GetOutput()->GetCellData(), "Direction0", cell).norm(), 1.0, 1e-12);
    }
  }
}

TEST(FaceField, IsTheDirectionTimesItsLength)
{
  const auto solver = NewSolver(Sphere(), Solver::FaceField);
  solver->Update();
  const std::vector<double> unit = Values(solver->GetOutput()->GetCellData(), "Direction0");
  const std::vector<double> field = Unknowns(solver);
  ASSERT_EQ(field.size(), 3u * 1280u);
  for (std::size_t i = 0; i < field.size(); i += 3)
  {
    const Vector3 vector(field[i], field[i + 1], field[i + 2]);
    const Vector3 direction(unit[i], unit[i + 1], unit[i + 2]);
    ASSERT_NEAR(direction.norm(), 1.0, 1e-12);
    ASSERT_LT((vector.norm() * direction - vector).norm(), 1e-12 * vector.norm());
  }
  solver->UnitLengthOff();
  solver->Update();
  EXPECT_LT(Difference(Values(solver->GetOutput()->GetCellData(), "Direction0"), field), 1e-12);
  EXPECT_EQ(CountsOf(solver), (Counts{ 1, 1, 1 }));
}

// Where a direction is prescribed, its three sides are; with the mean weight of their two faces.
TEST(OneForm, IsPrescribedOnEdges)
{
  const auto input = Sphere();
  const auto weights = Zeros("Weights", 1280, 1);
  weights->SetValue(10, 3.0);
  weights->SetValue(200, 0.5);
  input->GetCellData()->AddArray(weights);
  const auto solver = NewSolver(input, Solver::OneForm);
  solver->SetInputArrayToProcess(2, 0, 0, OnCells, "Weights");
  solver->Update();
  std::vector<double> expected(1920, 0.0);
  const std::map<Edge, int> edges = EdgesOf(input);
  vtkNew<vtkIdList> ids;
  for (vtkIdType cell : { 10, 200 })
  {
    input->GetCellPoints(cell, ids);
    for (int k = 0; k < 3; ++k)
    {
      expected[edges.at(std::minmax({ ids->GetId(k), ids->GetId((k + 1) % 3) }))] += 0.5 * weights->GetValue(cell);
    }
  }
  EXPECT_EQ(Values(Edges(solver)->GetCellData(), "Prescribed"), expected);
  EXPECT_FALSE(solver->GetOutput()->GetCellData()->HasArray("Prescribed"));
}

// Where a direction is prescribed at a point, the edges there are, with the mean weight of their two
// ends; between two such points by the trapezoidal rule.
TEST(OneForm, IsPrescribedOnTheEdgesOfPoints)
{
  const Surface grid = PlaneGrid(4, 4);
  const auto input = PolyDataOf(grid);
  const vtkIdType a = 12; // the middle
  const vtkIdType b = 13; // to the right of it
  AddPointVectors(input, "Given", { { a, { 1.0, 0.0, 0.5 } }, { b, { 3.0, 0.0, 0.0 } } });
  const auto solver = NewSolver(input, Solver::OneForm);
  solver->SetInputArrayToProcess(1, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "Given");
  solver->SetConstraintType(Solver::Hard);
  solver->Update();
  const std::vector<double> weights = Values(Edges(solver)->GetCellData(), "Prescribed");
  const std::vector<double> form = Values(Edges(solver)->GetCellData(), "OneForm");
  for (const auto& [edge, number] : EdgesOf(input))
  {
    const bool atA = edge.first == a || edge.second == a;
    const bool atB = edge.first == b || edge.second == b;
    EXPECT_EQ(weights[number], 0.5 * atA + 0.5 * atB);
    if (atA || atB)
    {
      const double strength = atA && atB ? 2.0 : atA ? 1.0 : 3.0;
      EXPECT_NEAR(form[number], strength * (grid.V(edge.second, 0) - grid.V(edge.first, 0)), 1e-14);
    }
  }
}

TEST_P(VectorField, HasOneDirectionAndNoArraysOfOtherFields)
{
  const auto crosses = NewSolver(Sphere(), Solver::PowerField);
  crosses->Update();
  ASSERT_TRUE(crosses->GetOutput()->GetCellData()->HasArray("Prescribed"));
  const auto solver = NewSolver(crosses->GetPolyDataOutput(), GetParam());
  solver->SetNumberOfDirections(4);
  solver->Update();
  const bool isOneForm = GetParam() == Solver::OneForm;
  auto* const cells = solver->GetOutput()->GetCellData();
  EXPECT_EQ(cells->HasArray("Prescribed"), !isOneForm);
  EXPECT_EQ(cells->HasArray("FaceField"), !isOneForm);
  EXPECT_EQ(Edges(solver)->GetCellData()->HasArray("OneForm"), isOneForm);
  EXPECT_EQ(Edges(solver)->GetCellData()->HasArray("Prescribed"), isOneForm);
  EXPECT_FALSE(cells->HasArray("PowerField"));
  EXPECT_FALSE(cells->HasArray("Direction1"));
  EXPECT_FALSE(solver->GetOutput()->GetPointData()->HasArray("PowerField"));
  EXPECT_EQ(
    vtkIntArray::SafeDownCast(solver->GetOutput()->GetFieldData()->GetAbstractArray("NumberOfDirections"))->GetValue(0),
    1);
}
