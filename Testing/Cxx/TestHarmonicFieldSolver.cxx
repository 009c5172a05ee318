#include "vtkHarmonicFieldSolver.h"

#include "TestTools.h"

#include "vtkDirectionalProlongation.h"
#include "vtkIdList.h"
#include "vtkIntArray.h"
#include "vtkSMPTools.h"
#include "vtkStringArray.h"
#include "vtkTable.h"
#include "vtkXMLPolyDataReader.h"
#include "vtkXMLPolyDataWriter.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <map>

using namespace dmg;
using namespace dmg::test;

namespace
{

constexpr int OnPoints = vtkDataObject::FIELD_ASSOCIATION_POINTS;
constexpr int OnCells = vtkDataObject::FIELD_ASSOCIATION_CELLS;

vtkSmartPointer<vtkHarmonicFieldSolver> NewSolver(vtkPolyData* input, int association = OnCells)
{
  auto solver = vtkSmartPointer<vtkHarmonicFieldSolver>::New();
  solver->SetInputData(input);
  solver->SetInputArrayToProcess(1, 0, 0, association, "Given");
  solver->SetTolerance(1e-8);
  return solver;
}

/// A sphere of 1280 faces on which two cells are prescribed.
vtkSmartPointer<vtkPolyData> Sphere()
{
  auto input = PolyDataOf(Icosphere(3));
  AddCellVectors(input, "Given", { { 10, { 1.0, 0.5, -0.25 } }, { 900, { -0.5, 0.25, 1.0 } } });
  return input;
}

/// 5120 faces, for which the default options make a coarse level.
vtkSmartPointer<vtkPolyData> LargeSphere()
{
  auto input = PolyDataOf(Icosphere(4));
  AddCellVectors(input, "Given", { { 10, { 1.0, 0.5, -0.25 } }, { 900, { -0.5, 0.25, 1.0 } } });
  return input;
}

/// The first with operators of three levels.
vtkSmartPointer<vtkPolyData> SphereWithOperators()
{
  vtkNew<vtkDirectionalProlongation> prolongation;
  prolongation->SetInputData(Sphere());
  prolongation->SetMinimumNumberOfFaces(60);
  prolongation->Update();
  return prolongation->GetOutput();
}

vtkTable* Convergence(vtkHarmonicFieldSolver* solver)
{
  return vtkTable::SafeDownCast(solver->GetOutputDataObject(2));
}

vtkPolyData* Edges(vtkHarmonicFieldSolver* solver)
{
  return vtkPolyData::SafeDownCast(solver->GetOutputDataObject(1));
}

void ExpectEmpty(vtkHarmonicFieldSolver* solver)
{
  EXPECT_EQ(solver->GetOutput()->GetNumberOfPoints(), 0);
  EXPECT_EQ(solver->GetOutput()->GetNumberOfCells(), 0);
  EXPECT_EQ(solver->GetOutput()->GetFieldData()->GetNumberOfArrays(), 0);
  EXPECT_EQ(Edges(solver)->GetNumberOfCells(), 0);
  EXPECT_EQ(Convergence(solver)->GetNumberOfColumns(), 0);
}

int Converged(vtkHarmonicFieldSolver* solver)
{
  return vtkIntArray::SafeDownCast(
    solver->GetOutput()->GetFieldData()->GetAbstractArray("Converged"))
    ->GetValue(0);
}

std::vector<double> CellValues(vtkHarmonicFieldSolver* solver, const std::string& name)
{
  return Values(solver->GetOutput()->GetCellData(), name);
}

/// Largest difference of two arrays, over the largest entry of the second.
double Difference(const std::vector<double>& a, const std::vector<double>& b)
{
  double difference = a.size() == b.size() ? 0.0 : std::numeric_limits<double>::infinity();
  double scale = 0.0;
  for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i)
  {
    difference = std::max(difference, std::abs(a[i] - b[i]));
    scale = std::max(scale, std::abs(b[i]));
  }
  return difference / scale;
}

struct Counts
{
  int Setups, Systems, Solves;
  bool operator==(const Counts& other) const
  {
    return Setups == other.Setups && Systems == other.Systems && Solves == other.Solves;
  }
};

std::ostream& operator<<(std::ostream& os, const Counts& counts)
{
  return os << counts.Setups << " set-ups, " << counts.Systems << " systems, " << counts.Solves
            << " solves";
}

Counts CountsOf(vtkHarmonicFieldSolver* solver)
{
  return { solver->GetNumberOfSetups(), solver->GetNumberOfSystems(), solver->GetNumberOfSolves() };
}

}

// The field
// -----------------------------------------------------------------------------------------

class FieldOfN : public testing::TestWithParam<int>
{
};

INSTANTIATE_TEST_SUITE_P(HarmonicFieldSolver, FieldOfN, testing::Range(1, 9));

// On a plate, the smoothest field that follows one direction is parallel.
TEST_P(FieldOfN, IsParallelOnAPlate)
{
  const int N = GetParam();
  const auto input = PolyDataOf(IrregularPlane(12, 9, 7));
  const Vector3 given(3.0, 4.0, 100.0); // of length 5 in the plane
  AddCellVectors(input, "Given", { { 50, given } });
  const auto solver = NewSolver(input);
  solver->SetNumberOfDirections(N);
  solver->SetTolerance(1e-12);
  solver->UnitLengthOff();
  solver->Update();
  vtkPolyData* const output = solver->GetOutput();
  for (vtkDataSetAttributes* data : { static_cast<vtkDataSetAttributes*>(output->GetCellData()),
         static_cast<vtkDataSetAttributes*>(output->GetPointData()) })
  {
    EXPECT_STREQ(data->GetVectors()->GetName(), "Direction0");
    for (vtkIdType i = 0; i < data->GetNumberOfTuples(); ++i)
    {
      // One of the N is the given direction; each is the one before, turned by 2 pi / N.
      double nearest = std::numeric_limits<double>::infinity();
      for (int k = 0; k < N; ++k)
      {
        const Vector3 direction = Tuple(data, "Direction" + std::to_string(k), i);
        const Vector3 next = Tuple(data, "Direction" + std::to_string((k + 1) % N), i);
        nearest = std::min(nearest, (direction - Vector3(3.0, 4.0, 0.0)).norm());
        const Eigen::AngleAxisd turn(2.0 * Pi / N, Vector3::UnitZ());
        ASSERT_LT((turn * direction - next).norm(), 1e-12 * 5.0);
      }
      ASSERT_LT(nearest, 1e-9 * 5.0);
      // Combed, Direction0 does not jump anywhere.
      ASSERT_LT((Tuple(data, "Direction0", i) - Tuple(data, "Direction0", 0)).norm(), 1e-8);
    }
    EXPECT_FALSE(data->HasArray(("Direction" + std::to_string(N)).c_str()));
  }
  EXPECT_EQ(Converged(solver), 1);
}

TEST_P(FieldOfN, HasIndicesThatSumToTheEulerCharacteristic)
{
  const std::pair<Surface, double> surfaces[] = { { IrregularSphere(3, 11), 2.0 },
    { IrregularTorus(24, 16, 5), 0.0 }, { DoubleTorus(3), -2.0 } };
  for (const auto& [surface, eulerCharacteristic] : surfaces)
  {
    SCOPED_TRACE(eulerCharacteristic);
    const auto input = PolyDataOf(surface);
    AddCellVectors(input, "Given", { { 3, { 1.0, 2.0, 3.0 } }, { 77, { 3.0, -1.0, 1.0 } } });
    const auto solver = NewSolver(input);
    solver->SetNumberOfDirections(GetParam());
    solver->Update();
    double sum = 0.0;
    for (double index : Values(solver->GetOutput()->GetPointData(), "SingularityIndex"))
    {
      EXPECT_NEAR(std::remainder(GetParam() * index, 1.0), 0.0, 1e-9);
      sum += index;
    }
    EXPECT_NEAR(sum, eulerCharacteristic, 1e-9);
  }
}

// The turnings across the edges around a point and its angle defect make up its index.
TEST_P(FieldOfN, TurnsAroundPointsByTheirIndices)
{
  const auto input = PolyDataOf(IrregularTorus(24, 16, 3));
  AddCellVectors(input, "Given", { { 3, { 1.0, 2.0, 3.0 } }, { 400, { 3.0, -1.0, 1.0 } } });
  const auto solver = NewSolver(input);
  solver->SetNumberOfDirections(GetParam());
  solver->Update();

  std::vector<double> sums(input->GetNumberOfPoints(), 2.0 * Pi);
  vtkNew<vtkIdList> ids;
  for (vtkIdType cell = 0; cell < input->GetNumberOfCells(); ++cell)
  {
    input->GetCellPoints(cell, ids);
    for (int k = 0; k < 3; ++k)
    {
      const auto position = [&input, &ids](int corner)
      { return Vector3(input->GetPoint(ids->GetId(corner % 3))); };
      const Vector3 a = position(k + 1) - position(k), b = position(k + 2) - position(k);
      sums[ids->GetId(k)] -= std::atan2(a.cross(b).norm(), a.dot(b));
    }
  }
  vtkPolyData* const edges = Edges(solver);
  ASSERT_EQ(edges->GetNumberOfCells(), 3 * input->GetNumberOfCells() / 2);
  const std::vector<double> turnings = Values(edges->GetCellData(), "Turning");
  for (vtkIdType edge = 0; edge < edges->GetNumberOfCells(); ++edge)
  {
    edges->GetCellPoints(edge, ids);
    ASSERT_LT(ids->GetId(0), ids->GetId(1));
    EXPECT_LE(std::abs(turnings[edge]), Pi / GetParam() * (1.0 + 1e-12));
    // Turning goes from left to right, which is clockwise around the first point.
    sums[ids->GetId(0)] -= turnings[edge];
    sums[ids->GetId(1)] += turnings[edge];
  }
  const std::vector<double> indices =
    Values(solver->GetOutput()->GetPointData(), "SingularityIndex");
  for (std::size_t point = 0; point < sums.size(); ++point)
  {
    EXPECT_NEAR(sums[point], 2.0 * Pi * indices[point], 1e-9) << "point " << point;
  }
}

TEST(HarmonicFieldSolver, SolversAgree)
{
  const auto input = SphereWithOperators();
  const auto solver = NewSolver(input);
  solver->SetTolerance(1e-12);
  solver->SetMaximumNumberOfIterations(1000);
  solver->SetSolver(vtkHarmonicFieldSolver::Cholesky);
  solver->Update();
  const std::vector<double> exact = CellValues(solver, "PowerField");
  for (int kind : { vtkHarmonicFieldSolver::Automatic, vtkHarmonicFieldSolver::VCycles,
         vtkHarmonicFieldSolver::ConjugateGradients })
  {
    for (int space : { vtkHarmonicFieldSolver::Nodal, vtkHarmonicFieldSolver::StructurePreserving })
    {
      SCOPED_TRACE(std::to_string(kind) + ", " + std::to_string(space));
      solver->SetSolver(kind);
      solver->SetCoarseSpace(space);
      solver->Update();
      EXPECT_EQ(Converged(solver), 1);
      EXPECT_LT(Difference(CellValues(solver, "PowerField"), exact), 1e-8);
    }
  }
}

TEST(HarmonicFieldSolver, OutputsCarryTheReport)
{
  const auto solver = NewSolver(SphereWithOperators());
  solver->SetSolver(vtkHarmonicFieldSolver::ConjugateGradients);
  solver->SetCoarseSpace(vtkHarmonicFieldSolver::StructurePreserving);
  solver->Update();
  vtkTable* const table = Convergence(solver);
  ASSERT_GE(table->GetNumberOfRows(), 2);
  for (vtkIdType row = 0; row < table->GetNumberOfRows(); ++row)
  {
    EXPECT_EQ(table->GetValueByName(row, "Iteration").ToInt(), row);
    EXPECT_EQ(table->GetValueByName(row, "Returned").ToInt(), row + 1 == table->GetNumberOfRows());
  }
  const vtkIdType last = table->GetNumberOfRows() - 1;
  EXPECT_NEAR(table->GetValueByName(0, "RelativeResidual").ToDouble(), 1.0, 1e-12);
  EXPECT_LE(table->GetValueByName(last, "RelativeResidual").ToDouble(), 1e-8);
  EXPECT_GT(table->GetValueByName(last - 1, "RelativeResidual").ToDouble(), 1e-8);
  for (vtkFieldData* data : { solver->GetOutput()->GetFieldData(), table->GetFieldData() })
  {
    const std::vector<double> unknowns = Values(data, "LevelUnknowns");
    const std::vector<double> nonZeros = Values(data, "LevelNonZeros");
    ASSERT_GE(unknowns.size(), 2u);
    ASSERT_EQ(nonZeros.size(), unknowns.size());
    EXPECT_EQ(unknowns[0], 1280.0);
    EXPECT_EQ(nonZeros[0], 4.0 * 1280.0); // itself and three neighbours
    double sum = 0.0;
    for (double level : nonZeros)
    {
      sum += level;
    }
    EXPECT_DOUBLE_EQ(Values(data, "OperatorComplexity").at(0), sum / nonZeros[0]);
    for (const char* name : { "SetupSeconds", "PrepareSeconds", "SolveSeconds", "SolverBytes" })
    {
      EXPECT_GT(Values(data, name).at(0), 0.0) << name;
    }
    EXPECT_TRUE(data->HasArray("Solver"));
    EXPECT_TRUE(data->HasArray("NumberOfDirections"));
  }
}

TEST(HarmonicFieldSolver, ASolveThatStopsShortWarnsAndGivesItsBest)
{
  const auto solver = NewSolver(SphereWithOperators());
  solver->SetSolver(vtkHarmonicFieldSolver::ConjugateGradients);
  solver->SetCoarseSpace(vtkHarmonicFieldSolver::StructurePreserving);
  solver->SetMaximumNumberOfIterations(1);
  Messages messages(solver);
  solver->Update();
  EXPECT_TRUE(messages.GetErrors().empty());
  ASSERT_EQ(messages.GetWarnings().size(), 1u);
  EXPECT_NE(messages.GetWarnings()[0].find("residual"), std::string::npos)
    << messages.GetWarnings()[0];
  EXPECT_EQ(Converged(solver), 0);
  EXPECT_EQ(solver->GetOutput()->GetNumberOfCells(), 1280);
  messages.Forget();
  solver->SetMaximumNumberOfIterations(100);
  solver->Update();
  EXPECT_TRUE(messages.Silent());
  EXPECT_EQ(Converged(solver), 1);
}

TEST(HarmonicFieldSolver, HardConstraintsHold)
{
  const auto input = Sphere();
  const auto solver = NewSolver(input);
  solver->SetConstraintType(vtkHarmonicFieldSolver::Hard);
  solver->SetNumberOfDirections(3);
  solver->UnitLengthOff();
  solver->Update();
  for (vtkIdType cell : { 10, 900 })
  {
    Vector3 points[3];
    vtkNew<vtkIdList> ids;
    input->GetCellPoints(cell, ids);
    for (int k = 0; k < 3; ++k)
    {
      input->GetPoint(ids->GetId(k), points[k].data());
    }
    const Vector3 normal = (points[1] - points[0]).cross(points[2] - points[0]).normalized();
    const Vector3 given = Tuple(input->GetCellData(), "Given", cell);
    const Vector3 tangential = given - given.dot(normal) * normal;
    double nearest = std::numeric_limits<double>::infinity();
    for (const char* name : { "Direction0", "Direction1", "Direction2" })
    {
      nearest = std::min(
        nearest, (Tuple(solver->GetOutput()->GetCellData(), name, cell) - tangential).norm());
    }
    EXPECT_LT(nearest, 1e-12);
  }
}

TEST(HarmonicFieldSolver, DirectionsAreUnitVectorsIfAsked)
{
  const auto solver = NewSolver(Sphere());
  solver->Update();
  for (vtkIdType cell = 0; cell < 1280; ++cell)
  {
    ASSERT_NEAR(Tuple(solver->GetOutput()->GetCellData(), "Direction2", cell).norm(), 1.0, 1e-12);
  }
}

TEST(HarmonicFieldSolver, ThreadsDoNotChangeABit)
{
  std::vector<double> results[2];
  const std::string before = vtkSMPTools::GetBackend();
  ASSERT_TRUE(vtkSMPTools::SetBackend("STDThread"));
  for (int threads : { 1, 2 })
  {
    vtkSMPTools::Initialize(threads);
    vtkNew<vtkDirectionalProlongation> prolongation;
    const auto input = PolyDataOf(Icosphere(5));
    AddCellVectors(input, "Given", { { 10, { 1.0, 0.5, -0.25 } } });
    prolongation->SetInputData(input);
    const auto solver = NewSolver(input);
    solver->SetInputConnection(prolongation->GetOutputPort());
    solver->SetSolver(vtkHarmonicFieldSolver::ConjugateGradients);
    solver->Update();
    results[threads - 1] = CellValues(solver, "PowerField");
  }
  vtkSMPTools::Initialize(0);
  vtkSMPTools::SetBackend(before.c_str());
  EXPECT_EQ(results[0], results[1]);
}

// Constraints
// ---------------------------------------------------------------------------------------

namespace
{

/// The cells that a solve took as prescribed, with their weights.
std::map<vtkIdType, double> PrescribedCells(vtkHarmonicFieldSolver* solver)
{
  solver->Update();
  std::map<vtkIdType, double> cells;
  const std::vector<double> weights = CellValues(solver, "Prescribed");
  for (std::size_t i = 0; i < weights.size(); ++i)
  {
    if (weights[i] != 0.0)
    {
      cells[static_cast<vtkIdType>(i)] = weights[i];
    }
  }
  return cells;
}

using Cells = std::map<vtkIdType, double>;

}

TEST(Constraints, WithoutMaskAreWhereTheVectorIsNotZero)
{
  EXPECT_EQ(PrescribedCells(NewSolver(Sphere())), (Cells{ { 10, 1.0 }, { 900, 1.0 } }));
}

TEST(Constraints, AreChosenByMaskAndWeighted)
{
  const auto input = Sphere();
  const auto mask = Zeros("Mask", 1280, 1);
  mask->SetValue(900, -1.0);
  const auto weights = Zeros("Weights", 1280, 1);
  weights->SetValue(900, 2.5); // where nothing is prescribed the weight does not count
  input->GetCellData()->AddArray(mask);
  input->GetCellData()->AddArray(weights);
  const auto solver = NewSolver(input);
  solver->SetInputArrayToProcess(0, 0, 0, OnCells, "Mask");
  solver->SetInputArrayToProcess(2, 0, 0, OnCells, "Weights");
  EXPECT_EQ(PrescribedCells(solver), (Cells{ { 900, 2.5 } }));
}

TEST(Constraints, CanBeTheActiveVectors)
{
  const auto input = Sphere();
  input->GetCellData()->SetActiveVectors("Given");
  vtkNew<vtkHarmonicFieldSolver> solver;
  solver->SetInputData(input);
  solver->SetInputArrayToProcess(1, 0, 0, OnCells, vtkDataSetAttributes::VECTORS);
  EXPECT_EQ(PrescribedCells(solver), (Cells{ { 10, 1.0 }, { 900, 1.0 } }));
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
  EXPECT_EQ(PrescribedCells(NewSolver(input, OnPoints)), expected);
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
  const auto solver = NewSolver(input, OnPoints);
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

// While the prescribed directions turn and move, the first direction of a cell goes on as the nearest one, so that it turns by
// no more than half a step; and after a jump it is combed as by a new filter.
TEST(Combing, HoldsStillWhilePrescribedDirectionsMove)
{
  constexpr int N = 4;
  constexpr int Frames = 24;
  const auto input = PolyDataOf(IrregularSphere(4, 3));
  const auto solver = NewSolver(input);
  solver->SetNumberOfDirections(N);
  const auto directionsOfFrame = [&](double frame) {
    const double turn = 0.6 * frame * Pi / Frames;
    AddCellVectors(input, "Given",
      { { 10, { 1.0, 0.5, -0.25 } }, { 2000, { std::cos(turn), std::sin(turn), 0.3 } },
        { 3000 + 7 * static_cast<int>(frame), { 0.2, std::sin(turn), std::cos(turn) } } });
    input->Modified();
    solver->Update();
    return CellValues(solver, "Direction0");
  };
  const auto cosine = [](const std::vector<double>& a, const std::vector<double>& b, std::size_t cell) {
    return a[3 * cell] * b[3 * cell] + a[3 * cell + 1] * b[3 * cell + 1] + a[3 * cell + 2] * b[3 * cell + 2];
  };
  std::vector<double> former = directionsOfFrame(0);
  for (int frame = 1; frame < Frames; ++frame)
  {
    const std::vector<double> current = directionsOfFrame(frame);
    for (std::size_t cell = 0; cell < current.size() / 3; ++cell)
    {
      ASSERT_GE(cosine(former, current, cell), std::cos(Pi / N) - 1e-6) << frame << ", " << cell;
    }
    former = current;
  }

  solver->SetNumberOfDirections(3);
  solver->Update();
  solver->SetNumberOfDirections(N);
  solver->Update();
  const auto fresh = NewSolver(input);
  fresh->SetNumberOfDirections(N);
  fresh->Update();
  const std::vector<double> expected = CellValues(fresh, "Direction0");
  const std::vector<double> combed = CellValues(solver, "Direction0");
  for (std::size_t cell = 0; cell < combed.size() / 3; ++cell)
  {
    ASSERT_GE(cosine(expected, combed, cell), 0.999) << cell;
  }
}

TEST(Constraints, AreTheActiveVectorsByDefault)
{
  const auto input = PolyDataOf(Icosphere(3));
  AddCellVectors(input, "Given", { { 12, { 1.0, 1.0, 0.0 } } });
  input->GetCellData()->SetActiveVectors("Given");
  vtkNew<vtkHarmonicFieldSolver> solver;
  solver->SetInputData(input);
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
    EXPECT_TRUE(PrescribedCells(solver).empty());
    EXPECT_EQ(Converged(solver), 1);
    // The lowest eigenvalue of crosses on the unit sphere is 4, and twice that with edges of weight 2 sqrt(3).
    const auto eigenvalues = Values(solver->GetOutput()->GetFieldData(), "Eigenvalues");
    ASSERT_EQ(eigenvalues.size(), 1u);
    EXPECT_NEAR(eigenvalues[0], 8.0, 0.3);
    std::vector<double> indices = Values(solver->GetOutput()->GetPointData(), "SingularityIndex");
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
  vtkPolyData* const output = solver->GetOutput();
  for (vtkIdType cell : { 0, 1, 2 })
  {
    EXPECT_EQ(Tuple(output->GetCellData(), "Direction0", cell), Vector3(0.0, 0.0, 0.0));
  }
  EXPECT_EQ(Tuple(output->GetPointData(), "Direction0", unused), Vector3(0.0, 0.0, 0.0));
  EXPECT_GT(Tuple(output->GetPointData(), "Direction0", 0).norm(), 0.5);

  // The triangles hold what they hold without the others.
  auto plain = PolyDataOf(Icosphere(3));
  AddCellVectors(plain, "Given", { { 10, { 1.0, 0.5, -0.25 } } });
  const auto reference = NewSolver(plain);
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
  const auto second = NewSolver(first->GetOutput());
  second->SetNumberOfDirections(2);
  second->Update();
  EXPECT_TRUE(second->GetOutput()->GetCellData()->HasArray("Direction1"));
  EXPECT_FALSE(second->GetOutput()->GetCellData()->HasArray("Direction2"));
  EXPECT_FALSE(second->GetOutput()->GetPointData()->HasArray("Direction5"));
  EXPECT_TRUE(first->GetOutput()->GetCellData()->HasArray("Direction5"))
    << "the input was modified";
}

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
    EXPECT_LT(
      Difference(CellValues(this->Solver, "PowerField"), CellValues(fresh, "PowerField")), 1e-5);
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
  EXPECT_EQ(this->Solver->GetOutput()->GetPoints(), copy->GetPoints());
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
    [](vtkHarmonicFieldSolver* s) { s->SetStartingLevel(1); },
    [](vtkHarmonicFieldSolver* s) { s->SetCoarseSpace(vtkHarmonicFieldSolver::Nodal); },
    [](vtkHarmonicFieldSolver* s) { s->SetSweeps(s->GetSweeps() + 1); },
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

// Stored operators
// ----------------------------------------------------------------------------------

TEST(StoredOperators, AreUsedAfterWritingAndReading)
{
  const std::string path = testing::TempDir() + "StoredOperators.vtp";
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

  const auto before = NewSolver(input), after = NewSolver(reader->GetOutput());
  for (vtkHarmonicFieldSolver* solver : { before.Get(), after.Get() })
  {
    solver->SetSolver(vtkHarmonicFieldSolver::ConjugateGradients);
    solver->SetCoarseSpace(vtkHarmonicFieldSolver::StructurePreserving);
    solver->Update();
    EXPECT_EQ(Values(solver->GetOutput()->GetFieldData(), "LevelUnknowns").size(), 3u);
  }
  EXPECT_EQ(CellValues(before, "PowerField"), CellValues(after, "PowerField"));
}

TEST(StoredOperators, ChangeNothingWhereTheSolverTakesSamples)
{
  vtkNew<vtkDirectionalProlongation> prolongation;
  const auto bare = PolyDataOf(IrregularSphere(4, 5));
  AddCellVectors(bare, "Given", { { 10, { 1.0, 0.5, -0.25 } } });
  prolongation->SetInputData(bare);
  prolongation->Update();
  vtkNew<vtkPolyData> moved;
  moved->DeepCopy(prolongation->GetOutput());
  double point[3];
  moved->GetPoint(5, point);
  moved->GetPoints()->SetPoint(5, 1.001 * point[0], 1.001 * point[1], 1.001 * point[2]);
  for (int kind : { vtkHarmonicFieldSolver::Automatic, vtkHarmonicFieldSolver::ConjugateGradients,
         vtkHarmonicFieldSolver::Cholesky })
  {
    const auto without = NewSolver(bare), with = NewSolver(prolongation->GetOutput()), stale = NewSolver(moved);
    const Messages messages(stale);
    for (vtkHarmonicFieldSolver* solver : { without.Get(), with.Get(), stale.Get() })
    {
      solver->SetSolver(kind);
      solver->Update();
    }
    EXPECT_EQ(CellValues(with, "PowerField"), CellValues(without, "PowerField"));
    EXPECT_TRUE(messages.Silent());
    EXPECT_EQ(stale->GetOutput()->GetNumberOfCells(), bare->GetNumberOfCells());
  }
}

TEST(StoredOperators, OfAnotherSurfaceAreRefused)
{
  const auto input = SphereWithOperators();
  const auto solver = NewSolver(input);
  solver->SetCoarseSpace(vtkHarmonicFieldSolver::StructurePreserving);
  Messages messages(solver);
  solver->Update();
  ASSERT_TRUE(messages.Silent());
  double point[3];
  input->GetPoint(5, point);
  input->GetPoints()->SetPoint(5, 1.001 * point[0], 1.001 * point[1], 1.001 * point[2]);
  input->GetPoints()->Modified();
  input->Modified();
  solver->Update();
  EXPECT_NE(messages.Error().find("apply Directional Prolongation (vtkDirectionalProlongation)"), std::string::npos)
    << messages.Error();
  ExpectEmpty(solver);
  EXPECT_EQ(CountsOf(solver), (Counts{ 1, 1, 1 }));

  // As soon as the surface is the old one again, nothing has to be redone.
  input->GetPoints()->SetPoint(5, point);
  input->GetPoints()->Modified();
  input->Modified();
  messages.Forget();
  solver->Update();
  EXPECT_TRUE(messages.Silent());
  EXPECT_EQ(solver->GetOutput()->GetNumberOfCells(), 1280);
  EXPECT_EQ(CountsOf(solver), (Counts{ 1, 1, 1 }));
}

namespace
{

struct Damage
{
  std::string Name;
  std::string Array; ///< that is damaged and that the message must name
  std::function<void(vtkFieldData*, vtkAbstractArray*)> Do;
};

std::ostream& operator<<(std::ostream& os, const Damage& damage)
{
  return os << damage.Name;
}

class DamagedOperators : public testing::TestWithParam<Damage>
{
};

void SetInt(vtkAbstractArray* array, vtkIdType i, int value)
{
  vtkIntArray::SafeDownCast(array)->SetValue(i, value);
}

void Shorten(vtkAbstractArray* array)
{
  array->Resize(array->GetNumberOfTuples() - 1);
}

const Damage Damages[] = {
  { "Missing", "Prolongation.SP.1.Columns",
    [](vtkFieldData* data, vtkAbstractArray* array) { data->RemoveArray(array->GetName()); } },
  { "WithoutFormat", "Prolongation.Format",
    [](vtkFieldData* data, vtkAbstractArray* array) { data->RemoveArray(array->GetName()); } },
  { "OtherFormat", "Prolongation.Format",
    [](vtkFieldData*, vtkAbstractArray* array) { SetInt(array, 0, 1); } }, // before 1-forms and face fields
  { "WithoutDigest", "Prolongation.Digest",
    [](vtkFieldData* data, vtkAbstractArray* array) { data->RemoveArray(array->GetName()); } },
  { "OptionsNotNumbers", "Prolongation.Options",
    [](vtkFieldData*, vtkAbstractArray* array) {
      vtkDoubleArray::SafeDownCast(array)->SetValue(1, std::numeric_limits<double>::quiet_NaN());
    } },
  { "OtherSize", "Prolongation.NumbersOfFaces",
    [](vtkFieldData*, vtkAbstractArray* array) { SetInt(array, 0, 1281); } },
  { "SizesThatGrow", "Prolongation.NumbersOfVertices",
    [](vtkFieldData*, vtkAbstractArray* array) { SetInt(array, 2, 100000); } },
  { "SizeOfNothing", "Prolongation.NumbersOfFaces",
    [](vtkFieldData*, vtkAbstractArray* array) { SetInt(array, 2, -5); } },
  { "LevelsThatDiffer", "Prolongation.NumbersOfVertices",
    [](vtkFieldData*, vtkAbstractArray* array) { Shorten(array); } },
  { "OffsetsTooFew", "Prolongation.S0.0.Offsets",
    [](vtkFieldData*, vtkAbstractArray* array) { Shorten(array); } },
  { "OffsetsThatFall", "Prolongation.Nodal.0.Offsets",
    [](vtkFieldData*, vtkAbstractArray* array) { SetInt(array, 7, 1000000); } },
  { "OffsetsNotFromZero", "Prolongation.Nodal.1.Offsets",
    [](vtkFieldData*, vtkAbstractArray* array) { SetInt(array, 0, -1); } },
  { "ColumnTooLarge", "Prolongation.SP.0.Columns",
    [](vtkFieldData*, vtkAbstractArray* array) { SetInt(array, 11, 1000000); } },
  { "ColumnNegative", "Prolongation.S0.1.Columns",
    [](vtkFieldData*, vtkAbstractArray* array) { SetInt(array, 0, -1); } },
  { "ColumnsTooFew", "Prolongation.SP.0.Offsets", // they no longer end where the columns do
    [](vtkFieldData* data, vtkAbstractArray*)
    { Shorten(data->GetAbstractArray("Prolongation.SP.0.Columns")); } },
  { "ValuesTooFew", "Prolongation.SP.0.Values",
    [](vtkFieldData*, vtkAbstractArray* array) { Shorten(array); } },
  { "ValueNotANumber", "Prolongation.Nodal.0.Values",
    [](vtkFieldData*, vtkAbstractArray* array) {
      vtkDoubleArray::SafeDownCast(array)->SetValue(3, std::numeric_limits<double>::quiet_NaN());
    } },
  { "ValueWithoutWeight", "Prolongation.S0.0.Values",
    [](vtkFieldData*, vtkAbstractArray* array)
    { vtkDoubleArray::SafeDownCast(array)->SetValue(3, 7.0); } },
  { "OtherType", "Prolongation.SP.0.Values",
    [](vtkFieldData* data, vtkAbstractArray* array)
    {
      vtkNew<vtkIntArray> other;
      other->SetName(array->GetName());
      data->AddArray(other);
    } },
};

}

TEST_P(DamagedOperators, AreRefusedByName)
{
  vtkNew<vtkPolyData> input;
  input->DeepCopy(SphereWithOperators());
  vtkFieldData* const data = input->GetFieldData();
  ASSERT_TRUE(data->HasArray(GetParam().Array.c_str()));
  GetParam().Do(data, data->GetAbstractArray(GetParam().Array.c_str()));
  const auto solver = NewSolver(input);
  solver->SetCoarseSpace(vtkHarmonicFieldSolver::StructurePreserving);
  const Messages messages(solver);
  solver->Update();
  EXPECT_NE(messages.Error().find("'" + GetParam().Array + "'"), std::string::npos)
    << messages.Error();
  EXPECT_NE(messages.Error().find("vtkDirectionalProlongation"), std::string::npos);
  ExpectEmpty(solver);
}

INSTANTIATE_TEST_SUITE_P(StoredOperators, DamagedOperators, testing::ValuesIn(Damages),
  [](const testing::TestParamInfo<Damage>& info) { return info.param.Name; });

// Inputs
// ---------------------------------------------------------------------------------------------

TEST(HarmonicFieldSolver, EmptyInputGivesEmptyOutputSilently)
{
  vtkNew<vtkPolyData> empty;
  const auto solver = NewSolver(empty);
  const Messages messages(solver);
  solver->Update();
  EXPECT_TRUE(messages.Silent());
  ExpectEmpty(solver);
}

TEST(HarmonicFieldSolver, PieceZeroHoldsTheWholeAndTheOthersNothing)
{
  const auto solver = NewSolver(Sphere());
  Messages messages(solver);
  solver->UpdatePiece(1, 2, 0);
  ExpectEmpty(solver);
  EXPECT_EQ(messages.GetWarnings().size(), 1u); // the input is not empty there
  messages.Forget();
  solver->UpdatePiece(0, 2, 0);
  EXPECT_EQ(solver->GetOutput()->GetNumberOfCells(), 1280);
  EXPECT_TRUE(messages.Silent());

  // Through both filters, nothing is asked for and nothing done for the other pieces.
  vtkNew<vtkDirectionalProlongation> prolongation;
  prolongation->SetInputData(Sphere());
  solver->SetInputConnection(prolongation->GetOutputPort());
  solver->UpdatePiece(1, 2, 0);
  ExpectEmpty(solver);
  EXPECT_EQ(prolongation->GetNumberOfSetups(), 0);
}

namespace
{

struct BadInput
{
  std::string Name;
  std::function<void(vtkPolyData*, vtkHarmonicFieldSolver*)> Spoil;
  std::vector<std::string> Words; ///< that the message must contain: element and remedy
};

std::ostream& operator<<(std::ostream& os, const BadInput& input)
{
  return os << input.Name;
}

class RefusedConstraints : public testing::TestWithParam<BadInput>
{
};

void Choose(vtkHarmonicFieldSolver* solver, int index, int association, const char* name)
{
  solver->SetInputArrayToProcess(index, 0, 0, association, name);
}

void SetCell(vtkPolyData* input, vtkIdType cell, double x, double y, double z)
{
  input->GetCellData()->GetArray("Given")->SetTuple3(cell, x, y, z);
}

const BadInput BadInputs[] = {
  { "AllVectorsZero",
    [](vtkPolyData* input, vtkHarmonicFieldSolver*)
    { input->GetCellData()->GetArray("Given")->Fill(0.0); },
    { "no direction is prescribed", "choose" } },
  { "ArrayThatDoesNotExist",
    [](vtkPolyData*, vtkHarmonicFieldSolver* solver) { Choose(solver, 1, OnCells, "Gone"); },
    { "'Gone'", "directions of the surface", "choose" } },
  { "ArrayOfPointsChosenOnCells",
    [](vtkPolyData*, vtkHarmonicFieldSolver* solver) { Choose(solver, 1, OnPoints, "Given"); },
    { "'Given'", "choose" } },
  { "ScalarsAsVectors",
    [](vtkPolyData* input, vtkHarmonicFieldSolver* solver)
    {
      input->GetCellData()->AddArray(Zeros("Scalars", 1280, 1));
      Choose(solver, 1, OnCells, "Scalars");
    },
    { "'Scalars'", "3 numbers", "choose" } },
  { "TextAsMask",
    [](vtkPolyData* input, vtkHarmonicFieldSolver* solver)
    {
      vtkNew<vtkStringArray> text;
      text->SetName("Text");
      text->SetNumberOfValues(1280);
      input->GetCellData()->AddArray(text);
      Choose(solver, 0, OnCells, "Text");
    },
    { "'Text'", "mask of the surface", "choose" } },
  { "MaskElsewhereThanVectors",
    [](vtkPolyData* input, vtkHarmonicFieldSolver* solver)
    {
      input->GetPointData()->AddArray(Zeros("Mask", input->GetNumberOfPoints(), 1));
      Choose(solver, 0, OnPoints, "Mask");
    },
    { "'Mask'", "'Given'", "choose" } },
  { "MaskWithoutVectors",
    [](vtkPolyData* input, vtkHarmonicFieldSolver* solver)
    {
      input->GetCellData()->AddArray(Zeros("Mask", 1280, 1));
      Choose(solver, 0, OnCells, "Mask");
      Choose(solver, 1, OnCells, "");
    },
    { "'Mask'", "choose" } },
  { "MaskedZero",
    [](vtkPolyData* input, vtkHarmonicFieldSolver* solver)
    {
      const auto mask = Zeros("Mask", 1280, 1);
      mask->SetValue(33, 1.0);
      input->GetCellData()->AddArray(mask);
      Choose(solver, 0, OnCells, "Mask");
    },
    { "cell 33", "zero", "mask" } },
  { "NotFinite",
    [](vtkPolyData* input, vtkHarmonicFieldSolver*)
    { SetCell(input, 44, 0.0, std::numeric_limits<double>::infinity(), 0.0); },
    { "cell 44", "not finite", "repair" } },
  { "WeightNotPositive",
    [](vtkPolyData* input, vtkHarmonicFieldSolver* solver)
    {
      const auto weights = Zeros("Weights", 1280, 1);
      weights->SetValue(900, 1.0);
      input->GetCellData()->AddArray(weights);
      Choose(solver, 2, OnCells, "Weights");
    },
    { "cell 10", "weight", "positive" } },
  { "NormalAtAPoint",
    [](vtkPolyData* input, vtkHarmonicFieldSolver* solver)
    {
      double normal[3]; // of an icosahedron's corner
      input->GetPoint(2, normal);
      AddPointVectors(input, "Normal", { { 2, Vector3(normal) } });
      Choose(solver, 1, OnPoints, "Normal");
    },
    { "point 2", "perpendicular", "leave the point out, by Mask" } },
  { "AlignmentNotPositive",
    [](vtkPolyData*, vtkHarmonicFieldSolver* solver) { solver->SetAlignment(-1.0); },
    { "lignment" } },
  { "EverythingHard",
    [](vtkPolyData* input, vtkHarmonicFieldSolver* solver)
    {
      for (vtkIdType cell = 0; cell < 1280; ++cell)
      {
        SetCell(input, cell, 0.6, 0.48, 0.64);
      }
      solver->SetConstraintType(vtkHarmonicFieldSolver::Hard);
    },
    { "hard" } },
  { "Quadrilateral",
    [](vtkPolyData* input, vtkHarmonicFieldSolver*) {
      input->GetPolys()->InsertNextCell({ 0, 1, 2, 3 });
    },
    { "cell 1280", "vtkTriangleFilter" } },
};

}

TEST_P(RefusedConstraints, NamesElementAndRemedyAndLeavesOutputsEmpty)
{
  const auto input = Sphere();
  const auto solver = NewSolver(input);
  solver->Update();
  GetParam().Spoil(input, solver);
  input->Modified();
  const Messages messages(solver);
  solver->Update();
  for (const std::string& word : GetParam().Words)
  {
    EXPECT_NE(messages.Error().find(word), std::string::npos)
      << "'" << word << "' is not in: " << messages.Error();
  }
  EXPECT_FALSE(messages.GetErrors().empty());
  ExpectEmpty(solver);
}

INSTANTIATE_TEST_SUITE_P(HarmonicFieldSolver, RefusedConstraints, testing::ValuesIn(BadInputs),
  [](const testing::TestParamInfo<BadInput>& info) { return info.param.Name; });

// Abort
// ----------------------------------------------------------------------------------------------

TEST(HarmonicFieldSolver, AbortInEachStageLeavesNothingAndTheNextRunIsWhole)
{
  const auto input = LargeSphere();
  const auto uninterrupted = NewSolver(input);
  uninterrupted->SetSolver(vtkHarmonicFieldSolver::ConjugateGradients);
  uninterrupted->Update();
  struct
  {
    double Fraction; // within the stage, see RequestData
    Counts Done;
  } const stages[] = { { 0.2, { 0, 0, 0 } }, { 0.51, { 1, 0, 0 } }, { 0.71, { 1, 1, 0 } } };
  for (const auto& stage : stages)
  {
    SCOPED_TRACE(stage.Fraction);
    const auto solver = NewSolver(input);
    solver->SetSolver(vtkHarmonicFieldSolver::ConjugateGradients);
    {
      const Messages messages(solver);
      const AbortAt abort(solver, stage.Fraction);
      solver->Update();
      EXPECT_TRUE(abort.Asked());
      EXPECT_TRUE(messages.Silent());
    }
    ExpectEmpty(solver);
    EXPECT_EQ(CountsOf(solver), stage.Done);
    solver->Update(); // nothing else has changed
    EXPECT_EQ(CountsOf(solver), (Counts{ 1, 1, 1 }));
    EXPECT_EQ(CellValues(solver, "PowerField"), CellValues(uninterrupted, "PowerField"));
  }
}

TEST(HarmonicFieldSolver, AbortKeepsWhatWasComplete)
{
  const auto input = LargeSphere();
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
