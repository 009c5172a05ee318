// Guides, and arrays that do not fit, of the surface and of guides.

#include "vtkHarmonicFieldSolver.h"

#include "NoteOfShear.h"
#include "TestTools.h"

#include "vtkIdList.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkTable.h"

#include <gtest/gtest.h>

#include <limits>
#include <set>

using namespace dmg;
using namespace dmg::test;

namespace
{

constexpr int OnPoints = vtkDataObject::FIELD_ASSOCIATION_POINTS;
constexpr int OnCells = vtkDataObject::FIELD_ASSOCIATION_CELLS;
constexpr double NaN = std::numeric_limits<double>::quiet_NaN();
constexpr double Infinity = std::numeric_limits<double>::infinity();

Vector3 Centroid(vtkPolyData* surface, vtkIdType cell)
{
  vtkNew<vtkIdList> corners;
  surface->GetCellPoints(cell, corners);
  Vector3 sum = Vector3::Zero();
  for (int k = 0; k < 3; ++k)
  {
    sum += Vector3(surface->GetPoint(corners->GetId(k))) / 3.0;
  }
  return sum;
}

/// Points without cells, at each of them the vector (1, 2, 0), in the array "Wind".
vtkSmartPointer<vtkPolyData> PointsAt(const std::vector<Vector3>& positions)
{
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  Vectors vectors;
  for (const Vector3& position : positions)
  {
    vectors.push_back({ points->InsertNextPoint(position.data()), { 1.0, 2.0, 0.0 } });
  }
  auto data = vtkSmartPointer<vtkPolyData>::New();
  data->SetPoints(points);
  AddPointVectors(data, "Wind", vectors);
  return data;
}

class Guides : public testing::Test
{
protected:
  void SetUp() override
  {
    this->Solver->SetInputData(this->Plate);
    this->Solver->SetDiscretisation(vtkHarmonicFieldSolver::PowerField); // shows the faces that a guide reaches
    this->Solver->SetGuideArrayToProcess(1, 1, 0, OnPoints, "Wind");
  }

  /// Expects one error of the filter, with some words, and empty outputs.
  void ExpectOneError(const std::vector<std::string>& words)
  {
    const Messages messages(this->Solver);
    this->Solver->Update();
    std::vector<std::string> errors;
    for (const std::string& error : messages.GetErrors())
    {
      if (error.find("returned failure for request") == std::string::npos) // the executive's
      {
        errors.push_back(error);
      }
    }
    ASSERT_EQ(errors.size(), 1u);
    for (const std::string& word : words)
    {
      EXPECT_NE(errors[0].find(word), std::string::npos) << "'" << word << "' is not in: " << errors[0];
    }
    EXPECT_EQ(this->Solver->GetOutput()->GetNumberOfCells(), 0);
  }

  std::set<vtkIdType> PrescribedCells()
  {
    const Messages messages(this->Solver);
    this->Solver->Update();
    EXPECT_TRUE(messages.GetErrors().empty()) << messages.Error();
    EXPECT_TRUE(WithoutNoteOfShear(messages.GetWarnings()).empty());
    return this->CellsOfOutput();
  }

  std::set<vtkIdType> CellsOfOutput()
  {
    std::set<vtkIdType> cells;
    const auto prescribed = Values(this->Solver->GetOutput()->GetCellData(), "Prescribed");
    for (std::size_t cell = 0; cell < prescribed.size(); ++cell)
    {
      if (prescribed[cell] > 0.0)
      {
        cells.insert(static_cast<vtkIdType>(cell));
      }
    }
    return cells;
  }

  const vtkSmartPointer<vtkPolyData> Plate = PolyDataOf(PlaneGrid(8, 8));
  const Vector3 Inside = Centroid(Plate, 40);
  vtkNew<vtkHarmonicFieldSolver> Solver;
};

}

TEST_F(Guides, MayBeComposite)
{
  vtkNew<vtkMultiBlockDataSet> inner, outer;
  inner->SetBlock(1, PointsAt({ Centroid(this->Plate, 7) })); // block 0 is null
  outer->SetBlock(0, inner);
  outer->SetBlock(1, PointsAt({ Centroid(this->Plate, 90) }));
  outer->SetBlock(2, vtkNew<vtkTable>());
  const auto without = PointsAt({ Centroid(this->Plate, 50) }); // the chosen array
  without->GetPointData()->GetArray("Wind")->SetName("Rain");
  outer->SetBlock(3, without);
  outer->SetBlock(4, PointsAt({}));
  this->Solver->SetInputDataObject(1, outer);
  EXPECT_EQ(this->PrescribedCells(), (std::set<vtkIdType>{ 7, 90 }));
}

TEST_F(Guides, MessagesNameTheBlock)
{
  vtkNew<vtkMultiBlockDataSet> blocks;
  blocks->SetBlock(0, PointsAt({ this->Inside }));
  blocks->SetBlock(1, PointsAt({ this->Inside, { 0.0, NaN, 0.0 } }));
  this->Solver->SetInputDataObject(1, blocks);
  this->ExpectOneError({ "point 1 of block 2 of the guide" });
}

TEST_F(Guides, AreNoTables)
{
  this->Solver->SetInputDataObject(1, vtkNew<vtkTable>());
  this->ExpectOneError({ "vtkTable", "Table To Points" });
}

TEST_F(Guides, WithoutPointsPrescribeNothing)
{
  this->Solver->SetInputDataObject(1, vtkNew<vtkPolyData>());
  EXPECT_TRUE(this->PrescribedCells().empty());
  AddCellVectors(this->Plate, "Given", { { 3, { 1.0, 0.0, 0.0 } } });
  this->Solver->SetInputArrayToProcess(1, 0, 0, OnCells, "Given");
  EXPECT_EQ(this->PrescribedCells(), (std::set<vtkIdType>{ 3 }));
}

TEST_F(Guides, HaveTheirOwnMaskAndWeights)
{
  const auto points = PointsAt({ Centroid(this->Plate, 7), Centroid(this->Plate, 90) });
  const auto mask = Zeros("Mask", 2, 1);
  mask->SetValue(1, 1.0);
  const auto weights = Zeros("Weights", 2, 1);
  weights->SetValue(1, 2.5);
  points->GetPointData()->AddArray(mask);
  points->GetPointData()->AddArray(weights);
  this->Solver->SetInputDataObject(1, points);
  this->Solver->SetGuideArrayToProcess(0, 1, 0, OnPoints, "Mask");
  this->Solver->SetGuideArrayToProcess(2, 1, 0, OnPoints, "Weights");
  EXPECT_EQ(this->PrescribedCells(), (std::set<vtkIdType>{ 90 }));
  EXPECT_EQ(Values(this->Solver->GetOutput()->GetCellData(), "Prescribed")[90], 2.5);
  mask->SetValue(0, 1.0); // the weight there is 0
  points->Modified();
  EXPECT_EQ(this->PrescribedCells(), (std::set<vtkIdType>{ 90 }));
}

TEST_F(Guides, MayHaveVectorsWithoutAName)
{
  const auto points = PointsAt({ this->Inside });
  points->GetPointData()->GetArray("Wind")->SetName(nullptr);
  points->GetPointData()->SetAttribute(points->GetPointData()->GetArray(0), vtkDataSetAttributes::VECTORS);
  this->Solver->SetInputDataObject(1, points);
  this->Solver->SetGuideArrayToProcess(1, 1, 0, OnPoints, nullptr);
  EXPECT_EQ(this->PrescribedCells(), (std::set<vtkIdType>{ 40 }));
}

TEST_F(Guides, HaveNoOtherArrays)
{
  const Messages messages(this->Solver);
  this->Solver->SetGuideArrayToProcess(3, 1, 0, OnPoints, "Wind");
  ASSERT_EQ(messages.GetErrors().size(), 1u);
  EXPECT_NE(messages.Error().find("choose"), std::string::npos) << messages.Error();
}

TEST_F(Guides, RefusePointsThatAreNowhere)
{
  for (const Vector3& position : { Vector3(NaN, 0.0, 0.0), Vector3(0.0, Infinity, 0.0), Vector3(0.0, 0.0, -Infinity) })
  {
    const auto points = PointsAt({ this->Inside, position, this->Inside });
    this->Solver->SetInputDataObject(1, points);
    this->ExpectOneError({ "point 1 of the guide", "move" });
    // The remedy works.
    points->GetPointData()->GetArray("Wind")->SetTuple3(1, 0.0, 0.0, 0.0);
    points->Modified();
    EXPECT_EQ(this->PrescribedCells(), (std::set<vtkIdType>{ 40 }));
  }
}

TEST_F(Guides, ReachPointsThatAreFarAway)
{
  this->Solver->SetMaximumDistance(1e6);
  this->Solver->SetInputDataObject(1, PointsAt({ this->Inside + Vector3(0.0, 0.0, 1e6) }));
  EXPECT_EQ(this->PrescribedCells(), (std::set<vtkIdType>{ 40 }));
}

TEST_F(Guides, RefuseArraysWithTooFewTuples)
{
  for (const char* name : { "Wind", "Mask", "Weights" })
  {
    for (vtkIdType tuples : { 0, 1 })
    {
      SCOPED_TRACE(std::string(name) + ", " + std::to_string(tuples));
      const auto points = PointsAt({ this->Inside, this->Inside });
      for (const char* other : { "Mask", "Weights" })
      {
        const auto ones = Zeros(other, 2, 1);
        ones->Fill(1.0);
        points->GetPointData()->AddArray(ones);
      }
      this->Solver->SetGuideArrayToProcess(0, 1, 0, OnPoints, "Mask");
      this->Solver->SetGuideArrayToProcess(2, 1, 0, OnPoints, "Weights");
      this->Solver->SetInputDataObject(1, points);
      EXPECT_EQ(this->PrescribedCells(), (std::set<vtkIdType>{ 40 }));
      points->GetPointData()->GetArray(name)->SetNumberOfTuples(tuples);
      points->Modified();
      this->ExpectOneError({ "array '" + std::string(name) + "'", "of the guide",
        std::to_string(tuples) + " tuples for 2 points", "choose another" });
    }
  }
}

TEST_F(Guides, RefuseActiveVectorsWithTooFewTuples)
{
  const auto points = PointsAt({ this->Inside, this->Inside });
  points->GetPointData()->SetActiveVectors("Wind");
  points->GetPointData()->GetArray("Wind")->SetNumberOfTuples(1);
  this->Solver->SetInputDataObject(1, points);
  this->Solver->SetGuideArrayToProcess(1, 1, 0, OnPoints, "");
  this->ExpectOneError({ "array 'Wind'", "1 tuples for 2 points" });
}

TEST_F(Guides, MayHaveArraysWithTooManyTuples)
{
  const auto points = PointsAt({ this->Inside });
  auto* const wind = points->GetPointData()->GetArray("Wind");
  wind->InsertNextTuple3(1.0, 0.0, 0.0);
  this->Solver->SetInputDataObject(1, points);
  EXPECT_EQ(this->PrescribedCells(), (std::set<vtkIdType>{ 40 }));
}

class Surfaces
  : public Guides
  , public testing::WithParamInterface<int>
{
};

INSTANTIATE_TEST_SUITE_P(Guides, Surfaces, testing::Values(OnPoints, OnCells));

TEST_P(Surfaces, RefuseArraysWithTooFewTuples)
{
  const int association = GetParam();
  const char* const names[] = { "Mask", "Given", "Weights" }; // by index
  for (int index : { 0, 1, 2 })
  {
    for (vtkIdType tuples : { 0, 7 })
    {
      SCOPED_TRACE(std::string(names[index]) + ", " + std::to_string(tuples));
      vtkDataSetAttributes* const attributes = this->Plate->GetAttributes(association);
      const vtkIdType elements = this->Plate->GetNumberOfElements(association);
      for (int i : { 0, 1, 2 })
      {
        const auto array = Zeros(names[i], elements, i == 1 ? 3 : 1);
        array->Fill(1.0);
        attributes->AddArray(array);
        this->Solver->SetInputArrayToProcess(i, 0, 0, association, names[i]);
      }
      EXPECT_FALSE(this->PrescribedCells().empty());
      attributes->GetArray(names[index])->SetNumberOfTuples(tuples);
      this->Plate->Modified();
      this->ExpectOneError({ "array '" + std::string(names[index]) + "'", "of the surface",
        std::to_string(tuples) + " tuples for " + std::to_string(elements), "choose another" });
    }
  }
}
