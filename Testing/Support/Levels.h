#ifndef dmgTestLevels_h
#define dmgTestLevels_h

#include "StructurePreserving/Decimation/MeshHierarchy.h"
#include "Support/NamedSurfaces.h"

#include <gtest/gtest.h>

namespace dmg::test
{

/// Calls visit(transition) for each step from a level of a surface to the next coarser one.
/// \return the coarse levels.
template <class Visit>
std::vector<TriangleMesh> VisitLevels(const TriangleMesh& mesh, const HierarchyOptions& options, Visit visit,
  const ExecutionContext& context = SerialContext())
{
  return BuildMeshHierarchy(mesh, options, context,
    [&visit](const LevelTransition& transition, const ExecutionContext&) { visit(transition); });
}

/// The same for several surfaces and both policies; expects two coarse levels at least of each.
template <class Visit>
void VisitLevels(const std::vector<NamedSurface>& surfaces, HierarchyOptions options, Visit visit)
{
  for (CollapsePolicy policy : { CollapsePolicy::IndependentRounds, CollapsePolicy::SequentialQueue })
  {
    options.Policy = policy;
    for (const NamedSurface& surface : surfaces)
    {
      SCOPED_TRACE(surface.Name);
      EXPECT_GE(VisitLevels(surface.Shape.Mesh(), options, visit).size(), 2u);
    }
  }
}

}

#endif
