#ifndef dmgSurfaceHierarchy_h
#define dmgSurfaceHierarchy_h

#include "Levels/HierarchyOptions.h"
#include "Levels/ProlongationOperators.h"
#include "Mesh/TriangleMesh.h"
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

/// Set-up. The only stage that decimates. Levels of samples have neither surfaces nor S0 nor any
/// structure-preserving operators: CoarseLevels and all operators but Nodal stay empty.
/// \throw InvalidInput an option is out of range, or the selection asks for operators that levels of
///   samples do not have.
/// \throw Cancelled
/// Checkpoints: several in each round of collapses, every 64 of them in exact overlays, or every
/// level of samples; fractions rise from 0 to 1 once.
SurfaceHierarchy BuildSurfaceHierarchy(const TriangleMesh& mesh, const HierarchyOptions& options,
  const ExecutionContext& context, const OperatorSelection& selection = OperatorSelection());

}

#endif
