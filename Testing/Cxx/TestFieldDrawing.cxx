#include "vtkFieldAngles.h"
#include "vtkFieldGlyphs.h"
#include "vtkFieldLines.h"
#include "vtkFieldSingularities.h"
#include "vtkHarmonicFieldSolver.h"

#include "TestTools.h"

#include "vtkDataArray.h"
#include "vtkIdTypeArray.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

namespace
{

using namespace dmg::test;
using dmg::Vector3;

constexpr int Points = vtkDataObject::FIELD_ASSOCIATION_POINTS;
constexpr int Cells = vtkDataObject::FIELD_ASSOCIATION_CELLS;

/// The four filters, by turns.
class FieldDrawing : public testing::TestWithParam<int>
{
protected:
  static vtkSmartPointer<vtkAlgorithm> New()
  {
    switch (GetParam())
    {
      case 0:
        return vtkSmartPointer<vtkFieldLines>::New();
      case 1:
        return vtkSmartPointer<vtkFieldGlyphs>::New();
      case 2:
        return vtkSmartPointer<vtkFieldSingularities>::New();
      default:
        return vtkSmartPointer<vtkFieldAngles>::New();
    }
  }

  static vtkDataSet* OutputOf(vtkAlgorithm* filter, int port = 0)
  {
    return vtkDataSet::SafeDownCast(filter->GetOutputDataObject(port));
  }

  /// What a filter says for an array that is no field. The surface goes on to show where the filter has it as its output.
  static std::string ChoiceErrorFor(vtkAlgorithm* filter, vtkPolyData* input)
  {
    if (!vtkFieldAngles::SafeDownCast(filter))
    {
      return ErrorFor(filter, input);
    }
    Messages messages(filter);
    filter->SetInputDataObject(input);
    filter->Update();
    vtkDataSet* const output = OutputOf(filter);
    EXPECT_EQ(output->GetNumberOfPoints(), input->GetNumberOfPoints());
    EXPECT_EQ(output->GetNumberOfCells(), input->GetNumberOfCells());
    EXPECT_EQ(output->GetCellData()->GetNumberOfArrays(), input->GetCellData()->GetNumberOfArrays());
    return messages.Error();
  }

  /// What a filter with this input says, and that its outputs are empty then.
  static std::string ErrorFor(vtkAlgorithm* filter, vtkPolyData* input)
  {
    Messages messages(filter);
    filter->SetInputDataObject(input);
    filter->Update();
    for (int port = 0; port < filter->GetNumberOfOutputPorts(); ++port)
    {
      EXPECT_EQ(OutputOf(filter, port)->GetNumberOfPoints(), 0);
      EXPECT_EQ(OutputOf(filter, port)->GetNumberOfCells(), 0);
    }
    return messages.Error();
  }
};

vtkSmartPointer<vtkPolyData> Crosses(
  const Surface& surface, int N = 4, int discretisation = vtkHarmonicFieldSolver::PointPowerField)
{
  const auto input = PolyDataOf(surface);
  AddCellVectors(input, "Given", { { 0, { 0.3, 1.0, 0.2 } }, { 5, { 1.0, 0.1, 0.4 } } });
  vtkNew<vtkHarmonicFieldSolver> solver;
  solver->SetInputData(input);
  solver->SetDiscretisation(discretisation);
  solver->SetNumberOfDirections(N);
  solver->SetInputArrayToProcess(1, 0, 0, Cells, "Given");
  solver->Update();
  auto output = vtkSmartPointer<vtkPolyData>::New();
  output->ShallowCopy(solver->GetOutput());
  return output;
}

/// One constant vector on all cells or points.
vtkSmartPointer<vtkPolyData> WithVectors(
  const Surface& surface, const std::string& name, int association, const Vector3& vector)
{
  auto data = PolyDataOf(surface);
  const vtkIdType size = data->GetNumberOfElements(association == Points ? vtkDataObject::POINT : vtkDataObject::CELL);
  const auto array = Zeros(name, size, 3);
  for (vtkIdType i = 0; i < size; ++i)
  {
    array->SetTuple(i, vector.data());
  }
  data->GetAttributes(association)->AddArray(array);
  return data;
}

TEST_P(FieldDrawing, DrawsTheSolversFieldWithoutFurtherAdo)
{
  const auto filter = New();
  filter->SetInputDataObject(Crosses(IrregularSphere(3, 3)));
  Messages messages(filter);
  filter->Update();
  EXPECT_TRUE(messages.Silent());
  EXPECT_GT(OutputOf(filter)->GetNumberOfCells(), 3);
}

TEST_P(FieldDrawing, LeavesOutWhatIsNotFinite)
{
  const double infinity = std::numeric_limits<double>::infinity();
  for (const auto& [association, name, value] :
    { std::make_tuple(Cells, "cells", infinity - infinity), std::make_tuple(Points, "points", infinity) })
  {
    const auto filter = New();
    const auto data = WithVectors(Icosphere(2), "Wind", association, { 1.0, 0.0, 0.0 });
    for (const vtkIdType element : { 70, 7 })
    {
      data->GetAttributes(association)->GetArray("Wind")->SetComponent(element, 1, value);
    }
    filter->SetInputDataObject(data);
    filter->SetInputArrayToProcess(0, 0, 0, association, "Wind");
    Messages messages(filter);
    filter->Update();
    EXPECT_EQ(messages.Error(), "");
    const std::string expected = "'Wind' is not finite at 2 " + std::string(name) + ", as at 7";
    EXPECT_EQ(std::count_if(messages.GetWarnings().begin(), messages.GetWarnings().end(),
                [&](const std::string& text) { return text.find(expected) != std::string::npos; }),
      1);
    EXPECT_GT(OutputOf(filter)->GetNumberOfPoints(), 0);
  }
}

TEST_P(FieldDrawing, TakesVectorsOfTwoNumbersInThePlane)
{
  for (const int association : { Cells, Points })
  {
    const auto drawn = [&](vtkPolyData* data, const char* name)
    {
      const auto filter = New();
      filter->SetInputDataObject(data);
      filter->SetInputArrayToProcess(0, 0, 0, association, name);
      filter->Update();
      return vtkSmartPointer<vtkDataSet>(OutputOf(filter));
    };
    const auto withTwo = [&](const Surface& surface)
    {
      auto data = WithVectors(surface, "Three", association, { 0.6, 0.8, 0.0 });
      const auto two = Zeros("Two", data->GetAttributes(association)->GetArray(0)->GetNumberOfTuples(), 2);
      two->FillComponent(0, 0.6);
      two->FillComponent(1, 0.8);
      data->GetAttributes(association)->AddArray(two);
      return data;
    };
    const auto plane = withTwo(PlaneGrid(12, 12));
    const auto two = drawn(plane, "Two"), three = drawn(plane, "Three");
    ASSERT_EQ(two->GetNumberOfPoints(), three->GetNumberOfPoints());
    for (vtkIdType point = 0; point < two->GetNumberOfPoints(); ++point)
    {
      EXPECT_EQ(Vector3(two->GetPoint(point)), Vector3(three->GetPoint(point)));
    }
    const auto filter = New();
    filter->SetInputArrayToProcess(0, 0, 0, association, "Two");
    EXPECT_NE(ChoiceErrorFor(filter, withTwo(Icosphere(1))).find("make vectors of 3 numbers, with Calculator"),
      std::string::npos);
  }
}

TEST_P(FieldDrawing, NamesWhatIsWrongWithTheInput)
{
  const auto filter = New();
  EXPECT_NE(
    ChoiceErrorFor(filter, PolyDataOf(Icosphere(1))).find("apply Harmonic Field Solver (vtkHarmonicFieldSolver) first"),
    std::string::npos);

  auto data = WithVectors(Icosphere(1), "Direction0", Cells, { 0.0, 0.0, 0.0 });
  EXPECT_NE(ChoiceErrorFor(filter, data).find("'Direction0' has no direction"), std::string::npos);

  data = WithVectors(Icosphere(1), "Direction0", Cells, { 1.0, 0.0, 0.0 });
  const auto askew = Zeros("Direction1", data->GetNumberOfCells(), 3);
  askew->Fill(1.0);
  data->GetCellData()->AddArray(askew);
  EXPECT_NE(ErrorFor(filter, data).find("of cell 0 are not 180 degrees apart"), std::string::npos);

  Surface quad = PlaneGrid(1, 1);
  data = WithVectors(quad, "Direction0", Cells, { 1.0, 0.0, 0.0 });
  data->GetPolys()->Reset();
  data->GetPolys()->InsertNextCell({ 0, 1, 3, 2 });
  data->GetCellData()->GetArray("Direction0")->SetNumberOfTuples(1);
  {
    const Messages messages(filter);
    filter->SetInputDataObject(data);
    filter->Update();
    EXPECT_EQ(messages.Error(), "");
  }
  data->GetPolys()->Reset();
  data->GetPolys()->InsertNextCell({ 0, 1, 3, 9 });
  data->GetPolys()->Modified();
  data->Modified();
  EXPECT_NE(ErrorFor(filter, data).find("cell 0 uses point 9"), std::string::npos);
}

TEST_P(FieldDrawing, RefusesArraysWithTooFewTuples)
{
  for (const char* const name : { "Direction0", "Direction1" })
  {
    const auto input = PolyDataOf(Icosphere(1));
    for (const char* const other : { "Direction0", "Direction1" })
    {
      AddVectors(input->GetCellData(), other, other == std::string(name) ? 7 : 80, { { 2, { 1.0, 0.5, -0.25 } } });
    }
    EXPECT_NE(
      ErrorFor(New(), input).find(std::string("array '") + name + "' has 7 tuples for 80 cells"), std::string::npos);
  }
}

TEST_P(FieldDrawing, NamesWhatIsWrongWithTheChoice)
{
  const auto filter = New();
  const auto data = WithVectors(Icosphere(1), "Direction0", Cells, { 1.0, 0.0, 0.0 });
  filter->SetInputArrayToProcess(0, 0, 0, Cells, "Wind");
  EXPECT_NE(ChoiceErrorFor(filter, data).find("array 'Wind'"), std::string::npos);
  data->GetCellData()->AddArray(Zeros("Wind", data->GetNumberOfCells(), 5));
  EXPECT_NE(ChoiceErrorFor(filter, data).find("holds neither vectors nor tensors"), std::string::npos);
  filter->SetInputArrayToProcess(0, 0, 0, Cells, "None");
  Messages messages(filter);
  filter->Update();
  EXPECT_TRUE(messages.Silent()) << messages.Error();
}

// Menus choose them where a surface has no other vectors.
TEST_P(FieldDrawing, RefusesNormals)
{
  const auto filter = New();
  const auto data = WithVectors(Icosphere(1), "Normals", Points, { 0.0, 0.0, 1.0 });
  data->GetPointData()->SetActiveNormals("Normals");
  filter->SetInputArrayToProcess(0, 0, 0, Points, "Normals");
  EXPECT_NE(ChoiceErrorFor(filter, data).find("holds the normals of the surface"), std::string::npos);
}

TEST_P(FieldDrawing, RecoversFromAnError)
{
  const auto filter = New();
  EXPECT_NE(ChoiceErrorFor(filter, PolyDataOf(Icosphere(1))), "");
  filter->SetInputDataObject(Crosses(Icosphere(2)));
  filter->Update();
  EXPECT_GT(OutputOf(filter)->GetNumberOfCells(), 0);
}

INSTANTIATE_TEST_SUITE_P(AllFilters, FieldDrawing, testing::Range(0, 4));

TEST(FieldLines, ReadAUsersArrays)
{
  const Vector3 direction(1.0, 0.0, 0.0);
  for (const int association : { Points, Cells })
  {
    for (const int N : { 0, 1, 2, 4 })
    {
      vtkNew<vtkFieldLines> lines;
      lines->SetInputData(WithVectors(IrregularPlane(20, 20, 4), "Wind", association, direction));
      lines->SetInputArrayToProcess(0, 0, 0, association, "Wind");
      lines->SetNumberOfDirections(N);
      lines->ArrowHeadsOff();
      lines->Update();
      vtkPolyData* const output = lines->GetOutput();
      ASSERT_GT(output->GetNumberOfLines(), 10);
      double range[2];
      output->GetCellData()->GetArray("Branch")->GetRange(range);
      EXPECT_EQ(range[0], 0.0);
      EXPECT_EQ(range[1], N == 4 ? 1.0 : 0.0);
      output->GetPointData()->GetArray("Magnitude")->GetRange(range);
      EXPECT_NEAR(range[0], 1.0, 1e-12);
      EXPECT_NEAR(range[1], 1.0, 1e-12);
      for (vtkIdType line = 0; line < output->GetNumberOfLines(); ++line)
      {
        const double branch = output->GetCellData()->GetArray("Branch")->GetComponent(line, 0);
        const double* const bounds = output->GetCell(line)->GetBounds();
        EXPECT_NEAR(branch == 0.0 ? bounds[2] : bounds[0], branch == 0.0 ? bounds[3] : bounds[1], 1e-9);
        EXPECT_NEAR(output->GetCellData()->GetArray("Length")->GetComponent(line, 0), 20.0, 1e-9);
        EXPECT_EQ(output->GetCellData()->GetArray("Seed")->GetComponent(line, 0), line);
      }
    }
  }
}

TEST(FieldLines, AreLiftedAlongTheNormals)
{
  vtkNew<vtkFieldLines> lines;
  lines->SetInputData(WithVectors(PlaneGrid(3, 4), "Direction0", Cells, { 0.0, 2.0, 0.0 }));
  lines->SetLift(0.1);
  lines->Update();
  double bounds[6];
  lines->GetOutput()->GetBounds(bounds);
  EXPECT_NEAR(bounds[4], 0.5, 1e-12); // a tenth of the diagonal
  EXPECT_NEAR(bounds[5], 0.5, 1e-12);
  EXPECT_EQ(Tuple(lines->GetOutput()->GetPointData(), "Normals", 0), Vector3(0.0, 0.0, 1.0));
}

TEST(FieldLines, ThatAreClosedEndWhereTheyBegan)
{
  const Surface prism = Prism(12, 6);
  const auto data = PolyDataOf(prism);
  const auto around = Zeros("Direction0", data->GetNumberOfPoints(), 3);
  for (vtkIdType i = 0; i < data->GetNumberOfPoints(); ++i)
  {
    around->SetTuple3(i, -prism.V(i, 1), prism.V(i, 0), 0.0);
  }
  data->GetPointData()->AddArray(around);
  vtkNew<vtkFieldLines> lines;
  lines->SetInputData(data);
  lines->SetSeparatingDistance(0.05);
  lines->ArrowHeadsOff();
  lines->Update();
  ASSERT_GT(lines->GetOutput()->GetNumberOfLines(), 2);
  for (vtkIdType line = 0; line < lines->GetOutput()->GetNumberOfLines(); ++line)
  {
    vtkIdList* const ids = lines->GetOutput()->GetCell(line)->GetPointIds();
    EXPECT_EQ(ids->GetId(0), ids->GetId(ids->GetNumberOfIds() - 1));
  }
}

/// What the warning says that a property should be.
double Remedy(const std::string& text, const std::string& property)
{
  const std::size_t at = text.rfind(property + " ");
  return at == std::string::npos ? -1.0 : std::stod(text.substr(at + property.size()));
}

TEST(FieldLines, ThatAreAllTooShortAreAWarningWhoseRemediesHelp)
{
  for (const auto& [distance, length] : { std::pair(0.9, 4.0), std::pair(0.1, 1000.0) })
  {
    vtkNew<vtkFieldLines> lines;
    lines->SetInputData(Crosses(IrregularSphere(3, 3)));
    lines->SetSeparatingDistance(distance);
    lines->SetMinimumLength(length);
    Messages messages(lines);
    lines->Update();
    EXPECT_EQ(lines->GetOutput()->GetNumberOfLines(), 0);
    ASSERT_EQ(messages.GetWarnings().size(), 1u);
    const std::string text = messages.GetWarnings()[0];
    messages.Forget();
    lines->SetSeparatingDistance(Remedy(text, "Separating Distance"));
    lines->Update();
    EXPECT_GT(lines->GetOutput()->GetNumberOfLines(), 0) << text;
    lines->SetSeparatingDistance(distance);
    lines->SetMinimumLength(Remedy(text, "Minimum Length"));
    lines->Update();
    EXPECT_GT(lines->GetOutput()->GetNumberOfLines(), 0) << text;
    EXPECT_TRUE(messages.Silent());
  }
}

// As crumbs far from each other have them: no Separating Distance that is allowed would do.
TEST(FieldLines, OnCrumbsAreAWarningThatNamesMinimumLengthAlone)
{
  Surface crumb = IrregularSphere(2, 3);
  crumb.V *= 1e-5;
  vtkNew<vtkFieldLines> lines;
  lines->SetInputData(Crosses(Union(crumb, crumb, Vector3(1.0, 0.0, 0.0))));
  lines->SetMinimumLength(1.0);
  Messages messages(lines);
  lines->Update();
  ASSERT_EQ(messages.GetWarnings().size(), 1u);
  const std::string text = messages.GetWarnings()[0];
  messages.Forget();
  EXPECT_EQ(text.find("Line Distance"), std::string::npos) << text;
  lines->SetMinimumLength(Remedy(text, "Minimum Length"));
  lines->Update();
  EXPECT_GT(lines->GetOutput()->GetNumberOfLines(), 0) << text;
  EXPECT_TRUE(messages.Silent());
}

TEST(FieldGlyphs, OffersStylesPlacementsAndSizings)
{
  const auto data = WithVectors(PlaneGrid(10, 10), "Wind", Cells, { 1.0, 0.0, 0.0 });
  vtkNew<vtkFieldGlyphs> glyphs;
  glyphs->SetInputData(data);
  glyphs->SetInputArrayToProcess(0, 0, 0, Cells, "Wind");
  glyphs->SetNumberOfDirections(4);
  glyphs->SetPlacement(vtkFieldGlyphs::EveryTriangle);
  glyphs->SetStyle(vtkFieldGlyphs::Strokes);
  glyphs->SetSizing(vtkFieldGlyphs::ByTriangle);
  glyphs->Update();
  EXPECT_EQ(glyphs->GetOutput()->GetNumberOfLines(), 4 * 200);
  double range[2];
  glyphs->GetOutput()->GetCellData()->GetArray("Direction")->GetRange(range);
  EXPECT_EQ(range[1], 3.0);
  glyphs->GetOutput()->GetCellData()->GetArray("Branch")->GetRange(range);
  EXPECT_EQ(range[1], 1.0);
  glyphs->GetOutput()->GetCellData()->GetArray("Glyph")->GetRange(range);
  EXPECT_EQ(range[1], 199.0);

  glyphs->SetStyle(vtkFieldGlyphs::Solid);
  glyphs->SetPlacement(vtkFieldGlyphs::EvenlySpread);
  glyphs->SetSeparatingDistance(0.1);
  glyphs->Update();
  EXPECT_EQ(glyphs->GetOutput()->GetNumberOfLines(), 0);
  EXPECT_GT(glyphs->GetOutput()->GetNumberOfPolys(), 100);
}

TEST(FieldSingularities, AreTheSolversAndSumToTheEulerCharacteristic)
{
  for (const auto& [surface, euler] : std::vector<std::pair<Surface, int>>{
         { IrregularSphere(3, 3), 2 }, { DoubleTorus(4), -2 }, { Disk(8), 1 }, { Annulus(24, 6), 0 } })
  {
    const auto field = Crosses(surface, 4, vtkHarmonicFieldSolver::PowerField);
    vtkNew<vtkFieldSingularities> singularities;
    singularities->SetInputData(field);
    singularities->Update();
    vtkPolyData* const points = singularities->GetOutput(0);
    vtkDataArray* const expected = field->GetPointData()->GetArray("SingularityIndex");
    vtkDataArray* const indices = points->GetPointData()->GetArray("Index");
    vtkDataArray* const ids = points->GetPointData()->GetArray("PointId");
    vtkIdType next = 0;
    for (vtkIdType point = 0; point < field->GetNumberOfPoints(); ++point)
    {
      if (expected->GetComponent(point, 0) != 0.0)
      {
        ASSERT_LT(next, points->GetNumberOfPoints());
        EXPECT_EQ(ids->GetComponent(next, 0), point);
        EXPECT_EQ(indices->GetComponent(next, 0), expected->GetComponent(point, 0));
        double a[3], b[3];
        field->GetPoint(point, a);
        points->GetPoint(next++, b);
        EXPECT_EQ(Vector3(a[0], a[1], a[2]), Vector3(b[0], b[1], b[2]));
      }
    }
    EXPECT_EQ(next, points->GetNumberOfPoints());
    EXPECT_EQ(points->GetNumberOfVerts(), next);
    vtkFieldData* const sums = points->GetFieldData();
    EXPECT_EQ(sums->GetArray("EulerCharacteristic")->GetComponent(0, 0), euler);
    EXPECT_NEAR(sums->GetArray("SumOfIndices")->GetComponent(0, 0), euler, 1e-9);
  }
}

TEST(FieldSingularities, CutsAreWhereTheSolverDidNotGoOn)
{
  const auto field = Crosses(IrregularSphere(3, 3));
  vtkNew<vtkFieldSingularities> singularities;
  singularities->SetInputData(field);
  singularities->Update();
  vtkPolyData* const cuts = singularities->GetOutput(1);
  EXPECT_GT(cuts->GetNumberOfLines(), 0);
  EXPECT_LT(cuts->GetNumberOfLines(), field->GetNumberOfCells() / 4);
  double range[2];
  cuts->GetCellData()->GetArray("Jump")->GetRange(range);
  EXPECT_GE(range[0], 1.0);
  EXPECT_LE(range[1], 3.0);
  cuts->GetCellData()->GetArray("Rotation")->GetRange(range);
  EXPECT_GE(range[0], -0.25 * dmg::Pi - 1e-12);
  EXPECT_LE(range[1], 0.25 * dmg::Pi + 1e-12);

  const auto flow = Crosses(IrregularSphere(3, 3), 1);
  singularities->SetInputData(flow);
  singularities->Update();
  EXPECT_EQ(singularities->GetOutput(1)->GetNumberOfLines(), 0) << "one direction has no cuts";
}

TEST(FieldSingularities, LoopsOfTheBoundaryAreClosedLines)
{
  vtkNew<vtkFieldSingularities> singularities;
  singularities->SetInputData(WithVectors(Annulus(24, 4), "Direction0", Cells, { 1.0, 0.0, 0.0 }));
  singularities->Update();
  vtkPolyData* const loops = singularities->GetOutput(2);
  ASSERT_EQ(loops->GetNumberOfLines(), 2);
  double sum = 0.0;
  for (vtkIdType loop = 0; loop < 2; ++loop)
  {
    vtkIdList* const ids = loops->GetCell(loop)->GetPointIds();
    EXPECT_EQ(ids->GetNumberOfIds(), 25);
    EXPECT_EQ(ids->GetId(0), ids->GetId(24));
    const double index = loops->GetCellData()->GetArray("Index")->GetComponent(loop, 0);
    EXPECT_EQ(std::abs(index), 1.0);
    sum += index;
  }
  EXPECT_EQ(sum, 0.0);
}

// Parallels around a vertex of five triangles turn by about 60 degrees across each of its edges.
TEST(FieldSingularities, OfAPoleWithTooFewTrianglesWarn)
{
  const auto field = PolyDataOf(dmg::test::Icosphere(2));
  const Vector3 pole(field->GetPoint(0));
  Vectors parallels;
  for (vtkIdType cell = 0; cell < field->GetNumberOfCells(); ++cell)
  {
    const double* const bounds = field->GetCell(cell)->GetBounds();
    const Vector3 centre(bounds[0] + bounds[1], bounds[2] + bounds[3], bounds[4] + bounds[5]);
    parallels.emplace_back(cell, pole.cross(centre));
  }
  AddCellVectors(field, "Parallels", parallels);
  vtkNew<vtkFieldSingularities> singularities;
  singularities->SetInputData(field);
  singularities->SetInputArrayToProcess(0, 0, 0, Cells, "Parallels");
  singularities->SetNumberOfDirections(4);
  Messages messages(singularities);
  singularities->Update();
  ASSERT_EQ(messages.GetWarnings().size(), 1u);
  for (const char* const word : { " and others look like several", "45 degrees", "refine", "fewer directions" })
  {
    EXPECT_NE(messages.GetWarnings().front().find(word), std::string::npos) << messages.GetWarnings().front();
  }
  const auto names = [&](vtkIdType point)
  { return messages.GetWarnings().front().find("at point " + std::to_string(point) + " ") != std::string::npos; };
  double opposite[] = { -pole[0], -pole[1], -pole[2] };
  EXPECT_TRUE(names(0) || names(field->FindPoint(opposite))) << "one of both poles";
  EXPECT_EQ(singularities->GetOutput(0)->GetPointData()->GetArray("Index")->GetComponent(0, 0), -0.25);

  messages.Forget();
  singularities->SetNumberOfDirections(2);
  singularities->Update();
  EXPECT_TRUE(messages.Silent()) << messages.Error();
  EXPECT_EQ(singularities->GetOutput(0)->GetNumberOfPoints(), 2);
}

}
