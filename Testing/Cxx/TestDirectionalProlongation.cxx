#include "vtkDirectionalProlongation.h"

#include "TestTools.h"

#include "vtkCompositeDataSet.h"
#include "vtkFloatArray.h"
#include "vtkInformation.h"
#include "vtkInformationIntegerKey.h"
#include "vtkIntArray.h"
#include "vtkPartitionedDataSetCollection.h"
#include "vtkSphereSource.h"
#include "vtkStringArray.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

using namespace dmg;
using namespace dmg::test;

namespace
{

/// 1280 faces, enough for two coarse levels with the options of NewFilter.
vtkSmartPointer<vtkPolyData> Sphere()
{
  return PolyDataOf(Icosphere(3));
}

vtkSmartPointer<vtkDirectionalProlongation> NewFilter(vtkPolyData* input)
{
  auto filter = vtkSmartPointer<vtkDirectionalProlongation>::New();
  filter->SetMinimumNumberOfFaces(60);
  filter->SetMaximumNumberOfCoarseLevels(2);
  filter->SetInputData(input);
  return filter;
}

int Value(vtkFieldData* data, const std::string& name, vtkIdType i)
{
  return vtkIntArray::SafeDownCast(data->GetAbstractArray(name.c_str()))->GetValue(i);
}

std::string Digest(vtkPolyData* data)
{
  auto* const array = vtkStringArray::SafeDownCast(data->GetFieldData()->GetAbstractArray("Prolongation.Digest"));
  return array ? array->GetValue(0) : "";
}

}

TEST(DirectionalProlongation, OperatorsAreHiddenFieldData)
{
  const auto input = Sphere();
  const auto filter = NewFilter(input);
  filter->Update();
  vtkPolyData* const output = filter->GetPolyDataOutput();
  vtkFieldData* const data = output->GetFieldData();
  EXPECT_EQ(output->GetPoints(), input->GetPoints());
  EXPECT_EQ(input->GetFieldData()->GetNumberOfArrays(), 0) << "the input was modified";

  ASSERT_EQ(data->GetNumberOfArrays(), 6 + 2 * 3 * 3);
  for (int i = 0; i < data->GetNumberOfArrays(); ++i)
  {
    vtkAbstractArray* const array = data->GetAbstractArray(i);
    EXPECT_EQ(array->GetInformation()->Get(vtkAbstractArray::GUI_HIDE()), 1) << array->GetName();
  }

  // A closed triangle surface has 2 #V - 4 = #F (genus 0), on every level.
  for (int level = 0; level < 3; ++level)
  {
    EXPECT_EQ(
      2 * Value(data, "Prolongation.NumbersOfVertices", level) - 4, Value(data, "Prolongation.NumbersOfFaces", level));
  }
  for (const std::string name : { "S0.0", "S0.1", "SP.0", "SP.1", "Nodal.0", "Nodal.1" })
  {
    SCOPED_TRACE(name);
    const int level = name.back() - '0';
    const bool isNodal = name[0] == 'N';
    const bool toFaces = name[0] == 'S' ? name[1] == 'P' : level == 0;
    const bool fromFaces = !isNodal && toFaces;
    auto* const offsets =
      vtkIntArray::SafeDownCast(data->GetAbstractArray(("Prolongation." + name + ".Offsets").c_str()));
    auto* const columns =
      vtkIntArray::SafeDownCast(data->GetAbstractArray(("Prolongation." + name + ".Columns").c_str()));
    auto* const values =
      vtkDoubleArray::SafeDownCast(data->GetAbstractArray(("Prolongation." + name + ".Values").c_str()));
    ASSERT_TRUE(offsets && columns && values);
    const vtkIdType rows =
      Value(data, toFaces ? "Prolongation.NumbersOfFaces" : "Prolongation.NumbersOfVertices", level);
    const int size =
      Value(data, fromFaces ? "Prolongation.NumbersOfFaces" : "Prolongation.NumbersOfVertices", level + 1);
    ASSERT_EQ(offsets->GetNumberOfValues(), rows + 1);
    ASSERT_EQ(offsets->GetValue(rows), columns->GetNumberOfValues());
    ASSERT_EQ(values->GetNumberOfTuples(), columns->GetNumberOfValues());
    ASSERT_EQ(values->GetNumberOfComponents(), name[1] == '0' ? 1 : 2);
    for (vtkIdType row = 0; row < rows; ++row)
    {
      double sum = 0.0;
      for (int i = offsets->GetValue(row); i < offsets->GetValue(row + 1); ++i)
      {
        EXPECT_GE(columns->GetValue(i), 0);
        EXPECT_LT(columns->GetValue(i), size);
        sum += values->GetNumberOfComponents() == 1
          ? values->GetValue(i)
          : std::hypot(values->GetComponent(i, 0), values->GetComponent(i, 1));
      }
      ASSERT_NEAR(sum, 1.0, 1e-12) << "row " << row;
    }
  }
}

TEST(DirectionalProlongation, LevelsAreDatasets)
{
  const auto input = Sphere();
  const auto filter = NewFilter(input);
  filter->Update();
  auto* const levels = vtkPartitionedDataSetCollection::SafeDownCast(filter->GetOutputDataObject(1));
  ASSERT_EQ(levels->GetNumberOfPartitionedDataSets(), 3u);
  vtkIdType finer = 0;
  for (unsigned int level = 0; level < 3; ++level)
  {
    auto* const surface = vtkPolyData::SafeDownCast(levels->GetPartition(level, 0));
    ASSERT_TRUE(surface);
    EXPECT_EQ("Level " + std::to_string(level), levels->GetMetaData(level)->Get(vtkCompositeDataSet::NAME()));
    const vtkIdType faces = surface->GetNumberOfCells();
    EXPECT_EQ(faces, Value(filter->GetOutput()->GetFieldData(), "Prolongation.NumbersOfFaces", level));
    if (level == 0)
    {
      EXPECT_EQ(surface->GetPoints(), input->GetPoints());
    }
    else // a quarter, as far as whole collapses allow
    {
      EXPECT_NEAR(faces, 0.25 * finer, 0.02 * finer + 2.0);
    }
    finer = faces;
  }
}

// What a change costs
// -------------------------------------------------------------------------------

TEST(DirectionalProlongation, ArrayAddedUpstreamRepeatsNothing)
{
  const auto input = Sphere();
  const auto filter = NewFilter(input);
  filter->Update();
  AddCellVectors(input, "Later", {});
  input->Modified();
  filter->Update();
  EXPECT_EQ(filter->GetNumberOfSetups(), 1);
  EXPECT_TRUE(filter->GetOutput()->GetCellData()->HasArray("Later"));
}

TEST(DirectionalProlongation, SameContentInOtherObjectsRepeatsNothing)
{
  const auto filter = NewFilter(Sphere());
  filter->Update();
  const std::string digest = Digest(filter->GetPolyDataOutput());
  const auto same = Sphere();
  same->GetPolys()->ConvertTo32BitStorage();
  filter->SetInputData(same);
  filter->Update();
  EXPECT_EQ(filter->GetNumberOfSetups(), 1);
  EXPECT_EQ(filter->GetPolyDataOutput()->GetPoints(), same->GetPoints());
  EXPECT_EQ(Digest(filter->GetPolyDataOutput()), digest);
}

TEST(DirectionalProlongation, OlderSurfaceSwappedInIsNotServedTheLastResult)
{
  const auto older = PolyDataOf(Torus(30, 20));
  const auto newer = Sphere();
  const auto filter = NewFilter(newer);
  filter->Update();
  ASSERT_LT(older->GetMTime(), newer->GetMTime());
  filter->SetInputData(older);
  filter->Update();
  EXPECT_EQ(filter->GetNumberOfSetups(), 2);
  EXPECT_EQ(Value(filter->GetOutput()->GetFieldData(), "Prolongation.NumbersOfFaces", 0), 1200);
}

TEST(DirectionalProlongation, EveryPointAndCornerCounts)
{
  const auto input = Sphere();
  const auto filter = NewFilter(input);
  filter->Update();
  const std::string digest = Digest(filter->GetPolyDataOutput());

  // The last bit of one coordinate.
  double point[3];
  input->GetPoint(100, point);
  point[2] = std::nextafter(point[2], 2.0);
  input->GetPoints()->SetPoint(100, point);
  input->GetPoints()->Modified();
  filter->Update();
  EXPECT_EQ(filter->GetNumberOfSetups(), 2);
  EXPECT_NE(Digest(filter->GetPolyDataOutput()), digest);

  // The same triangle, begun at another corner.
  const std::string second = Digest(filter->GetPolyDataOutput());
  Surface turned = Icosphere(3);
  std::swap(turned.F(7, 0), turned.F(7, 1));
  std::swap(turned.F(7, 1), turned.F(7, 2));
  const auto other = PolyDataOf(turned);
  filter->SetInputData(other);
  filter->Update();
  EXPECT_EQ(filter->GetNumberOfSetups(), 3);
  EXPECT_NE(Digest(filter->GetPolyDataOutput()), digest);
  EXPECT_NE(Digest(filter->GetPolyDataOutput()), second);
}

TEST(DirectionalProlongation, EveryPropertyCounts)
{
  const auto filter = NewFilter(Sphere());
  filter->Update();
  filter->SetFaceRatio(0.5);
  filter->Update();
  EXPECT_EQ(filter->GetNumberOfSetups(), 2);
  filter->SetMaximumNumberOfCoarseLevels(1);
  filter->Update();
  EXPECT_EQ(filter->GetNumberOfSetups(), 3);
  EXPECT_FALSE(filter->GetOutput()->GetFieldData()->HasArray("Prolongation.S0.1.Values"));
  filter->SetMinimumNumberOfFaces(800);
  filter->Update();
  EXPECT_EQ(filter->GetNumberOfSetups(), 4);
  filter->SetCollapsePolicy(vtkDirectionalProlongation::SequentialQueue);
  filter->Update();
  EXPECT_EQ(filter->GetNumberOfSetups(), 5);
}

// Inputs
// ---------------------------------------------------------------------------------------------

TEST(DirectionalProlongation, VertsAndLinesAndUnusedPointsTakeNoPart)
{
  const auto input = Sphere();
  const vtkIdType unused = input->GetPoints()->InsertNextPoint(5.0, 5.0, 5.0);
  vtkNew<vtkCellArray> verts, lines;
  verts->InsertNextCell({ unused });
  lines->InsertNextCell({ 0, unused });
  input->SetVerts(verts);
  input->SetLines(lines);
  const auto filter = NewFilter(input);
  filter->Update();
  EXPECT_EQ(filter->GetOutput()->GetNumberOfCells(), 1282);
  EXPECT_EQ(Value(filter->GetOutput()->GetFieldData(), "Prolongation.NumbersOfFaces", 0), 1280);
  EXPECT_EQ(Value(filter->GetOutput()->GetFieldData(), "Prolongation.NumbersOfVertices", 0), 642);
}

TEST(DirectionalProlongation, OtherOperatorsAreReplaced)
{
  const auto input = Sphere();
  auto filter = NewFilter(input);
  filter->Update();
  ASSERT_TRUE(filter->GetOutput()->GetFieldData()->HasArray("Prolongation.S0.1.Values"));
  const auto again = NewFilter(filter->GetPolyDataOutput());
  again->SetMaximumNumberOfCoarseLevels(1);
  again->Update();
  vtkFieldData* const data = again->GetOutput()->GetFieldData();
  EXPECT_TRUE(data->HasArray("Prolongation.S0.0.Values"));
  EXPECT_FALSE(data->HasArray("Prolongation.S0.1.Values"));
}

TEST(DirectionalProlongation, PieceZeroHoldsTheWholeAndTheOthersNothing)
{
  vtkNew<vtkSphereSource> source; // gives a piece of itself where that is asked for
  source->SetThetaResolution(20);
  source->SetPhiResolution(11);
  vtkNew<vtkDirectionalProlongation> filter;
  filter->SetInputConnection(source->GetOutputPort());
  Messages messages(filter);
  filter->UpdatePiece(1, 2, 0);
  EXPECT_EQ(filter->GetOutput()->GetNumberOfCells(), 0);
  filter->UpdatePiece(0, 2, 0);
  EXPECT_EQ(filter->GetOutput()->GetNumberOfCells(), 2 * 20 * (11 - 2));
  EXPECT_TRUE(messages.Silent());

  filter->SetInputData(Sphere()); // the same in every piece
  filter->UpdatePiece(1, 2, 0);
  EXPECT_EQ(filter->GetOutput()->GetNumberOfCells(), 0);
  EXPECT_EQ(messages.GetWarnings().size(), 1u);
}

namespace
{

struct BadInput
{
  std::string Name;
  std::function<vtkSmartPointer<vtkPolyData>()> Make;
  std::vector<std::string> Words; ///< that the message must contain: element and remedy
};

/// Two triangles above a line cell, so that the triangles are cells 1 and 2, and an unused point,
/// so that vertices are not points.
vtkSmartPointer<vtkPolyData> TwoTriangles(
  std::initializer_list<vtkIdType> first, std::initializer_list<vtkIdType> second)
{
  vtkNew<vtkPoints> points;
  points->InsertNextPoint(9.0, 9.0, 9.0);
  points->InsertNextPoint(0.0, 0.0, 0.0);
  points->InsertNextPoint(1.0, 0.0, 0.0);
  points->InsertNextPoint(1.0, 1.0, 0.0);
  points->InsertNextPoint(0.0, 1.0, 0.0);
  points->InsertNextPoint(1.0, 0.0, 0.0); // where point 2 is
  vtkNew<vtkCellArray> lines, polygons;
  lines->InsertNextCell({ 1, 2 });
  polygons->InsertNextCell(first);
  polygons->InsertNextCell(second);
  auto data = vtkSmartPointer<vtkPolyData>::New();
  data->SetPoints(points);
  data->SetLines(lines);
  data->SetPolys(polygons);
  return data;
}

std::ostream& operator<<(std::ostream& os, const BadInput& input)
{
  return os << input.Name;
}

class RefusedSurface : public testing::TestWithParam<BadInput>
{
};

const BadInput BadInputs[] = {
  { "LinesOnly",
    []
    {
      auto data = TwoTriangles({ 1, 2, 3 }, { 1, 3, 4 });
      data->SetPolys(nullptr);
      return data;
    },
    { "no triangles" } },
  { "PointOutOfRange",
    [] {
      return TwoTriangles({ 1, 2, 3 }, { 1, 3, 77 });
    },
    { "cell 2", "point 77", "repair" } },
  { "RepeatedCorner",
    [] {
      return TwoTriangles({ 1, 2, 3 }, { 1, 3, 3 });
    },
    { "cell 2" } },
  { "OppositeOrientation",
    [] {
      return TwoTriangles({ 1, 2, 3 }, { 1, 4, 3 });
    },
    { "cell" } },
  { "NotFinite",
    []
    {
      auto data = TwoTriangles({ 1, 2, 3 }, { 1, 3, 4 });
      data->GetPoints()->SetPoint(4, 0.0, std::numeric_limits<double>::quiet_NaN(), 0.0);
      return data;
    },
    { "point 4" } },
  { "CornersInOnePlace",
    []
    {
      auto data = TwoTriangles({ 1, 2, 3 }, { 2, 5, 4 });
      data->GetPoints()->SetPoint(4, 1.0, 0.0, 0.0);
      return data;
    },
    { "cell 2" } },
};

}

TEST(DirectionalProlongation, TakesQuadrilateralsAndStrips)
{
  const auto strips = TwoTriangles({ 1, 2, 3 }, { 1, 3, 4 });
  vtkNew<vtkCellArray> strip;
  strip->InsertNextCell({ 1, 2, 4, 3 });
  strips->SetPolys(nullptr);
  strips->SetStrips(strip);
  for (const auto& [input, cells] : { std::pair(TwoTriangles({ 1, 4, 3 }, { 1, 2, 3, 4 }), 3), std::pair(strips, 3) })
  {
    const auto filter = NewFilter(input);
    const Messages messages(filter);
    filter->Update();
    EXPECT_EQ(messages.Error(), "");
    EXPECT_EQ(filter->GetOutput()->GetNumberOfCells(), cells);
  }
}

TEST_P(RefusedSurface, NamesElementAndRemedyAndLeavesOutputsEmpty)
{
  const auto input = GetParam().Make();
  const auto filter = NewFilter(input);
  filter->StrictOn();
  const Messages messages(filter);
  filter->Update();
  for (const std::string& word : GetParam().Words)
  {
    EXPECT_NE(messages.Error().find(word), std::string::npos) << "'" << word << "' is not in: " << messages.Error();
  }
  EXPECT_FALSE(messages.GetErrors().empty());
  EXPECT_EQ(filter->GetOutput()->GetNumberOfCells(), 0);
  EXPECT_EQ(filter->GetOutput()->GetNumberOfPoints(), 0);
  EXPECT_EQ(filter->GetNumberOfSetups(), 0);
}

INSTANTIATE_TEST_SUITE_P(DirectionalProlongation, RefusedSurface, testing::ValuesIn(BadInputs),
  [](const testing::TestParamInfo<BadInput>& info) { return info.param.Name; });
