#ifndef dmgEdgeCollapse_h
#define dmgEdgeCollapse_h

#include "StructurePreserving/Decimation/CollapseRecord.h"
#include "StructurePreserving/Decimation/CollapsibleMesh.h"
#include "StructurePreserving/Decimation/JointFlattening.h"
#include "StructurePreserving/Decimation/SurfaceTracking.h"

#include <optional>

namespace dmg
{

/// Limits of the change that a collapse may make to the shape of the mesh.
struct CollapseLimits
{
  int MaximumValence;        ///< of the vertex that it makes
  double LeastNormalCosine;  ///< between the normals of a face before and after; -2: any turn
  bool KeepShape;            ///< no new thin triangles
  bool MayFlattenIntoCircle; ///< where the conformal flattening folds

  /// The limits of three steps, from strict ones to the topology alone, for surfaces that cannot be decimated otherwise.
  static constexpr int NumberOfSteps = 3;
  static CollapseLimits Step(int step)
  {
    switch (step)
    {
      case 0:
        return { 12, 0.2, true, false };
      case 1:
        return { 24, 0.0, false, true };
      default:
        return { 60, -2.0, false, true };
    }
  }
};

/// One edge collapse from check to result, with the fine mesh tracked. Serves one thread.
class EdgeCollapse
{
public:
  EdgeCollapse(CollapsibleMesh& mesh, SurfaceTracking& tracking)
    : Mesh(mesh)
    , Tracking(tracking)
    , Worker(tracking.TakeWorker())
  {
  }
  ~EdgeCollapse() { this->Tracking.GiveBack(std::move(this->Worker)); }
  EdgeCollapse(const EdgeCollapse&) = delete;
  EdgeCollapse& operator=(const EdgeCollapse&) = delete;

  /// Collapses the edge, or leaves everything as it is where the limits, the topology or the
  /// flattening forbid it, or where a face would have all corners in one place.
  /// CollapsibleMesh::FinishCollapse must follow.
  std::optional<CollapsibleMesh::Afterwork> Try(int halfedge, const CollapseLimits& limits);

  /// The ring of the last collapse.
  const OneRing& Ring() const { return this->LastRing; }
  CollapseRecord Record() const { return { this->LastRing, this->Flattening.Plane() }; }

private:
  bool MakesAPoint() const;
  bool KeepsShape(const CollapseLimits& limits) const;

  CollapsibleMesh& Mesh;
  SurfaceTracking& Tracking;
  std::unique_ptr<SurfaceTracking::Worker> Worker;
  OneRing LastRing;
  JointFlattening Flattening;
};

}

#endif
