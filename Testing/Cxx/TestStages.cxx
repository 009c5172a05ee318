// Which stages of a solver a change repeats, and what an abort leaves of them.

#include "vtkHarmonicFieldSolver.h"

#include "SolverTools.h"

#include "vtkDirectionalProlongation.h"
#include "vtkTable.h"

#include <gtest/gtest.h>

#include <functional>
#include <utility>
#include <vector>

using namespace dmg;
using namespace dmg::test;

// What a change costs
// -------------------------------------------------------------------------------

class Stages : public testing::Test
{
protected:
  void SetUp() override
  {
    this->Solver->SetSolver(vtkHarmonicFieldSolver::ConjugateGradients);
    this->Solver->SetCoarseSpace(vtkHarmonicFieldSolver::StructurePreserving);
    this->Solver->Update();
    ASSERT_EQ(CountsOf(this->Solver), (Counts{ 1, 1, 1 }));
  }

  /// A solver without a past gives the same field to the tolerance.
  void ExpectSameAsFresh()
  {
    const auto fresh = NewSolver(vtkPolyData::SafeDownCast(this->Solver->GetInput()));
    fresh->SetSolver(vtkHarmonicFieldSolver::Cholesky);
    fresh->SetNumberOfDirections(this->Solver->GetNumberOfDirections());
    fresh->SetAlignment(this->Solver->GetAlignment());
    fresh->SetConstraintType(this->Solver->GetConstraintType());
    fresh->Update();
    EXPECT_LT(Difference(CellValues(this->Solver, "PowerField"), CellValues(fresh, "PowerField")), 1e-5);
  }

  vtkSmartPointer<vtkPolyData> Input = SphereWithOperators();
  vtkSmartPointer<vtkHarmonicFieldSolver> Solver = NewSolver(this->Input);
};

TEST_F(Stages, ArrayAddedUpstreamRepeatsNothing)
{
  AddCellVectors(this->Input, "Later", {});
  this->Input->Modified();
  this->Solver->Update();
  EXPECT_EQ(CountsOf(this->Solver), (Counts{ 1, 1, 1 }));
  EXPECT_TRUE(this->Solver->GetOutput()->GetCellData()->HasArray("Later"));
}

TEST_F(Stages, OutputOptionsRepeatNothing)
{
  const std::vector<double> unit = CellValues(this->Solver, "Direction0");
  this->Solver->UnitLengthOff();
  this->Solver->CombingOff();
  this->Solver->Update();
  EXPECT_EQ(CountsOf(this->Solver), (Counts{ 1, 1, 1 }));
  EXPECT_NE(CellValues(this->Solver, "Direction0"), unit);
}

TEST_F(Stages, SameContentInOtherObjectsRepeatsNothing)
{
  vtkNew<vtkPolyData> copy;
  copy->DeepCopy(this->Input);
  this->Solver->SetInputData(copy);
  this->Solver->Update();
  EXPECT_EQ(CountsOf(this->Solver), (Counts{ 1, 1, 1 }));
  EXPECT_EQ(this->Solver->GetPolyDataOutput()->GetPoints(), copy->GetPoints());
}

TEST_F(Stages, AnotherValueOnlySolves)
{
  const double turned[] = { 0.5, -0.25, 1.0 };
  this->Input->GetCellData()->GetArray("Given")->SetTuple(10, turned);
  this->Input->GetCellData()->GetArray("Given")->Modified();
  this->Input->Modified();
  this->Solver->Update();
  EXPECT_EQ(CountsOf(this->Solver), (Counts{ 1, 1, 2 }));
  this->ExpectSameAsFresh();
}

TEST_F(Stages, ASolveStartsFromTheSolutionBefore)
{
  const vtkIdType iterations = Convergence(this->Solver)->GetNumberOfRows() - 1;
  auto* const given = this->Input->GetCellData()->GetArray("Given");
  given->SetComponent(10, 0, 1.001 * given->GetComponent(10, 0));
  this->Input->Modified();
  this->Solver->Update();
  EXPECT_EQ(CountsOf(this->Solver), (Counts{ 1, 1, 2 }));
  EXPECT_LT(Convergence(this->Solver)->GetValueByName(0, "RelativeResidual").ToDouble(), 1e-2);
  EXPECT_LT(Convergence(this->Solver)->GetNumberOfRows() - 1, iterations);
}

TEST_F(Stages, AnotherToleranceOnlySolves)
{
  this->Solver->SetTolerance(1e-10);
  this->Solver->Update();
  EXPECT_EQ(CountsOf(this->Solver), (Counts{ 1, 1, 2 }));
  const vtkIdType last = Convergence(this->Solver)->GetNumberOfRows() - 1;
  EXPECT_LE(Convergence(this->Solver)->GetValueByName(last, "RelativeResidual").ToDouble(), 1e-10);
  this->Solver->SetMaximumNumberOfIterations(50);
  this->Solver->Update();
  EXPECT_EQ(CountsOf(this->Solver), (Counts{ 1, 1, 3 }));
}

TEST_F(Stages, AMovedConstraintRepeatsTheSystem)
{
  const double zero[] = { 0.0, 0.0, 0.0 }, given[] = { 1.0, 0.5, -0.25 };
  this->Input->GetCellData()->GetArray("Given")->SetTuple(10, zero);
  this->Input->GetCellData()->GetArray("Given")->SetTuple(11, given);
  this->Input->Modified();
  this->Solver->Update();
  EXPECT_EQ(CountsOf(this->Solver), (Counts{ 1, 2, 2 }));
  this->ExpectSameAsFresh();
}

TEST_F(Stages, OtherWeightsStartFromTheFieldBefore)
{
  this->Solver->SetAlignment(1.001);
  this->Solver->Update();
  EXPECT_EQ(CountsOf(this->Solver), (Counts{ 1, 2, 2 }));
  EXPECT_LT(Convergence(this->Solver)->GetValueByName(0, "RelativeResidual").ToDouble(), 1e-2);
  this->ExpectSameAsFresh();
}

TEST_F(Stages, EveryOptionOfTheSystemRepeatsIt)
{
  int systems = 1;
  const std::function<void(vtkHarmonicFieldSolver*)> changes[] = {
    [](vtkHarmonicFieldSolver* s) { s->SetNumberOfDirections(6); },
    [](vtkHarmonicFieldSolver* s) { s->SetExpectedSolves(2); },
    [](vtkHarmonicFieldSolver* s) { s->SetAlignment(3.0); },
    [](vtkHarmonicFieldSolver* s) { s->SetConstraintType(vtkHarmonicFieldSolver::Hard); },
    [](vtkHarmonicFieldSolver* s) { s->SetSolver(vtkHarmonicFieldSolver::VCycles); },
  };
  for (const auto& change : changes)
  {
    change(this->Solver);
    this->Solver->Update();
    ++systems;
    EXPECT_EQ(CountsOf(this->Solver), (Counts{ 1, systems, systems }));
    this->ExpectSameAsFresh();
  }
  const auto weights = Zeros("Weights", 1280, 1);
  weights->Fill(2.0);
  this->Input->GetCellData()->AddArray(weights);
  this->Solver->SetInputArrayToProcess(2, 0, 0, OnCells, "Weights");
  this->Solver->Update();
  EXPECT_EQ(this->Solver->GetNumberOfSystems(), systems + 1);
}

TEST_F(Stages, OlderSurfaceSwappedInIsNotServedTheLastResult)
{
  const auto older = Sphere();
  const auto newer = PolyDataOf(IrregularSphere(3, 5));
  AddCellVectors(newer, "Given", { { 10, { 1.0, 0.5, -0.25 } } });
  this->Solver->SetInputData(newer);
  this->Solver->Update();
  EXPECT_EQ(CountsOf(this->Solver), (Counts{ 2, 2, 2 }));
  ASSERT_LT(older->GetMTime(), newer->GetMTime());
  this->Solver->SetInputData(older);
  this->Solver->Update();
  EXPECT_EQ(CountsOf(this->Solver), (Counts{ 3, 3, 3 }));
  this->ExpectSameAsFresh();
}

TEST_F(Stages, OtherOperatorsOfTheSameSurfaceRepeatTheSetup)
{
  vtkNew<vtkDirectionalProlongation> prolongation;
  prolongation->SetInputData(this->Input);
  prolongation->SetMinimumNumberOfFaces(60);
  prolongation->SetFaceRatio(0.5);
  this->Solver->SetInputConnection(prolongation->GetOutputPort());
  this->Solver->Update();
  EXPECT_EQ(CountsOf(this->Solver), (Counts{ 2, 2, 2 }));
  this->Solver->SetInputData(this->Input); // its levels are kept, what was solved on them is not
  this->Solver->Update();
  EXPECT_EQ(CountsOf(this->Solver), (Counts{ 2, 3, 3 }));
  this->ExpectSameAsFresh();
}

TEST(HarmonicFieldSolver, CholeskyNeedsNoOperators)
{
  const auto solver = NewSolver(Sphere());
  solver->SetSolver(vtkHarmonicFieldSolver::Cholesky);
  solver->Update();
  EXPECT_EQ(CountsOf(solver), (Counts{ 1, 1, 1 }));
  solver->SetSolver(vtkHarmonicFieldSolver::ConjugateGradients); // now they are built
  solver->Update();
  EXPECT_EQ(CountsOf(solver), (Counts{ 2, 2, 2 }));
  solver->SetSolver(vtkHarmonicFieldSolver::Cholesky); // and kept
  solver->Update();
  EXPECT_EQ(CountsOf(solver), (Counts{ 2, 3, 3 }));
}

TEST_P(VectorField, RepeatsWhatAChangeConcerns)
{
  const auto input = SphereWithOperators();
  const auto solver = NewSolver(input, GetParam());
  solver->SetSolver(Solver::ConjugateGradients);
  solver->SetCoarseSpace(Solver::StructurePreserving);
  solver->Update();
  EXPECT_EQ(CountsOf(solver), (Counts{ 1, 1, 1 }));

  input->GetCellData()->GetArray("Given")->SetTuple3(10, 0.5, -0.25, 1.0);
  input->Modified();
  solver->Update();
  EXPECT_EQ(CountsOf(solver), (Counts{ 1, 1, 2 }));

  const auto weights = Zeros("Weights", 1280, 1);
  weights->Fill(2.0);
  input->GetCellData()->AddArray(weights);
  solver->SetInputArrayToProcess(2, 0, 0, OnCells, "Weights");
  solver->Update();
  EXPECT_EQ(CountsOf(solver), (Counts{ 1, 2, 3 }));

  int systems = 2;
  const std::function<void(Solver*)> changes[] = {
    [](Solver* s) { s->SetSolver(Solver::VCycles); },
    [](Solver* s) { s->SetSolver(Solver::NestedIterations); },
  };
  for (const auto& change : changes)
  {
    change(solver);
    solver->Update();
    ++systems;
    EXPECT_EQ(CountsOf(solver), (Counts{ 1, systems, systems + 1 }));
  }
}

TEST(Discretisation, AnotherRepeatsTheSystemAndDecimatesOnlyForOperatorsThatAreMissing)
{
  const auto solver = NewSolver(Sphere(4), Solver::PowerField);
  solver->SetSolver(Solver::ConjugateGradients);
  const auto counts = [&solver](int discretisation, int space)
  {
    solver->SetDiscretisation(discretisation);
    solver->SetCoarseSpace(space);
    solver->Update();
    return CountsOf(solver);
  };
  EXPECT_EQ(counts(Solver::PowerField, Solver::LinearInterpolation), (Counts{ 1, 1, 1 })); // takes samples
  EXPECT_EQ(counts(Solver::FaceField, Solver::LinearInterpolation), (Counts{ 2, 2, 2 }));  // others
  EXPECT_EQ(counts(Solver::OneForm, Solver::LinearInterpolation), (Counts{ 3, 3, 3 }));    // forgotten meanwhile
  EXPECT_EQ(counts(Solver::OneForm, Solver::StructurePreserving), (Counts{ 4, 4, 4 }));
  EXPECT_EQ(counts(Solver::FaceField, Solver::StructurePreserving), (Counts{ 5, 5, 5 }));
  EXPECT_EQ(counts(Solver::OneForm, Solver::StructurePreserving), (Counts{ 5, 6, 6 })); // kept
  EXPECT_EQ(counts(Solver::OneForm, Solver::LinearInterpolation), (Counts{ 5, 7, 7 })); // what was made of the samples
  EXPECT_EQ(counts(Solver::PowerField, Solver::LinearInterpolation), (Counts{ 5, 8, 8 })); // kept, too
}

// Abort
// ----------------------------------------------------------------------------------------------

TEST(HarmonicFieldSolver, AbortKeepsWhatWasComplete)
{
  const auto input = Sphere(4);
  const auto solver = NewSolver(input);
  solver->SetSolver(vtkHarmonicFieldSolver::ConjugateGradients);
  solver->Update();
  const std::vector<double> before = CellValues(solver, "PowerField");
  // In the set-up, and after it.
  for (const auto& [fraction, setups] : { std::pair(0.2, 1), std::pair(0.51, 2) })
  {
    solver->SetNumberOfDirections(5);
    {
      const AbortAt abort(solver, fraction);
      solver->Update();
      ASSERT_TRUE(abort.Asked());
    }
    ExpectEmpty(solver);
    solver->SetNumberOfDirections(4);
    solver->Update();
    EXPECT_EQ(CountsOf(solver), (Counts{ setups, 1, 1 }));
    EXPECT_EQ(CellValues(solver, "PowerField"), before);
  }
}
