#include "vtkHarmonicFieldSolver.h"

#include "TestTools.h"

#include "vtkDirectionalProlongation.h"
#include "vtkIdList.h"
#include "vtkIntArray.h"
#include "vtkPartitionedDataSetCollection.h"
#include "vtkStringArray.h"
#include "vtkTable.h"
#include "vtkXMLPolyDataReader.h"
#include "vtkXMLPolyDataWriter.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <set>

using namespace dmg;
using namespace dmg::test;

namespace
{

using Solver = vtkHarmonicFieldSolver;

constexpr int OnCells = vtkDataObject::FIELD_ASSOCIATION_CELLS;

vtkSmartPointer<Solver> NewSolver(vtkPolyData* input, int discretisation)
{
  auto solver = vtkSmartPointer<Solver>::New();
  solver->SetInputData(input);
  solver->SetInputArrayToProcess(1, 0, 0, OnCells, "Given");
  solver->SetDiscretisation(discretisation);
  solver->SetTolerance(1e-8);
  return solver;
}

/// A sphere on which two cells are prescribed, of 1280 faces unless said otherwise.
vtkSmartPointer<vtkPolyData> Sphere(int subdivisions = 3)
{
  auto input = PolyDataOf(Icosphere(subdivisions));
  AddCellVectors(input, "Given", { { 10, { 1.0, 0.5, -0.25 } }, { 200, { -0.5, 0.25, 1.0 } } });
  return input;
}

/// Of a surface with few faces, three levels at most.
vtkSmartPointer<vtkDirectionalProlongation> NewProlongation(vtkPolyData* input)
{
  auto prolongation = vtkSmartPointer<vtkDirectionalProlongation>::New();
  prolongation->SetInputData(input);
  prolongation->SetMinimumNumberOfFaces(60);
  prolongation->SetMaximumNumberOfCoarseLevels(2);
  return prolongation;
}

/// The sphere with all operators of three levels.
vtkSmartPointer<vtkPolyData> SphereWithOperators()
{
  const auto prolongation = NewProlongation(Sphere());
  prolongation->FaceFieldsOn();
  prolongation->OneFormsOn();
  prolongation->Update();
  return prolongation->GetOutput();
}

vtkPolyData* Edges(Solver* solver)
{
  return vtkPolyData::SafeDownCast(solver->GetOutputDataObject(1));
}

vtkTable* Convergence(Solver* solver)
{
  return vtkTable::SafeDownCast(solver->GetOutputDataObject(2));
}

/// The numbers that a field of any kind is made of.
std::vector<double> Unknowns(Solver* solver)
{
  switch (solver->GetDiscretisation())
  {
    case Solver::OneForm:
      return Values(Edges(solver)->GetCellData(), "OneForm");
    case Solver::FaceField:
      return Values(solver->GetOutput()->GetCellData(), "FaceField");
    default:
      return Values(solver->GetOutput()->GetCellData(), "PowerField");
  }
}

/// Largest difference of two arrays, over the largest entry of the second.
double Difference(const std::vector<double>& a, const std::vector<double>& b)
{
  double difference =
    a.size() == b.size() && !b.empty() ? 0.0 : std::numeric_limits<double>::infinity();
  double scale = 0.0;
  for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i)
  {
    difference = std::max(difference, std::abs(a[i] - b[i]));
    scale = std::max(scale, std::abs(b[i]));
  }
  return difference / scale;
}

using Counts = std::array<int, 3>; // set-ups, systems, solves

Counts CountsOf(Solver* solver)
{
  return { solver->GetNumberOfSetups(), solver->GetNumberOfSystems(), solver->GetNumberOfSolves() };
}

void ExpectEmpty(Solver* solver)
{
  EXPECT_EQ(solver->GetOutput()->GetNumberOfCells(), 0);
  EXPECT_EQ(solver->GetOutput()->GetFieldData()->GetNumberOfArrays(), 0);
  EXPECT_EQ(Edges(solver)->GetNumberOfCells(), 0);
  EXPECT_EQ(Convergence(solver)->GetNumberOfColumns(), 0);
}

int Converged(Solver* solver)
{
  return vtkIntArray::SafeDownCast(
    solver->GetOutput()->GetFieldData()->GetAbstractArray("Converged"))
    ->GetValue(0);
}

using Edge = std::pair<vtkIdType, vtkIdType>; // smaller point first

/// The edges in the documented order, with their numbers.
std::map<Edge, int> EdgesOf(vtkPolyData* surface)
{
  std::map<Edge, int> edges;
  vtkNew<vtkIdList> ids;
  for (vtkIdType cell = 0; cell < surface->GetNumberOfCells(); ++cell)
  {
    surface->GetCellPoints(cell, ids);
    for (int k = 0; k < 3; ++k)
    {
      edges[std::minmax({ ids->GetId(k), ids->GetId((k + 1) % 3) })] = 0;
    }
  }
  int number = 0;
  for (auto& edge : edges)
  {
    edge.second = number++;
  }
  return edges;
}

Vector3 Along(vtkPolyData* surface, const Edge& edge)
{
  return Vector3(surface->GetPoint(edge.second)) - Vector3(surface->GetPoint(edge.first));
}

/// The two discretisations whose unknowns are vectors, not powers.
class VectorField : public testing::TestWithParam<int>
{
};

std::string NameOf(const testing::TestParamInfo<int>& info)
{
  const char* const names[] = { "PowerField", "FaceField", "OneForm" };
  return names[info.param];
}

INSTANTIATE_TEST_SUITE_P(
  Discretisations, VectorField, testing::Values(Solver::FaceField, Solver::OneForm), NameOf);

}

// The field
// -----------------------------------------------------------------------------------------

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
  vtkPolyData* const output = solver->GetOutput();
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
  const Vector3 given = 2.5 *
    (Along(input, { ids->GetId(0), ids->GetId(1) }) + Along(input, { ids->GetId(0), ids->GetId(2) }));
  AddCellVectors(input, "Given", { { 33, given } });
  const auto solver = NewSolver(input, GetParam());
  solver->UnitLengthOff();
  solver->Update();
  for (double turning : Values(Edges(solver)->GetCellData(), "Turning"))
  {
    ASSERT_NEAR(turning, 0.0, 1e-7);
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
  EXPECT_LT((Tuple(solver->GetOutput()->GetCellData(), "Direction0", 33) - given).norm(),
    1e-7 * given.norm());
}

TEST_P(VectorField, HasIndicesThatSumToTheEulerCharacteristic)
{
  const std::pair<Surface, double> surfaces[] = { { IrregularSphere(3, 11), 2.0 },
    { IrregularTorus(24, 16, 5), 0.0 }, { DoubleTorus(3), -2.0 } };
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
      expected[edges.at(std::minmax({ ids->GetId(k), ids->GetId((k + 1) % 3) }))] +=
        0.5 * weights->GetValue(cell);
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
      EXPECT_NEAR(
        form[number], strength * (grid.V(edge.second, 0) - grid.V(edge.first, 0)), 1e-14);
    }
  }
}

TEST_P(VectorField, HasOneDirectionAndNoArraysOfOtherFields)
{
  const auto crosses = NewSolver(Sphere(), Solver::PowerField);
  crosses->Update();
  ASSERT_TRUE(crosses->GetOutput()->GetCellData()->HasArray("Prescribed"));
  const auto solver = NewSolver(crosses->GetOutput(), GetParam());
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
  EXPECT_EQ(vtkIntArray::SafeDownCast(
              solver->GetOutput()->GetFieldData()->GetAbstractArray("NumberOfDirections"))
              ->GetValue(0),
    1);
}

// Solvers
// --------------------------------------------------------------------------------------------

TEST_P(VectorField, IsTheSameByEverySolver)
{
  const auto input = SphereWithOperators();
  auto* const vertices = vtkIntArray::SafeDownCast(
    input->GetFieldData()->GetAbstractArray("Prolongation.NumbersOfVertices"));
  ASSERT_TRUE(vertices);
  ASSERT_EQ(vertices->GetNumberOfValues(), 3);
  const auto solver = NewSolver(input, GetParam());
  solver->SetTolerance(1e-12);
  solver->SetMaximumNumberOfIterations(2000);
  solver->SetSolver(Solver::Cholesky);
  solver->Update();
  const std::vector<double> exact = Unknowns(solver);
  for (int kind : { Solver::ConjugateGradients, Solver::VCycles })
  {
    for (int space : { Solver::Nodal, Solver::StructurePreserving })
    {
      SCOPED_TRACE(std::to_string(kind) + ", " + std::to_string(space));
      solver->SetSolver(kind);
      solver->SetCoarseSpace(space);
      solver->SetStartingLevel(space == Solver::Nodal ? 1 : -1); // with -1, nodal levels would be samples
      solver->Update();
      const std::vector<double> levels =
        Values(solver->GetOutput()->GetFieldData(), "LevelUnknowns");
      if (space == Solver::Nodal) // vectors at vertices, the first few of which can be factored
      {
        ASSERT_EQ(levels.size(), 2u);
        EXPECT_EQ(levels[1], 2.0 * vertices->GetValue(1));
      }
      else
      {
        EXPECT_EQ(levels.size(), 3u);
      }
      EXPECT_EQ(Converged(solver), 1);
      EXPECT_LT(Difference(Unknowns(solver), exact), 1e-7);
    }
  }
}

namespace
{

std::vector<double> Column(Solver* solver, const char* name)
{
  return Values(Convergence(solver)->GetRowData(), name);
}

class AnyField : public VectorField
{
};

INSTANTIATE_TEST_SUITE_P(Discretisations, AnyField,
  testing::Values(Solver::PowerField, Solver::FaceField, Solver::OneForm), NameOf);

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
  const auto expectDirections = [](vtkDataSetAttributes* a, vtkDataSetAttributes* b, auto number) {
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
  const auto indices = Values(solver->GetOutput()->GetPointData(), "SingularityIndex");
  const auto otherIndices = Values(other->GetOutput()->GetPointData(), "SingularityIndex");
  for (std::size_t i = 0; i < indices.size(); ++i)
  {
    EXPECT_NEAR(otherIndices[point(i)], indices[i], 1e-12);
  }

  const char* const name = GetParam() == Solver::OneForm ? "OneForm" : "Turning";
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
  for (int space : { Solver::Nodal, Solver::StructurePreserving })
  {
    SCOPED_TRACE(space);
    const auto solver = NewSolver(SphereWithOperators(), GetParam());
    solver->SetCoarseSpace(space);
    solver->SetSolver(Solver::CoarseProlongation);
    solver->Update();
    EXPECT_FALSE(Convergence(solver)->GetRowData()->HasArray("Error"));
    solver->CompareWithCholeskyOn();
    solver->Update();
    ASSERT_FALSE(Column(solver, "Error").empty());
    const double sketch = Column(solver, "Error").back();
    EXPECT_GT(sketch, 0.0);

    solver->SetSolver(Solver::NestedIterations);
    solver->SetNestedCycles(0);
    for (int rule : { Solver::FixedNumber, Solver::WhileErrorFalls, Solver::WhileResidualFalls })
    {
      SCOPED_TRACE(rule);
      solver->SetNestedRule(rule);
      const Messages messages(solver);
      solver->Update();
      EXPECT_TRUE(messages.Silent());
      const std::vector<double> errors = Column(solver, "Error");
      ASSERT_GE(errors.size(), 2u);
      EXPECT_LT(errors.back(), errors.front());
      EXPECT_LT(errors.back(), sketch);
    }
  }
}

// Every level exactly as fine as the start is solved at once.
TEST_P(AnyField, StartedOnTheFinestLevelIsExact)
{
  const auto solver = NewSolver(SphereWithOperators(), GetParam());
  solver->SetSolver(Solver::Cholesky);
  solver->Update();
  const std::vector<double> exact = Unknowns(solver);
  solver->SetSolver(Solver::CoarseProlongation);
  solver->SetStartingLevel(0);
  solver->Update();
  EXPECT_LT(Difference(Unknowns(solver), exact), 1e-7);
  EXPECT_EQ(Values(solver->GetOutput()->GetFieldData(), "LevelUnknowns").size(), 1u);
}

// A surface that is too small for coarse levels is factored, whatever the solver.
TEST_P(AnyField, OfASurfaceOfOneLevelIsFactored)
{
  const auto solver = NewSolver(Sphere(), GetParam());
  solver->SetSolver(Solver::Cholesky);
  solver->Update();
  const std::vector<double> exact = Unknowns(solver);
  for (int kind : { Solver::VCycles, Solver::ConjugateGradients, Solver::NestedIterations,
         Solver::CoarseProlongation })
  {
    solver->SetSolver(kind);
    const Messages messages(solver);
    solver->Update();
    EXPECT_TRUE(messages.Silent()) << messages.Error();
    EXPECT_EQ(Unknowns(solver), exact);
    auto* const report = vtkStringArray::SafeDownCast(
      solver->GetOutput()->GetFieldData()->GetAbstractArray("Solver"));
    EXPECT_NE(report->GetValue(0).find("because there are no coarse levels"), std::string::npos)
      << report->GetValue(0);
  }
}

// What a change costs
// -------------------------------------------------------------------------------

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
    [](Solver* s) { s->SetVertexAreas(Solver::Barycentric); },
    [](Solver* s) { s->SetStartingLevel(1); },
    [](Solver* s) { s->SetCoarseSpace(Solver::Nodal); },
    [](Solver* s) { s->CompareWithCholeskyOn(); },
    [](Solver* s) { s->SetSolver(Solver::NestedIterations); },
    [](Solver* s) { s->SetNestedRule(Solver::WhileResidualFalls); },
    [](Solver* s) { s->SetMaximumNumberOfNestedSweeps(5); },
    [](Solver* s) { s->SetNestedSweeps(5); },
    [](Solver* s) { s->SetNestedCycles(0); },
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
  EXPECT_EQ(counts(Solver::PowerField, Solver::Nodal), (Counts{ 1, 1, 1 })); // takes samples
  EXPECT_EQ(counts(Solver::FaceField, Solver::Nodal), (Counts{ 2, 2, 2 }));  // others
  EXPECT_EQ(counts(Solver::OneForm, Solver::Nodal), (Counts{ 3, 3, 3 }));    // forgotten meanwhile
  EXPECT_EQ(counts(Solver::OneForm, Solver::StructurePreserving), (Counts{ 4, 4, 4 }));
  EXPECT_EQ(counts(Solver::FaceField, Solver::StructurePreserving), (Counts{ 5, 5, 5 }));
  EXPECT_EQ(counts(Solver::OneForm, Solver::StructurePreserving), (Counts{ 5, 6, 6 })); // kept
  EXPECT_EQ(counts(Solver::OneForm, Solver::Nodal), (Counts{ 5, 7, 7 })); // what was made of the samples
  EXPECT_EQ(counts(Solver::PowerField, Solver::Nodal), (Counts{ 5, 8, 8 })); // kept, too
}

// Operators
// ------------------------------------------------------------------------------------------

TEST_P(VectorField, OfStoredOperatorsIsThatOfTheOriginalsToTheBit)
{
  const std::string path =
    testing::TempDir() + "StoredOperators" + std::to_string(GetParam()) + ".vtp";
  const auto input = SphereWithOperators();
  vtkNew<vtkXMLPolyDataWriter> writer;
  writer->SetFileName(path.c_str());
  writer->SetInputData(input);
  writer->SetDataModeToBinary(); // see README, "Files"
  ASSERT_EQ(writer->Write(), 1);
  vtkNew<vtkXMLPolyDataReader> reader;
  reader->SetFileName(path.c_str());
  reader->Update();
  std::remove(path.c_str());
  const auto before = NewSolver(input, GetParam());
  const auto after = NewSolver(reader->GetOutput(), GetParam());
  for (Solver* solver : { before.Get(), after.Get() })
  {
    solver->SetSolver(Solver::ConjugateGradients);
    solver->SetCoarseSpace(Solver::StructurePreserving);
    solver->Update();
    EXPECT_EQ(Values(solver->GetOutput()->GetFieldData(), "LevelUnknowns").size(), 3u);
  }
  EXPECT_EQ(Unknowns(before), Unknowns(after));
}

TEST_P(AnyField, NamesThePropertyThatMissingOperatorsTake)
{
  const auto prolongation = NewProlongation(Sphere());
  prolongation->PowerFieldsOff();
  const auto solver = NewSolver(nullptr, GetParam());
  solver->SetInputConnection(prolongation->GetOutputPort());
  solver->SetSolver(Solver::ConjugateGradients);
  solver->SetCoarseSpace(Solver::StructurePreserving);
  Messages messages(solver);
  solver->Update();
  const char* const properties[] = { "Power Fields", "Face Fields", "One Forms" };
  EXPECT_NE(messages.Error().find(std::string("Directional Prolongation (vtkDirectionalProlongation) with ") +
              properties[GetParam()] + " on"),
    std::string::npos)
    << messages.Error();
  ExpectEmpty(solver);

  messages.Forget();
  prolongation->SetPowerFields(GetParam() == Solver::PowerField);
  prolongation->SetFaceFields(GetParam() == Solver::FaceField);
  prolongation->SetOneForms(GetParam() == Solver::OneForm);
  solver->Update();
  EXPECT_TRUE(messages.Silent()) << messages.Error();
  EXPECT_EQ(solver->GetOutput()->GetNumberOfCells(), 1280);
  EXPECT_EQ(solver->GetNumberOfSolves(), 1);
}

TEST_P(VectorField, OfDamagedOperatorsIsRefused)
{
  vtkNew<vtkPolyData> input;
  input->DeepCopy(SphereWithOperators());
  const std::string name = std::string("Prolongation.") +
    (GetParam() == Solver::OneForm ? "S1" : "SX") + ".1.Values";
  auto* const values =
    vtkDoubleArray::SafeDownCast(input->GetFieldData()->GetAbstractArray(name.c_str()));
  ASSERT_TRUE(values);
  const double good = values->GetValue(3);
  values->SetValue(3, std::numeric_limits<double>::infinity());
  const auto solver = NewSolver(input, GetParam());
  solver->SetSolver(Solver::ConjugateGradients);
  solver->SetCoarseSpace(Solver::StructurePreserving);
  Messages messages(solver);
  solver->Update();
  EXPECT_NE(messages.Error().find("'" + name + "' holds a value"), std::string::npos)
    << messages.Error();
  ExpectEmpty(solver);

  messages.Forget();
  values->SetValue(3, good);
  input->Modified();
  solver->Update();
  EXPECT_TRUE(messages.Silent()) << messages.Error();
  EXPECT_EQ(solver->GetOutput()->GetNumberOfCells(), 1280);
}

namespace
{

/// A real operator of field data times a vector.
std::vector<double> Product(
  vtkFieldData* data, const std::string& name, const std::vector<double>& x)
{
  const auto array = [data, &name](const char* part)
  { return data->GetAbstractArray(("Prolongation." + name + "." + part).c_str()); };
  auto* const offsets = vtkIntArray::SafeDownCast(array("Offsets"));
  auto* const columns = vtkIntArray::SafeDownCast(array("Columns"));
  auto* const values = vtkDoubleArray::SafeDownCast(array("Values"));
  std::vector<double> result(offsets->GetNumberOfValues() - 1, 0.0);
  for (std::size_t row = 0; row < result.size(); ++row)
  {
    for (int i = offsets->GetValue(row); i < offsets->GetValue(row + 1); ++i)
    {
      result[row] += values->GetValue(i) * x.at(columns->GetValue(i));
    }
  }
  return result;
}

/// Differences along the edges, in the documented order and orientation.
std::vector<double> Differences(vtkPolyData* surface, const std::vector<double>& function)
{
  std::vector<double> differences;
  for (const auto& edge : EdgesOf(surface))
  {
    differences.push_back(function.at(edge.first.second) - function.at(edge.first.first));
  }
  return differences;
}

class Construction : public testing::TestWithParam<int>
{
};

INSTANTIATE_TEST_SUITE_P(DirectionalProlongation, Construction,
  testing::Values(
    vtkDirectionalProlongation::TrackedPaths, vtkDirectionalProlongation::ExactOverlay),
  [](const testing::TestParamInfo<int>& info)
  { return std::string(info.param ? "ExactOverlay" : "TrackedPaths"); });

}

// Any program can read the arrays: gradients stay gradients on edges numbered as documented.
TEST_P(Construction, CarriesGradientsBetweenTheLevels)
{
  const auto prolongation = NewProlongation(PolyDataOf(IrregularSphere(2, 3)));
  prolongation->SetConstruction(GetParam());
  prolongation->OneFormsOn();
  prolongation->Update();
  vtkFieldData* const data = prolongation->GetOutput()->GetFieldData();
  auto* const levels =
    vtkPartitionedDataSetCollection::SafeDownCast(prolongation->GetOutputDataObject(1));
  ASSERT_GE(levels->GetNumberOfPartitionedDataSets(), 2u);
  EXPECT_EQ(Values(data, "Prolongation.Options").at(4), GetParam());
  for (unsigned int level = 0; level + 1 < levels->GetNumberOfPartitionedDataSets(); ++level)
  {
    auto* const fine = vtkPolyData::SafeDownCast(levels->GetPartition(level, 0));
    auto* const coarse = vtkPolyData::SafeDownCast(levels->GetPartition(level + 1, 0));
    std::vector<double> function(coarse->GetNumberOfPoints());
    for (std::size_t i = 0; i < function.size(); ++i)
    {
      function[i] = std::sin(3.0 * i * i);
    }
    const std::string suffix = "." + std::to_string(level);
    EXPECT_LT(Difference(Product(data, "S1" + suffix, Differences(coarse, function)),
                Differences(fine, Product(data, "S0" + suffix, function))),
      1e-11);
  }
}

TEST_P(Construction, ServesEveryDiscretisation)
{
  const auto prolongation = NewProlongation(Sphere(2));
  prolongation->SetConstruction(GetParam());
  prolongation->FaceFieldsOn();
  prolongation->OneFormsOn();
  for (int discretisation : { Solver::PowerField, Solver::FaceField, Solver::OneForm })
  {
    const auto solver = NewSolver(nullptr, discretisation);
    solver->SetInputConnection(prolongation->GetOutputPort());
    solver->SetTolerance(1e-12);
    solver->SetSolver(Solver::Cholesky);
    solver->Update();
    const std::vector<double> exact = Unknowns(solver);
    solver->SetSolver(Solver::ConjugateGradients);
    for (int space : { Solver::Nodal, Solver::StructurePreserving })
    {
      solver->SetCoarseSpace(space);
      solver->SetStartingLevel(1); // else nodal levels would be samples
      solver->Update();
      EXPECT_EQ(Values(solver->GetOutput()->GetFieldData(), "LevelUnknowns").size(), 2u);
      EXPECT_LT(Difference(Unknowns(solver), exact), 1e-7);
    }
  }
  EXPECT_EQ(prolongation->GetNumberOfSetups(), 1);
}

TEST(DirectionalProlongation, EverySelectionCounts)
{
  const auto prolongation = NewProlongation(Sphere(2));
  prolongation->Update();
  const auto names = [&prolongation]
  {
    std::set<std::string> found;
    vtkFieldData* const data = prolongation->GetOutput()->GetFieldData();
    for (const char* name : { "S0", "S1", "SX", "SP", "Nodal" })
    {
      if (data->HasArray(("Prolongation." + std::string(name) + ".0.Values").c_str()))
      {
        found.insert(name);
      }
    }
    return found;
  };
  using Names = std::set<std::string>;
  EXPECT_EQ(names(), (Names{ "S0", "SP", "Nodal" }));
  int setups = 1;
  const std::pair<std::function<void(vtkDirectionalProlongation*)>, Names> changes[] = {
    { [](auto* p) { p->OneFormsOn(); }, { "S0", "S1", "SP", "Nodal" } },
    { [](auto* p) { p->FaceFieldsOn(); }, { "S0", "S1", "SX", "SP", "Nodal" } },
    { [](auto* p) { p->PowerFieldsOff(); }, { "S0", "S1", "SX", "Nodal" } },
    { [](auto* p) { p->SetConstruction(1); }, { "S0", "S1", "SX", "Nodal" } },
  };
  for (const auto& [change, expected] : changes)
  {
    change(prolongation);
    prolongation->Update();
    EXPECT_EQ(names(), expected);
    EXPECT_EQ(prolongation->GetNumberOfSetups(), ++setups);
  }
}

// Harmonic basis
// -------------------------------------------------------------------------------------

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
    given.push_back({ face,
      (surface.V.row(surface.F(face, 1)) - surface.V.row(surface.F(face, 0))).transpose() });
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
  auto* const size = vtkIntArray::SafeDownCast(
    solver->GetOutputDataObject(port)->GetFieldData()->GetAbstractArray("HarmonicBasisSize"));
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
      Along(surface, { ids->GetId(0), ids->GetId(1) })
        .cross(Along(surface, { ids->GetId(0), ids->GetId(2) }))
        .norm();
    sum +=
      area * Tuple(surface->GetCellData(), a, cell).dot(Tuple(surface->GetCellData(), b, cell));
  }
  return sum;
}

}

TEST_P(VectorField, HasAnOrthonormalHarmonicBasis)
{
  const std::pair<Surface, int> surfaces[] = { { IrregularTorus(24, 16, 5), 2 },
    { DoubleTorus(3), 4 }, { Annulus(20, 4), 1 }, { IrregularSphere(3, 11), 0 },
    { IrregularPlane(8, 6, 1), 0 } };
  for (const auto& [surface, dimension] : surfaces)
  {
    SCOPED_TRACE(dimension);
    const auto input = WithThreeGiven(surface);
    const auto solver = NewSolver(input, GetParam());
    solver->HarmonicBasisOn();
    const Messages messages(solver);
    solver->Update();
    ASSERT_TRUE(messages.Silent()) << messages.Error();
    vtkPolyData* const output = solver->GetOutput();
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
  vtkPolyData* const output = solver->GetOutput();
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
  { return solver->GetOutput()->GetCellData()->GetAbstractArray("HarmonicBasis 1"); };
  solver->Update();
  EXPECT_EQ(CountsOf(solver), (Counts{ 1, 1, 1 }));
  EXPECT_EQ(NumberOfBasisArrays(solver->GetOutput()), 0);
  EXPECT_EQ(BasisSize(solver), -1);
  const std::vector<double> field = Unknowns(solver);

  solver->HarmonicBasisOn();
  solver->Update();
  EXPECT_EQ(CountsOf(solver), (Counts{ 1, 1, 1 }));
  EXPECT_EQ(Unknowns(solver), field);
  const vtkSmartPointer<vtkAbstractArray> kept = firstArray();
  ASSERT_TRUE(kept);

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
  EXPECT_EQ(NumberOfBasisArrays(solver->GetOutput()), 0);
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
  EXPECT_EQ(NumberOfBasisArrays(solver->GetOutput()), 4);
}

TEST(PowerField, HasNoHarmonicBasis)
{
  const auto solver = NewSolver(WithThreeGiven(IrregularTorus(24, 16, 5)), Solver::PowerField);
  solver->HarmonicBasisOn();
  const Messages messages(solver);
  solver->Update();
  EXPECT_TRUE(messages.Silent());
  EXPECT_EQ(NumberOfBasisArrays(solver->GetOutput()), 0);
  EXPECT_EQ(BasisSize(solver), -1);
}

// A basis that the input brought along is that of an earlier solver.
TEST_P(VectorField, ReplacesTheHarmonicBasisOfItsInput)
{
  const auto first = NewSolver(WithThreeGiven(DoubleTorus(3)), GetParam());
  first->HarmonicBasisOn();
  first->Update();
  ASSERT_EQ(NumberOfBasisArrays(first->GetOutput()), 4);
  vtkNew<vtkPolyData> input;
  input->DeepCopy(first->GetOutput());
  input->GetCellData()->AddArray(Zeros("HarmonicBasis 5", input->GetNumberOfCells(), 3));
  input->GetCellData()->AddArray(Zeros("HarmonicBasis 5 of mine", input->GetNumberOfCells(), 3));
  const auto second = NewSolver(input, GetParam());
  second->Update();
  EXPECT_EQ(NumberOfBasisArrays(second->GetOutput()), 1);
  EXPECT_TRUE(second->GetOutput()->GetCellData()->HasArray("HarmonicBasis 5 of mine"));
  EXPECT_EQ(BasisSize(second), -1);
  second->HarmonicBasisOn();
  second->Update();
  EXPECT_EQ(NumberOfBasisArrays(second->GetOutput()), 5);
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
  for (vtkPolyData* input :
    { nothingGiven.Get(), triangle.Get(), moebius.Get(), degenerate.Get(), empty.Get() })
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
      (grid.V.row(grid.F(face, 0)) + grid.V.row(grid.F(face, 1)) + grid.V.row(grid.F(face, 2)))
        .transpose() /
      3.0;
    const bool isHole =
      static_cast<int>(centre[0]) % 2 == 1 && static_cast<int>(centre[1]) % 2 == 1;
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
  EXPECT_NE(messages.GetWarnings()[0].find("3025 harmonic fields"), std::string::npos)
    << messages.GetWarnings()[0];
  EXPECT_EQ(solver->GetOutput()->GetNumberOfCells(), faces);
  EXPECT_EQ(NumberOfBasisArrays(solver->GetOutput()), 0);
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
  EXPECT_NEAR(Integral(solver->GetOutput(), "HarmonicBasis 2", "HarmonicBasis 2"), 1.0, 1e-12);
}

// Abort
// ----------------------------------------------------------------------------------------------

TEST_P(VectorField, AbortedInAnyStageLeavesNothingAndIsWholeTheNextTime)
{
  const auto input = Sphere(4);
  const auto newSolver = [&input]
  {
    const auto solver = NewSolver(input, GetParam());
    solver->SetSolver(Solver::ConjugateGradients);
    solver->SetCoarseSpace(Solver::StructurePreserving);
    return solver;
  };
  const auto uninterrupted = newSolver();
  uninterrupted->Update();
  const std::pair<double, Counts> stages[] = { { 0.2, { 0, 0, 0 } }, { 0.51, { 1, 0, 0 } },
    { 0.71, { 1, 1, 0 } }, { 0.91, { 1, 1, 1 } } };
  for (const auto& [fraction, done] : stages)
  {
    SCOPED_TRACE(fraction);
    const auto solver = newSolver();
    {
      const Messages messages(solver);
      const AbortAt abort(solver, fraction);
      solver->Update();
      EXPECT_TRUE(abort.Asked());
      EXPECT_TRUE(messages.Silent());
    }
    ExpectEmpty(solver);
    EXPECT_EQ(CountsOf(solver), done);
    solver->Update(); // nothing else has changed
    EXPECT_EQ(CountsOf(solver), (Counts{ 1, 1, 1 }));
    EXPECT_EQ(Unknowns(solver), Unknowns(uninterrupted));
  }
}
