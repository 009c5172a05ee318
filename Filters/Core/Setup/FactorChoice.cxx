#include "Setup/FactorChoice.h"

#include "Analysis/HarmonicForms.h"
#include "Mesh/TriangleQuality.h"

#include <cmath>

namespace dmg
{

CycleObstacles ObstaclesOf(const TriangleMesh& mesh, bool hasHarmonicFields, const ExecutionContext& context)
{
  return { ShareOfFacesBelow(ThinTriangleQuality, mesh, context), hasHarmonicFields ? NumberOfGenerators(mesh) : 0 };
}

std::string WhyFactorIsBetter(const CycleObstacles& obstacles)
{
  if (obstacles.ShareOfThinTriangles > LargestShareOfThinTriangles)
  {
    return ", chosen because " + std::to_string(std::lround(100.0 * obstacles.ShareOfThinTriangles)) +
      " % of the triangles are thin (more than " + std::to_string(std::lround(100.0 * LargestShareOfThinTriangles)) +
      " %)";
  }
  if (obstacles.Loops > LargestNumberOfGenerators)
  {
    return ", chosen because the surface has " + std::to_string(obstacles.Loops) +
      " loops around handles and holes, each with a harmonic field (more than " +
      std::to_string(LargestNumberOfGenerators) + ")";
  }
  return "";
}

}
