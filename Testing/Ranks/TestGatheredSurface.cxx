#include "SurfaceInPieces.h"

#include "vtkAppendFilter.h"
#include "vtkCellData.h"
#include "vtkDirectionalField.h"
#include "vtkFieldAngles.h"
#include "vtkFieldGlyphs.h"
#include "vtkFieldLines.h"
#include "vtkFieldQuads.h"
#include "vtkFieldSingularities.h"
#include "vtkImageData.h"
#include "vtkLineSource.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkPointData.h"
#include "vtkPrincipalDirections.h"
#include "vtkScaleFilter.h"
#include "vtkSurfaceDistance.h"
#include "vtkTable.h"
#include "vtkUnsignedCharArray.h"
#include "vtkUnstructuredGrid.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>

namespace dmg::test
{

namespace
{

/// The solver's output on rank 0 is the field of the whole, and nothing is elsewhere.
void ExpectWhole(Solver* solver)
{
  if (Rank() > 0)
  {
    ExpectEmpty(solver);
    return;
  }
  const auto whole = FieldOfWhole();
  vtkDataSet* const field = vtkDataSet::SafeDownCast(solver->GetOutput());
  EXPECT_EQ(field->GetNumberOfCells(), whole->GetNumberOfCells());
  EXPECT_EQ(field->GetNumberOfPoints(), whole->GetNumberOfPoints());
  EXPECT_LT(LargestDifference(field, whole), 1e-7); // ten times the tolerance
}

/// A solver that runs on one process only.
vtkSmartPointer<Solver> NewGathering(vtkPolyData* input)
{
  auto solver = NewSolver(input);
  solver->SetSolver(Solver::Cholesky);
  return solver;
}

/// Rank 0 alone tells the error, once; of other ranks, the executive says that there was one.
void ExpectOneError(const Messages& messages, Solver* solver, const std::string& words)
{
  if (Rank() > 0)
  {
    EXPECT_TRUE(std::none_of(messages.GetErrors().begin(), messages.GetErrors().end(),
      [](const std::string& text) { return text.find("returned failure") == std::string::npos; }))
      << messages.Error();
  }
  else
  {
    EXPECT_NE(messages.Error().find(words), std::string::npos) << messages.Error();
  }
  ExpectEmpty(solver);
}

}

TEST(GatheredSurface, HasTheFieldOfTheWhole)
{
  const auto solver = NewGathering(OwnBand());
  const Messages messages(solver);
  UpdateOwnPiece(solver);
  EXPECT_TRUE(messages.Silent());
  ExpectWhole(solver);
  if (Rank() == 0)
  {
    EXPECT_EQ(
      Gathered(solver->GetOutput()).find("1280 cells of " + std::to_string(Ranks()) + " ranks were gathered"), 0u)
      << Gathered(solver->GetOutput());
  }
}

TEST(GatheredSurface, IsOneCopyWhereEachRankHasReadTheSameFile)
{
  const auto solver = NewGathering(Sphere());
  const Messages messages(solver);
  UpdateOwnPiece(solver);
  EXPECT_TRUE(messages.Silent());
  ExpectWhole(solver);
  EXPECT_EQ(Gathered(solver->GetOutput()), "");
}

TEST(GatheredSurface, MayHaveAnEmptyPieceOnAnyRank)
{
  for (const int first : { 0, 1 }) // the last rank, or the first one
  {
    const auto solver = NewGathering(OwnBand(Ranks() - 1, first));
    UpdateOwnPiece(solver);
    ExpectWhole(solver);
  }
}

TEST(GatheredSurface, IsEmptyWhereAllPiecesAre)
{
  vtkNew<vtkPolyData> empty;
  const auto solver = NewGathering(empty);
  const Messages messages(solver);
  UpdateOwnPiece(solver);
  EXPECT_TRUE(messages.Silent());
  ExpectEmpty(solver);
}

// A triangle of one rank has a point that is not there. VTK would read it from wherever that leads.
TEST(GatheredSurface, RefusesCellsWhosePointsAreNotThere)
{
  for (const vtkIdType far : { vtkIdType(-1), vtkIdType(1000000000) })
  {
    const auto band = OwnBand();
    if (Rank() == 1)
    {
      band->GetPolys()->InsertNextCell({ 0, 1, far });
      band->GetCellData()->GetArray("Given")->InsertNextTuple3(0.0, 0.0, 0.0);
    }
    for (const int discretisation : { Solver::PowerField, Solver::PointPowerField }) // gathered, and in pieces
    {
      const auto solver = NewSolver(band);
      solver->SetDiscretisation(discretisation);
      const Messages messages(solver);
      UpdateOwnPiece(solver);
      ExpectEmpty(solver);
      ExpectOneError(messages, solver, "uses point " + std::to_string(far) + ", and the surface has");
    }
  }
}

// Cells of a model where nothing was measured. RemoveGhostCells copies the arrays that are left.
TEST(GatheredSurface, HandsArraysOnThatAreNotFiniteAndLeavesOutShortOnes)
{
  const auto band = OwnBand();
  vtkNew<vtkDoubleArray> measured;
  measured->SetName("Measured");
  measured->SetNumberOfTuples(band->GetNumberOfPoints());
  measured->Fill(std::nan(""));
  band->GetPointData()->AddArray(measured);
  vtkNew<vtkDoubleArray> shortOne;
  shortOne->SetName("Short");
  band->GetCellData()->AddArray(shortOne);
  vtkNew<vtkUnsignedCharArray> ghosts;
  ghosts->SetName(vtkDataSetAttributes::GhostArrayName());
  ghosts->SetNumberOfTuples(band->GetNumberOfCells());
  ghosts->Fill(0);
  band->GetCellData()->AddArray(ghosts);
  for (const int discretisation : { Solver::PowerField, Solver::PointPowerField })
  {
    const auto solver = NewSolver(band);
    solver->SetDiscretisation(discretisation);
    const Messages messages(solver);
    UpdateOwnPiece(solver);
    EXPECT_TRUE(messages.GetErrors().empty()) << messages.Error();
    EXPECT_EQ(Sum(static_cast<int>(solver->GetOutput()->GetNumberOfCells())), Icosphere(Subdivisions).F.rows());
  }
}

TEST(GatheredSurface, LeavesGhostsOut)
{
  // The next band is there as well, as ghosts.
  const auto piece = PieceOfSphere(Subdivisions,
    [](const Surface& whole, int f)
    { return BandOf(whole, f, Ranks()) == Rank() || BandOf(whole, f, Ranks()) == Rank() + 1; });
  vtkNew<vtkUnsignedCharArray> ghosts;
  ghosts->SetName(vtkDataSetAttributes::GhostArrayName());
  const Surface whole = Icosphere(Subdivisions);
  for (int f = 0; f < whole.F.rows(); ++f)
  {
    const int band = BandOf(whole, f, Ranks());
    if (band == Rank() || band == Rank() + 1)
    {
      ghosts->InsertNextValue(band == Rank() ? 0 : vtkDataSetAttributes::DUPLICATECELL);
    }
  }
  piece->GetCellData()->AddArray(ghosts);
  const auto solver = NewGathering(piece);
  UpdateOwnPiece(solver);
  ExpectWhole(solver);
}

TEST(GatheredSurface, HasNoSeamsWherePointsAreNotJoined)
{
  const auto solver = NewGathering(OwnBand());
  solver->JoinPointsOff();
  UpdateOwnPiece(solver);
  ExpectWhole(solver);
}

TEST(GatheredSurface, JoinsPointsByTheirGlobalIds)
{
  const auto piece = OwnBand();
  const Surface whole = Icosphere(Subdivisions);
  std::map<Place, int> numbers;
  for (int i = 0; i < whole.V.rows(); ++i)
  {
    numbers[{ whole.V(i, 0), whole.V(i, 1), whole.V(i, 2) }] = i;
  }
  vtkNew<vtkIdTypeArray> ids;
  for (vtkIdType point = 0; point < piece->GetNumberOfPoints(); ++point)
  {
    Place place;
    piece->GetPoint(point, place.data());
    ids->InsertNextValue(1000 + numbers.at(place));
    for (double& coordinate : place) // as where ranks have rounded for themselves
    {
      coordinate *= 1.0 + 1e-14 * Rank();
    }
    piece->GetPoints()->SetPoint(point, place.data());
  }
  ids->SetName("Ids");
  piece->GetPointData()->SetGlobalIds(ids);
  const auto solver = NewGathering(piece);
  solver->JoinPointsOff();
  UpdateOwnPiece(solver);
  if (Rank() == 0)
  {
    EXPECT_EQ(solver->GetOutput()->GetNumberOfPoints(), whole.V.rows());
  }
}

TEST(GatheredSurface, MayBeAnUnstructuredGrid)
{
  vtkNew<vtkAppendFilter> asGrid;
  asGrid->SetInputData(OwnBand());
  asGrid->Update();
  vtkNew<Solver> solver;
  solver->SetInputData(asGrid->GetOutput());
  solver->AllDirectionsOn();
  solver->SetInputArrayToProcess(1, 0, 0, OnCells, "Given");
  solver->SetTolerance(1e-8);
  solver->SetSolver(Solver::Cholesky);
  UpdateOwnPiece(solver);
  EXPECT_TRUE(vtkUnstructuredGrid::SafeDownCast(solver->GetOutputDataObject(0)));
  ExpectWhole(solver);
}

TEST(GatheredSurface, IsTheSkinOfAVolumeInPieces)
{
  // Each rank has a cube of 3 x 3 x 3 hexahedra of a row of cubes.
  vtkNew<vtkImageData> cube;
  cube->SetDimensions(4, 4, 4);
  cube->SetOrigin(3.0 * Rank(), 0.0, 0.0);
  vtkNew<vtkAppendFilter> asGrid;
  asGrid->SetInputData(cube);
  asGrid->Update();
  vtkNew<Solver> solver;
  solver->SetInputData(asGrid->GetOutput());
  const Messages messages(solver);
  UpdateOwnPiece(solver);
  EXPECT_EQ(messages.Error(), "");
  if (Rank() > 0)
  {
    ExpectEmpty(solver);
    return;
  }
  auto* const skin = vtkDataSet::SafeDownCast(solver->GetOutputDataObject(0));
  EXPECT_EQ(skin->GetNumberOfCells(), 2 * 9 + 4 * 9 * Ranks()); // no sides between cubes
  EXPECT_EQ(skin->GetNumberOfPoints(), 2 * 4 + 12 * (3 * Ranks() + 1));
}

TEST(GatheredSurface, TakesGuidesOfAllRanksOnce)
{
  const auto withGuide = [](vtkPolyData* surface, vtkDataObject* guide)
  {
    const auto solver = NewGathering(surface);
    solver->SetInputDataObject(1, guide);
    return solver;
  };
  vtkNew<vtkLineSource> line;
  line->SetPoint1(1.0, -0.3, 0.1);
  line->SetPoint2(1.0, 0.3, 0.2);
  line->SetResolution(5);
  line->Update();
  const auto whole = withGuide(Sphere(), line->GetOutput());
  whole->Update();
  vtkNew<vtkPolyData> none;
  const int last = Ranks() - 1;
  for (const bool isOnAll : { true, false })
  {
    const auto solver = withGuide(OwnBand(), isOnAll || Rank() == last ? line->GetOutput() : none);
    UpdateOwnPiece(solver);
    if (Rank() == 0)
    {
      EXPECT_LT(
        LargestDifference(vtkDataSet::SafeDownCast(solver->GetOutput()), vtkDataSet::SafeDownCast(whole->GetOutput())),
        1e-7);
    }
  }
}

TEST(GatheredSurface, AnErrorOfOneRankIsToldOnce)
{
  const auto piece = OwnBand();
  if (Rank() == 1)
  {
    piece->GetPoints()->SetPoint(7, 0.0, std::nan(""), 0.0);
  }
  const auto solver = NewGathering(piece);
  const Messages messages(solver);
  UpdateOwnPiece(solver);
  ExpectOneError(messages, solver, "has a coordinate that is not finite");

  vtkSmartPointer<vtkDataObject> other = OwnBand();
  if (Rank() == 1)
  {
    vtkNew<vtkAppendFilter> asGrid;
    asGrid->SetInputData(OwnBand());
    asGrid->Update();
    other = asGrid->GetOutput();
  }
  vtkNew<Solver> mixed;
  mixed->SetSolver(Solver::Cholesky);
  mixed->SetInputDataObject(other);
  const Messages ofMixed(mixed);
  UpdateOwnPiece(mixed);
  ExpectOneError(ofMixed, mixed, "of different types");
}

TEST(GatheredSurface, RanksThatDifferInPropertiesAreTold)
{
  const auto solver = NewGathering(OwnBand());
  solver->SetNumberOfDirections(Rank() == 1 ? 2 : 4);
  const Messages messages(solver);
  UpdateOwnPiece(solver);
  ExpectOneError(
    messages, solver, "ranks 0 and 1 differ in a property: \"NumberOfDirections: 4\" and \"NumberOfDirections: 2\"");

  vtkNew<vtkPolyData> guide;
  const auto guided = NewGathering(OwnBand());
  if (Rank() == 1)
  {
    guided->SetInputDataObject(1, guide);
  }
  const Messages ofGuided(guided);
  UpdateOwnPiece(guided);
  ExpectOneError(ofGuided, guided, "connections of input 1");
}

TEST(GatheredSurface, IsRefusedWhereMemoryIsShort)
{
  setenv("DMG_MEMORY_LIMIT", "1024", 1); // of the whole machine: less than is used already
  const auto solver = NewGathering(OwnBand());
  const Messages messages(solver);
  UpdateOwnPiece(solver);
  unsetenv("DMG_MEMORY_LIMIT");
  ExpectOneError(messages, solver, "its 1280 cells take some");
  solver->Modified();
  UpdateOwnPiece(solver);
  ExpectWhole(solver);
}

TEST(GatheredSurface, AnAbortOnAnyRankEndsAll)
{
  for (const int rank : { 0, 1 })
  {
    const auto solver = NewGathering(OwnBand());
    {
      const AbortAt abort(solver, Rank() == rank ? 0.0 : 2.0);
      UpdateOwnPiece(solver);
      EXPECT_TRUE(abort.Asked() == (Rank() == rank));
    }
    ExpectEmpty(solver);
    UpdateOwnPiece(solver);
    ExpectWhole(solver);
  }
}

TEST(GatheredSurface, LeavesOfCompositeDatasetsNeedNoOtherRank)
{
  vtkNew<vtkMultiBlockDataSet> blocks;
  for (int block = 0; block <= Rank(); ++block) // another number on each rank
  {
    blocks->SetBlock(block, Sphere());
  }
  vtkNew<Solver> solver;
  solver->SetInputDataObject(blocks);
  solver->SetInputArrayToProcess(1, 0, 0, OnCells, "Given");
  const Messages messages(solver); // those of ignored cells
  UpdateOwnPiece(solver);
  auto* const output = vtkMultiBlockDataSet::SafeDownCast(solver->GetOutputDataObject(0));
  ASSERT_TRUE(output);
  EXPECT_EQ(output->GetNumberOfCells(), 1280 * (Rank() + 1)); // the executive asks each rank for the whole of each leaf
}

TEST(GatheredSurface, OneRankMayWorkAlone)
{
  if (Rank() == Ranks() - 1)
  {
    const auto solver = NewGathering(Sphere());
    solver->Update();
    EXPECT_EQ(solver->GetOutput()->GetNumberOfCells(), 1280);
  }
}

TEST(GatheredSurface, HasDistancesOverSeams)
{
  vtkNew<vtkLineSource> ends; // at the poles, on each rank
  ends->SetPoint1(0.0, 0.0, 1.0);
  ends->SetPoint2(0.0, 0.0, -1.0);
  vtkNew<vtkSurfaceDistance> distance;
  distance->SetInputData(OwnBand());
  distance->SetPoint(0.0, 0.0, 1.0);
  distance->SetInputConnection(2, ends->GetOutputPort());
  const Messages messages(distance);
  UpdateOwnPiece(distance);
  EXPECT_TRUE(messages.Silent()) << messages.Error();
  auto* const measured = vtkDataSet::SafeDownCast(distance->GetOutputDataObject(0));
  EXPECT_EQ(measured->GetNumberOfCells(), Rank() == 0 ? 1280 : 0);
  EXPECT_EQ(vtkDataSet::SafeDownCast(distance->GetOutputDataObject(2))->GetNumberOfCells(), Rank() == 0 ? 1 : 0);
  if (Rank() == 0)
  {
    EXPECT_NEAR(Values(measured->GetFieldData(), "LargestDistance").at(0), Pi, 0.02);
  }
}

TEST(GatheredSurface, HasScalesOverSeams)
{
  const auto piece = OwnBand();
  const auto heights = Zeros("Height", piece->GetNumberOfPoints(), 1);
  for (vtkIdType point = 0; point < piece->GetNumberOfPoints(); ++point)
  {
    heights->SetValue(point, piece->GetPoint(point)[2]); // of degree 1
  }
  piece->GetPointData()->AddArray(heights);
  vtkNew<vtkScaleFilter> scales;
  scales->SetInputData(piece);
  scales->AddArray("Height");
  scales->AddWavelength(std::sqrt(2.0) * Pi);
  scales->SetSolver(vtkScaleFilter::Cholesky); // which does not run in pieces
  const Messages messages(scales);
  UpdateOwnPiece(scales);
  EXPECT_TRUE(messages.Silent()) << messages.Error();
  auto* const filtered = vtkDataSet::SafeDownCast(scales->GetOutputDataObject(0));
  EXPECT_EQ(filtered->GetNumberOfCells(), Rank() == 0 ? 1280 : 0);
  auto* const spectrum = vtkTable::SafeDownCast(scales->GetOutputDataObject(1));
  EXPECT_EQ(spectrum->GetNumberOfRows(), Rank() == 0 ? 24 : 0);
  if (Rank() == 0)
  {
    vtkDataArray* const below = filtered->GetPointData()->GetScalars();
    for (vtkIdType point = 0; point < filtered->GetNumberOfPoints(); ++point)
    {
      EXPECT_NEAR(below->GetComponent(point, 0), filtered->GetPoint(point)[2] / 3.0, 0.005); // a third of the wave
    }
  }
}

TEST(GatheredSurface, IsDrawnWithoutSeams)
{
  // Each rank has its band of the field, as a file in pieces has.
  const auto whole = FieldOfWhole();
  const auto piece = OwnBand();
  const auto directions = DirectionsAtPoints(whole);
  const auto array = Zeros("Direction0", piece->GetNumberOfPoints(), 3);
  for (vtkIdType point = 0; point < piece->GetNumberOfPoints(); ++point)
  {
    Place place;
    piece->GetPoint(point, place.data());
    array->SetTuple(point, directions.at(place)[0].data());
  }
  piece->GetPointData()->AddArray(array);
  piece->GetCellData()->Initialize();
  const auto update = [&piece](vtkAlgorithm* filter)
  {
    filter->SetInputDataObject(piece);
    filter->SetInputArrayToProcess(0, 0, 0, OnPoints, "Direction0");
    const Messages messages(filter);
    UpdateOwnPiece(filter);
    EXPECT_TRUE(messages.Silent()) << filter->GetClassName() << messages.Error();
    EXPECT_EQ(Gathered(filter->GetOutputDataObject(0)).empty(), Rank() > 0) << filter->GetClassName();
    return vtkDataSet::SafeDownCast(filter->GetOutputDataObject(0));
  };
  vtkNew<vtkFieldLines> lines;
  lines->SetNumberOfDirections(4);
  vtkDataSet* const drawn = update(lines);
  vtkNew<vtkFieldGlyphs> glyphs;
  glyphs->SetNumberOfDirections(4);
  EXPECT_EQ(update(glyphs)->GetNumberOfCells() > 0, Rank() == 0);
  vtkNew<vtkFieldSingularities> singularities;
  singularities->SetNumberOfDirections(4);
  vtkDataSet* const points = update(singularities);
  vtkNew<vtkFieldAngles> angles;
  angles->SetNumberOfDirections(4);
  EXPECT_EQ(update(angles)->GetNumberOfCells(), Rank() == 0 ? 1280 : 0);
  vtkNew<vtkPrincipalDirections> curvatures;
  EXPECT_EQ(update(curvatures)->GetNumberOfCells(), Rank() == 0 ? 1280 : 0);
  if (Rank() > 0)
  {
    EXPECT_EQ(drawn->GetNumberOfCells(), 0);
    EXPECT_EQ(points->GetNumberOfPoints(), 0);
    return;
  }
  double sum = 0.0; // of indices: the Euler characteristic
  for (vtkIdType k = 0; k < points->GetNumberOfPoints(); ++k)
  {
    sum += points->GetPointData()->GetArray("Index")->GetComponent(k, 0);
  }
  EXPECT_NEAR(sum, 2.0, 1e-12);
  int crossing = 0;
  vtkNew<vtkIdList> ids;
  for (vtkIdType line = 0; line < drawn->GetNumberOfCells(); ++line)
  {
    drawn->GetCellPoints(line, ids);
    const double seam = 2.0 / Ranks() - 1.0;
    const auto isAbove = [&](vtkIdType point) { return drawn->GetPoint(point)[2] > seam; };
    const auto above = std::count_if(ids->begin(), ids->end(), isAbove);
    crossing += above > 0 && above < ids->GetNumberOfIds() ? 1 : 0;
  }
  EXPECT_GT(crossing, 10);
}

TEST(GatheredSurface, HasTheQuadsOfTheWhole)
{
  const auto update = [](vtkPolyData* surface, bool isInPieces)
  {
    auto filter = vtkSmartPointer<vtkFieldQuads>::New();
    filter->SetInputData(surface);
    filter->SetNumberOfQuads(200);
    const Messages messages(filter);
    isInPieces ? UpdateOwnPiece(filter) : filter->Update();
    EXPECT_TRUE(messages.Silent()) << messages.Error();
    return filter;
  };
  const auto numberOf = [](vtkFieldQuads* filter, const char* name)
  { return filter->GetOutput()->GetFieldData()->GetArray(name)->GetComponent(0, 0); };
  const auto filter = update(OwnBand(), true);
  for (int port = 0; port < 3; ++port)
  {
    EXPECT_EQ(vtkDataSet::SafeDownCast(filter->GetOutputDataObject(port))->GetNumberOfCells() > 0, Rank() == 0);
  }
  if (Rank() == 0)
  {
    const auto whole = update(Sphere(Subdivisions), false);
    EXPECT_FALSE(Gathered(filter->GetOutput()).empty());
    EXPECT_EQ(numberOf(filter, "EulerCharacteristic"), 2.0);
    EXPECT_EQ(numberOf(filter, "Singularities"), numberOf(whole, "Singularities"));
  }
}

TEST(GatheredSurface, DirectionalFieldDrawsIt)
{
  vtkNew<vtkDirectionalField> field;
  field->SetInputData(OwnBand());
  field->SetSolver(Solver::Cholesky);
  const Messages messages(field);
  UpdateOwnPiece(field);
  EXPECT_TRUE(messages.Silent());
  for (int port = 0; port < 3; ++port)
  {
    EXPECT_EQ(vtkDataSet::SafeDownCast(field->GetOutputDataObject(port))->GetNumberOfCells() > 0, Rank() == 0);
  }
  field->SetNumberOfDirections(99);
  UpdateOwnPiece(field);
  EXPECT_EQ(field->GetOutput()->GetNumberOfCells(), 0);
  EXPECT_EQ(messages.GetErrors().empty(), false); // the executive says on all ranks that it failed
  EXPECT_EQ(messages.GetWarnings().size(), 0u);
}

}
