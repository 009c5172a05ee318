#include "Setup/FactorChoice.h"

#include "Support/MeshFactory.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

using namespace dmg;
using namespace dmg::test;

namespace
{

/// A strip with so many thin columns of a hundred, whose faces have a quality of 0.017.
TriangleMesh StripWithThinTriangles(int thin)
{
  std::vector<double> widths(100, 1.0);
  std::fill_n(widths.begin() + 20, thin, 0.01);
  return Strip(widths).Mesh();
}

}

TEST(FactorChoice, ManyThinTrianglesAreForAFactor)
{
  for (const bool hasHarmonicFields : { false, true })
  {
    const CycleObstacles few = ObstaclesOf(StripWithThinTriangles(2), hasHarmonicFields, SerialContext());
    EXPECT_DOUBLE_EQ(few.ShareOfThinTriangles, 0.02);
    EXPECT_EQ(few.Loops, 0);
    EXPECT_EQ(WhyFactorIsBetter(few), "");
    EXPECT_EQ(WhyFactorIsBetter(few), "");
    const CycleObstacles many = ObstaclesOf(StripWithThinTriangles(25), hasHarmonicFields, SerialContext());
    EXPECT_DOUBLE_EQ(many.ShareOfThinTriangles, 0.25);
    EXPECT_NE(WhyFactorIsBetter(many), "");
    EXPECT_EQ(WhyFactorIsBetter(many), ", chosen because 25 % of the triangles are thin (more than 3 %)");
  }
}

TEST(FactorChoice, ManyLoopsAreForAFactorWhereTheyHaveHarmonicFields)
{
  // Two loops for each hole through the slab.
  const TriangleMesh few = PerforatedSlab(4, 5, 2).Mesh();
  EXPECT_EQ(ObstaclesOf(few, true, SerialContext()).Loops, 40);
  EXPECT_EQ(WhyFactorIsBetter(ObstaclesOf(few, true, SerialContext())), "");
  const TriangleMesh many = PerforatedSlab(3, 7, 2).Mesh();
  EXPECT_NE(WhyFactorIsBetter(ObstaclesOf(many, true, SerialContext())), "");
  EXPECT_EQ(WhyFactorIsBetter(ObstaclesOf(many, true, SerialContext())),
    ", chosen because the surface has 42 loops around handles and holes, each with a harmonic field (more than 40)");
  EXPECT_EQ(ObstaclesOf(many, false, SerialContext()).Loops, 0);
  EXPECT_EQ(WhyFactorIsBetter(ObstaclesOf(many, false, SerialContext())), "");
}
