#include "FactorChoice.h"

#include "Analysis/HarmonicForms.h"
#include "Mesh/TriangleQuality.h"

#include <cmath>

namespace dmg
{

CycleObstacles ObstaclesOf(const TriangleMesh& mesh, bool hasHarmonicFields, const ExecutionContext& context)
{
  return { ShareOfFacesBelow(NeedleQuality, mesh, context), hasHarmonicFields ? NumberOfLoops(mesh) : 0 };
}

bool IsFactorBetter(const CycleObstacles& obstacles)
{
  return obstacles.ShareOfNeedles > LargestShareOfNeedles || obstacles.Loops > LargestNumberOfLoops;
}

std::string WhyFactorIsBetter(const CycleObstacles& obstacles)
{
  if (obstacles.ShareOfNeedles > LargestShareOfNeedles)
  {
    return ", chosen because " + std::to_string(std::lround(100.0 * obstacles.ShareOfNeedles)) +
      " % of the triangles are needles (more than " + std::to_string(std::lround(100.0 * LargestShareOfNeedles)) +
      " %)";
  }
  if (obstacles.Loops > LargestNumberOfLoops)
  {
    return ", chosen because the surface has " + std::to_string(obstacles.Loops) +
      " loops, each with a harmonic field (more than " + std::to_string(LargestNumberOfLoops) + ")";
  }
  return "";
}

}
