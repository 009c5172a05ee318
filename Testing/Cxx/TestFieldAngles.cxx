#include "vtkFieldAngles.h"

#include "TestTools.h"

#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkPointData.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace
{

using namespace dmg::test;
using dmg::Pi;
using dmg::Vector3;

/// A cylinder around the z axis with a vector on each cell, at an angle in degrees from the axis, counter-clockwise seen from
/// outside.
vtkSmartPointer<vtkPolyData> Helix(double degrees)
{
  Surface tube = Annulus(60, 10);
  for (Eigen::Index v = 0; v < tube.V.rows(); ++v)
  {
    // The rings of the annulus become rings around the axis, and its normals point outwards.
    const double angle = std::atan2(tube.V(v, 1), tube.V(v, 0));
    const double height = -tube.V.row(v).norm();
    tube.V.row(v) << std::cos(angle), std::sin(angle), height;
  }
  const auto data = PolyDataOf(tube);
  const auto vectors = Zeros("Direction0", data->GetNumberOfCells(), 3);
  const auto across = Zeros("Around", data->GetNumberOfPoints(), 3);
  for (vtkIdType cell = 0; cell < data->GetNumberOfCells(); ++cell)
  {
    Vector3 normal = (tube.V.row(tube.F(cell, 1)) - tube.V.row(tube.F(cell, 0))).transpose();
    normal =
      normal.cross(Vector3((tube.V.row(tube.F(cell, 2)) - tube.V.row(tube.F(cell, 0))).transpose())).normalized();
    const Vector3 axis = Vector3::UnitZ();
    const Vector3 vector = std::cos(degrees * Pi / 180.0) * axis + std::sin(degrees * Pi / 180.0) * normal.cross(axis);
    vectors->SetTuple(cell, vector.data());
  }
  for (vtkIdType point = 0; point < data->GetNumberOfPoints(); ++point)
  {
    across->SetTuple3(point, -tube.V(point, 1), tube.V(point, 0), 0.0);
  }
  data->GetCellData()->AddArray(vectors);
  data->GetPointData()->AddArray(across);
  return data;
}

std::vector<double> Angles(vtkFieldAngles* filter)
{
  filter->Update();
  return Values(filter->GetOutput()->GetCellData(), "Angle");
}

}

// Angles of the nearest of N directions are those of one of them, less multiples of 360 / N.
TEST(FieldAngles, AreThoseOfAHelixAgainstItsAxis)
{
  for (const int N : { 1, 2, 3, 4 })
  {
    for (const double degrees : { 0.0, 20.0, -35.0, 70.0, 130.0, -170.0 })
    {
      vtkNew<vtkFieldAngles> filter;
      filter->SetInputData(Helix(degrees));
      filter->SetNumberOfDirections(N);
      const double step = 360.0 / N;
      const double expected = degrees - step * std::round(degrees / step);
      const std::vector<double> angles = Angles(filter);
      ASSERT_FALSE(angles.empty());
      for (const double angle : angles)
      {
        ASSERT_NEAR(angle, expected, 1e-9) << N << ", " << degrees;
      }
      // The length of the axis does not matter, nor, for even N, its sign.
      filter->SetAxis(0.0, 0.0, N % 2 == 0 ? -3.0 : 3.0);
      EXPECT_NEAR(Angles(filter).front(), expected, 1e-9);
    }
  }
}

TEST(FieldAngles, MayBeCountedFromVectorsAtPoints)
{
  vtkNew<vtkFieldAngles> filter;
  filter->SetInputData(Helix(75.0));
  filter->SetNumberOfDirections(2);
  filter->SetInputArrayToProcess(1, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "Around");
  // A quarter turn from the axis, seen from outside, lies the direction around it.
  for (const double angle : Angles(filter))
  {
    ASSERT_NEAR(std::abs(angle), 15.0, 1e-6);
  }
}

TEST(FieldAngles, StandBesideTheScalarsThatWereActive)
{
  const auto helix = Helix(20.0);
  helix->GetCellData()->SetScalars(Zeros("Layer", helix->GetNumberOfCells(), 1));
  vtkNew<vtkFieldAngles> filter;
  filter->SetInputData(helix);
  filter->Update();
  EXPECT_TRUE(filter->GetOutput()->GetCellData()->HasArray("Layer"));
  EXPECT_STREQ(filter->GetOutput()->GetCellData()->GetScalars()->GetName(), "Angle");
}

TEST(FieldAngles, AreZeroWhereTheAxisIsPerpendicularWithAWarning)
{
  const auto plane = PolyDataOf(PlaneGrid(3, 3));
  const auto vectors = Zeros("Direction0", plane->GetNumberOfCells(), 3);
  vectors->FillComponent(0, 1.0);
  plane->GetCellData()->AddArray(vectors);
  vtkNew<vtkFieldAngles> filter;
  filter->SetInputData(plane);
  Messages messages(filter);
  for (const double angle : Angles(filter))
  {
    EXPECT_EQ(angle, 0.0);
  }
  ASSERT_EQ(messages.GetWarnings().size(), 1u);
  EXPECT_NE(messages.GetWarnings()[0].find("no angle on 18 of 18 triangles"), std::string::npos);
  messages.Forget();
  filter->SetAxis(0.0, 1.0, 5.0);
  for (const double angle : Angles(filter))
  {
    EXPECT_NEAR(angle, -90.0, 1e-9);
  }
  EXPECT_TRUE(messages.Silent());
}

TEST(FieldAngles, CountTheTrianglesWhereAReferenceVectorIsZero)
{
  const auto helix = Helix(75.0);
  auto* const around = helix->GetPointData()->GetArray("Around");
  vtkIdType size;
  const vtkIdType* corners;
  helix->GetCellPoints(7, size, corners);
  for (int k = 0; k < 3; ++k)
  {
    around->SetTuple3(corners[k], 0.0, 0.0, 0.0);
  }
  vtkNew<vtkFieldAngles> filter;
  filter->SetInputData(helix);
  filter->SetInputArrayToProcess(1, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "Around");
  const Messages messages(filter);
  EXPECT_EQ(Angles(filter)[7], 0.0);
  ASSERT_EQ(messages.GetWarnings().size(), 1u);
  EXPECT_NE(messages.GetWarnings()[0].find("no angle on 1 of "), std::string::npos);
}
