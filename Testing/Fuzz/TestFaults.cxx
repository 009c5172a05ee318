// Memory that runs out, aborts at any moment, two filters at once: an error or a whole result, and a process that goes on.

#include "Support/FailingRequests.h"
#include "Support/SolverOfUnknowns.h"
#include "vtkHarmonicFieldSolver.h"
#include "vtkHodgeDecomposition.h"

#include "FieldSolver.h"
#include "TestTools.h"

#include "vtkDirectionalProlongation.h"
#include "vtkFieldAngles.h"
#include "vtkFieldGlyphs.h"
#include "vtkFieldLines.h"
#include "vtkFieldQuads.h"
#include "vtkFieldSingularities.h"
#include "vtkParallelTransport.h"
#include "vtkPrincipalDirections.h"
#include "vtkScaleFilter.h"
#include "vtkSurfaceDistance.h"

#include <SuiteSparse_config.h>
#include <gtest/gtest.h>

#include <atomic>
#include <cstdlib>
#include <random>
#include <thread>
#include <utility>

using namespace dmg;
using namespace dmg::test;

// Memory: the n-th request of the executing thread fails, in the core, or in the library of the filters. There, requests
// of VTK's own libraries are spared, whose lists and arrays do not survive that: they leave objects half made, or end the
// process.
// ----------------------------------------------------------------------------------------------

namespace
{

thread_local long long requests = 0;   ///< counted while failing >= 0
thread_local long long failing = -1;   ///< the request that fails; 0: none
thread_local bool isOfFilters = false; ///< only requests from the code of their library count

const CodeRange codeOfFilters = CodeOf("FiltersDirectionalFields");
const CodeRange codeOfOpenMp = CodeOf("libgomp"); // which ends the process if there is no memory

}

bool dmg::test::Fails(const void* caller)
{
  return failing >= 0 && (!isOfFilters || codeOfFilters.Contains(caller)) && !codeOfOpenMp.Contains(caller) &&
    ++requests == failing;
}

namespace
{

constexpr int OnCells = vtkDataObject::FIELD_ASSOCIATION_CELLS;
constexpr int OnPoints = vtkDataObject::FIELD_ASSOCIATION_POINTS;

vtkSmartPointer<vtkPolyData> Given(const Surface& surface)
{
  auto input = PolyDataOf(surface);
  AddCellVectors(input, "Given", { { 10, { 1.0, 0.5, -0.25 } }, { 150, { -0.5, 0.25, 1.0 } } });
  return input;
}

vtkSmartPointer<vtkHarmonicFieldSolver> NewSolver(vtkPolyData* input, int discretisation, int kind)
{
  const auto solver = vtkSmartPointer<vtkHarmonicFieldSolver>::New();
  solver->SetInputData(input);
  solver->SetInputArrayToProcess(1, 0, 0, OnCells, "Given");
  solver->SetDiscretisation(discretisation);
  solver->SetSolver(kind);
  return solver;
}

std::vector<double> FieldOf(vtkAlgorithm* solver)
{
  vtkDataObject* const output = solver->GetOutputDataObject(0);
  return Values(output->GetAttributesAsFieldData(vtkDataObject::CELL), "Direction0");
}

/// The first requests, and others ever farther apart.
std::vector<long long> Some(long long all, int dense = 60)
{
  std::vector<long long> some;
  for (long long number = 1; number <= all; number += 1 + number / dense)
  {
    some.push_back(number);
  }
  return some;
}

}

namespace
{

/// What CHOLMOD asks for memory.
void LetCholmodCall(void* (*allocate)(std::size_t))
{
#if SUITESPARSE_MAIN_VERSION >= 7 // functions in place of a structure
  SuiteSparse_config_malloc_func_set(allocate);
#else
  SuiteSparse_config.malloc_func = allocate;
#endif
}

}

// The core survives the failure of any request.
TEST(Memory, ThatRunsOutInTheCoreIsAnExceptionAndTheNextSolveIsWhole)
{
  const TriangleMesh mesh = Torus(20, 16).Mesh();
  Constraints directions;
  directions.OnFaces = { { 10, { 1.0, 0.5, -0.25 }, 1.0 }, { 200, { -0.5, 0.25, 1.0 }, 1.0 } };
  for (const auto kind : { DiscretisationKind::PowerField, DiscretisationKind::FaceField, DiscretisationKind::OneForm })
  {
    for (const auto& [space, solverKind] :
      { std::pair(CoarseSpaceKind::LinearInterpolation, SolverKind::ConjugateGradients),
        std::pair(CoarseSpaceKind::StructurePreserving, SolverKind::ConjugateGradients),
        std::pair(CoarseSpaceKind::LinearInterpolation, SolverKind::Cholesky) })
    {
      FieldOptions options;
      options.Field.Kind = kind;
      options.CoarseSpace = space;
      options.Solver.Kind = solverKind;
      requests = 0;
      failing = 0;
      SolverOfUnknowns whole(mesh);
      const Vector<double> expected = whole.Solve(directions, options, {});
      failing = -1;
      int errors = 0;
      for (const long long number : Some(requests))
      {
        SCOPED_TRACE(testing::Message() << "request " << number);
        SolverOfUnknowns solver(mesh);
        requests = 0;
        failing = number;
        try
        {
          solver.Solve(directions, options, {});
        }
        catch (const std::exception&)
        {
          ++errors;
        }
        failing = -1;
        ASSERT_EQ(solver.Solve(directions, options, {}), expected);
      }
      EXPECT_GT(errors, 50);
    }
  }
}

namespace
{

/// Of all cells and points of all outputs.
std::vector<double> AllNumbers(vtkAlgorithm* filter)
{
  std::vector<double> all;
  for (int port = 0; port < filter->GetNumberOfOutputPorts(); ++port)
  {
    for (const int kind : { OnCells, OnPoints })
    {
      vtkFieldData* const arrays = filter->GetOutputDataObject(port)->GetAttributesAsFieldData(kind);
      for (int k = 0; arrays && k < arrays->GetNumberOfArrays(); ++k)
      {
        const std::vector<double> values = Values(arrays, arrays->GetAbstractArray(k)->GetName());
        all.insert(all.end(), values.begin(), values.end());
      }
    }
  }
  return all;
}

/// Filters of every kind, on one surface.
std::vector<vtkSmartPointer<vtkAlgorithm>> AllFilters(vtkPolyData* input)
{
  std::vector<vtkSmartPointer<vtkAlgorithm>> all;
  for (int discretisation = 0; discretisation < 4; ++discretisation)
  {
    const auto solver = NewSolver(input, discretisation, vtkHarmonicFieldSolver::ConjugateGradients);
    solver->SetInputArrayToProcess(3, 0, 0, OnPoints, discretisation == 3 ? "Values" : "");
    solver->SetInputData(1, Given(Torus(12, 8)));
    solver->SetGuideArrayToProcess(1, 1, 0, OnCells, "Given");
    solver->SetHarmonicBasis(true);
    solver->SetCurvatureWeight(discretisation == 0 ? 1.0 : 0.0);
    all.push_back(solver);
  }
  const auto singular = NewSolver(input, 0, vtkHarmonicFieldSolver::Automatic);
  singular->SetInputData(2, vtkNew<vtkPolyData>());
  const auto prolongation = vtkSmartPointer<vtkDirectionalProlongation>::New();
  prolongation->FaceFieldsOn();
  prolongation->OneFormsOn();
  prolongation->SetMinimumNumberOfFaces(50);
  prolongation->SetInputData(input);
  all.insert(all.end(), { singular, prolongation });
  const auto distance = vtkSmartPointer<vtkSurfaceDistance>::New();
  distance->SetInputData(input);
  distance->AddInputDataObject(1, Given(Torus(12, 8))); // its points, brought to the surface
  distance->AddInputDataObject(2, PolyDataOf(Torus(6, 4)));
  all.push_back(distance);
  const std::initializer_list<vtkSmartPointer<vtkAlgorithm>> drawings = { vtkSmartPointer<vtkFieldLines>::New(),
    vtkSmartPointer<vtkFieldGlyphs>::New(), vtkSmartPointer<vtkFieldSingularities>::New(),
    vtkSmartPointer<vtkFieldAngles>::New(), vtkSmartPointer<vtkPrincipalDirections>::New(),
    vtkSmartPointer<vtkHodgeDecomposition>::New(), vtkSmartPointer<vtkParallelTransport>::New(),
    vtkSmartPointer<vtkScaleFilter>::New() };
  for (const auto& drawing : drawings)
  {
    drawing->SetInputDataObject(input);
    drawing->SetInputArrayToProcess(0, 0, 0, OnCells, "Everywhere");
    all.push_back(drawing);
  }
  return all;
}

/// Every cell and point has something.
vtkSmartPointer<vtkPolyData> SmallTorus()
{
  const auto input = Given(Torus(32, 20));
  const auto everywhere = Zeros("Everywhere", input->GetNumberOfCells(), 3);
  const auto values = Zeros("Values", input->GetNumberOfPoints(), 1);
  for (vtkIdType cell = 0; cell < input->GetNumberOfCells(); ++cell)
  {
    everywhere->SetTuple3(cell, 1.0, 0.3, 0.1);
  }
  for (vtkIdType point = 0; point < input->GetNumberOfPoints(); ++point)
  {
    values->SetValue(point, 1.0 * (point % 7));
  }
  input->GetCellData()->AddArray(everywhere);
  input->GetPointData()->AddArray(values);
  return input;
}

}

TEST(Memory, ThatRunsOutInAFilterIsAnErrorAndTheNextUpdateIsWhole)
{
  ASSERT_GT(codeOfFilters.End, codeOfFilters.Begin);
  const auto input = SmallTorus();
  const std::size_t kinds = AllFilters(input).size();
  for (std::size_t kind = 0; kind < kinds; ++kind)
  {
    const auto update = [kind](vtkAlgorithm* filter, long long number)
    {
      const Messages messages(filter);
      requests = 0;
      isOfFilters = true;
      failing = number;
      filter->Update();
      failing = -1;
      isOfFilters = false;
      return messages.Error();
    };
    const auto whole = AllFilters(input)[kind];
    SCOPED_TRACE(testing::Message() << whole->GetClassName() << ' ' << kind);
    ASSERT_EQ(update(whole, 0), "");
    const long long all = requests;
    const std::vector<double> expected = AllNumbers(whole);
    ASSERT_FALSE(expected.empty());
    int errors = 0;
    for (const long long number : Some(all, 10))
    {
      SCOPED_TRACE(testing::Message() << "request " << number << " of " << all);
      const auto filter = AllFilters(input)[kind];
      const std::string error = update(filter, number);
      errors += !error.empty();
      if (error.empty())
      {
        ASSERT_EQ(AllNumbers(filter), expected);
        continue;
      }
      ASSERT_EQ(filter->GetOutputDataObject(0)->GetNumberOfElements(vtkDataObject::CELL), 0);
      filter->Modified();
      ASSERT_EQ(update(filter, 0), "");
      ASSERT_EQ(AllNumbers(filter), expected);
    }
    EXPECT_GT(errors, 10);
  }
}

namespace
{

void* NoMoreThanFourMegabytes(std::size_t size)
{
  return size > 4000000 ? nullptr : __libc_malloc(size);
}

}

TEST(Memory, ThatTheFactorLacksIsAnErrorAndConjugateGradientsHelp)
{
  const auto solver = NewSolver(Given(Torus(100, 60)), 0, vtkHarmonicFieldSolver::Cholesky);
  const Messages messages(solver);
  LetCholmodCall(NoMoreThanFourMegabytes);
  solver->Update();
  EXPECT_NE(messages.Error().find("choose Conjugate Gradients as Solver"), std::string::npos) << messages.Error();
  EXPECT_TRUE(FieldOf(solver).empty());
  solver->SetSolver(vtkHarmonicFieldSolver::ConjugateGradients);
  solver->Update();
  EXPECT_FALSE(FieldOf(solver).empty());
  LetCholmodCall(__libc_malloc);
}

TEST(Memory, ThatFactorsOfQuadsLackIsAnErrorWithARemedyThatQuadsHave)
{
  vtkNew<vtkFieldQuads> quads;
  quads->SetInputData(PolyDataOf(Torus(100, 60)));
  quads->SetNumberOfQuads(500);
  const Messages messages(quads);
  LetCholmodCall(NoMoreThanFourMegabytes);
  quads->Update();
  LetCholmodCall(__libc_malloc);
  EXPECT_NE(messages.Error().find("do not fit into memory"), std::string::npos) << messages.Error();
  EXPECT_EQ(messages.Error().find("Solver"), std::string::npos) << messages.Error();
  EXPECT_EQ(quads->GetOutput()->GetNumberOfCells(), 0);
  quads->SetInputData(PolyDataOf(Torus(24, 12)));
  quads->Update();
  EXPECT_GT(quads->GetOutput()->GetNumberOfCells(), 0);
}

// Aborts
// ----------------------------------------------------------------------------------------------

TEST(Abort, AtAnyMomentLeavesNothingAndTheNextRunIsWhole)
{
  constexpr unsigned Seed = 20261125;
  SCOPED_TRACE(Seed);
  std::mt19937 random(Seed);
  const auto torus = Given(Torus(40, 30));
  const auto sphere = Given(Icosphere(4)); // its triangles are even, so there is no note of sheared ones
  using Solver = vtkHarmonicFieldSolver;
  for (const auto& [discretisation, input] :
    std::vector<std::pair<int, vtkSmartPointer<vtkPolyData>>>{ { Solver::PointPowerField, torus },
      { Solver::PowerField, sphere }, { Solver::FaceField, torus }, { Solver::OneForm, torus } })
  {
    const auto solver = NewSolver(input, discretisation, vtkHarmonicFieldSolver::ConjugateGradients);
    const auto whole = NewSolver(input, discretisation, vtkHarmonicFieldSolver::ConjugateGradients);
    whole->Update();
    for (int trial = 0; trial < 20; ++trial)
    {
      const double fraction = random() / static_cast<double>(random.max());
      SCOPED_TRACE(fraction);
      const auto fresh = NewSolver(input, discretisation, vtkHarmonicFieldSolver::ConjugateGradients);
      {
        const Messages messages(fresh);
        const AbortAt abort(fresh, fraction);
        fresh->Update();
        EXPECT_TRUE(messages.Silent());
        if (abort.Asked() && fraction < 0.9)
        {
          EXPECT_EQ(fresh->GetOutput()->GetNumberOfCells(), 0);
        }
      }
      fresh->Modified();
      fresh->Update();
      ASSERT_EQ(FieldOf(fresh), FieldOf(whole));
    }
  }
}

// Threads
// ----------------------------------------------------------------------------------------------

TEST(TwoFilters, InTwoThreadsGiveTheBitsOfOne)
{
  const vtkSmartPointer<vtkPolyData> inputs[] = { Given(Torus(40, 30)), Given(Icosphere(4)) };
  std::vector<double> expected[2], found[2];
  for (int discretisation = 0; discretisation < 3; ++discretisation)
  {
    const auto solve = [&inputs, discretisation](int i)
    {
      const auto solver = NewSolver(inputs[i], discretisation, vtkHarmonicFieldSolver::ConjugateGradients);
      solver->Update();
      return FieldOf(solver);
    };
    for (int i = 0; i < 2; ++i)
    {
      expected[i] = solve(i);
      ASSERT_FALSE(expected[i].empty());
    }
    for (int trial = 0; trial < 5; ++trial)
    {
      std::thread other([&] { found[1] = solve(1); });
      found[0] = solve(0);
      other.join();
      EXPECT_EQ(found[0], expected[0]);
      EXPECT_EQ(found[1], expected[1]);
    }
  }
}
