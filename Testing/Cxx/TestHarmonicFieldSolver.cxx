#include "vtkHarmonicFieldSolver.h"

#include "SolverTools.h"

#include "vtkDirectionalProlongation.h"
#include "vtkIdList.h"
#include "vtkImageData.h"
#include "vtkTable.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

using namespace dmg;
using namespace dmg::test;

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
  vtkPolyData* const output = solver->GetPolyDataOutput();
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
  const std::pair<Surface, double> surfaces[] = { { IrregularSphere(3, 11), 2.0 }, { IrregularTorus(24, 16, 5), 0.0 },
    { DoubleTorus(3), -2.0 } };
  for (const auto& [surface, eulerCharacteristic] : surfaces)
  {
    SCOPED_TRACE(eulerCharacteristic);
    const auto input = PolyDataOf(surface);
    AddCellVectors(input, "Given", { { 3, { 1.0, 2.0, 3.0 } }, { 77, { 3.0, -1.0, 1.0 } } });
    const auto solver = NewSolver(input);
    solver->SetNumberOfDirections(GetParam());
    solver->Update();
    double sum = 0.0;
    for (double index : CellValues(solver, "SingularityIndex"))
    {
      EXPECT_NEAR(std::remainder(GetParam() * index, 1.0), 0.0, 1e-9);
      sum += index;
    }
    EXPECT_NEAR(sum, eulerCharacteristic, 1e-9);
  }
}

// The rotations across the edges around a point and its angle defect make up its index.
TEST_P(FieldOfN, TurnsAroundPointsByTheirIndices)
{
  const auto input = PolyDataOf(IrregularTorus(24, 16, 3));
  AddCellVectors(input, "Given", { { 3, { 1.0, 2.0, 3.0 } }, { 400, { 3.0, -1.0, 1.0 } } });
  const auto solver = NewSolver(input, Solver::PowerField);
  solver->SetNumberOfDirections(GetParam());
  solver->Update();

  std::vector<double> sums(input->GetNumberOfPoints(), 2.0 * Pi);
  vtkNew<vtkIdList> ids;
  for (vtkIdType cell = 0; cell < input->GetNumberOfCells(); ++cell)
  {
    input->GetCellPoints(cell, ids);
    for (int k = 0; k < 3; ++k)
    {
      const auto position = [&input, &ids](int corner) { return Vector3(input->GetPoint(ids->GetId(corner % 3))); };
      const Vector3 a = position(k + 1) - position(k), b = position(k + 2) - position(k);
      sums[ids->GetId(k)] -= std::atan2(a.cross(b).norm(), a.dot(b));
    }
  }
  vtkPolyData* const edges = Edges(solver);
  ASSERT_EQ(edges->GetNumberOfCells(), 3 * input->GetNumberOfCells() / 2);
  const std::vector<double> rotations = Values(edges->GetCellData(), "Rotation");
  for (vtkIdType edge = 0; edge < edges->GetNumberOfCells(); ++edge)
  {
    edges->GetCellPoints(edge, ids);
    ASSERT_LT(ids->GetId(0), ids->GetId(1));
    EXPECT_LE(std::abs(rotations[edge]), Pi / GetParam() * (1.0 + 1e-12));
    // The rotation goes from left to right, which is clockwise around the first point.
    sums[ids->GetId(0)] -= rotations[edge];
    sums[ids->GetId(1)] += rotations[edge];
  }
  const std::vector<double> indices = Values(solver->GetOutput()->GetPointData(), "SingularityIndex");
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
  for (int kind :
    { vtkHarmonicFieldSolver::Automatic, vtkHarmonicFieldSolver::VCycles, vtkHarmonicFieldSolver::ConjugateGradients })
  {
    for (int space : { vtkHarmonicFieldSolver::LinearInterpolation, vtkHarmonicFieldSolver::StructurePreserving })
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
    EXPECT_EQ(unknowns[0], 642.0);
    EXPECT_EQ(nonZeros[0], 642.0 + 2.0 * 1920.0); // each point, and each edge from both ends
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
  EXPECT_NE(messages.GetWarnings()[0].find("residual"), std::string::npos) << messages.GetWarnings()[0];
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
  for (vtkIdType cell : { 10, 200 })
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
      nearest = std::min(nearest, (Tuple(solver->GetOutput()->GetCellData(), name, cell) - tangential).norm());
    }
    EXPECT_LT(nearest, 1e-12);
  }
}

TEST(HarmonicFieldSolver, Direction0IsTheSameWhetherTheOthersComeOrNot)
{
  const auto solver = NewSolver(Sphere());
  solver->AllDirectionsOff();
  solver->Update();
  const auto cells = Values(solver->GetOutput()->GetCellData(), "Direction0");
  const auto points = Values(solver->GetOutput()->GetPointData(), "Direction0");
  EXPECT_FALSE(solver->GetOutput()->GetCellData()->HasArray("Direction1"));
  EXPECT_FALSE(solver->GetOutput()->GetPointData()->HasArray("Direction1"));
  solver->AllDirectionsOn();
  solver->Update();
  EXPECT_EQ(solver->GetNumberOfSolves(), 1);
  EXPECT_TRUE(solver->GetOutput()->GetCellData()->HasArray("Direction3"));
  EXPECT_TRUE(solver->GetOutput()->GetPointData()->HasArray("Direction3"));
  EXPECT_EQ(Values(solver->GetOutput()->GetCellData(), "Direction0"), cells);
  EXPECT_EQ(Values(solver->GetOutput()->GetPointData(), "Direction0"), points);
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

// While the prescribed directions turn and move, the first direction of a cell goes on as the nearest one, so that it turns by
// no more than half a step; and after a jump it is combed as by a new filter.
TEST(Combing, HoldsStillWhilePrescribedDirectionsMove)
{
  constexpr int N = 4;
  constexpr int Frames = 24;
  const auto input = PolyDataOf(IrregularSphere(4, 3));
  const auto solver = NewSolver(input);
  solver->SetNumberOfDirections(N);
  const auto directionsOfFrame = [&](double frame)
  {
    const double turn = 0.6 * frame * Pi / Frames;
    AddCellVectors(input, "Given",
      { { 10, { 1.0, 0.5, -0.25 } }, { 2000, { std::cos(turn), std::sin(turn), 0.3 } },
        { 3000 + 7 * static_cast<int>(frame), { 0.2, std::sin(turn), std::cos(turn) } } });
    input->Modified();
    solver->Update();
    return CellValues(solver, "Direction0");
  };
  const auto cosine = [](const std::vector<double>& a, const std::vector<double>& b, std::size_t cell)
  { return a[3 * cell] * b[3 * cell] + a[3 * cell + 1] * b[3 * cell + 1] + a[3 * cell + 2] * b[3 * cell + 2]; };
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

// The pipeline asks for an empty image again and again, since it has no extent.
TEST(HarmonicFieldSolver, TellsOnceWhyItFailsOnAnImage)
{
  vtkNew<vtkImageData> image;
  image->SetDimensions(5, 5, 1);
  vtkNew<vtkHarmonicFieldSolver> solver;
  solver->SetInputData(image);
  solver->SetNumberOfDirections(99);
  const auto errorsOfUpdates = [&solver]
  {
    const Messages messages(solver);
    for (const int port : { 0, 1, 2, 3, 0 })
    {
      solver->Update(port);
    }
    EXPECT_NE(messages.Error().find("Number Of Directions"), std::string::npos);
    return std::count_if(messages.GetErrors().begin(), messages.GetErrors().end(),
      [](const std::string& text) { return text.find("Number Of Directions") != std::string::npos; });
  };
  EXPECT_EQ(errorsOfUpdates(), 1);
  solver->SetNumberOfDirections(98);
  EXPECT_EQ(errorsOfUpdates(), 1) << "another error, or the same one after a change, is told";
  solver->SetNumberOfDirections(4);
  const Messages messages(solver);
  solver->Update();
  EXPECT_TRUE(messages.GetErrors().empty());
  EXPECT_EQ(solver->GetOutput()->GetNumberOfCells(), 16);
}
