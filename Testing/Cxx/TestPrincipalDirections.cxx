#include "vtkFieldSingularities.h"
#include "vtkPrincipalDirections.h"

#include "TestTools.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace dmg::test;
using dmg::Vector3;

namespace
{

const char* const Names[] = { "MaximumDirection", "MinimumDirection", "MaximumCurvature", "MinimumCurvature",
  "Confidence" };

// A torus has no point where its curvatures agree, and its principal directions close around both generators.
TEST(PrincipalDirectionsFilter, ChoosesSignsThatContinue)
{
  vtkNew<vtkPrincipalDirections> filter;
  filter->SetInputData(PolyDataOf(IrregularTorus(60, 30, 3)));
  filter->Update();
  vtkPolyData* const output = filter->GetPolyDataOutput();
  for (vtkIdType cell = 0; cell < output->GetNumberOfCells(); ++cell)
  {
    vtkIdType size;
    const vtkIdType* corners;
    output->GetCellPoints(cell, size, corners);
    for (int k = 0; k < 3; ++k)
    {
      const Vector3 ofPoint = Tuple(output->GetPointData(), "MaximumDirection", corners[k]);
      EXPECT_GT(ofPoint.dot(Tuple(output->GetCellData(), "MaximumDirection", cell)), 0.5);
      EXPECT_GT(ofPoint.dot(Tuple(output->GetPointData(), "MaximumDirection", corners[(k + 1) % 3])), 0.5);
    }
  }
}

TEST(PrincipalDirectionsFilter, ShowsThoseOfATorusOnCellsAndPoints)
{
  const auto torus = PolyDataOf(IrregularTorus(60, 30, 3));
  AddCellVectors(torus, "Given", { { 3, { 1.0, 0.0, 0.0 } } });
  const vtkIdType stray = torus->GetPoints()->InsertNextPoint(0.0, 0.0, 0.0);
  vtkNew<vtkPrincipalDirections> filter;
  filter->SetInputData(torus);
  filter->SetScale(1.5);
  const Messages messages(filter);
  filter->Update();
  EXPECT_TRUE(messages.Silent());
  vtkPolyData* const output = filter->GetPolyDataOutput();
  EXPECT_TRUE(output->GetCellData()->GetArray("Given"));
  ASSERT_EQ(output->GetNumberOfCells(), 3600);
  for (vtkIdType point = 0; point < stray; ++point)
  {
    const Vector3 p(torus->GetPoint(point));
    const Vector3 around = Vector3(-p[1], p[0], 0.0).normalized();
    const double angle = std::atan2(p[2], std::hypot(p[0], p[1]) - 1.0);
    vtkPointData* const data = output->GetPointData();
    EXPECT_LT(std::abs(Tuple(data, "MaximumDirection", point).dot(around)), 0.1);
    EXPECT_GT(std::abs(Tuple(data, "MinimumDirection", point).dot(around)), 0.99);
    EXPECT_NEAR(data->GetArray("MaximumCurvature")->GetComponent(point, 0), 2.5, 0.5);
    EXPECT_NEAR(
      data->GetArray("MinimumCurvature")->GetComponent(point, 0), std::cos(angle) / (1.0 + 0.4 * std::cos(angle)), 0.3);
  }
  for (const char* name : Names)
  {
    EXPECT_EQ(output->GetPointData()->GetArray(name)->GetComponent(stray, 0), 0.0) << name;
    ASSERT_TRUE(output->GetCellData()->GetArray(name)) << name;
  }
  for (vtkIdType cell = 0; cell < output->GetNumberOfCells(); ++cell)
  {
    const Vector3 maximum = Tuple(output->GetCellData(), "MaximumDirection", cell);
    const Vector3 minimum = Tuple(output->GetCellData(), "MinimumDirection", cell);
    vtkIdType size;
    const vtkIdType* corners;
    output->GetCellPoints(cell, size, corners);
    const Vector3 a(output->GetPoint(corners[0])), b(output->GetPoint(corners[1])), c(output->GetPoint(corners[2]));
    const Vector3 normal = (b - a).cross(c - a).normalized();
    EXPECT_LT((normal.cross(maximum) - minimum).norm(), 1e-9);
    EXPECT_LT(std::abs(maximum.dot(Vector3(-a[1], a[0], 0.0).normalized())), 0.15);
  }
}

// Their signs are arbitrary: taken for vectors, they would have singularities all over. Those of a torus have none.
TEST(PrincipalDirectionsFilter, MakesDirectionsThatAreDrawnAsLines)
{
  vtkNew<vtkPrincipalDirections> bends;
  bends->SetInputData(PolyDataOf(IrregularTorus(60, 30, 3)));
  bends->Update();
  for (const char* const name : { "MaximumDirection", "MinimumDirection" })
  {
    for (const int association : { vtkDataObject::FIELD_ASSOCIATION_CELLS, vtkDataObject::FIELD_ASSOCIATION_POINTS })
    {
      // Signs as other sources of axes leave them.
      vtkDataArray* const axes = bends->GetPolyDataOutput()->GetAttributes(association)->GetArray(name);
      for (vtkIdType element = 0; element < axes->GetNumberOfTuples(); element += 3)
      {
        const Vector3 flipped = -Vector3(axes->GetTuple3(element));
        axes->SetTuple(element, flipped.data());
      }
      vtkNew<vtkFieldSingularities> singularities;
      singularities->SetInputData(bends->GetPolyDataOutput());
      singularities->SetInputArrayToProcess(0, 0, 0, association, name);
      singularities->Update();
      EXPECT_EQ(singularities->GetOutput()->GetNumberOfPoints(), 0) << name;
      singularities->SetNumberOfDirections(1);
      singularities->Update();
      EXPECT_GT(singularities->GetOutput()->GetNumberOfPoints(), 10) << name;
    }
  }
}

TEST(PrincipalDirectionsFilter, LooksFartherAtALargerScale)
{
  // Thin triangles of noise on a plane: the larger the scale, the flatter it comes out.
  Surface plane = IrregularPlane(40, 40, 3);
  for (int i = 0; i < plane.V.rows(); ++i)
  {
    plane.V(i, 2) = 0.1 * std::sin(37.0 * i);
  }
  vtkNew<vtkPrincipalDirections> filter;
  filter->SetInputData(PolyDataOf(plane));
  double former = 1e9;
  for (const double scale : { 0.0, 2.0, 4.0, 8.0 })
  {
    filter->SetScale(scale);
    filter->Update();
    double sum = 0.0;
    for (const double curvature : Values(filter->GetOutput()->GetPointData(), "MaximumCurvature"))
    {
      sum += std::abs(curvature);
    }
    EXPECT_LT(sum, 0.6 * former);
    former = sum;
  }
}

TEST(PrincipalDirectionsFilter, LeavesNothingOfARunThatFails)
{
  vtkNew<vtkPrincipalDirections> filter;
  filter->SetInputData(vtkSmartPointer<vtkPolyData>::New());
  Messages messages(filter);
  filter->Update();
  EXPECT_TRUE(messages.Silent());
  EXPECT_EQ(filter->GetOutput()->GetNumberOfPoints(), 0);

  filter->SetInputData(PolyDataOf(MoebiusStrip(12)));
  filter->StrictOn();
  filter->Update();
  EXPECT_FALSE(messages.Error().empty());
  EXPECT_EQ(filter->GetOutput()->GetNumberOfPoints(), 0);
  messages.Forget();
  filter->StrictOff();
  filter->Update();
  EXPECT_TRUE(messages.Error().empty());
  EXPECT_EQ(filter->GetOutput()->GetNumberOfCells(), 24);
}

}
