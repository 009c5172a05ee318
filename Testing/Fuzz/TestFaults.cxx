// Memory that runs out, aborts at any moment, two filters at once: an error or a whole result, and a process that goes on.

#include "vtkHarmonicFieldSolver.h"

#include "FieldSolver.h"
#include "TestTools.h"

#include <SuiteSparse_config.h>
#include <gtest/gtest.h>

#include <atomic>
#include <cerrno>
#include <cstdlib>
#include <random>
#include <thread>

using namespace dmg;
using namespace dmg::test;

// Memory: the n-th request of the executing thread fails, in the core. (VTK's own lists and arrays do not survive that:
// they leave objects half made, or end the process.)
// ----------------------------------------------------------------------------------------------

extern "C"
{
  void* __libc_malloc(std::size_t);
  void* __libc_calloc(std::size_t, std::size_t);
  void* __libc_realloc(void*, std::size_t);
  void* __libc_memalign(std::size_t, std::size_t);
}

namespace
{

thread_local long long requests = 0; ///< counted while failing >= 0
thread_local long long failing = -1; ///< the request that fails; 0: none
bool Fails()
{
  return failing >= 0 && ++requests == failing;
}

}

extern "C"
{
  void* malloc(std::size_t size)
  {
    return Fails() ? nullptr : __libc_malloc(size);
  }
  void* calloc(std::size_t number, std::size_t size)
  {
    return Fails() ? nullptr : __libc_calloc(number, size);
  }
  void* realloc(void* memory, std::size_t size)
  {
    return Fails() ? nullptr : __libc_realloc(memory, size);
  }
  void* aligned_alloc(std::size_t alignment, std::size_t size)
  {
    return Fails() ? nullptr : __libc_memalign(alignment, size);
  }
  int posix_memalign(void** memory, std::size_t alignment, std::size_t size)
  {
    *memory = Fails() ? nullptr : __libc_memalign(alignment, size);
    return *memory ? 0 : ENOMEM;
  }
}

namespace
{

constexpr int OnCells = vtkDataObject::FIELD_ASSOCIATION_CELLS;

vtkSmartPointer<vtkPolyData> Given(const Surface& surface)
{
  auto input = PolyDataOf(surface);
  AddCellVectors(input, "Given", { { 10, { 1.0, 0.5, -0.25 } }, { 200, { -0.5, 0.25, 1.0 } } });
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

std::vector<double> Field(vtkAlgorithm* solver)
{
  vtkDataObject* const output = solver->GetOutputDataObject(0);
  return Values(output->GetAttributesAsFieldData(vtkDataObject::CELL), "Direction0");
}

/// The first requests, and others ever farther apart.
std::vector<long long> Some(long long all)
{
  std::vector<long long> some;
  for (long long number = 1; number <= all; number += 1 + number / 60)
  {
    some.push_back(number);
  }
  return some;
}

}

namespace
{

/// CHOLMOD's cholmod_solve2 ends in a segmentation fault where its own requests fail; they do not, in these tests.
class SparesCholmod : public testing::Environment
{
  void SetUp() override
  {
    SuiteSparse_config.malloc_func = __libc_malloc;
    SuiteSparse_config.calloc_func = __libc_calloc;
    SuiteSparse_config.realloc_func = __libc_realloc;
  }
};

const testing::Environment* const sparesCholmod = testing::AddGlobalTestEnvironment(new SparesCholmod);

}

// The core survives the failure of any other request.
TEST(Memory, ThatRunsOutInTheCoreIsAnExceptionAndTheNextSolveIsWhole)
{
  const TriangleMesh mesh = Torus(20, 16).Mesh();
  PrescribedDirections directions;
  directions.OnFaces = { { 10, { 1.0, 0.5, -0.25 }, 1.0 }, { 200, { -0.5, 0.25, 1.0 }, 1.0 } };
  for (const auto kind : { DiscretisationKind::PowerField, DiscretisationKind::FaceField, DiscretisationKind::OneForm })
  {
    for (const auto space : { CoarseSpaceKind::Nodal, CoarseSpaceKind::StructurePreserving })
    {
      FieldOptions options;
      options.Field.Kind = kind;
      options.CoarseSpace = space;
      options.Solver.Kind = SolverKind::ConjugateGradients;
      requests = 0;
      failing = 0;
      FieldSolver whole(mesh);
      const Vector<double> expected = whole.Solve(directions, options, {});
      failing = -1;
      int errors = 0;
      for (const long long number : Some(requests))
      {
        SCOPED_TRACE(testing::Message() << "request " << number);
        FieldSolver solver(mesh);
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

void* NoMoreThanFourMegabytes(std::size_t size)
{
  return size > 4000000 ? nullptr : __libc_malloc(size);
}

}

TEST(Memory, ThatTheFactorLacksIsAnErrorAndConjugateGradientsHelp)
{
  const auto solver = NewSolver(Given(Torus(100, 60)), 0, vtkHarmonicFieldSolver::Cholesky);
  const Messages messages(solver);
  SuiteSparse_config.malloc_func = NoMoreThanFourMegabytes;
  solver->Update();
  EXPECT_NE(messages.Error().find("choose Conjugate Gradients as Solver"), std::string::npos) << messages.Error();
  EXPECT_TRUE(Field(solver).empty());
  solver->SetSolver(vtkHarmonicFieldSolver::ConjugateGradients);
  solver->Update();
  EXPECT_FALSE(Field(solver).empty());
  SuiteSparse_config.malloc_func = __libc_malloc;
}

// Aborts
// ----------------------------------------------------------------------------------------------

TEST(Abort, AtAnyMomentLeavesNothingAndTheNextRunIsWhole)
{
  constexpr unsigned Seed = 20261125;
  SCOPED_TRACE(Seed);
  std::mt19937 random(Seed);
  const auto input = Given(Torus(40, 30));
  for (int discretisation = 0; discretisation < 3; ++discretisation)
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
      ASSERT_EQ(Field(fresh), Field(whole));
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
    const auto solve = [&inputs, discretisation](int i) {
      const auto solver = NewSolver(inputs[i], discretisation, vtkHarmonicFieldSolver::ConjugateGradients);
      solver->Update();
      return Field(solver);
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
