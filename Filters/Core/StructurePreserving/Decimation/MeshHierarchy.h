#ifndef dmgMeshHierarchy_h
#define dmgMeshHierarchy_h

#include "Mesh/TriangleMesh.h"
#include "StructurePreserving/Decimation/CollapseRecord.h"
#include "StructurePreserving/Decimation/HierarchyOptions.h"
#include "StructurePreserving/Decimation/SurfaceTracking.h"
#include "Support/ExecutionContext.h"

#include <functional>
#include <vector>

namespace dmg
{

/// The place of a fine mesh on the next coarser one.
struct LevelTransition
{
  const TriangleMesh& Fine;
  const TriangleMesh& Coarse;
  const SurfaceTracking& Tracking;
  /// The number in Coarse of each slot that the tracking names, or -1.
  const std::vector<int>& CoarseVertex;
  const std::vector<int>& CoarseFace;
  /// The collapses from Fine to Coarse, oldest first, in slots as above. Null unless the options
  /// ask for ProlongationConstruction::ExactOverlay.
  const std::vector<CollapseRecord>* Collapses = nullptr;
};

/// Decimates a surface level by level. Level l + 1 has FaceRatio times the faces of level l, or
/// MinimumNumberOfFaces if that is more; there are no more levels where a level would keep over
/// 70 % of the faces. Thesis, section 5.4.
/// \param onLevel called with each new level, and with the part of the progress that its own work
///   has: most of it for exact overlays, little for tracked paths. The tracking is gone afterwards.
/// \return the levels above the finest.
/// \throw InvalidInput an option is out of range. \throw Cancelled
/// Cost: O(#F). Checkpoints: several in each round of collapses, and after onLevel; fractions rise
/// from 0 to 1 once.
std::vector<TriangleMesh> BuildMeshHierarchy(const TriangleMesh& mesh, const HierarchyOptions& options,
  const ExecutionContext& context, const std::function<void(const LevelTransition&, const ExecutionContext&)>& onLevel);

}

#endif
