#include "SurfaceInPieces.h"

#include "vtkCellData.h"
#include "vtkDirectionalField.h"
#include "vtkFieldLines.h"
#include "vtkFieldSingularities.h"
#include "vtkLineSource.h"
#include "vtkPointData.h"

#include <gtest/gtest.h>

#include <cmath>

/// Fields that each rank has on its own piece, with PETSc.
namespace dmg::test
{

namespace
{

vtkDataSet* OutputOf(vtkAlgorithm* filter, int port = 0)
{
  return vtkDataSet::SafeDownCast(filter->GetOutputDataObject(port));
}

/// Ten times the tolerance.
constexpr double Near = 1e-7;

/// Each rank has its own cells and points, with the field of the whole.
void ExpectPieces(vtkAlgorithm* solver, vtkDataSet* own, vtkDataSet* whole)
{
  vtkDataSet* const output = OutputOf(solver);
  EXPECT_EQ(output->GetNumberOfCells(), own->GetNumberOfCells());
  EXPECT_EQ(output->GetNumberOfPoints(), own->GetNumberOfPoints());
  EXPECT_EQ(Gathered(output), "");
  double sum = 0.0; // of indices
  if (own->GetNumberOfCells() > 0)
  {
    EXPECT_LT(LargestDifference(output, whole), Near);
    for (const double index : Values(output->GetCellData(), "SingularityIndex"))
    {
      sum += index;
    }
  }
  EXPECT_EQ(Sum(static_cast<int>(std::lround(4.0 * sum))), 8); // four times the Euler characteristic
}

vtkSmartPointer<vtkDataSet> WholeOf(Solver* solver)
{
  solver->Update(); // piece 0 of 1: this rank alone
  return vtkDataSet::SafeDownCast(solver->GetOutputDataObject(0));
}

/// The triangles of a surface with directions at points, which each triangle has for itself in a soup.
vtkSmartPointer<vtkPolyData> WithWind(vtkPolyData* surface, bool isSoup)
{
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  vtkNew<vtkCellArray> triangles;
  vtkNew<vtkDoubleArray> wind;
  wind->SetName("Wind");
  wind->SetNumberOfComponents(3);
  const auto add = [&](vtkIdType point)
  {
    Place place;
    surface->GetPoint(point, place.data());
    const double turn = std::sin(3.0 * place[2]);
    wind->InsertNextTuple3(-place[1], place[0] + turn, turn * place[0]);
    return points->InsertNextPoint(place.data());
  };
  for (vtkIdType point = 0; !isSoup && point < surface->GetNumberOfPoints(); ++point)
  {
    add(point);
  }
  vtkNew<vtkIdList> corners;
  for (vtkIdType cell = 0; cell < surface->GetNumberOfCells(); ++cell)
  {
    surface->GetCellPoints(cell, corners);
    triangles->InsertNextCell(3);
    for (const vtkIdType point : *corners)
    {
      triangles->InsertCellPoint(isSoup ? add(point) : point);
    }
  }
  auto result = vtkSmartPointer<vtkPolyData>::New();
  result->SetPoints(points);
  result->SetPolys(triangles);
  result->GetPointData()->AddArray(wind);
  return result;
}

/// Whether the field of pieces is that of the sphere, with constraints at points.
void ExpectFieldOfWind(vtkPolyData* own)
{
  const auto solver = NewSolver(own);
  const auto whole = NewSolver(WithWind(Sphere(Subdivisions), false));
  for (Solver* const each : { solver.Get(), whole.Get() })
  {
    each->SetInputArrayToProcess(1, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "Wind");
    each->SetSmoothingLength(0.3);
    each->UnitLengthOff();
  }
  UpdateOwnPiece(solver);
  EXPECT_EQ(Gathered(OutputOf(solver)), "");
  EXPECT_EQ(OutputOf(solver)->GetNumberOfPoints(), own->GetNumberOfPoints());
  EXPECT_LT(LargestDifference(OutputOf(solver), WholeOf(whole)), 1e-6);
}

}

TEST(FieldInPieces, IsThatOfTheWhole)
{
  const auto own = OwnBand();
  const auto solver = NewSolver(own);
  const Messages messages(solver);
  UpdateOwnPiece(solver);
  EXPECT_TRUE(messages.Silent()) << messages.Error();
  ExpectPieces(solver, own, FieldOfWhole());
  EXPECT_EQ(Converged(solver), 1);
  EXPECT_GT(Convergence(solver)->GetNumberOfRows(), 1);
}

TEST(FieldInPieces, MayHaveAnEmptyPieceOnAnyRank)
{
  if (Ranks() < 3)
  {
    GTEST_SKIP() << "one rank alone has the surface";
  }
  for (const int first : { 0, 1 })
  {
    const auto own = OwnBand(Ranks() - 1, first);
    const auto solver = NewSolver(own);
    UpdateOwnPiece(solver);
    ExpectPieces(solver, own, FieldOfWhole());
    EXPECT_EQ(Converged(solver), 1);
  }
}

TEST(FieldInPieces, PointsOfSeamsAreOneThoughRanksRoundThem)
{
  const auto own = OwnBand();
  for (vtkIdType point = 0; point < own->GetNumberOfPoints(); ++point)
  {
    Place place;
    own->GetPoint(point, place.data());
    for (double& coordinate : place)
    {
      coordinate *= 1.0 + 2e-16 * Rank();
    }
    own->GetPoints()->SetPoint(point, place.data());
  }
  const auto solver = NewSolver(own);
  UpdateOwnPiece(solver);
  double sum = 0.0;
  for (const double index : Values(OutputOf(solver)->GetCellData(), "SingularityIndex"))
  {
    sum += index;
  }
  EXPECT_EQ(Sum(static_cast<int>(std::lround(4.0 * sum))), 8); // a slit would have others
  EXPECT_EQ(Gathered(OutputOf(solver)), "");
}

TEST(FieldInPieces, IsTheSmoothestOneWhereNothingIsFollowed)
{
  const auto own = OwnBand();
  vtkNew<Solver> solver;
  solver->SetInputData(own);
  solver->SetNumberOfDirections(4);
  UpdateOwnPiece(solver);
  EXPECT_EQ(OutputOf(solver)->GetNumberOfCells(), own->GetNumberOfCells());
  EXPECT_EQ(Gathered(OutputOf(solver)), "");
  double sum = 0.0;
  for (const double index : Values(OutputOf(solver)->GetCellData(), "SingularityIndex"))
  {
    sum += index;
  }
  EXPECT_EQ(Sum(static_cast<int>(std::lround(4.0 * sum))), 8);
}

TEST(FieldInPieces, WithoutPrescriptionsDependsNotOnWhatWasSolvedBefore)
{
  vtkNew<Solver> fresh, used;
  for (Solver* solver : { fresh.Get(), used.Get() })
  {
    solver->SetInputData(OwnBand());
    solver->SetNumberOfDirections(4);
  }
  used->SetInputArrayToProcess(1, 0, 0, OnCells, "Given");
  UpdateOwnPiece(used);
  used->SetInputArrayToProcess(1, 0, 0, OnCells, "");
  UpdateOwnPiece(used);
  UpdateOwnPiece(fresh);
  EXPECT_EQ(Gathered(OutputOf(used)), "");
  EXPECT_EQ(
    Values(OutputOf(used)->GetPointData(), "PowerField"), Values(OutputOf(fresh)->GetPointData(), "PowerField"));
}

/// Vertices beside the triangles change neither positions nor triangles.
TEST(FieldInPieces, HasAsManyTuplesAsCellsWhenTheirNumberAloneChanges)
{
  vtkNew<Solver> solver;
  for (const int vertices : { 0, 3, 1 })
  {
    const auto own = OwnBand();
    vtkNew<vtkCellArray> marks;
    for (int k = 0; k < vertices * Rank(); ++k)
    {
      marks->InsertNextCell({ 0 });
    }
    own->SetVerts(marks);
    own->GetCellData()->Initialize();
    solver->SetInputData(own);
    UpdateOwnPiece(solver);
    vtkDataSet* const output = OutputOf(solver);
    EXPECT_EQ(output->GetNumberOfCells(), own->GetNumberOfCells());
    EXPECT_EQ(output->GetCellData()->GetArray("Direction0")->GetNumberOfTuples(), own->GetNumberOfCells());
  }
}

TEST(FieldInPieces, OutputsMayBeChangedByTheCaller)
{
  const auto solver = NewSolver(OwnBand());
  UpdateOwnPiece(solver);
  const auto before = Values(OutputOf(solver)->GetCellData(), "Direction0");
  OutputOf(solver)->GetCellData()->GetArray("Direction0")->Fill(0.0);
  solver->SetCombing(false);
  UpdateOwnPiece(solver);
  solver->SetCombing(true);
  UpdateOwnPiece(solver);
  EXPECT_EQ(Values(OutputOf(solver)->GetCellData(), "Direction0"), before);
  solver->Modified();
  OutputOf(solver)->GetCellData()->GetArray("Direction0")->Fill(0.0);
  UpdateOwnPiece(solver);
  EXPECT_EQ(Values(OutputOf(solver)->GetCellData(), "Direction0"), before);
}

TEST(FieldInPieces, FollowsGuidesAndFeaturesAndAMovedGuideBuildsNoLevels)
{
  vtkNew<vtkLineSource> line;
  line->SetPoint1(1.0, -0.3, 0.1);
  line->SetPoint2(1.0, 0.3, 0.2);
  line->SetResolution(5);
  const auto own = OwnBand();
  const auto solver = NewSolver(own);
  const auto whole = NewSolver(Sphere());
  for (Solver* const each : { solver.Get(), whole.Get() })
  {
    each->SetInputConnection(1, line->GetOutputPort());
    each->SetRotation(20.0);
  }
  for (const double height : { 0.2, 0.5 })
  {
    line->SetPoint2(0.9, 0.4, height);
    UpdateOwnPiece(solver);
    ExpectPieces(solver, own, WholeOf(whole));
    EXPECT_EQ(solver->GetNumberOfSetups(), 1);
  }
}

TEST(FieldInPieces, FollowsFeaturesAndSmoothsDataAsTheWholeDoes)
{
  const auto own = OwnBand();
  const auto solver = NewSolver(own);
  const auto whole = NewSolver(Sphere(Subdivisions));
  for (Solver* const each : { solver.Get(), whole.Get() })
  {
    each->SetSharpEdgesWeight(2.0);
    each->SetFeatureAngle(3.0); // some edges of the triangulated sphere have more, some less
    each->SetSharpEdgesRotation(30.0);
    each->UnitLengthOff(); // where the field vanishes, its direction says nothing
  }
  const auto without = FieldOfWhole();
  UpdateOwnPiece(solver);
  ExpectPieces(solver, own, WholeOf(whole));
  EXPECT_GT(LargestDifference(OutputOf(solver), without), 0.01); // edges are followed
  for (Solver* const each : { solver.Get(), whole.Get() })
  {
    each->SetSharpEdgesWeight(0.0);
    each->SetSmoothingLength(0.3);
  }
  UpdateOwnPiece(solver);
  ExpectPieces(solver, own, WholeOf(whole));
}

TEST(FieldInPieces, PointsThatAreThereManyTimesWeighOnce)
{
  ExpectFieldOfWind(WithWind(OwnBand(), true));
}

// Triangles are dealt in turn, so that those of a rank make several fans around a point.
TEST(FieldInPieces, PointsWithSeveralFansOnARankWeighOnce)
{
  for (const bool isSoup : { false, true })
  {
    SCOPED_TRACE(isSoup);
    const auto own = PieceOfSphere(Subdivisions, [](const Surface&, int f) { return f % Ranks() == Rank(); });
    ExpectFieldOfWind(WithWind(own, isSoup));
  }
}

TEST(FieldInPieces, FunctionsHaveTheValuesOfTheWhole)
{
  // A function that is given at the points of the upper half, softly.
  const auto withValues = [](vtkSmartPointer<vtkPolyData> surface)
  {
    vtkNew<vtkDoubleArray> values;
    values->SetName("Height");
    for (vtkIdType point = 0; point < surface->GetNumberOfPoints(); ++point)
    {
      double place[3];
      surface->GetPoint(point, place);
      values->InsertNextValue(place[2] > 0.0 ? place[2] + place[0] : std::nan(""));
    }
    surface->GetPointData()->AddArray(values);
    return surface;
  };
  const auto own = withValues(OwnBand());
  const auto solver = NewSolver(own, Solver::ScalarFunction);
  const auto whole = NewSolver(withValues(Sphere(Subdivisions)), Solver::ScalarFunction);
  for (Solver* const each : { solver.Get(), whole.Get() })
  {
    each->SetInputArrayToProcess(3, 0, 0, OnPoints, "Height");
    each->SetAlignment(10.0);
  }
  UpdateOwnPiece(solver);
  EXPECT_EQ(Gathered(OutputOf(solver)), "");
  vtkDataSet* const expected = WholeOf(whole);
  std::map<Place, double> byPlace;
  const auto ofWhole = Values(expected->GetPointData(), "ScalarFunction");
  for (vtkIdType point = 0; point < expected->GetNumberOfPoints(); ++point)
  {
    Place place;
    expected->GetPoint(point, place.data());
    byPlace[place] = ofWhole[point];
  }
  const auto values = Values(OutputOf(solver)->GetPointData(), "ScalarFunction");
  ASSERT_EQ(static_cast<vtkIdType>(values.size()), own->GetNumberOfPoints());
  for (vtkIdType point = 0; point < own->GetNumberOfPoints(); ++point)
  {
    Place place;
    own->GetPoint(point, place.data());
    EXPECT_NEAR(values[point], byPlace.at(place), Near);
  }
}

TEST(FieldInPieces, IsGatheredWithTheReason)
{
  const auto solver = NewSolver(OwnBand(), Solver::FaceField);
  UpdateOwnPiece(solver);
  EXPECT_EQ(OutputOf(solver)->GetNumberOfCells(), Rank() == 0 ? 1280 : 0);
  EXPECT_EQ(Gathered(OutputOf(solver)).find("since flows are found on one process") != std::string::npos, Rank() == 0)
    << Gathered(OutputOf(solver));

  // Pieces that are turned against each other are turned on one process.
  const auto own = OwnBand();
  if (Rank() == 1)
  {
    vtkNew<vtkCellArray> turned;
    vtkNew<vtkIdList> corners;
    for (vtkIdType cell = 0; cell < own->GetNumberOfCells(); ++cell)
    {
      own->GetCellPoints(cell, corners);
      turned->InsertNextCell({ corners->GetId(0), corners->GetId(2), corners->GetId(1) });
    }
    own->SetPolys(turned);
  }
  const auto ofTurned = NewSolver(own);
  UpdateOwnPiece(ofTurned);
  EXPECT_EQ(OutputOf(ofTurned)->GetNumberOfCells(), Rank() == 0 ? 1280 : 0);
  EXPECT_EQ(Gathered(OutputOf(ofTurned)).find("since the pieces cannot be joined where they are") != std::string::npos,
    Rank() == 0)
    << Gathered(OutputOf(ofTurned));
}

TEST(FieldInPieces, AnErrorOrAnAbortOfOneRankEndsAll)
{
  const auto own = OwnBand();
  const auto solver = NewSolver(own);
  {
    const AbortAt abort(solver, Rank() == 1 ? 0.0 : 2.0);
    UpdateOwnPiece(solver);
  }
  ExpectEmpty(solver);
  solver->SetAlignment(Rank() == 1 ? -1.0 : 1.0); // as if a rank had been told something else
  const Messages messages(solver);
  UpdateOwnPiece(solver);
  ExpectEmpty(solver);
  solver->SetAlignment(1e4);
  UpdateOwnPiece(solver);
  EXPECT_EQ(OutputOf(solver)->GetNumberOfCells(), own->GetNumberOfCells());
}

TEST(FieldInPieces, IsDrawnWithoutSeams)
{
  const auto solver = NewSolver(OwnBand());
  vtkNew<vtkFieldLines> lines;
  lines->SetInputConnection(solver->GetOutputPort());
  UpdateOwnPiece(lines);
  vtkNew<vtkFieldSingularities> singularities;
  singularities->SetInputConnection(solver->GetOutputPort());
  UpdateOwnPiece(singularities);
  EXPECT_EQ(solver->GetNumberOfSolves(), 1);
  vtkDataSet* const drawn = OutputOf(lines);
  if (Rank() > 0)
  {
    EXPECT_EQ(drawn->GetNumberOfCells(), 0);
    return;
  }
  EXPECT_NE(Gathered(drawn), "");
  EXPECT_EQ(OutputOf(singularities, 2)->GetNumberOfCells(), 0); // no boundary, as seams would be
  double sum = 0.0;
  for (const double index : Values(OutputOf(singularities)->GetPointData(), "Index"))
  {
    sum += index;
  }
  EXPECT_NEAR(sum, 2.0, 1e-12);
  int crossing = 0;
  vtkNew<vtkIdList> ids;
  for (vtkIdType line = 0; line < drawn->GetNumberOfCells(); ++line)
  {
    drawn->GetCellPoints(line, ids);
    const double seam = 2.0 / Ranks() - 1.0;
    const auto above =
      std::count_if(ids->begin(), ids->end(), [&](vtkIdType point) { return drawn->GetPoint(point)[2] > seam; });
    crossing += above > 0 && above < ids->GetNumberOfIds() ? 1 : 0;
  }
  EXPECT_GT(crossing, 10);
}

TEST(FieldInPieces, OfDirectionalFieldHasItsLinesOnTheFirstRank)
{
  const auto own = OwnBand();
  vtkNew<vtkDirectionalField> field;
  field->SetInputData(own);
  const Messages messages(field);
  UpdateOwnPiece(field);
  EXPECT_TRUE(messages.Silent()) << messages.Error();
  EXPECT_EQ(OutputOf(field)->GetNumberOfCells(), own->GetNumberOfCells());
  EXPECT_EQ(OutputOf(field, 1)->GetNumberOfCells() > 0, Rank() == 0);
  EXPECT_EQ(OutputOf(field, 2)->GetNumberOfCells() > 0, Rank() == 0);
}

TEST(FieldInPieces, DirectionalFieldThatVanishesIsNotDrawnOnAnyRank)
{
  const auto own = OwnBand();
  const auto values = Zeros("Height", own->GetNumberOfPoints(), 1); // a constant function has no gradient
  own->GetPointData()->AddArray(values);
  vtkNew<vtkDirectionalField> field;
  field->SetInputData(own);
  field->SetDiscretisation(Solver::ScalarFunction);
  field->SetInputArrayToProcess(1, 0, 0, OnPoints, "Height");
  const Messages messages(field);
  UpdateOwnPiece(field);
  EXPECT_EQ(OutputOf(field, 1)->GetNumberOfCells(), 0);
  EXPECT_EQ(OutputOf(field, 2)->GetNumberOfCells(), 0);
}

}
