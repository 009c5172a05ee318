// The harmonic basis of face fields and 1-forms.

#include "vtkHarmonicFieldSolver.h"

#include "SolverTools.h"
#include "SurfaceEdges.h"

#include "vtkIdList.h"
#include "vtkIntArray.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <utility>
#include <vector>

using namespace dmg;
using namespace dmg::test;

namespace
{

/// On which three cells are prescribed, along their first sides: one alone does not hold the four
/// harmonic fields of a double torus.
vtkSmartPointer<vtkPolyData> WithThreeGiven(const Surface& surface)
{
  auto input = PolyDataOf(surface);
  const int faces = static_cast<int>(surface.F.rows());
  Vectors given;
  for (int face : { 3, faces / 3, 2 * faces / 3 })
  {
    given.push_back({ face, (surface.V.row(surface.F(face, 1)) - surface.V.row(surface.F(face, 0))).transpose() });
  }
  AddCellVectors(input, "Given", given);
  return input;
}

std::string BasisName(int k)
{
  return "HarmonicBasis " + std::to_string(k);
}

/// HarmonicBasisSize; -1 where there is none.
int BasisSize(Solver* solver, int port = 0)
{
  auto* const size =
    vtkIntArray::SafeDownCast(solver->GetOutputDataObject(port)->GetFieldData()->GetAbstractArray("HarmonicBasisSize"));
  return size ? size->GetValue(0) : -1;
}

/// How many arrays of cells have names that begin as those of the basis do.
int NumberOfBasisArrays(vtkPolyData* data)
{
  int number = 0;
  for (int i = 0; i < data->GetCellData()->GetNumberOfArrays(); ++i)
  {
    number += std::string(data->GetCellData()->GetArrayName(i)).find("HarmonicBasis") == 0;
  }
  return number;
}

/// Sum over the cells of area times the product of two arrays of vectors.
double Integral(vtkPolyData* surface, const std::string& a, const std::string& b)
{
  double sum = 0.0;
  vtkNew<vtkIdList> ids;
  for (vtkIdType cell = 0; cell < surface->GetNumberOfCells(); ++cell)
  {
    surface->GetCellPoints(cell, ids);
    const double area = 0.5 *
      Along(surface, { ids->GetId(0), ids->GetId(1) }).cross(Along(surface, { ids->GetId(0), ids->GetId(2) })).norm();
    sum += area * Tuple(surface->GetCellData(), a, cell).dot(Tuple(surface->GetCellData(), b, cell));
  }
  return sum;
}

}

TEST_P(VectorField, HasAnOrthonormalHarmonicBasis)
{
  const std::pair<Surface, int> surfaces[] = { { IrregularTorus(24, 16, 5), 2 }, { DoubleTorus(3), 4 },
    { Annulus(20, 4), 1 }, { IrregularSphere(3, 11), 0 }, { IrregularPlane(8, 6, 1), 0 } };
  for (const auto& [surface, dimension] : surfaces)
  {
    SCOPED_TRACE(dimension);
    const auto input = WithThreeGiven(surface);
    const auto solver = NewSolver(input, GetParam());
    solver->HarmonicBasisOn();
    const Messages messages(solver);
    solver->Update();
    ASSERT_TRUE(messages.Silent()) << messages.Error();
    vtkPolyData* const output = solver->GetPolyDataOutput();
    EXPECT_EQ(BasisSize(solver), dimension);
    EXPECT_EQ(BasisSize(solver, 2), dimension);
    ASSERT_EQ(NumberOfBasisArrays(output), dimension);
    const bool isOneForm = GetParam() == Solver::OneForm;
    EXPECT_EQ(NumberOfBasisArrays(Edges(solver)), isOneForm ? dimension : 0);
    EXPECT_STREQ(output->GetCellData()->GetVectors()->GetName(), "Direction0");
    EXPECT_EQ(input->GetCellData()->GetNumberOfArrays(), 1);
    const std::map<Edge, int> edges = EdgesOf(input);
    for (int i = 1; i <= dimension; ++i)
    {
      for (int k = 1; k <= i; ++k)
      {
        EXPECT_NEAR(Integral(output, BasisName(i), BasisName(k)), i == k, 1e-12);
      }
      const std::vector<double> form = Values(Edges(solver)->GetCellData(), BasisName(i));
      vtkNew<vtkIdList> ids;
      for (vtkIdType cell = 0; isOneForm && cell < output->GetNumberOfCells(); ++cell)
      {
        // A closed form is the integral of its constant vector along the sides of a face.
        const Vector3 vector = Tuple(output->GetCellData(), BasisName(i), cell);
        input->GetCellPoints(cell, ids);
        for (int side = 0; side < 3; ++side)
        {
          const Edge edge = std::minmax({ ids->GetId(side), ids->GetId((side + 1) % 3) });
          ASSERT_NEAR(form.at(edges.at(edge)), vector.dot(Along(input, edge)), 1e-12);
        }
      }
    }
  }
}

// On a flat torus the field that one face asks for is parallel, and so in the span of the basis.
TEST_P(VectorField, IsASumOfTheHarmonicBasisOnAFlatTorus)
{
  const auto input = PolyDataOf(FlatTorus(8, 2));
  vtkNew<vtkIdList> ids;
  input->GetCellPoints(33, ids);
  AddCellVectors(input, "Given", { { 33, Along(input, { ids->GetId(0), ids->GetId(1) }) } });
  const auto solver = NewSolver(input, GetParam());
  solver->UnitLengthOff();
  solver->HarmonicBasisOn();
  solver->Update();
  vtkPolyData* const output = solver->GetPolyDataOutput();
  ASSERT_EQ(BasisSize(solver), 2);
  const double square = Integral(output, "Direction0", "Direction0");
  double squares = 0.0;
  for (int k = 1; k <= 2; ++k)
  {
    squares += std::pow(Integral(output, "Direction0", BasisName(k)), 2);
  }
  EXPECT_GT(square, 0.0);
  EXPECT_NEAR(squares, square, 1e-7 * square);
}

TEST_P(VectorField, HasItsHarmonicBasisWithoutRepeatingAnyStageAndOnce)
{
  const auto input = WithThreeGiven(IrregularTorus(24, 16, 5));
  const auto solver = NewSolver(input, GetParam());
  solver->SetSolver(Solver::ConjugateGradients);
  const auto firstArray = [&solver]
  {
    vtkDataArray* const array = solver->GetOutput()->GetCellData()->GetArray("HarmonicBasis 1");
    std::vector<double> values;
    for (vtkIdType i = 0; array && i < array->GetNumberOfTuples(); ++i)
    {
      values.push_back(array->GetComponent(i, 0));
    }
    return values;
  };
  solver->Update();
  EXPECT_EQ(CountsOf(solver), (Counts{ 1, 1, 1 }));
  EXPECT_EQ(NumberOfBasisArrays(solver->GetPolyDataOutput()), 0);
  EXPECT_EQ(BasisSize(solver), -1);
  const std::vector<double> field = Unknowns(solver);

  solver->HarmonicBasisOn();
  solver->Update();
  EXPECT_EQ(CountsOf(solver), (Counts{ 1, 1, 1 }));
  EXPECT_EQ(Unknowns(solver), field);
  const std::vector<double> kept = firstArray();
  ASSERT_FALSE(kept.empty());

  // Other values, weights and solvers leave it.
  input->GetCellData()->GetArray("Given")->SetTuple3(3, 0.5, -0.25, 1.0);
  input->Modified();
  solver->Update();
  EXPECT_EQ(CountsOf(solver), (Counts{ 1, 1, 2 }));
  EXPECT_EQ(firstArray(), kept);
  solver->SetAlignment(2.0);
  solver->SetSolver(Solver::Cholesky);
  solver->Update();
  EXPECT_EQ(CountsOf(solver), (Counts{ 1, 2, 3 }));
  EXPECT_EQ(firstArray(), kept);

  solver->HarmonicBasisOff();
  solver->Update();
  EXPECT_EQ(CountsOf(solver), (Counts{ 1, 2, 3 }));
  EXPECT_EQ(NumberOfBasisArrays(solver->GetPolyDataOutput()), 0);
  EXPECT_EQ(NumberOfBasisArrays(Edges(solver)), 0);
  EXPECT_EQ(BasisSize(solver), -1);
  solver->HarmonicBasisOn();
  solver->Update();
  EXPECT_EQ(firstArray(), kept);

  // Another discretisation and another surface have another.
  solver->SetDiscretisation(GetParam() == Solver::OneForm ? Solver::FaceField : Solver::OneForm);
  solver->Update();
  EXPECT_NE(firstArray(), kept);
  EXPECT_EQ(NumberOfBasisArrays(Edges(solver)), GetParam() == Solver::OneForm ? 0 : 2);
  solver->SetInputData(WithThreeGiven(DoubleTorus(3)));
  solver->Update();
  EXPECT_EQ(BasisSize(solver), 4);
  EXPECT_EQ(NumberOfBasisArrays(solver->GetPolyDataOutput()), 4);
}

TEST(PowerField, HasNoHarmonicBasis)
{
  const auto solver = NewSolver(WithThreeGiven(IrregularTorus(24, 16, 5)));
  solver->HarmonicBasisOn();
  const Messages messages(solver);
  solver->Update();
  EXPECT_TRUE(messages.Silent());
  EXPECT_EQ(NumberOfBasisArrays(solver->GetPolyDataOutput()), 0);
  EXPECT_EQ(BasisSize(solver), -1);
}

// A basis that the input brought along is that of an earlier solver.
TEST_P(VectorField, ReplacesTheHarmonicBasisOfItsInput)
{
  const auto first = NewSolver(WithThreeGiven(DoubleTorus(3)), GetParam());
  first->HarmonicBasisOn();
  first->Update();
  ASSERT_EQ(NumberOfBasisArrays(first->GetPolyDataOutput()), 4);
  vtkNew<vtkPolyData> input;
  input->DeepCopy(first->GetOutput());
  input->GetCellData()->AddArray(Zeros("HarmonicBasis 5", input->GetNumberOfCells(), 3));
  input->GetCellData()->AddArray(Zeros("HarmonicBasis 5 of mine", input->GetNumberOfCells(), 3));
  const auto second = NewSolver(input, GetParam());
  second->Update();
  EXPECT_EQ(NumberOfBasisArrays(second->GetPolyDataOutput()), 1);
  EXPECT_TRUE(second->GetOutput()->GetCellData()->HasArray("HarmonicBasis 5 of mine"));
  EXPECT_EQ(BasisSize(second), -1);
  second->HarmonicBasisOn();
  second->Update();
  EXPECT_EQ(NumberOfBasisArrays(second->GetPolyDataOutput()), 5);
  EXPECT_FALSE(second->GetOutput()->GetCellData()->HasArray("HarmonicBasis 5"));
  EXPECT_EQ(BasisSize(second), 4);
  EXPECT_EQ(NumberOfBasisArrays(input), 6);
}

// One triangle, no cells, nothing prescribed, triangles of no area: as without the basis.
TEST_P(VectorField, OfPoorInputFailsAsWithoutHarmonicBasis)
{
  const auto nothingGiven = PolyDataOf(IrregularTorus(24, 16, 5));
  AddCellVectors(nothingGiven, "Given", {});
  const auto triangle = PolyDataOf({ Points(Points::Identity(3, 3)), Triangles{ { 0, 1, 2 } } });
  AddCellVectors(triangle, "Given", { { 0, { 1.0, -1.0, 0.0 } } });
  const auto moebius = PolyDataOf(MoebiusStrip(9));
  AddCellVectors(moebius, "Given", { { 0, { 1.0, -1.0, 0.0 } } });
  const auto degenerate = WithThreeGiven(SphereWithZeroAreaFaces(2, 3));
  vtkNew<vtkPolyData> empty;
  for (vtkPolyData* input : { nothingGiven.Get(), triangle.Get(), moebius.Get(), degenerate.Get(), empty.Get() })
  {
    std::string errors[2];
    vtkIdType cells[2];
    for (bool on : { false, true })
    {
      const auto solver = NewSolver(input, GetParam());
      solver->SetHarmonicBasis(on);
      const Messages messages(solver);
      solver->Update();
      errors[on] = messages.Error();
      cells[on] = solver->GetOutput()->GetNumberOfCells();
      EXPECT_EQ(BasisSize(solver), on && cells[on] > 0 ? 0 : -1);
    }
    // A message begins with the place in the sources and the address of the filter.
    const auto text = [](const std::string& error) { return error.substr(error.find("): ") + 1); };
    EXPECT_EQ(text(errors[0]), text(errors[1]));
    EXPECT_EQ(cells[0], cells[1]);
  }
}

// A plate with 3025 holes has as many fields, on 18592 faces.
TEST_P(VectorField, HasNoHarmonicBasisWhereThatIsTooMuchToHold)
{
  const int size = 111;
  const Surface grid = PlaneGrid(size, size);
  Surface sieve{ grid.V, Triangles(2 * size * size - 2 * 55 * 55, 3) };
  int faces = 0;
  for (int face = 0; face < grid.F.rows(); ++face)
  {
    const Vector3 centre =
      (grid.V.row(grid.F(face, 0)) + grid.V.row(grid.F(face, 1)) + grid.V.row(grid.F(face, 2))).transpose() / 3.0;
    const bool isHole = static_cast<int>(centre[0]) % 2 == 1 && static_cast<int>(centre[1]) % 2 == 1;
    if (!isHole)
    {
      sieve.F.row(faces++) = grid.F.row(face);
    }
  }
  ASSERT_EQ(faces, sieve.F.rows());
  const auto input = PolyDataOf(sieve);
  AddCellVectors(input, "Given", {})->FillComponent(0, 1.0); // holds them all
  const auto solver = NewSolver(input, GetParam());
  solver->SetSolver(Solver::Cholesky);
  solver->HarmonicBasisOn();
  Messages messages(solver);
  solver->Update();
  EXPECT_EQ(messages.Error(), "");
  ASSERT_EQ(messages.GetWarnings().size(), 1u);
  EXPECT_NE(messages.GetWarnings()[0].find("3025 harmonic fields"), std::string::npos) << messages.GetWarnings()[0];
  EXPECT_EQ(solver->GetOutput()->GetNumberOfCells(), faces);
  EXPECT_EQ(NumberOfBasisArrays(solver->GetPolyDataOutput()), 0);
  EXPECT_EQ(BasisSize(solver), 0);

  messages.Forget(); // said once per surface
  input->GetCellData()->GetArray("Given")->SetTuple3(3, 0.5, -0.25, 1.0);
  input->Modified();
  solver->Update();
  EXPECT_TRUE(messages.Silent());
}

TEST_P(VectorField, AbortedInItsHarmonicBasisKeepsItsSolution)
{
  const auto input = WithThreeGiven(IrregularTorus(60, 40, 5));
  const auto solver = NewSolver(input, GetParam());
  solver->HarmonicBasisOn();
  for (double fraction : { 0.925, 0.95, 0.97, 0.99, 0.999 })
  {
    SCOPED_TRACE(fraction);
    const Messages messages(solver);
    const AbortAt abort(solver, fraction);
    solver->Update();
    EXPECT_TRUE(abort.Asked());
    EXPECT_TRUE(messages.Silent());
    ExpectEmpty(solver);
    EXPECT_EQ(CountsOf(solver), (Counts{ 1, 1, 1 }));
  }
  solver->Update();
  EXPECT_EQ(CountsOf(solver), (Counts{ 1, 1, 1 }));
  EXPECT_EQ(BasisSize(solver), 2);
  EXPECT_NEAR(Integral(solver->GetPolyDataOutput(), "HarmonicBasis 2", "HarmonicBasis 2"), 1.0, 1e-12);
}
