#include "StructurePreserving/Decimation/MeshHierarchy.h"

#include "StructurePreserving/Decimation/CollapseQueue.h"
#include "StructurePreserving/Decimation/CollapseRounds.h"
#include "StructurePreserving/Decimation/CollapsibleMesh.h"
#include "Support/Errors.h"

#include <algorithm>
#include <cmath>

namespace dmg
{

namespace
{

// A level that keeps more of the faces than this is not worth its cost.
constexpr double LargestUsefulRatio = 0.7;

/// The share of the collapses in the progress of a level and its operators.
double ShareOfCollapses(ProlongationConstruction construction)
{
  return construction == ProlongationConstruction::ExactOverlay ? 0.02 : 0.8;
}

void CheckOptions(const HierarchyOptions& options)
{
  if (!(options.FaceRatio > 0.0 && options.FaceRatio < 1.0))
  {
    throw InvalidInput("the ratio of faces between two levels must lie between 0 and 1");
  }
  if (options.MaximumNumberOfCoarseLevels < 0)
  {
    throw InvalidInput("the number of coarse levels must not be negative");
  }
  if (options.MinimumNumberOfFaces < 4)
  {
    throw InvalidInput("the coarsest level must keep at least 4 faces");
  }
}

}

std::vector<TriangleMesh> BuildMeshHierarchy(const TriangleMesh& mesh, const HierarchyOptions& options,
  const ExecutionContext& context, const std::function<void(const LevelTransition&, const ExecutionContext&)>& onLevel)
{
  CheckOptions(options);
  std::vector<TriangleMesh> levels;
  levels.reserve(options.MaximumNumberOfCoarseLevels); // the loop holds references into it
  CollapsibleMesh shrinking(mesh, context);
  const TriangleMesh* fine = &mesh;
  double progress = 0.0;
  while (static_cast<int>(levels.size()) < options.MaximumNumberOfCoarseLevels)
  {
    const int faces = fine->NumberOfFaces();
    const int target = std::max(static_cast<int>(std::lround(options.FaceRatio * faces)), options.MinimumNumberOfFaces);
    if (target > LargestUsefulRatio * faces)
    {
      break;
    }
    // The work of a level is proportional to its faces.
    const double done = progress + (1.0 - progress) * (1.0 - options.FaceRatio);
    const double collapsed = progress + ShareOfCollapses(options.Construction) * (done - progress);
    const PartOfContext part(context, progress, collapsed);
    SurfaceTracking tracking(*fine);
    std::vector<CollapseRecord> collapses;
    std::vector<CollapseRecord>* const records =
      options.Construction == ProlongationConstruction::ExactOverlay ? &collapses : nullptr;
    if (options.Policy == CollapsePolicy::IndependentRounds)
    {
      CollapseInRounds(shrinking, tracking, target, records, part);
    }
    else
    {
      CollapseByQueue(shrinking, tracking, target, records, part);
    }
    if (shrinking.NumberOfLiveFaces() > LargestUsefulRatio * faces)
    {
      break; // the topology holds the rest
    }
    CollapsibleMesh::Compacted compacted = shrinking.Compact();
    levels.push_back(std::move(compacted.Mesh));
    onLevel({ *fine, levels.back(), tracking, compacted.VertexNumber, compacted.FaceNumber, records },
      PartOfContext(context, collapsed, done));
    context.Checkpoint(done);
    CollapsibleMesh next(levels.back(), context);
    next.InheritQuadrics(shrinking, compacted.VertexNumber);
    shrinking = std::move(next);
    fine = &levels.back();
    progress = done;
  }
  context.Checkpoint(1.0);
  return levels;
}

}
