#include "SurfaceInPieces.h"

#include "vtkCellData.h"
#include "vtkPointData.h"
#include "vtkScaleFilter.h"
#include "vtkTable.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

/// Scales that each rank has on its own piece, with PETSc.
namespace dmg::test
{

namespace
{

constexpr double Wavelength = 1.2;

/// Heights and winds of several lengths at the points.
vtkSmartPointer<vtkPolyData> WithQuantities(vtkSmartPointer<vtkPolyData> surface)
{
  const vtkIdType points = surface->GetNumberOfPoints();
  const auto heights = Zeros("Height", points, 1);
  const auto winds = Zeros("Wind", points, 3);
  for (vtkIdType point = 0; point < points; ++point)
  {
    Place p;
    surface->GetPoint(point, p.data());
    heights->SetValue(point, 5.0 + p[2] + 0.3 * std::sin(7.0 * p[0] - 4.0 * p[1]));
    winds->SetTuple3(point, -p[1], p[0] + std::sin(6.0 * p[2]), 0.2);
  }
  surface->GetPointData()->AddArray(heights);
  surface->GetPointData()->AddArray(winds);
  return surface;
}

vtkSmartPointer<vtkScaleFilter> NewScales(vtkPolyData* surface)
{
  auto scales = vtkSmartPointer<vtkScaleFilter>::New();
  scales->SetInputData(surface);
  scales->AddArray("Height");
  scales->AddArray("Wind");
  scales->AddWavelength(Wavelength);
  scales->SetFlowKind(vtkScaleFilter::Wholes);
  scales->SetTolerance(1e-8);
  scales->SetSpectrumRows(2);
  return scales;
}

vtkDataSet* OutputOf(vtkAlgorithm* filter)
{
  return vtkDataSet::SafeDownCast(filter->GetOutputDataObject(0));
}

vtkTable* SpectrumOf(vtkAlgorithm* filter)
{
  return vtkTable::SafeDownCast(filter->GetOutputDataObject(1));
}

std::map<Place, Vector3> ByPlace(vtkDataSet* surface, const std::string& name)
{
  std::map<Place, Vector3> values;
  vtkDataArray* const array = surface->GetPointData()->GetArray(name.c_str());
  for (vtkIdType point = 0; array && point < surface->GetNumberOfPoints(); ++point)
  {
    Place place;
    surface->GetPoint(point, place.data());
    Vector3 value = Vector3::Zero();
    for (int k = 0; k < array->GetNumberOfComponents(); ++k)
    {
      value[k] = array->GetComponent(point, k);
    }
    values[place] = value;
  }
  return values;
}

void ExpectSame(vtkDataSet* piece, vtkDataSet* whole, const std::string& name)
{
  SCOPED_TRACE(name);
  const auto expected = ByPlace(whole, name);
  const auto here = ByPlace(piece, name);
  EXPECT_FALSE(expected.empty());
  EXPECT_EQ(here.empty(), piece->GetNumberOfPoints() == 0);
  for (const auto& [place, value] : here)
  {
    const auto found = expected.find(place);
    ASSERT_TRUE(found != expected.end());
    EXPECT_LE((value - found->second).norm(), 1e-6);
  }
}

/// Whether the outputs are those of the whole surface, by this process alone.
void ExpectScalesOfWhole(vtkPolyData* own)
{
  const auto inPieces = NewScales(own);
  const Messages messages(inPieces);
  UpdateOwnPiece(inPieces);
  EXPECT_TRUE(messages.Silent()) << messages.Error();
  const auto onOne = NewScales(WithQuantities(Sphere(Subdivisions)));
  onOne->Update(); // piece 0 of 1
  vtkDataSet* const output = OutputOf(inPieces);
  EXPECT_EQ(Gathered(output), "");
  EXPECT_EQ(output->GetNumberOfPoints(), own->GetNumberOfPoints());
  for (const char* const name : { "Height below 1.2", "Height above 1.2", "Wind below 1.2", "Wind above 1.2" })
  {
    ExpectSame(output, OutputOf(onOne), name);
  }
  for (const char* const name : { "MeansBefore", "MeansAfter" })
  {
    EXPECT_NEAR(Values(output->GetFieldData(), name).at(0), Values(OutputOf(onOne)->GetFieldData(), name).at(0), 1e-9);
  }
  EXPECT_EQ(output->GetFieldData()->GetArray("Converged")->GetComponent(0, 0), 1.0);
  ASSERT_EQ(SpectrumOf(inPieces)->GetNumberOfRows(), Rank() == 0 ? 2 : 0);
  for (const char* const name : { "Height in band", "Wind in band" })
  {
    for (vtkIdType row = 0; row < SpectrumOf(inPieces)->GetNumberOfRows(); ++row)
    {
      EXPECT_NEAR(SpectrumOf(inPieces)->GetValueByName(row, name).ToDouble(),
        SpectrumOf(onOne)->GetValueByName(row, name).ToDouble(), 1e-3)
        << name;
    }
  }
}

}

TEST(ScalesInPieces, AreThoseOfTheWhole)
{
  ExpectScalesOfWhole(WithQuantities(OwnBand()));
}

TEST(ScalesInPieces, MayHaveAnEmptyPieceOnAnyRank)
{
  if (Ranks() < 3)
  {
    GTEST_SKIP() << "one rank alone has the surface";
  }
  for (const int first : { 0, 1 })
  {
    ExpectScalesOfWhole(WithQuantities(OwnBand(Ranks() - 1, first)));
  }
}

TEST(ScalesInPieces, OfANextTimeNeedNoOtherSetup)
{
  const auto own = WithQuantities(OwnBand());
  const auto scales = NewScales(own);
  scales->SpectrumOff();
  UpdateOwnPiece(scales);
  EXPECT_EQ(scales->GetNumberOfSetups(), 2); // for functions and for vectors
  const auto later = vtkSmartPointer<vtkPolyData>::New();
  later->ShallowCopy(own);
  const auto zeros = Zeros("Height", own->GetNumberOfPoints(), 1);
  later->GetPointData()->AddArray(zeros);
  scales->SetInputData(later);
  UpdateOwnPiece(scales);
  EXPECT_EQ(scales->GetNumberOfSetups(), 2);
  EXPECT_EQ(scales->GetNumberOfSplits(), 4);
  for (const double height : Values(OutputOf(scales)->GetPointData(), "Height below 1.2"))
  {
    EXPECT_EQ(height, 0.0);
  }
}

TEST(ScalesInPieces, AreGatheredWhereOneProcessIsNeeded)
{
  const auto expectGathered = [](vtkScaleFilter* scales, const std::string& reason)
  {
    SCOPED_TRACE(reason);
    UpdateOwnPiece(scales);
    EXPECT_EQ(OutputOf(scales)->GetNumberOfCells(), Rank() == 0 ? 1280 : 0);
    if (Rank() == 0)
    {
      EXPECT_NE(Gathered(OutputOf(scales)).find(reason), std::string::npos) << Gathered(OutputOf(scales));
    }
  };
  const auto own = WithQuantities(OwnBand());
  const auto parts = NewScales(own);
  parts->SetFlowKind(vtkScaleFilter::Parts);
  expectGathered(parts, "parts of flows");
  const auto factors = NewScales(own);
  factors->SetSolver(vtkScaleFilter::Cholesky);
  expectGathered(factors, "conjugate gradients");
  const auto varying = NewScales(own);
  varying->ClearArrays();
  varying->AddArray("Height");
  varying->SetInputArrayToProcess(3, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "Height");
  expectGathered(varying, "wavelengths that vary");
  const auto land = WithQuantities(OwnBand());
  if (Rank() == Ranks() - 1)
  {
    land->GetPointData()->GetArray("Height")->SetComponent(0, 0, std::numeric_limits<double>::quiet_NaN());
  }
  expectGathered(NewScales(land), "gaps");
  const auto ofCells = NewScales(own);
  const auto cells = Zeros("OfCells", own->GetNumberOfCells(), 1);
  own->GetCellData()->AddArray(cells);
  ofCells->AddArray("OfCells");
  expectGathered(ofCells, "quantities of cells");
}

TEST(ScalesInPieces, AskForAChoiceOnAllRanks)
{
  vtkNew<vtkScaleFilter> scales;
  const auto own = OwnBand(); // with one array, of cells, which is no choice beside another
  own->GetCellData()->AddArray(Zeros("Other", own->GetNumberOfCells(), 1));
  scales->SetInputData(own);
  const Messages messages(scales);
  UpdateOwnPiece(scales);
  EXPECT_EQ(OutputOf(scales)->GetNumberOfCells(), own->GetNumberOfCells());
  EXPECT_EQ(messages.Error().find("there is nothing to filter") != std::string::npos, Rank() == 0) << messages.Error();
}

}
