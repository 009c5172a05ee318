// The input Singularities of the solver.

#include "vtkFieldSingularities.h"
#include "vtkHarmonicFieldSolver.h"

#include "TestTools.h"

#include "vtkFloatArray.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkTable.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <map>

using namespace dmg;
using namespace dmg::test;

namespace
{

/// Points without cells; with an array "Index", unless that is empty.
vtkSmartPointer<vtkPolyData> PointsAt(
  const std::vector<Vector3>& positions, const std::vector<float>& indices = {}, const char* name = "Index")
{
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  for (const Vector3& position : positions)
  {
    points->InsertNextPoint(position.data());
  }
  auto data = vtkSmartPointer<vtkPolyData>::New();
  data->SetPoints(points);
  if (!indices.empty())
  {
    vtkNew<vtkFloatArray> array;
    array->SetName(name);
    for (const float index : indices)
    {
      array->InsertNextValue(index);
    }
    data->GetPointData()->AddArray(array);
  }
  return data;
}

std::vector<Vector3> CornersOfCube()
{
  std::vector<Vector3> corners;
  for (int k = 0; k < 8; ++k)
  {
    corners.push_back(Vector3(k & 1 ? 1.0 : -1.0, k & 2 ? 1.0 : -1.0, k & 4 ? 1.0 : -1.0) / std::sqrt(3.0));
  }
  return corners;
}

class Singularities : public testing::Test
{
protected:
  void SetUp() override { this->Solver->SetInputData(this->Sphere); }

  /// N times the index of each singular point of the surface.
  std::map<vtkIdType, int> Found()
  {
    const Messages messages(this->Solver);
    this->Solver->Update();
    EXPECT_TRUE(messages.Silent()) << messages.Error();
    std::map<vtkIdType, int> found;
    const auto indices = Values(this->Solver->GetOutput()->GetPointData(), "SingularityIndex");
    for (std::size_t point = 0; point < indices.size(); ++point)
    {
      const auto times = static_cast<int>(std::lround(this->Solver->GetNumberOfDirections() * indices[point]));
      if (times != 0)
      {
        found[static_cast<vtkIdType>(point)] = times;
      }
    }
    return found;
  }

  void ExpectOneError(const std::vector<std::string>& words)
  {
    const Messages messages(this->Solver);
    this->Solver->Update();
    for (const std::string& word : words)
    {
      EXPECT_NE(messages.Error().find(word), std::string::npos) << "'" << word << "' is not in: " << messages.Error();
    }
    EXPECT_EQ(messages.GetErrors().size(), 2u); // and that of the executive
    EXPECT_EQ(this->Solver->GetOutput()->GetNumberOfCells(), 0);
  }

  Vector3 PointOfSphere(vtkIdType point) { return Vector3(this->Sphere->GetPoint(point)); }

  const vtkSmartPointer<vtkPolyData> Sphere = PolyDataOf(IrregularSphere(3, 3));
  vtkNew<vtkHarmonicFieldSolver> Solver;
};

}

TEST_F(Singularities, AreThoseOfTheField)
{
  // Without an array, each is of 1 / N, and the same point twice of 2 / N.
  this->Solver->SetInputData(2,
    PointsAt({ PointOfSphere(7), PointOfSphere(80), 1.05 * PointOfSphere(80), PointOfSphere(200), PointOfSphere(300),
      PointOfSphere(400), PointOfSphere(500), 0.99 * PointOfSphere(600) }));
  EXPECT_EQ(this->Found(),
    (std::map<vtkIdType, int>{ { 7, 1 }, { 80, 2 }, { 200, 1 }, { 300, 1 }, { 400, 1 }, { 500, 1 }, { 600, 1 } }));
  const auto power = Values(this->Solver->GetOutput()->GetCellData(), "PowerField");
  for (std::size_t i = 0; i < power.size(); i += 2)
  {
    EXPECT_NEAR(std::hypot(power[i], power[i + 1]), 1.0, 1e-12);
  }
}

TEST_F(Singularities, HaveIndicesFromAnArrayOfAnyName)
{
  this->Solver->SetNumberOfDirections(3);
  const std::vector<Vector3> places{ PointOfSphere(7), PointOfSphere(80), PointOfSphere(200), PointOfSphere(300),
    PointOfSphere(400), PointOfSphere(500), PointOfSphere(620), PointOfSphere(630) };
  const float third = 1.0F / 3.0F; // 32 bits
  const std::vector<float> indices{ third, third, third, third, third, third, third, -third };
  const std::map<vtkIdType, int> expected{ { 7, 1 }, { 80, 1 }, { 200, 1 }, { 300, 1 }, { 400, 1 }, { 500, 1 },
    { 620, 1 }, { 630, -1 } };
  this->Solver->SetInputData(2, PointsAt(places, indices));
  EXPECT_EQ(this->Found(), expected);
  this->Solver->SetInputData(2, PointsAt(places, indices, "Turns"));
  this->Solver->SetSingularityIndexArray("Turns");
  EXPECT_EQ(this->Found(), expected);
  this->Solver->SetSingularityIndexArray("Twists");
  this->ExpectOneError({ "'Twists'", "Singularity Index" });
}

TEST_F(Singularities, MayBeThoseOfAnotherField)
{
  vtkNew<vtkHarmonicFieldSolver> other;
  other->SetInputData(this->Sphere);
  other->SetDiscretisation(vtkHarmonicFieldSolver::PowerField); // which has them at points
  vtkNew<vtkFieldSingularities> singularities;
  singularities->SetInputConnection(other->GetOutputPort());
  this->Solver->AddSingularitiesConnection(singularities->GetOutputPort());
  const auto found = this->Found();
  EXPECT_EQ(Values(this->Solver->GetOutput()->GetPointData(), "SingularityIndex"),
    Values(other->GetOutput()->GetPointData(), "SingularityIndex"));
  EXPECT_FALSE(found.empty());

  this->Solver->RemoveAllSingularities();
  this->Solver->AddSingularitiesConnection(singularities->GetOutputPort(3));
  EXPECT_EQ(this->Found(), found) << "as spheres";
}

// Those on triangles come to the nearest points, one each.
TEST_F(Singularities, MayBeThoseOfAFieldAtPoints)
{
  vtkNew<vtkHarmonicFieldSolver> other;
  other->SetInputData(this->Sphere);
  vtkNew<vtkFieldSingularities> singularities;
  singularities->SetInputConnection(other->GetOutputPort());
  this->Solver->AddSingularitiesConnection(singularities->GetOutputPort());
  const auto found = this->Found();
  vtkPolyData* const places = singularities->GetOutput(0);
  EXPECT_EQ(found.size(), static_cast<std::size_t>(places->GetNumberOfPoints()));
  EXPECT_EQ(found.size(), 8u);
}

TEST_F(Singularities, MovedSolveAgainOnly)
{
  const auto expectCounts = [this](int setups, int systems, int solves)
  {
    EXPECT_EQ(this->Solver->GetNumberOfSetups(), setups);
    EXPECT_EQ(this->Solver->GetNumberOfSystems(), systems);
    EXPECT_EQ(this->Solver->GetNumberOfSolves(), solves);
  };
  std::vector<Vector3> places = CornersOfCube();
  this->Solver->SetInputData(2, PointsAt(places));
  this->Found();
  expectCounts(1, 1, 1);
  places[3] = Vector3(0, 0, 1);
  this->Solver->SetInputData(2, PointsAt(places));
  const auto moved = this->Found();
  expectCounts(1, 1, 2);
  this->Solver->SetCombing(false);
  EXPECT_EQ(this->Found(), moved);
  expectCounts(1, 1, 2);
  // And away, for the smoothest field, and back to the singularities, which are kept.
  this->Solver->RemoveAllSingularities();
  this->Found();
  expectCounts(2, 2, 3);
  this->Solver->SetInputData(2, PointsAt(places));
  EXPECT_EQ(this->Found(), moved);
  expectCounts(2, 2, 3);
}

TEST_F(Singularities, AreNoneWhereTheInputIsEmpty)
{
  this->Solver->SetInputData(2, vtkNew<vtkPolyData>());
  this->ExpectOneError({ "sum to 0", "Euler characteristic is 2", "add singularities of 2 in all" });
  this->Solver->SetInputData(PolyDataOf(IrregularTorus(40, 20, 4)));
  EXPECT_TRUE(this->Found().empty());
  this->Solver->SetInputData(PolyDataOf(Annulus(30, 6)));
  EXPECT_TRUE(this->Found().empty());
}

TEST_F(Singularities, TurnToTheGuides)
{
  this->Solver->SetInputData(2, PointsAt(CornersOfCube()));
  const Vector3 direction = Vector3(0.3, 0.5, 0.0); // nearly tangent at the pole
  const auto guide = PointsAt({ { 0.0, 0.0, 1.0 } });
  AddPointVectors(guide, "Wind", { { 0, direction } });
  this->Solver->SetGuideArrayToProcess(1, 1, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "Wind");
  this->Solver->SetInputData(1, guide);
  this->Solver->AllDirectionsOn();
  EXPECT_EQ(this->Found().size(), 8u);
  const auto prescribed = Values(this->Solver->GetOutput()->GetCellData(), "Prescribed");
  int number = 0;
  for (std::size_t cell = 0; cell < prescribed.size(); ++cell)
  {
    if (prescribed[cell] > 0.0)
    {
      ++number;
      double best = 0.0;
      for (const char* name : { "Direction0", "Direction1", "Direction2", "Direction3" })
      {
        double tuple[3];
        this->Solver->GetOutput()->GetCellData()->GetArray(name)->GetTuple(static_cast<vtkIdType>(cell), tuple);
        best = std::max(best, Vector3(tuple).dot(direction.normalized()));
      }
      EXPECT_GT(best, 0.98); // triangles of 8 degrees lean out of the plane
    }
  }
  EXPECT_EQ(number, 1);
}

TEST_F(Singularities, MayBeComposite)
{
  std::vector<Vector3> places = CornersOfCube();
  vtkNew<vtkMultiBlockDataSet> blocks;
  blocks->SetBlock(0, PointsAt({ places.begin(), places.begin() + 3 }));
  blocks->SetBlock(1, PointsAt({ places.begin() + 3, places.end() }, { 0.25F, 0.25F, 0.25F, 0.25F, 0.25F }));
  this->Solver->SetInputDataObject(2, blocks);
  EXPECT_EQ(this->Found().size(), 8u);
  blocks->SetBlock(1, PointsAt({ places[3], places[4] }, { 0.25F, 0.3F }));
  blocks->Modified();
  this->ExpectOneError({ "point 1 of block 2 of the input Singularities", "0.3", "multiples of 1/4" });
}

TEST_F(Singularities, ThatCannotBeAreErrors)
{
  constexpr double NaN = std::numeric_limits<double>::quiet_NaN();
  this->Solver->SetInputData(2, PointsAt({ { 0, 0, 1 }, { 0, 0, -1 } }, { 1.0F, 0.5F }));
  this->ExpectOneError({ "sum to 1.5", "characteristic is 2", "add singularities of 0.5 in all" });
  this->Solver->SetInputData(2, PointsAt({ { 0, 0, 3 } }));
  this->ExpectOneError({ "point 0 of the input Singularities", "farther from the surface", "Maximum Distance" });
  this->Solver->SetInputData(2, PointsAt({ { 0, 0, NaN } }));
  this->ExpectOneError({ "point 0 of the input Singularities", "nan" });
  this->Solver->SetInputDataObject(2, vtkNew<vtkTable>());
  this->ExpectOneError({ "vtkTable", "Table To Points" });
  // What helps is not to move them nearer.
  this->Solver->SetInputData(2, PointsAt({ { 0, 0, 3 } }));
  for (const int kind :
    { vtkHarmonicFieldSolver::FaceField, vtkHarmonicFieldSolver::OneForm, vtkHarmonicFieldSolver::ScalarFunction })
  {
    this->Solver->SetDiscretisation(kind);
    this->ExpectOneError({ "only power fields can have them", "take the input Singularities away" });
  }
  this->Solver->SetDiscretisation(vtkHarmonicFieldSolver::PowerField);
  this->Solver->SetInputData(PolyDataOf(PlaneGrid(1, 4)));
  this->Solver->SetInputData(2, PointsAt({ { 0.5, 0.5, 0 } }));
  this->ExpectOneError({ "point 0 of the input Singularities", "boundary" });
}

// The nearest point inside: the boundary has no singularities.
TEST_F(Singularities, NearTheBoundaryStandInside)
{
  this->Solver->SetInputData(PolyDataOf(PlaneGrid(4, 4)));
  this->Solver->SetInputData(2, PointsAt({ { 1.6, 0.1, 0 } })); // a triangle with (1, 0), (2, 0) and (2, 1)
  EXPECT_EQ(this->Found(), (std::map<vtkIdType, int>{ { 7, 1 } }));
}
