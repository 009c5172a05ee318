#include "StructurePreserving/SurfaceHierarchy.h"

#include "Support/Errors.h"
#include "Support/Identities.h"
#include "Support/MeshFactory.h"
#include "Support/TbbContext.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

using namespace dmg;
using namespace dmg::test;

namespace
{

HierarchyOptions Deep()
{
  HierarchyOptions options;
  options.MinimumNumberOfFaces = 100;
  return options;
}

}

// The exact overlay takes the place of tracked paths, on every level and in the caller's numbering.
TEST(BuildSurfaceHierarchy, ExactOverlayKeepsTheSameStructure)
{
  const TriangleMesh mesh = IrregularTorus(24, 12, 4).Mesh();
  HierarchyOptions options = Deep();
  options.Construction = ProlongationConstruction::ExactOverlay;
  const SurfaceHierarchy hierarchy = BuildSurfaceHierarchy(mesh, options, SerialContext());
  const TriangleMesh* fine = &mesh;
  for (std::size_t level = 0; level < hierarchy.CoarseLevels.size(); ++level)
  {
    const TriangleMesh& coarse = hierarchy.CoarseLevels[level];
    EXPECT_LT(ExactnessResidual(*fine, coarse, hierarchy.Operators.S0[level], hierarchy.Operators.S1[level]), 1e-12);
    fine = &coarse;
  }
  EXPECT_GE(hierarchy.CoarseLevels.size(), 1u);
}

// Decimation and overlays of all levels share one way from 0 to 1, and either can be stopped.
TEST(BuildSurfaceHierarchy, ReportsProgressOnceAndStopsWhenAsked)
{
  const TriangleMesh mesh = IrregularTorus(24, 12, 4).Mesh();
  for (ProlongationConstruction construction :
    { ProlongationConstruction::TrackedPaths, ProlongationConstruction::ExactOverlay })
  {
    const bool isExact = construction == ProlongationConstruction::ExactOverlay;
    HierarchyOptions options = Deep();
    options.Construction = construction;
    TbbContext all(2);
    const SurfaceHierarchy hierarchy = BuildSurfaceHierarchy(mesh, options, all);
    const std::vector<double>& progress = all.Progress();
    EXPECT_TRUE(std::is_sorted(progress.begin(), progress.end()));
    EXPECT_EQ(progress.front(), 0.0);
    EXPECT_EQ(progress.back(), 1.0);
    if (isExact)
    {
      // A collapse takes away two faces, so the first level has 216 of 576: steps of 64 are thirds.
      ASSERT_EQ(hierarchy.CoarseLevels.front().NumberOfFaces(), 144);
      double longest = 0.0;
      for (std::size_t i = 1; i < progress.size(); ++i)
      {
        longest = std::max(longest, progress[i] - progress[i - 1]);
      }
      EXPECT_LT(longest, 64.0 / 216.0);
    }
    for (std::size_t count = 1; count <= progress.size(); count += isExact ? 7 : 1)
    {
      TbbContext context(2);
      context.CancelAfter(static_cast<int>(count));
      EXPECT_THROW(BuildSurfaceHierarchy(mesh, options, context), Cancelled);
      EXPECT_EQ(context.Progress().size(), count);
    }
  }
}
