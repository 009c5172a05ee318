#ifndef dmgTestLevels_h
#define dmgTestLevels_h

#include "Hierarchy/MeshHierarchy.h"

namespace dmg::test
{

/// Calls visit(transition) for each step from a level of a surface to the next coarser one.
/// \return the coarse levels.
template <class Visit>
std::vector<TriangleMesh> VisitLevels(const TriangleMesh& mesh, const HierarchyOptions& options,
  Visit visit, const ExecutionContext& context = SerialContext())
{
  return BuildMeshHierarchy(mesh, options, context,
    [&visit](const LevelTransition& transition, const ExecutionContext&) { visit(transition); });
}

}

#endif
