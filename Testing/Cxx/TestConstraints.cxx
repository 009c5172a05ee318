// What a solver takes as prescribed.

#include "vtkHarmonicFieldSolver.h"

#include "SolverTools.h"

#include "vtkIdList.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <vector>

using namespace dmg;
using namespace dmg::test;

namespace
{

using Cells = std::map<vtkIdType, double>;

/// The cells, or points, that a solve took as prescribed, with their weights.
Cells PrescribedOn(vtkHarmonicFieldSolver* solver, int association)
{
  solver->Update();
  Cells elements;
  const std::vector<double> weights = Values(solver->GetOutput()->GetAttributes(association), "Prescribed");
  for (std::size_t i = 0; i < weights.size(); ++i)
  {
    if (weights[i] != 0.0)
    {
      elements[static_cast<vtkIdType>(i)] = weights[i];
    }
  }
  return elements;
}

/// Those of a field on faces.
Cells PrescribedCells(vtkHarmonicFieldSolver* solver)
{
  solver->SetDiscretisation(Solver::PowerField);
  return PrescribedOn(solver, vtkDataObject::CELL);
}

}

TEST(Constraints, WithoutMaskAreWhereTheVectorIsNotZero)
{
  EXPECT_EQ(PrescribedCells(NewSolver(Sphere())), (Cells{ { 10, 1.0 }, { 200, 1.0 } }));
}

TEST(Constraints, AreChosenByMaskAndWeighted)
{
  const auto input = Sphere();
  const auto mask = Zeros("Mask", 1280, 1);
  mask->SetValue(200, -1.0);
  const auto weights = Zeros("Weights", 1280, 1);
  weights->SetValue(200, 2.5); // where nothing is prescribed the weight does not count
  input->GetCellData()->AddArray(mask);
  input->GetCellData()->AddArray(weights);
  const auto solver = NewSolver(input);
  solver->SetInputArrayToProcess(0, 0, 0, OnCells, "Mask");
  solver->SetInputArrayToProcess(2, 0, 0, OnCells, "Weights");
  EXPECT_EQ(PrescribedCells(solver), (Cells{ { 200, 2.5 } }));
}

// As from an array that says how far each measured vector can be trusted.
TEST(Constraints, OfWeightZeroPrescribeNothing)
{
  const auto input = Sphere();
  const auto weights = Zeros("Weights", 1280, 1);
  weights->SetValue(200, 2.5);
  input->GetCellData()->AddArray(weights);
  const auto solver = NewSolver(input);
  solver->SetInputArrayToProcess(2, 0, 0, OnCells, "Weights");
  EXPECT_EQ(PrescribedCells(solver), (Cells{ { 200, 2.5 } }));
}

TEST(Constraints, CanBeTheActiveVectors)
{
  const auto input = Sphere();
  input->GetCellData()->SetActiveVectors("Given");
  vtkNew<vtkHarmonicFieldSolver> solver;
  solver->SetInputData(input);
  solver->SetInputArrayToProcess(1, 0, 0, OnCells, vtkDataSetAttributes::VECTORS);
  EXPECT_EQ(PrescribedCells(solver), (Cells{ { 10, 1.0 }, { 200, 1.0 } }));
}

TEST(Constraints, AtPointsPrescribeTheFacesAround)
{
  const auto input = PolyDataOf(Icosphere(3));
  AddPointVectors(input, "Given", { { 100, { 1.0, 2.0, 3.0 } } });
  vtkNew<vtkIdList> around;
  input->BuildLinks();
  input->GetPointCells(100, around);
  Cells expected;
  for (vtkIdType i = 0; i < around->GetNumberOfIds(); ++i)
  {
    expected[around->GetId(i)] = 1.0;
  }
  const auto solver = NewSolver(input);
  solver->SetInputArrayToProcess(1, 0, 0, OnPoints, "Given");
  EXPECT_EQ(PrescribedCells(solver), expected);
}

// A direction along a crease, at a point of the crease, is parallel to both sides and is so carried
// to each of them unchanged.
TEST(Constraints, AtPointsAreCarriedIntoTheFaces)
{
  Surface roof = PlaneGrid(4, 4);
  for (int i = 0; i < roof.V.rows(); ++i)
  {
    roof.V(i, 2) = -std::abs(roof.V(i, 0) - 2.0);
  }
  const auto input = PolyDataOf(roof);
  vtkIdType ridge = -1;
  for (vtkIdType i = 0; i < input->GetNumberOfPoints(); ++i)
  {
    if (roof.V.row(i) == Eigen::RowVector3d(2.0, 2.0, 0.0))
    {
      ridge = i;
    }
  }
  ASSERT_GE(ridge, 0);
  AddPointVectors(input, "Given", { { ridge, { 0.0, 2.0, 0.5 } } });
  const auto solver = NewSolver(input);
  solver->SetInputArrayToProcess(1, 0, 0, OnPoints, "Given");
  solver->SetNumberOfDirections(1);
  solver->SetConstraintType(vtkHarmonicFieldSolver::Hard);
  solver->UnitLengthOff();
  const Cells prescribed = PrescribedCells(solver);
  ASSERT_EQ(prescribed.size(), 6u);
  for (const auto& cell : prescribed)
  {
    const Vector3 direction = Tuple(solver->GetOutput()->GetCellData(), "Direction0", cell.first);
    EXPECT_LT((direction - Vector3(0.0, 2.0, 0.0)).norm(), 1e-12);
  }
}

TEST(Constraints, FromAGuidePrescribeTheNearestFace)
{
  const auto input = PolyDataOf(PlaneGrid(4, 4));
  // Centroids of cells 5 and 20, from above, between them a zero vector.
  const auto above = [&input](vtkIdType cell)
  {
    vtkNew<vtkIdList> ids;
    input->GetCellPoints(cell, ids);
    Vector3 sum = Vector3::Zero();
    for (int k = 0; k < 3; ++k)
    {
      sum += Vector3(input->GetPoint(ids->GetId(k))) / 3.0;
    }
    return Vector3(sum + Vector3(0.0, 0.0, 0.75));
  };
  vtkNew<vtkPoints> positions;
  for (const Vector3& position : { above(5), Vector3(1.0, 1.0, 1.0), above(20) })
  {
    positions->InsertNextPoint(position.data());
  }
  vtkNew<vtkPolyData> points;
  points->SetPoints(positions);
  AddPointVectors(points, "Wind", { { 0, { 1.0, 0.0, 0.5 } }, { 2, { 0.0, 1.0, 0.0 } } });
  AddVectors(points->GetPointData(), "Other", 3, { { 1, { 1.0, 0.0, 0.0 } } });

  vtkNew<vtkHarmonicFieldSolver> solver;
  solver->SetInputData(input);
  solver->SetInputData(1, points);
  solver->SetMaximumDistance(0.2);
  solver->SetGuideArrayToProcess(1, 1, 0, OnPoints, "Wind");
  EXPECT_EQ(PrescribedCells(solver), (Cells{ { 5, 1.0 }, { 20, 1.0 } }));

  // The active vectors where nothing is chosen, and both sources together.
  points->GetPointData()->SetActiveVectors("Wind");
  AddCellVectors(input, "Given", { { 12, { 1.0, 1.0, 0.0 } } });
  const auto both = NewSolver(input);
  both->SetInputData(1, points);
  both->SetMaximumDistance(0.2);
  EXPECT_EQ(PrescribedCells(both), (Cells{ { 5, 1.0 }, { 12, 1.0 }, { 20, 1.0 } }));
}

TEST(Constraints, AreNotTheActiveVectorsUnlessTheyAreChosen)
{
  const auto input = PolyDataOf(Icosphere(3));
  AddCellVectors(input, "Given", { { 12, { 1.0, 1.0, 0.0 } } });
  input->GetCellData()->SetActiveVectors("Given");
  vtkNew<vtkHarmonicFieldSolver> solver;
  solver->SetInputData(input);
  EXPECT_TRUE(PrescribedCells(solver).empty());
  solver->SetInputArrayToProcess(1, 0, 0, OnPoints, "Active Vectors");
  EXPECT_EQ(PrescribedCells(solver), (Cells{ { 12, 1.0 } }));
}

TEST(Constraints, AreNotTheFieldOfAFormerSolverUnlessItIsNamed)
{
  vtkNew<vtkHarmonicFieldSolver> first, second;
  first->SetInputData(PolyDataOf(Icosphere(3)));
  second->SetInputConnection(first->GetOutputPort());
  for (const char* const chosen : { static_cast<const char*>(nullptr), "Active Vectors" })
  {
    if (chosen)
    {
      second->SetInputArrayToProcess(1, 0, 0, OnPoints, chosen);
    }
    second->SetNumberOfDirections(2);
    EXPECT_TRUE(PrescribedCells(second).empty());
  }
  second->SetInputArrayToProcess(1, 0, 0, OnCells, "Direction0");
  EXPECT_EQ(PrescribedCells(second).size(), 1280u);
  // The report is that of the second alone.
  EXPECT_TRUE(first->GetOutput()->GetFieldData()->HasArray("Eigenvalues"));
  EXPECT_FALSE(second->GetOutput()->GetFieldData()->HasArray("Eigenvalues"));
}

TEST(Constraints, AreNoneWhereDirectionsAreNotFollowed)
{
  const auto input = Sphere();
  input->GetCellData()->SetActiveVectors("Given");
  const auto solver = NewSolver(input);
  solver->SetInputArrayToProcess(0, 0, 0, OnCells, "Nowhere");
  solver->FollowDirectionsOff();
  EXPECT_TRUE(PrescribedCells(solver).empty());
  EXPECT_EQ(Values(solver->GetOutput()->GetFieldData(), "Eigenvalues").size(), 1u);
}

// Each of these chooses nothing.
TEST(Constraints, WithoutThemTheFieldIsTheSmoothest)
{
  for (const char* const chosen : { static_cast<const char*>(nullptr), "", "None" })
  {
    const auto input = PolyDataOf(Icosphere(3));
    AddCellVectors(input, "Given", { { 12, { 1.0, 1.0, 0.0 } } });
    vtkNew<vtkHarmonicFieldSolver> solver;
    solver->SetInputData(input);
    if (chosen)
    {
      solver->SetInputArrayToProcess(1, 0, 0, OnCells, chosen);
    }
    EXPECT_TRUE(PrescribedOn(solver, vtkDataObject::POINT).empty());
    EXPECT_EQ(Converged(solver), 1);
    // The lowest eigenvalue of crosses on the unit sphere is 4.
    const auto eigenvalues = Values(solver->GetOutput()->GetFieldData(), "Eigenvalues");
    ASSERT_EQ(eigenvalues.size(), 1u);
    EXPECT_NEAR(eigenvalues[0], 4.0, 0.15);
    std::vector<double> indices = CellValues(solver, "SingularityIndex");
    indices.erase(std::remove(indices.begin(), indices.end(), 0.0), indices.end());
    EXPECT_EQ(indices, std::vector<double>(8, 0.25));
  }
}

TEST(Constraints, OnVertsLinesAndUnusedPointsTakeNoPart)
{
  auto input = PolyDataOf(Icosphere(3));
  const vtkIdType unused = input->GetPoints()->InsertNextPoint(5.0, 5.0, 5.0);
  vtkNew<vtkCellArray> verts, lines;
  verts->InsertNextCell({ unused });
  lines->InsertNextCell({ 0, 1 });
  lines->InsertNextCell({ 0, unused });
  input->SetVerts(verts);
  input->SetLines(lines);
  AddCellVectors(input, "Given", { { 1, { 1.0, 0.0, 0.0 } }, { 13, { 1.0, 0.5, -0.25 } } });
  const auto solver = NewSolver(input);
  EXPECT_EQ(PrescribedCells(solver), (Cells{ { 13, 1.0 } }));
  vtkPolyData* const output = solver->GetPolyDataOutput();
  for (vtkIdType cell : { 0, 1, 2 })
  {
    EXPECT_EQ(Tuple(output->GetCellData(), "Direction0", cell), Vector3(0.0, 0.0, 0.0));
  }
  EXPECT_EQ(Tuple(output->GetPointData(), "Direction0", unused), Vector3(0.0, 0.0, 0.0));
  EXPECT_GT(Tuple(output->GetPointData(), "Direction0", 0).norm(), 0.5);

  // The triangles hold what they hold without the others.
  auto plain = PolyDataOf(Icosphere(3));
  AddCellVectors(plain, "Given", { { 10, { 1.0, 0.5, -0.25 } } });
  const auto reference = NewSolver(plain, Solver::PowerField);
  reference->Update();
  std::vector<double> values = CellValues(solver, "PowerField");
  values.erase(values.begin(), values.begin() + 2 * 3);
  EXPECT_EQ(values, CellValues(reference, "PowerField"));
}

TEST(Constraints, DoNotDependOnThePrecisionOfThePoints)
{
  const Surface grid = PlaneGrid(8, 8); // its coordinates are exact in both
  std::vector<double> results[2];
  for (int precision : { VTK_FLOAT, VTK_DOUBLE })
  {
    const auto input = PolyDataOf(grid, precision);
    AddCellVectors(input, "Given", { { 10, { 1.0, 0.5, -0.25 } }, { 90, { 0.0, 1.0, 0.0 } } });
    const auto solver = NewSolver(input);
    solver->Update();
    results[precision == VTK_DOUBLE] = CellValues(solver, "PowerField");
  }
  EXPECT_EQ(results[0], results[1]);
}

TEST(Constraints, ArraysOfAnEarlierSolveDoNotLinger)
{
  const auto first = NewSolver(Sphere());
  first->SetNumberOfDirections(6);
  first->Update();
  const auto second = NewSolver(first->GetPolyDataOutput());
  second->SetNumberOfDirections(2);
  second->Update();
  EXPECT_TRUE(second->GetOutput()->GetCellData()->HasArray("Direction1"));
  EXPECT_FALSE(second->GetOutput()->GetCellData()->HasArray("Direction2"));
  EXPECT_FALSE(second->GetOutput()->GetPointData()->HasArray("Direction5"));
  EXPECT_TRUE(first->GetOutput()->GetCellData()->HasArray("Direction5")) << "the input was modified";
}
