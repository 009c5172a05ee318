// What holds for fields of every discretisation.

#include "vtkHarmonicFieldSolver.h"

#include "SolverTools.h"
#include "SurfaceEdges.h"

#include "vtkIntArray.h"
#include "vtkStringArray.h"
#include "vtkTable.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <map>
#include <string>
#include <vector>

using namespace dmg;
using namespace dmg::test;

namespace
{

std::string NameOf(const testing::TestParamInfo<int>& info)
{
  const char* const names[] = { "PowerField", "FaceField", "OneForm", "ScalarFunction", "PointPowerField" };
  return names[info.param];
}

/// Of the last iterate: that of the solution plus the square of the error in the energy norm.
double LastEnergy(Solver* solver)
{
  return Values(Convergence(solver)->GetRowData(), "Energy").back();
}

// For the tests of all files.
INSTANTIATE_TEST_SUITE_P(Discretisations, VectorField, testing::Values(Solver::FaceField, Solver::OneForm), NameOf);
INSTANTIATE_TEST_SUITE_P(Discretisations, AnyField,
  testing::Values(Solver::PowerField, Solver::FaceField, Solver::OneForm, Solver::PointPowerField), NameOf);

}

TEST_P(VectorField, IsTheSameByEverySolver)
{
  const auto input = SphereWithOperators();
  const auto solver = NewSolver(input, GetParam());
  solver->SetTolerance(1e-12);
  solver->SetMaximumNumberOfIterations(2000);
  solver->SetSolver(Solver::Cholesky);
  solver->Update();
  const std::vector<double> exact = Unknowns(solver);
  for (int kind : { Solver::ConjugateGradients, Solver::VCycles })
  {
    SCOPED_TRACE(kind);
    solver->SetSolver(kind);
    solver->SetCoarseSpace(Solver::StructurePreserving); // linear levels would be samples
    solver->Update();
    EXPECT_EQ(Values(solver->GetOutput()->GetFieldData(), "LevelUnknowns").size(), 3u);
    EXPECT_EQ(Converged(solver), 1);
    EXPECT_LT(Difference(Unknowns(solver), exact), 1e-7);
  }
}

// Files number points and cells as they like; so does the solver inside.
TEST_P(AnyField, DoesNotDependOnTheOrderOfPointsAndCells)
{
  const Surface surface = IrregularTorus(40, 24, 5);
  const Relabelled relabelled = Relabel(surface, 12);
  const Vectors given{ { 10, { 1.0, 0.5, -0.25 } }, { 700, { -0.5, 0.25, 1.0 } } };
  Vectors relabelledGiven = given;
  for (auto& [cell, vector] : relabelledGiven)
  {
    cell = relabelled.NewFaces[cell];
  }
  const auto input = PolyDataOf(surface);
  AddCellVectors(input, "Given", given);
  const auto relabelledInput = PolyDataOf(relabelled.Result);
  AddCellVectors(relabelledInput, "Given", relabelledGiven);
  const auto solver = NewSolver(input, GetParam());
  const auto other = NewSolver(relabelledInput, GetParam());
  const auto point = [&relabelled](vtkIdType id) { return relabelled.NewVertices[id]; };
  const auto cell = [&relabelled](vtkIdType id) { return relabelled.NewFaces[id]; };
  for (Solver* s : { solver.Get(), other.Get() })
  {
    s->SetTolerance(1e-12);
    s->UnitLengthOff();
    s->Update();
    ASSERT_EQ(Converged(s), 1);
  }

  // Which of the N directions is the first is a matter of where combing starts.
  const auto expectDirections = [](vtkDataSetAttributes* a, vtkDataSetAttributes* b, auto number)
  {
    const int N = a->HasArray("Direction1") ? 4 : 1;
    for (vtkIdType i = 0; i < a->GetNumberOfTuples(); ++i)
    {
      const Vector3 expected = Tuple(a, "Direction0", i);
      double nearest = std::numeric_limits<double>::infinity();
      for (int k = 0; k < N; ++k)
      {
        const Vector3 direction = Tuple(b, "Direction" + std::to_string(k), number(i));
        nearest = std::min(nearest, (direction - expected).norm());
      }
      ASSERT_LT(nearest, 1e-7 * expected.norm()) << i;
    }
  };
  expectDirections(solver->GetOutput()->GetCellData(), other->GetOutput()->GetCellData(), cell);
  expectDirections(solver->GetOutput()->GetPointData(), other->GetOutput()->GetPointData(), point);
  const bool areOnCells = GetParam() == Solver::PointPowerField;
  const auto indicesOf = [areOnCells](Solver* of)
  {
    vtkDataSetAttributes* const cells = of->GetOutput()->GetCellData();
    vtkDataSetAttributes* const points = of->GetOutput()->GetPointData();
    return Values(areOnCells ? cells : points, "SingularityIndex");
  };
  const std::vector<double> indices = indicesOf(solver);
  const std::vector<double> otherIndices = indicesOf(other);
  for (std::size_t i = 0; i < indices.size(); ++i)
  {
    EXPECT_NEAR(otherIndices[areOnCells ? cell(i) : point(i)], indices[i], 1e-12);
  }

  const char* const name = GetParam() == Solver::OneForm ? "OneForm" : "Rotation";
  const std::vector<double> onEdges = Values(Edges(solver)->GetCellData(), name);
  const std::vector<double> otherOnEdges = Values(Edges(other)->GetCellData(), name);
  const std::map<Edge, int> numbers = EdgesOf(input), otherNumbers = EdgesOf(relabelledInput);
  ASSERT_EQ(onEdges.size(), numbers.size());
  ASSERT_EQ(otherOnEdges.size(), numbers.size());
  const double scale = *std::max_element(onEdges.begin(), onEdges.end());
  for (const auto& [edge, number] : numbers)
  {
    const int a = point(edge.first), b = point(edge.second);
    const double sign = a < b ? 1.0 : -1.0;
    const int otherNumber = otherNumbers.at(std::minmax<vtkIdType>({ a, b }));
    EXPECT_NEAR(sign * otherOnEdges[otherNumber], onEdges[number], 1e-7 * scale);
  }
}

TEST_P(AnyField, OfNestedIterationsComesCloserToThatOfCholesky)
{
  for (int space : { Solver::LinearInterpolation, Solver::StructurePreserving })
  {
    SCOPED_TRACE(space);
    const auto solver = NewSolver(SphereWithOperators(), GetParam());
    solver->SetCoarseSpace(space);
    solver->SetSolver(Solver::Cholesky);
    solver->Update();
    const double exact = LastEnergy(solver);
    solver->SetSolver(Solver::CoarseProlongation);
    solver->Update();
    const double sketch = LastEnergy(solver);
    EXPECT_GT(sketch, exact);

    solver->SetSolver(Solver::NestedIterations);
    const Messages messages(solver);
    solver->Update();
    EXPECT_TRUE(messages.Silent());
    EXPECT_LT(LastEnergy(solver), sketch);
    EXPECT_GT(LastEnergy(solver), exact);
  }
}

// A surface that is too small for coarse levels is factored, whatever the solver.
TEST_P(AnyField, OfASurfaceOfOneLevelIsFactored)
{
  const auto solver = NewSolver(Sphere(), GetParam());
  solver->SetSolver(Solver::Cholesky);
  solver->Update();
  const std::vector<double> exact = Unknowns(solver);
  for (int kind : { Solver::VCycles, Solver::ConjugateGradients, Solver::NestedIterations, Solver::CoarseProlongation })
  {
    solver->SetSolver(kind);
    const Messages messages(solver);
    solver->Update();
    EXPECT_TRUE(messages.Silent()) << messages.Error();
    EXPECT_EQ(Unknowns(solver), exact);
    auto* const report = vtkStringArray::SafeDownCast(solver->GetOutput()->GetFieldData()->GetAbstractArray("Solver"));
    EXPECT_NE(report->GetValue(0).find("because there are no coarse levels"), std::string::npos) << report->GetValue(0);
  }
}
