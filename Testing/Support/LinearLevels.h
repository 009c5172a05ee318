#ifndef dmgTestLinearLevels_h
#define dmgTestLinearLevels_h

#include "Levels/SampledLevels.h"
#include "StructurePreserving/SurfaceHierarchy.h"

namespace dmg::test
{

/// Both ways to make levels of a surface.
enum class LevelKind
{
  EdgeCollapses,
  Sampling
};

/// Linear operators alone.
inline ProlongationOperators LinearLevels(LevelKind kind, const TriangleMesh& mesh, const HierarchyOptions& decimation,
  double sampleDistance, const ExecutionContext& context)
{
  return kind == LevelKind::Sampling
    ? SampledLevels(mesh, sampleDistance, context)
    : BuildSurfaceHierarchy(mesh, decimation, context, { false, false, false }).Operators;
}

}

#endif
