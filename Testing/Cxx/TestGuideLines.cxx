// Lines as guides, several guides at once, their weights and their report.

#include "vtkHarmonicFieldSolver.h"

#include "NoteOfShear.h"
#include "TestTools.h"

#include "vtkIdList.h"
#include "vtkIntArray.h"
#include "vtkTrivialProducer.h"
#include "vtkUnstructuredGrid.h"

#include <gtest/gtest.h>

#include <map>

using namespace dmg;
using namespace dmg::test;

namespace
{

constexpr int OnPoints = vtkDataObject::FIELD_ASSOCIATION_POINTS;
constexpr int OnCells = vtkDataObject::FIELD_ASSOCIATION_CELLS;
constexpr int InFieldData = vtkDataObject::FIELD_ASSOCIATION_NONE;
using Cells = std::map<vtkIdType, double>; // weights

vtkSmartPointer<vtkPoints> PointsOf(const std::vector<Vector3>& positions)
{
  auto points = vtkSmartPointer<vtkPoints>::New();
  points->SetDataTypeToDouble();
  for (const Vector3& position : positions)
  {
    points->InsertNextPoint(position.data());
  }
  return points;
}

/// One polyline through some points.
vtkSmartPointer<vtkPolyData> Polyline(const std::vector<Vector3>& positions)
{
  vtkNew<vtkCellArray> lines;
  lines->InsertNextCell(static_cast<int>(positions.size()));
  for (std::size_t i = 0; i < positions.size(); ++i)
  {
    lines->InsertCellPoint(static_cast<vtkIdType>(i));
  }
  auto data = vtkSmartPointer<vtkPolyData>::New();
  data->SetPoints(PointsOf(positions));
  data->SetLines(lines);
  return data;
}

vtkSmartPointer<vtkPolyData> PointWithVector(const Vector3& position, const Vector3& vector, const std::string& name)
{
  auto data = vtkSmartPointer<vtkPolyData>::New();
  data->SetPoints(PointsOf({ position }));
  AddPointVectors(data, name, { { 0, vector } });
  return data;
}

/// Unit squares, of which square (column, row) has faces 2 (8 row + column) and one more; the first
/// or the second is below the rising diagonal.
class GuideLines : public testing::Test
{
protected:
  void SetUp() override
  {
    this->Solver->SetInputData(this->Plate);
    this->Solver->SetDiscretisation(vtkHarmonicFieldSolver::PowerField); // shows the faces that a guide reaches
    this->Solver->SetNumberOfDirections(1);
    this->Solver->SetConstraintType(vtkHarmonicFieldSolver::Hard);
  }

  /// \param warning that is expected; empty for none.
  Cells Prescribed(const std::string& warning = "")
  {
    const Messages messages(this->Solver);
    this->Solver->Update();
    EXPECT_TRUE(messages.GetErrors().empty()) << messages.Error();
    const std::vector<std::string> warnings = WithoutNoteOfShear(messages.GetWarnings());
    EXPECT_EQ(warnings.size(), warning.empty() ? 0u : 1u);
    if (!warnings.empty())
    {
      EXPECT_NE(warnings[0].find(warning), std::string::npos) << warnings[0];
    }
    Cells cells;
    const auto values = Values(this->Solver->GetOutput()->GetCellData(), "Prescribed");
    for (std::size_t cell = 0; cell < values.size(); ++cell)
    {
      if (values[cell] > 0.0)
      {
        cells[static_cast<vtkIdType>(cell)] = values[cell];
      }
    }
    return cells;
  }

  std::string Error()
  {
    const Messages messages(this->Solver);
    this->Solver->Update();
    return messages.Error();
  }

  /// The cells that the line y = row + 0.3, from x = 0.1 to 7.9, passes: 30 / L times its length there, on two sides. The
  /// surface has size L = 8, and its triangles are equal.
  Cells CellsInRow(int row, double weight = 1.0)
  {
    Cells cells;
    vtkNew<vtkIdList> corners;
    for (vtkIdType cell = 0; cell < this->Plate->GetNumberOfCells(); ++cell)
    {
      double from = 7.9, to = 0.1;
      this->Plate->GetCellPoints(cell, corners);
      for (int k = 0; k < 3; ++k)
      {
        const Vector3 a(this->Plate->GetPoint(corners->GetId(k)));
        const Vector3 b(this->Plate->GetPoint(corners->GetId((k + 1) % 3)));
        const double along = (row + 0.3 - a.y()) / (b.y() - a.y()); // infinite for horizontal sides
        if (along >= 0.0 && along <= 1.0)
        {
          const double x = a.x() + along * (b.x() - a.x());
          from = std::min(from, std::max(x, 0.1));
          to = std::max(to, std::min(x, 7.9));
        }
      }
      if (to > from)
      {
        cells[cell] = weight * 2.0 * 30.0 / 8.0 * (to - from);
      }
    }
    return cells;
  }

  Vector3 Direction(vtkIdType cell) { return Tuple(this->Solver->GetOutput()->GetCellData(), "Direction0", cell); }

  int Report(const char* name)
  {
    return vtkIntArray::SafeDownCast(this->Solver->GetOutput()->GetFieldData()->GetAbstractArray(name))->GetValue(0);
  }

  void ExpectNear(const Cells& cells, const Cells& expected)
  {
    ASSERT_EQ(cells.size(), expected.size());
    for (const auto& [cell, weight] : expected)
    {
      ASSERT_EQ(cells.count(cell), 1u) << "cell " << cell;
      EXPECT_NEAR(cells.at(cell), weight, 1e-12) << "cell " << cell;
    }
  }

  const vtkSmartPointer<vtkPolyData> Plate = PolyDataOf(PlaneGrid(8, 8));
  vtkNew<vtkHarmonicFieldSolver> Solver;
};

}

// Two points are enough for a whole row of squares.
TEST_F(GuideLines, PrescribeTheirTangentsWhereTheyPass)
{
  const auto line = Polyline({ { 0.1, 3.3, 0.2 }, { 7.9, 3.3, 0.2 } });
  this->Solver->SetInputDataObject(1, line);
  this->ExpectNear(this->Prescribed(), this->CellsInRow(3));
  for (const auto& cell : this->CellsInRow(3))
  {
    EXPECT_LT((this->Direction(cell.first) - Vector3(1.0, 0.0, 0.0)).norm(), 1e-9);
  }
  EXPECT_EQ(this->Report("GuidesTaken"), 1);
  EXPECT_EQ(this->Report("GuidesTooFar"), 0);
  EXPECT_NEAR(Values(this->Solver->GetOutput()->GetFieldData(), "GuidesFarthest").at(0), 0.2, 1e-12);
}

// Neither its number of points, nor its kind of dataset, nor how it was drawn makes a line weigh
// more.
TEST_F(GuideLines, WeighByTheirLength)
{
  std::vector<Vector3> positions;
  for (int i = 0; i <= 1000; ++i)
  {
    positions.emplace_back(0.1 + 7.8 * i / 1000, 3.3, 0.0);
  }
  const auto dense = Polyline(positions);
  this->Solver->SetInputDataObject(1, dense);
  this->ExpectNear(this->Prescribed(), this->CellsInRow(3));
  EXPECT_EQ(this->Report("GuidesTaken"), 1000);

  vtkNew<vtkUnstructuredGrid> grid;
  grid->SetPoints(PointsOf({ { 0.1, 3.3, 0.0 }, { 7.9, 3.3, 0.0 } }));
  const vtkIdType ends[] = { 0, 1 };
  grid->InsertNextCell(VTK_LINE, 2, ends);
  this->Solver->SetInputDataObject(1, grid);
  this->ExpectNear(this->Prescribed(), this->CellsInRow(3));
}

// To a field of lines it is all the same whether a guide runs to or fro, to crosses a quarter turn
// is.
TEST_F(GuideLines, AreNoPowers)
{
  const auto fieldOf = [this](int N, vtkDataObject* guide)
  {
    this->Solver->SetNumberOfDirections(N);
    this->Solver->SetInputDataObject(1, guide);
    this->Solver->Update();
    return Values(this->Solver->GetOutput()->GetCellData(), "PowerField");
  };
  const auto expectSame = [](const std::vector<double>& a, const std::vector<double>& b)
  {
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t i = 0; i < a.size(); ++i)
    {
      EXPECT_NEAR(a[i], b[i], 1e-12);
    }
  };
  const Vector3 a(0.2, 0.7, 0.0), b(6.9, 5.3, 0.0);
  expectSame(fieldOf(2, Polyline({ a, b })), fieldOf(2, Polyline({ b, a })));
  this->Solver->SetGuideArrayToProcess(1, 1, 0, OnPoints, "Wind");
  expectSame(fieldOf(4, PointWithVector(a, { 3.0, 1.0, 0.0 }, "Wind")),
    fieldOf(4, PointWithVector(a, { -1.0, 3.0, 0.0 }, "Wind")));
}

TEST_F(GuideLines, MayBeSeveralWithOtherGuides)
{
  const auto line = Polyline({ { 0.1, 3.3, 0.0 }, { 7.9, 3.3, 0.0 } });
  const auto point = PointWithVector({ 5.3, 6.2, 0.0 }, { 0.0, 1.0, 0.0 }, "Wind");
  this->Solver->AddInputDataObject(1, line);
  this->Solver->AddInputDataObject(1, point);
  this->Solver->SetGuideArrayToProcess(1, 1, 0, OnPoints, "Wind");
  const Cells cells = this->Prescribed();
  EXPECT_EQ(cells.size(), this->CellsInRow(3).size() + 1);
  for (const auto& cell : cells)
  {
    const bool isOfLine = this->CellsInRow(3).count(cell.first) > 0;
    const Vector3 expected = isOfLine ? Vector3(1.0, 0.0, 0.0) : Vector3(0.0, 1.0, 0.0);
    EXPECT_LT((this->Direction(cell.first) - expected).norm(), 1e-9);
  }
  EXPECT_EQ(this->Report("GuidesTaken"), 2);

  this->Solver->RemoveAllGuides();
  EXPECT_TRUE(this->Prescribed().empty());
}

TEST_F(GuideLines, WithChosenVectorsPrescribeThese)
{
  const auto line = Polyline({ { 0.1, 3.3, 0.0 }, { 7.9, 3.3, 0.0 } });
  AddCellVectors(line, "OfCells", { { 0, { 0.0, 2.0, 0.0 } } });
  AddPointVectors(line, "OfPoints", { { 1, { 0.0, 1.0, 0.0 } } });
  this->Solver->SetInputDataObject(1, line);
  // On a cell, along all of the line; at a point, there only.
  this->Solver->SetGuideArrayToProcess(1, 1, 0, OnCells, "OfCells");
  this->ExpectNear(this->Prescribed(), this->CellsInRow(3));
  for (const auto& cell : this->CellsInRow(3))
  {
    EXPECT_LT((this->Direction(cell.first) - Vector3(0.0, 1.0, 0.0)).norm(), 1e-9);
  }
  this->Solver->SetGuideArrayToProcess(1, 1, 0, OnPoints, "OfPoints");
  EXPECT_EQ(this->Prescribed().size(), 1u);
}

TEST_F(GuideLines, CellsWithVectorsPrescribeTheFaceAtTheirMean)
{
  const auto copy = PolyDataOf(PlaneGrid(8, 8));
  AddCellVectors(copy, "Wind", { { 17, { 1.0, 0.0, 0.0 } }, { 90, { 0.0, 1.0, 0.0 } } });
  this->Solver->SetInputDataObject(1, copy);
  this->Solver->SetGuideArrayToProcess(1, 1, 0, OnCells, "Wind");
  this->ExpectNear(this->Prescribed(), { { 17, 1.0 }, { 90, 1.0 } });
  // The same as active vectors.
  copy->GetCellData()->SetActiveVectors("Wind");
  this->Solver->SetGuideArrayToProcess(1, 1, 0, OnCells, "");
  this->ExpectNear(this->Prescribed(), { { 17, 1.0 }, { 90, 1.0 } });
}

// Soft, since hard constraints have no weights.
TEST_F(GuideLines, HaveWeights)
{
  this->Solver->SetConstraintType(vtkHarmonicFieldSolver::Soft);
  const auto first = Polyline({ { 0.1, 3.3, 0.0 }, { 7.9, 3.3, 0.0 } });
  const auto second = Polyline({ { 0.1, 5.3, 0.0 }, { 7.9, 5.3, 0.0 } });
  this->Solver->AddInputDataObject(1, first);
  this->Solver->AddInputDataObject(1, second);
  const auto expected = [this](double weight)
  {
    Cells cells = this->CellsInRow(3, weight);
    const Cells others = this->CellsInRow(5);
    cells.insert(others.begin(), others.end());
    return cells;
  };
  const auto weights = [](vtkIdType tuples, double weight)
  {
    const auto array = Zeros("Weights", tuples, 1);
    array->Fill(weight);
    return array;
  };
  first->GetFieldData()->AddArray(weights(1, 2.5));
  this->Solver->SetGuideArrayToProcess(2, 1, 0, InFieldData, "Weights");
  this->ExpectNear(this->Prescribed(), expected(2.5));
  first->GetCellData()->AddArray(weights(1, 3.5));
  this->Solver->SetGuideArrayToProcess(2, 1, 0, OnCells, "Weights");
  this->ExpectNear(this->Prescribed(), expected(3.5));
  first->GetPointData()->AddArray(weights(2, 4.5));
  this->Solver->SetGuideArrayToProcess(2, 1, 0, OnPoints, "Weights");
  this->ExpectNear(this->Prescribed(), expected(4.5));

  first->GetPointData()->GetArray("Weights")->SetTuple1(1, -4.5); // also where both ends cancel
  first->Modified();
  EXPECT_NE(this->Error().find("cell 0 of guide 0, at its point 1, is -4.5"), std::string::npos);
  first->GetFieldData()->GetArray("Weights")->Fill(-2.0);
  first->Modified();
  this->Solver->SetGuideArrayToProcess(2, 1, 0, InFieldData, "Weights");
  EXPECT_NE(this->Error().find("the weight of guide 0"), std::string::npos);
  this->Solver->SetGuideArrayToProcess(2, 1, 0, OnPoints, "Gone");
  EXPECT_NE(this->Error().find("'Gone', chosen for the weights"), std::string::npos);
}

TEST_F(GuideLines, OfWeightZeroAreNotFollowed)
{
  this->Solver->SetConstraintType(vtkHarmonicFieldSolver::Soft);
  const auto first = Polyline({ { 0.1, 3.3, 0.0 }, { 7.9, 3.3, 0.0 } });
  const auto second = Polyline({ { 0.1, 5.3, 0.0 }, { 7.9, 5.3, 0.0 } });
  this->Solver->AddInputDataObject(1, first);
  this->Solver->AddInputDataObject(1, second);
  first->GetFieldData()->AddArray(Zeros("Weights", 1, 1));
  first->GetCellData()->AddArray(Zeros("Weights", 1, 1));
  first->GetPointData()->AddArray(Zeros("Weights", 2, 1));
  for (const int association : { InFieldData, OnCells, OnPoints })
  {
    this->Solver->SetGuideArrayToProcess(2, 1, 0, association, "Weights");
    this->ExpectNear(this->Prescribed(), this->CellsInRow(5));
  }
  // And if none is left, the field is not the smoothest one without a word.
  this->Solver->RemoveInputConnection(1, 1);
  EXPECT_NE(this->Error().find("no direction is prescribed"), std::string::npos);
}

// A name alone is that of the array beside the vectors.
TEST_F(GuideLines, TakeWeightsFromWhereTheirVectorsAre)
{
  this->Solver->SetConstraintType(vtkHarmonicFieldSolver::Soft);
  const vtkSmartPointer<vtkPolyData> cells = PolyDataOf(PlaneGrid(8, 8));
  AddCellVectors(cells, "Way", { { 7, Vector3::UnitX() } });
  const auto onPoints = Zeros("Weights", cells->GetNumberOfPoints(), 1);
  const auto onCells = Zeros("Weights", cells->GetNumberOfCells(), 1);
  onCells->Fill(2.5);
  cells->GetPointData()->AddArray(onPoints);
  cells->GetCellData()->AddArray(onCells);
  this->Solver->SetInputDataObject(1, cells);
  this->Solver->SetGuideDirections("Way");
  this->Solver->SetGuideWeights("Weights");
  this->ExpectNear(this->Prescribed(), { { 7, 2.5 } });
}

// The ports beyond the first are those of ParaView's lists.
TEST_F(GuideLines, TakeTypedNumbersAsWeights)
{
  this->Solver->SetConstraintType(vtkHarmonicFieldSolver::Soft);
  const auto first = Polyline({ { 0.1, 3.3, 0.0 }, { 7.9, 3.3, 0.0 } });
  this->Solver->AddInputDataObject(1, first);
  this->Solver->SetInputDataObject(4, Polyline({ { 0.1, 5.3, 0.0 }, { 7.9, 5.3, 0.0 } }));
  const auto expected = [this](double ofThird, double ofFifth)
  {
    Cells cells;
    for (const auto& [row, factor] : { std::pair(3, ofThird), std::pair(5, ofFifth) })
    {
      for (const auto& [cell, weight] : this->CellsInRow(row))
      {
        cells[cell] = factor * weight;
      }
    }
    return cells;
  };
  this->ExpectNear(this->Prescribed(), expected(1.0, 1.0));
  this->Solver->SetGuideWeights("5");
  this->ExpectNear(this->Prescribed(), expected(5.0, 5.0));
  this->Solver->SetGuideWeights(" 2, 7; 0.5"); // the second one is that of the empty port
  this->ExpectNear(this->Prescribed(), expected(2.0, 0.5));
  this->Solver->SetGuideWeights("0 1 1");
  this->ExpectNear(this->Prescribed(), this->CellsInRow(5));
  this->Solver->SetGuideWeights("1 1 -2");
  EXPECT_NE(this->Error().find("weight of guide 1, typed in Guide Weights, is -2"), std::string::npos);
  this->Solver->SetGuideWeights("1 apple");
  EXPECT_NE(this->Error().find("'1 apple', chosen for the weights"), std::string::npos);
  // A number is the name of an array, where there is one.
  this->Solver->SetGuideWeights("7");
  const auto zeros = Zeros("7", 1, 1);
  first->GetFieldData()->AddArray(zeros);
  this->ExpectNear(this->Prescribed(), this->CellsInRow(5));
}

// As where a person clears the first of ParaView's lists.
TEST_F(GuideLines, KeepTheirWeightsWhereOneBeforeThemIsTakenAway)
{
  this->Solver->SetConstraintType(vtkHarmonicFieldSolver::Soft);
  this->Solver->AddInputDataObject(1, Polyline({ { 0.1, 3.3, 0.0 }, { 7.9, 3.3, 0.0 } }));
  this->Solver->SetInputDataObject(3, Polyline({ { 0.1, 5.3, 0.0 }, { 7.9, 5.3, 0.0 } }));
  this->Solver->SetGuideWeights("1 10");
  this->Prescribed();
  this->Solver->RemoveAllGuides();
  this->ExpectNear(this->Prescribed(), this->CellsInRow(5, 10.0));
}

TEST_F(GuideLines, TakeNoMoreWeightsThanThereAreOfThem)
{
  this->Solver->SetConstraintType(vtkHarmonicFieldSolver::Soft);
  this->Solver->AddInputDataObject(1, Polyline({ { 0.1, 3.3, 0.0 }, { 7.9, 3.3, 0.0 } }));
  this->Solver->SetGuideWeights("4 10 7");
  this->ExpectNear(this->Prescribed("3 numbers"), this->CellsInRow(3, 4.0));
  // Without a guide they are nobody's.
  this->Solver->RemoveAllGuides();
  this->Prescribed();
}

TEST_F(GuideLines, AreFollowedOnceWhereTheyAreChosenTwice)
{
  this->Solver->SetConstraintType(vtkHarmonicFieldSolver::Soft);
  vtkNew<vtkTrivialProducer> source;
  source->SetOutput(Polyline({ { 0.1, 3.3, 0.0 }, { 7.9, 3.3, 0.0 } }));
  this->Solver->AddInputConnection(1, source->GetOutputPort());
  this->Solver->SetInputConnection(3, source->GetOutputPort());
  this->Solver->SetGuideWeights("2 5");
  this->ExpectNear(this->Prescribed("chosen more than once"), this->CellsInRow(3, 2.0));
}

// The search structure of a surface is kept for another dataset with the same content.
TEST_F(GuideLines, FollowTheSurfaceAlsoWhereTheFormerInputIsChanged)
{
  const vtkSmartPointer<vtkPolyData> former = PolyDataOf(PlaneGrid(8, 8));
  this->Solver->SetInputData(former);
  this->Solver->SetInputDataObject(1, Polyline({ { 0.1, 3.3, 0.0 }, { 7.9, 3.3, 0.0 } }));
  this->ExpectNear(this->Prescribed(), this->CellsInRow(3));
  for (vtkIdType point = 0; point < former->GetNumberOfPoints(); ++point)
  {
    const Vector3 moved = Vector3(former->GetPoint(point)) + 1.3 * Vector3::UnitY();
    former->GetPoints()->SetPoint(point, moved.data());
  }
  this->Solver->SetInputData(this->Plate);
  this->Solver->SetInputDataObject(1, Polyline({ { 0.1, 5.3, 0.0 }, { 7.9, 5.3, 0.0 } }));
  this->ExpectNear(this->Prescribed(), this->CellsInRow(5));
}

TEST_F(GuideLines, HaveMasks)
{
  const auto line = Polyline({ { 0.1, 3.3, 0.0 }, { 7.9, 3.3, 0.0 }, { 7.9, 5.3, 0.0 } });
  const auto mask = Zeros("Mask", 3, 1);
  mask->SetValue(0, 1.0);
  mask->SetValue(1, 1.0);
  line->GetPointData()->AddArray(mask);
  this->Solver->SetInputDataObject(1, line);
  this->Solver->SetGuideArrayToProcess(0, 1, 0, OnPoints, "Mask");
  this->ExpectNear(this->Prescribed(), this->CellsInRow(3));
}

TEST_F(GuideLines, WarnOfWhatIsLeftOut)
{
  this->Solver->SetMaximumDistance(0.5 / std::sqrt(128.0)); // half a square
  const auto line = Polyline({ { 0.1, 3.3, 0.0 }, { 7.9, 3.3, 0.0 }, { 7.9, 3.3, 9.0 } });
  this->Solver->SetInputDataObject(1, line);
  this->ExpectNear(this->Prescribed("1 element farther from the surface than 0.5"), this->CellsInRow(3));
  EXPECT_EQ(this->Report("GuidesTaken"), 1);
  EXPECT_EQ(this->Report("GuidesTooFar"), 1);
  EXPECT_EQ(this->Report("GuidesPerpendicular"), 1); // its lower part
  EXPECT_EQ(this->Report("GuidesOnFarSide"), 0);

  // The remedy works.
  this->Solver->SetMaximumDistance(1.0);
  this->Prescribed("within 5 degrees of the normal");
  EXPECT_EQ(this->Report("GuidesTooFar"), 0);

  this->Solver->SetInputDataObject(1, Polyline({ { 1.0, 1.0, 50.0 }, { 3.0, 3.0, 50.0 } }));
  const std::string error = this->Error();
  EXPECT_NE(error.find("no direction is prescribed"), std::string::npos) << error;
  EXPECT_NE(error.find("raise Maximum Distance"), std::string::npos) << error;
}

TEST_F(GuideLines, AreLeftOutWithinFiveDegreesOfTheNormal)
{
  for (const bool isVector : { false, true })
  {
    for (const double degrees : { 4.9, 5.1 })
    {
      const double angle = degrees * Pi / 180.0;
      const Vector3 foot(3.4, 3.3, 0.0), leaning(std::sin(angle), 0.0, std::cos(angle));
      const auto line = Polyline({ foot, foot + 0.1 * leaning });
      AddPointVectors(line, "Wind", { { 0, leaning } });
      this->Solver->SetInputDataObject(1, line);
      this->Solver->SetGuideArrayToProcess(1, 1, 0, OnPoints, isVector ? "Wind" : "");
      if (degrees < 5.0)
      {
        const std::string error = this->Error();
        EXPECT_NE(error.find("1 element within 5 degrees of the normal"), std::string::npos) << error;
        continue;
      }
      EXPECT_FALSE(this->Prescribed().empty());
      EXPECT_EQ(this->Report("GuidesPerpendicular"), 0);
    }
  }
}

TEST_F(GuideLines, WithNothingToFollowAreAnError)
{
  this->Solver->AddInputDataObject(1, Polyline({ { 0.1, 3.3, 0.0 }, { 7.9, 3.3, 0.0 } }));
  this->Solver->AddInputDataObject(1, PolyDataOf(PlaneGrid(2, 2)));
  EXPECT_NE(this->Error().find("guide 1 has neither lines nor vectors"), std::string::npos);
}

TEST_F(GuideLines, WithoutDataAreAnError)
{
  this->Solver->AddInputConnection(1, vtkNew<vtkTrivialProducer>()->GetOutputPort());
  EXPECT_NE(this->Error().find("is a vtkDataObject"), std::string::npos);
}

TEST_F(GuideLines, WithPointsThatDoNotExistAreAnError)
{
  const auto line = Polyline({ { 0.1, 3.3, 0.0 }, { 7.9, 3.3, 0.0 } });
  line->GetLines()->InsertNextCell({ 1, 99 });
  this->Solver->SetInputDataObject(1, line);
  EXPECT_NE(this->Error().find("uses point 99"), std::string::npos);
}

// A unit vector along the line, whatever the discretisation.
TEST_F(GuideLines, PrescribeFlows)
{
  this->Solver->UnitLengthOff();
  this->Solver->SetInputDataObject(1, Polyline({ { 0.1, 3.3, 0.0 }, { 7.9, 3.3, 0.0 } }));
  for (int kind : { vtkHarmonicFieldSolver::FaceField, vtkHarmonicFieldSolver::OneForm })
  {
    this->Solver->SetDiscretisation(kind);
    this->Prescribed();
    for (const auto& cell : this->CellsInRow(3))
    {
      EXPECT_LT((this->Direction(cell.first) - Vector3(1.0, 0.0, 0.0)).norm(), 1e-9);
    }
  }
}
