#ifndef dmgSurfaceHierarchy_h
#define dmgSurfaceHierarchy_h

#include "Levels/ProlongationOperators.h"
#include "Mesh/TriangleMesh.h"
#include "StructurePreserving/Decimation/HierarchyOptions.h"
#include "Support/ExecutionContext.h"

#include <vector>

namespace dmg
{

/// A hierarchy of a mesh and the prolongations between its levels.
struct SurfaceHierarchy
{
  /// The levels above the finest, level 1 first.
  std::vector<TriangleMesh> CoarseLevels;
  ProlongationOperators Operators;
};

/// Decimates a surface, and makes the operators between its levels.
/// \throw InvalidInput an option is out of range.
/// \throw Cancelled
/// Checkpoints: several in each round of collapses, and every 64 collapses in exact overlays. Fractions rise from 0 to 1
/// once.
SurfaceHierarchy BuildSurfaceHierarchy(const TriangleMesh& mesh, const HierarchyOptions& options,
  const ExecutionContext& context, const OperatorSelection& selection = OperatorSelection());

}

#endif
