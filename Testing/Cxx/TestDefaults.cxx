#include "Geodesics/DistanceSources.h"
#include "Geodesics/ParallelTransport.h"
#include "Preparation/PreparedSurface.h"
#include "PropertiesOfSolver.h"
#include "Scales/ScaleFilter.h"
#include "StructurePreserving/Decimation/HierarchyOptions.h"

#include "vtkDirectionalProlongation.h"
#include "vtkHarmonicFieldSolver.h"
#include "vtkNew.h"
#include "vtkParallelTransport.h"
#include "vtkPrincipalDirections.h"
#include "vtkScaleFilter.h"
#include "vtkSurfaceDistance.h"

#include <gtest/gtest.h>

using namespace dmg;

// Testing/ParaView/TestDefaults.py compares these with the panel's.

TEST(Defaults, OfTheSolverAreThoseOfTheCore)
{
  vtkNew<vtkHarmonicFieldSolver> filter;
  const FieldProblem problem = PropertiesOf(filter).Problem;
  const FieldProblem expected;
  EXPECT_TRUE(problem.Options == expected.Options);
  EXPECT_TRUE(problem.Stop == expected.Stop);
  EXPECT_EQ(problem.Features.BoundaryWeight, expected.Features.BoundaryWeight);
  EXPECT_EQ(problem.Features.BoundaryRotation, expected.Features.BoundaryRotation);
  EXPECT_EQ(problem.Features.SharpEdgesWeight, expected.Features.SharpEdgesWeight);
  EXPECT_EQ(problem.Features.SharpEdgesRotation, expected.Features.SharpEdgesRotation);
  EXPECT_EQ(problem.Features.FeatureAngle, expected.Features.FeatureAngle);
  EXPECT_EQ(problem.Features.CurvatureWeight, expected.Features.CurvatureWeight);
  EXPECT_EQ(problem.Features.CurvatureRotation, expected.Features.CurvatureRotation);
  EXPECT_EQ(problem.Features.CurvatureScale, expected.Features.CurvatureScale);
  EXPECT_EQ(problem.Features.FollowsMinimum, expected.Features.FollowsMinimum);
  EXPECT_EQ(problem.Combing, expected.Combing);
  EXPECT_EQ(problem.UnitLength, expected.UnitLength);
  EXPECT_EQ(problem.UnitLengthWhileSmoothing, expected.UnitLengthWhileSmoothing);
  EXPECT_EQ(problem.HarmonicBasis, expected.HarmonicBasis);
  EXPECT_EQ(problem.Guides.MaximumDistance, expected.Guides.MaximumDistance);
  EXPECT_EQ(problem.Rotation.Everywhere, expected.Rotation.Everywhere);
  EXPECT_EQ(filter->GetJoinPoints(), PreparationOptions().JoinPoints);
  EXPECT_EQ(filter->GetStrict(), PreparationOptions().Strict);
}

TEST(Defaults, OfOtherFiltersAreThoseOfTheCore)
{
  vtkNew<vtkDirectionalProlongation> prolongation;
  const HierarchyOptions expected;
  EXPECT_EQ(prolongation->GetFaceRatio(), expected.FaceRatio);
  EXPECT_EQ(prolongation->GetMaximumNumberOfCoarseLevels(), expected.MaximumNumberOfCoarseLevels);
  EXPECT_EQ(prolongation->GetMinimumNumberOfFaces(), expected.MinimumNumberOfFaces);
  EXPECT_EQ(prolongation->GetCollapsePolicy(), static_cast<int>(expected.Policy));
  EXPECT_EQ(prolongation->GetConstruction(), static_cast<int>(expected.Construction));
  EXPECT_EQ(prolongation->GetJoinPoints(), PreparationOptions().JoinPoints);
  EXPECT_EQ(prolongation->GetStrict(), PreparationOptions().Strict);
  EXPECT_EQ(vtkNew<vtkPrincipalDirections>()->GetScale(), FeatureOptions().CurvatureScale);
  EXPECT_EQ(vtkNew<vtkParallelTransport>()->GetTimeStep(), TransportOptions().TimeStep);
  EXPECT_EQ(vtkNew<vtkSurfaceDistance>()->GetMaximumSourceDistance(), DistanceOptions().MaximumSourceDistance);
  EXPECT_EQ(vtkNew<vtkSurfaceDistance>()->GetSigned(), DistanceOptions().Signed);
  vtkNew<vtkScaleFilter> scales;
  EXPECT_EQ(scales->GetOrder(), ScaleFilterOptions().Order);
  EXPECT_EQ(scales->GetLengthScale(), ScaleFilterOptions().LengthScale);
}
