// What messages tell the user to do, done on the input that caused them: it works.

#include "vtkHarmonicFieldSolver.h"

#include "Refusals.h"
#include "TestTools.h"

#include "vtkArrayCalculator.h"
#include "vtkCellSizeFilter.h"
#include "vtkCleanPolyData.h"
#include "vtkDecimatePro.h"
#include "vtkDirectionalProlongation.h"
#include "vtkFieldLines.h"
#include "vtkGeometryFilter.h"
#include "vtkPolyDataNormals.h"
#include "vtkRemoveDuplicatePolys.h"
#include "vtkTable.h"
#include "vtkTableToPolyData.h"
#include "vtkThreshold.h"
#include "vtkTriangleFilter.h"
#include "vtkUnstructuredGrid.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace dmg;
using namespace dmg::test;

namespace
{

constexpr int OnCells = vtkDataObject::FIELD_ASSOCIATION_CELLS;

using Data = vtkSmartPointer<vtkDataSet>;

template <class Filter>
Data OutputOf(Filter* filter, vtkDataSet* input)
{
  filter->SetInputData(input);
  filter->Update();
  return filter->GetOutput();
}

Data Triangulated(vtkDataSet* input)
{
  return OutputOf(vtkNew<vtkTriangleFilter>().Get(), input);
}

Data Cleaned(vtkDataSet* input)
{
  return OutputOf(vtkNew<vtkCleanPolyData>().Get(), input);
}

Data WithoutDuplicates(vtkDataSet* input)
{
  return OutputOf(vtkNew<vtkRemoveDuplicatePolys>().Get(), input);
}

Data ExtractedSurface(vtkDataSet* input)
{
  return Triangulated(OutputOf(vtkNew<vtkGeometryFilter>().Get(), input));
}

Data WithNormals(vtkDataSet* input, double featureAngle)
{
  vtkNew<vtkPolyDataNormals> normals;
  normals->ConsistencyOn();
  normals->SplittingOn();
  normals->SetFeatureAngle(featureAngle);
  normals->NonManifoldTraversalOff();
  return OutputOf(normals.Get(), input);
}

Data TurnedAndCut(vtkDataSet* input)
{
  return WithNormals(input, 180.0);
}

Data CutWhereItTurns(vtkDataSet* input)
{
  return WithNormals(input, 60.0);
}

/// Of each triangle, its first side.
void PrescribeSides(vtkDataSet* data)
{
  const auto sides = Zeros("Given", data->GetNumberOfCells(), 3);
  for (vtkIdType cell = 0; cell < data->GetNumberOfCells(); ++cell)
  {
    const Vector3 from(data->GetPoint(data->GetCell(cell)->GetPointId(0)));
    const Vector3 to(data->GetPoint(data->GetCell(cell)->GetPointId(1)));
    const Vector3 side = to - from;
    sides->SetTuple(cell, side.data());
  }
  data->GetCellData()->AddArray(sides);
}

vtkSmartPointer<vtkHarmonicFieldSolver> NewSolver(vtkDataSet* input)
{
  auto solver = vtkSmartPointer<vtkHarmonicFieldSolver>::New();
  solver->SetInputData(input);
  solver->SetInputArrayToProcess(1, 0, 0, OnCells, "Given");
  return solver;
}

}

// Surfaces
// ----------------------------------------------------------------------------------------------

namespace
{

struct BadSurface
{
  std::string Name;
  std::function<Data()> Make;
  std::vector<std::string> Words; ///< of the message: the element and the remedy
  std::function<Data(vtkDataSet*)> Remedy;
};

std::ostream& operator<<(std::ostream& os, const BadSurface& surface)
{
  return os << surface.Name;
}

Data Polygons(
  std::initializer_list<Vector3> positions, std::initializer_list<std::initializer_list<vtkIdType>> polygons)
{
  vtkNew<vtkPoints> points;
  for (const Vector3& position : positions)
  {
    points->InsertNextPoint(position.data());
  }
  vtkNew<vtkCellArray> cells;
  for (const auto& polygon : polygons)
  {
    cells->InsertNextCell(polygon);
  }
  auto data = vtkSmartPointer<vtkPolyData>::New();
  data->SetPoints(points);
  data->SetPolys(cells);
  return data;
}

const std::initializer_list<Vector3> Square = { { 0, 0, 0 }, { 1, 0, 0 }, { 1, 1, 0 }, { 0, 1, 0 }, { 1, 1, 1 } };

Data Grid(int cellType, std::initializer_list<vtkIdType> corners)
{
  auto grid = vtkSmartPointer<vtkUnstructuredGrid>::New();
  vtkNew<vtkPoints> points;
  for (const Vector3& position : Square)
  {
    points->InsertNextPoint(position.data());
  }
  grid->SetPoints(points);
  grid->InsertNextCell(cellType, static_cast<vtkIdType>(corners.size()), corners.begin());
  return grid;
}

const std::string CutAndTurn =
  "Generate Surface Normals (vtkPolyDataNormals) with Consistency and Splitting on, Feature "
  "Angle 180 and Non-Manifold Traversal off";

/// Refused where Strict is on, and else solved on.
const BadSurface BadSurfaces[] = {
  { "RepeatedCorner",
    [] {
      return Polygons(Square, { { 0, 1, 2 }, { 0, 2, 2 } });
    },
    { "cell 1", "point 2 twice", "Clean (vtkCleanPolyData), then Triangulate (vtkTriangleFilter)" },
    [](vtkDataSet* input) { return Triangulated(Cleaned(input)); } },
  { "CornersInOnePlace",
    [] {
      return Polygons(
        { { 0, 0, 0 }, { 1, 0, 0 }, { 1, 1, 0 }, { 1, 1, 0 }, { 1, 1, 0 } }, { { 0, 1, 2 }, { 2, 3, 4 } });
    },
    { "cell 1", "one place", "Clean (vtkCleanPolyData)" }, Cleaned },
  { "OppositeOrientation",
    [] {
      return Polygons(Square, { { 0, 1, 2 }, { 0, 3, 2 } });
    },
    { "cell 0 and cell 1", "oriented against", CutAndTurn }, TurnedAndCut },
  { "MoebiusStrip", [] { return PolyDataOf(MoebiusStrip(9)); },
    { "oriented against", "Moebius", "Feature Angle of 60 or less" }, CutWhereItTurns },
  { "CoarseMoebiusStrip", [] { return PolyDataOf(MoebiusStrip(5)); },
    { "oriented against", "Moebius", "Feature Angle of 60 or less" }, CutWhereItTurns },
  { "ThreeFacesAtAnEdge",
    [] {
      return Polygons(Square, { { 0, 1, 2 }, { 2, 3, 0 }, { 2, 4, 0 } });
    },
    { "3 triangles", CutAndTurn }, TurnedAndCut },
  { "AFaceTooMuchAtAnEdge",
    [] {
      return Polygons(Square, { { 0, 1, 2 }, { 2, 3, 0 }, { 2, 4, 0 } });
    },
    { "3 triangles", "cell 2", "remove the surplus ones" },
    [](vtkDataSet*) -> Data {
      return Polygons(Square, { { 0, 1, 2 }, { 2, 3, 0 } });
    } },
  { "ThreeFacesAtAnEdgeThatDisagree",
    [] {
      return Polygons(Square, { { 0, 1, 2 }, { 0, 3, 2 }, { 0, 4, 2 } });
    },
    { "3 triangles", CutAndTurn }, TurnedAndCut },
  { "PinchedPoint", [] { return PolyDataOf(PinchedTetrahedra()); }, { "point 0", "pinched", CutAndTurn },
    TurnedAndCut },
  { "TwiceTheSameTriangle",
    [] {
      return Polygons(Square, { { 0, 1, 2 }, { 0, 2, 3 }, { 1, 2, 0 } });
    },
    { "cell 0 and cell 2", "same triangle", "Clean Cells to Grid and Extract Surface (vtkRemoveDuplicatePolys)" },
    WithoutDuplicates },
};

}

class Remedy : public testing::TestWithParam<BadSurface>
{
};

TEST_P(Remedy, HelpsTheSurfaceThatNeedsIt)
{
  const Data input = GetParam().Make();
  PrescribeSides(input);
  const auto solver = NewSolver(input);
  solver->StrictOn();
  ExpectRefusal(solver, GetParam().Words);
  vtkNew<vtkDirectionalProlongation> prolongation;
  prolongation->SetInputData(input);
  prolongation->StrictOn();
  ExpectRefusal(prolongation, GetParam().Words);

  const Data helped = GetParam().Remedy(input);
  PrescribeSides(helped);
  solver->SetInputData(helped);
  ExpectOutput(solver);
}

TEST_P(Remedy, IsNotNeededWithoutStrict)
{
  const Data input = GetParam().Make();
  PrescribeSides(input);
  const auto solver = NewSolver(input);
  ExpectOutput(solver);
  EXPECT_EQ(solver->GetOutput()->GetNumberOfCells(), input->GetNumberOfCells());
  EXPECT_NE(solver->GetOutput()->GetFieldData()->GetAbstractArray("SurfacePreparation"), nullptr);
  vtkNew<vtkFieldLines> lines;
  lines->SetInputConnection(solver->GetOutputPort());
  ExpectOutput(lines);
  vtkNew<vtkDirectionalProlongation> prolongation;
  prolongation->SetInputData(input);
  ExpectOutput(prolongation);
}

INSTANTIATE_TEST_SUITE_P(Messages, Remedy, testing::ValuesIn(BadSurfaces),
  [](const testing::TestParamInfo<BadSurface>& info) { return info.param.Name; });

/// Triangles with points of their own, as files of type STL have them.
TEST(Remedy, CleanMakesASurfaceOfTrianglesThatShareNoPoints)
{
  const Surface whole = Icosphere(2);
  Surface soup;
  soup.V.resize(3 * whole.F.rows(), 3);
  soup.F.resize(whole.F.rows(), 3);
  for (int corner = 0; corner < soup.V.rows(); ++corner)
  {
    soup.V.row(corner) = whole.V.row(whole.F(corner / 3, corner % 3));
    soup.F(corner / 3, corner % 3) = corner;
  }
  const auto input = PolyDataOf(soup);
  vtkNew<vtkHarmonicFieldSolver> solver;
  solver->JoinPointsOff();
  const Messages messages(solver);
  solver->SetInputData(input);
  solver->Update();
  ASSERT_EQ(messages.GetWarnings().size(), 1u);
  EXPECT_NE(messages.GetWarnings()[0].find("apply Clean (vtkCleanPolyData)"), std::string::npos);

  const Messages ofWhole(solver);
  solver->SetInputData(Cleaned(input));
  solver->Update();
  EXPECT_TRUE(ofWhole.GetWarnings().empty());
  EXPECT_EQ(Values(solver->GetOutput()->GetFieldData(), "Eigenvalues").size(), 1u);
}

TEST(Remedy, IsNotAskedForTrianglesThatAreAlone)
{
  vtkNew<vtkHarmonicFieldSolver> solver;
  const Messages messages(solver);
  solver->SetInputData(Polygons(
    { { 0, 0, 0 }, { 1, 0, 0 }, { 1, 1, 0 }, { 4, 0, 0 }, { 5, 0, 0 }, { 5, 1, 0 } }, { { 0, 1, 2 }, { 3, 4, 5 } }));
  solver->Update();
  EXPECT_TRUE(messages.GetWarnings().empty());
}

// What messages about surfaces that are too large name; those are too large for a test.
TEST(Remedy, DecimateLeavesSurfacesThatAreTaken)
{
  for (const Surface& surface : { Icosphere(4), Torus(60, 40), PlaneGrid(50, 40) })
  {
    const auto input = PolyDataOf(surface);
    vtkNew<vtkDecimatePro> decimate;
    decimate->SetTargetReduction(0.9);
    const Data smaller = OutputOf(decimate.Get(), input);
    EXPECT_LT(smaller->GetNumberOfCells(), input->GetNumberOfCells() / 2);
    PrescribeSides(smaller);
    ExpectOutput(NewSolver(smaller));
  }
}

// Without area nothing is determined; there is no remedy but another surface.
TEST(Refusal, NamesASurfaceWithoutArea)
{
  const Data input = PolyDataOf(Icosphere(2));
  vtkPoints* const points = vtkPolyData::SafeDownCast(input)->GetPoints();
  for (vtkIdType point = 0; point < points->GetNumberOfPoints(); ++point)
  {
    points->SetPoint(point, static_cast<double>(point), 0.0, 0.0);
  }
  PrescribeSides(input);
  ExpectRefusal(NewSolver(input), { "no triangle of the surface has an area", "line" });
}

// The forms of a torus that is flat as a line have no vectors.
TEST(Remedy, ThresholdOfAreasLeavesFieldsThatCanBeToldApart)
{
  Surface torus = Torus(8, 6);
  torus.V.col(0) += 0.1 * torus.V.col(1) + 0.01 * torus.V.col(2);
  torus.V.rightCols(2).setZero();
  const Data input = PolyDataOf(Union(Icosphere(2), torus, Vector3(6.0, 0.0, 0.0)));
  const auto solver = NewSolver(input);
  solver->SetInputArrayToProcess(1, 0, 0, OnCells, "");
  solver->SetDiscretisation(vtkHarmonicFieldSolver::FaceField);
  solver->HarmonicBasisOn();
  solver->JoinPointsOff(); // else the part is a line
  ExpectRefusal(solver, { "cannot be told apart", "Cell Size, Threshold of Area and Extract Surface" });

  vtkNew<vtkCellSizeFilter> sizes;
  sizes->SetInputData(input);
  vtkNew<vtkThreshold> threshold;
  threshold->SetInputConnection(sizes->GetOutputPort());
  threshold->SetInputArrayToProcess(0, 0, 0, OnCells, "Area");
  threshold->SetThresholdFunction(vtkThreshold::THRESHOLD_UPPER);
  threshold->SetUpperThreshold(1e-6);
  threshold->Update();
  solver->SetInputData(ExtractedSurface(threshold->GetOutput()));
  ExpectOutput(solver);
}

// What is prescribed
// ----------------------------------------------------------------------------------------------

namespace
{

/// A sphere on which the cells 10 and 900 are prescribed, and all weights are 1.
vtkSmartPointer<vtkPolyData> Sphere()
{
  auto input = PolyDataOf(Icosphere(3));
  AddCellVectors(input, "Given", { { 10, { 1.0, 0.5, -0.25 } }, { 900, { -0.5, 0.25, 1.0 } } });
  const auto weights = Zeros("Weights", 1280, 1);
  weights->Fill(1.0);
  input->GetCellData()->AddArray(weights);
  return input;
}

Data Calculated(vtkDataSet* input, const char* result, const std::string& function)
{
  vtkNew<vtkArrayCalculator> calculator;
  calculator->SetAttributeTypeToCellData();
  calculator->AddScalarArrayName("Weights");
  calculator->AddVectorArrayName("Given");
  calculator->SetResultArrayName(result);
  calculator->SetFunction(function.c_str());
  calculator->SetInputData(input);
  calculator->Update();
  return calculator->GetDataSetOutput();
}

}

TEST(Remedy, CalculatorBringsDirectionsToASizeThatCanBeComputedWith)
{
  for (const auto& [size, word] : { std::pair("1e-100", "too small"), std::pair("1e100", "too large") })
  {
    const Data input = Calculated(Sphere(), "Given", std::string(size) + " * Given");
    const auto solver = NewSolver(input);
    ExpectRefusal(solver, { "length of the directions", word, "Calculator (vtkArrayCalculator)" });
    solver->SetInputData(Calculated(input, "Given", "Given / " + std::string(size)));
    ExpectOutput(solver);
  }
}

TEST(Remedy, CalculatorBringsWeightsToASizeThatCanBeComputedWith)
{
  for (const auto& [size, word] : { std::pair("1e-300", "too small"), std::pair("1e300", "too large") })
  {
    const Data input = Calculated(Sphere(), "Weights", std::string(size) + " * Weights");
    const auto solver = NewSolver(input);
    solver->SetInputArrayToProcess(2, 0, 0, OnCells, "Weights");
    ExpectRefusal(solver, { "weight", word, "Calculator (vtkArrayCalculator)" });
    solver->SetInputData(Calculated(input, "Weights", "Weights / " + std::string(size)));
    ExpectOutput(solver);
  }
}

TEST(Remedy, TableToPointsMakesAGuideOfATable)
{
  vtkNew<vtkTable> table;
  for (const char* const name : { "x", "y", "z" })
  {
    const auto column = Zeros(name, 1, 1);
    column->SetValue(0, 0.6);
    table->AddColumn(column);
  }
  const auto vectors = Zeros("Vectors", 1, 3);
  vectors->SetTuple3(0, 1.0, -1.0, 0.0);
  table->AddColumn(vectors);
  const auto solver = NewSolver(Sphere());
  solver->SetInputData(1, table);
  ExpectRefusal(solver, { "vtkTable", "Table To Points (vtkTableToPolyData)" });
  vtkNew<vtkTableToPolyData> points;
  points->SetInputData(table);
  points->SetXColumn("x");
  points->SetYColumn("y");
  points->SetZColumn("z");
  solver->SetInputConnection(1, points->GetOutputPort());
  solver->SetGuideArrayToProcess(1, 1, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "Vectors");
  ExpectOutput(solver);
}

TEST(Remedy, DirectionalProlongationAgainReplacesOperatorsOfAnotherSurface)
{
  vtkNew<vtkDirectionalProlongation> prolongation;
  prolongation->SetInputData(Sphere());
  prolongation->Update();
  vtkNew<vtkPolyData> moved;
  moved->DeepCopy(prolongation->GetOutput());
  moved->GetPoints()->SetPoint(3, 0.1, 0.2, 0.9);
  const auto solver = NewSolver(moved);
  solver->SetCoarseSpace(vtkHarmonicFieldSolver::StructurePreserving);
  ExpectRefusal(solver, { "another", "Directional Prolongation (vtkDirectionalProlongation)" });
  prolongation->SetInputData(moved);
  solver->SetInputConnection(prolongation->GetOutputPort());
  ExpectOutput(solver);
}

TEST(Remedy, ExtractedSurfaceHasTheTrianglesThatLinesLack)
{
  const Data lines = Polygons(Square, {});
  vtkNew<vtkCellArray> cells;
  cells->InsertNextCell({ 0, 1 });
  vtkPolyData::SafeDownCast(lines)->SetLines(cells);
  PrescribeSides(lines);
  const auto solver = NewSolver(lines);
  ExpectRefusal(solver, { "no triangles", "Extract Surface (vtkGeometryFilter)" });
  const Data surface = ExtractedSurface(Grid(VTK_TETRA, { 0, 1, 3, 4 }));
  PrescribeSides(surface);
  solver->SetInputData(surface);
  ExpectOutput(solver);
}
