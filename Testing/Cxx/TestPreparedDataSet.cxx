#include "TestTools.h"

#include "Adapters/Surface/PreparedDataSet.h"

#include "vtkPointData.h"
#include "vtkSphereSource.h"

#include <gtest/gtest.h>

namespace
{

vtkSmartPointer<vtkPolyData> Sphere(int resolution)
{
  vtkNew<vtkSphereSource> source;
  source->SetThetaResolution(resolution);
  source->SetPhiResolution(resolution);
  source->Update();
  return source->GetOutput();
}

std::shared_ptr<const dmg::PreparedDataSet> Prepared(vtkDataSet* surface, const dmg::PreparationOptions& options = {})
{
  return dmg::PrepareDataSet(surface, options, dmg::SerialContext());
}

TEST(PreparedDataSet, IsSharedByDatasetsOfEqualContent)
{
  const auto first = Prepared(Sphere(8));
  const auto again = Sphere(8);
  again->GetPointData()->RemoveArray("Normals");
  EXPECT_EQ(Prepared(again), first);
}

TEST(PreparedDataSet, IsAnotherForAnotherSurfaceOrOtherOptions)
{
  const auto sphere = Sphere(8);
  const auto held = Prepared(sphere);
  EXPECT_NE(Prepared(Sphere(9)), held);
  dmg::PreparationOptions options;
  options.JoinPoints = false;
  EXPECT_NE(Prepared(sphere, options), held);
  options = {};
  options.Order = dmg::Numbering::AsGiven;
  EXPECT_NE(Prepared(sphere, options), held);
}

TEST(PreparedDataSet, GoesWithTheLastWhoHoldsIt)
{
  std::weak_ptr<const dmg::PreparedDataSet> held = Prepared(Sphere(8));
  EXPECT_TRUE(held.expired());
}

}
