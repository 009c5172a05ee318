#include "StructurePreserving/Decimation/CollapseQueue.h"

#include "StructurePreserving/Decimation/EdgeCollapse.h"

#include <algorithm>
#include <functional>
#include <limits>
#include <queue>
#include <tuple>

namespace dmg
{

namespace
{

constexpr int CollapsesPerCheckpoint = 1024;

class Queue
{
public:
  Queue(CollapsibleMesh& mesh, SurfaceTracking& tracking, int targetFaces, std::vector<CollapseRecord>* records,
    const ExecutionContext& context)
    : Mesh(mesh)
    , Collapse(mesh, tracking)
    , TargetFaces(targetFaces)
    , Records(records)
    , Context(context)
    , Penalty(mesh.NumberOfHalfedgeSlots(), 0.0)
    , Version(mesh.NumberOfHalfedgeSlots(), 0)
  {
  }

  void Run()
  {
    const int start = this->Mesh.NumberOfLiveFaces();
    this->FindLargestCost();
    for (int step = 0; step < CollapseLimits::NumberOfSteps; ++step)
    {
      this->PushAll();
      int visited = 0;
      while (!this->Entries.empty() && this->Mesh.NumberOfLiveFaces() > this->TargetFaces)
      {
        if (visited++ % CollapsesPerCheckpoint == 0)
        {
          this->Context.Checkpoint(
            static_cast<double>(start - this->Mesh.NumberOfLiveFaces()) / (start - this->TargetFaces));
        }
        const auto [cost, halfedge, version] = this->Entries.top();
        this->Entries.pop();
        if (version == this->Version[halfedge] && this->Mesh.IsLive(halfedge / 3))
        {
          this->CollapseEdge(halfedge, CollapseLimits::Step(step));
        }
      }
    }
  }

private:
  using Entry = std::tuple<double, int, int>; // cost, halfedge, version

  bool StandsForItsEdge(int halfedge) const
  {
    return this->Mesh.Twin(halfedge) < 0 || halfedge < this->Mesh.Twin(halfedge);
  }

  void FindLargestCost()
  {
    for (int h = 0; h < this->Mesh.NumberOfHalfedgeSlots(); ++h)
    {
      const double cost = this->Mesh.CollapseCost(h);
      if (cost < std::numeric_limits<double>::infinity())
      {
        this->LargestCost = std::max(this->LargestCost, cost);
      }
    }
  }

  void PushAll()
  {
    for (int h = 0; h < this->Mesh.NumberOfHalfedgeSlots(); ++h)
    {
      if (this->Mesh.IsLive(h / 3) && this->StandsForItsEdge(h))
      {
        this->Push(h);
      }
    }
  }

  void Push(int halfedge)
  {
    const double cost = this->Mesh.CollapseCost(halfedge) + this->Penalty[halfedge];
    if (cost < std::numeric_limits<double>::infinity())
    {
      this->Entries.emplace(cost, halfedge, ++this->Version[halfedge]);
    }
  }

  void CollapseEdge(int halfedge, const CollapseLimits& limits)
  {
    const auto result = this->Collapse.Try(halfedge, limits);
    if (!result)
    {
      return;
    }
    this->Mesh.FinishCollapse(*result);
    if (this->Records)
    {
      this->Records->push_back(this->Collapse.Record());
    }
    const int hub = this->Collapse.Ring().Target;
    this->Mesh.VisitOutgoing(hub,
      [this](int leaving)
      {
        this->Delay(leaving);
        // The last edge of a fan with a gap has no halfedge that leaves the hub.
        const int returning = TriangleMesh::Previous(leaving);
        if (this->Mesh.Twin(returning) < 0)
        {
          this->Delay(returning);
        }
      });
  }

  void Delay(int halfedge)
  {
    const int twin = this->Mesh.Twin(halfedge);
    const double before = twin < 0 ? this->Penalty[halfedge] : std::max(this->Penalty[halfedge], this->Penalty[twin]);
    for (int h : { halfedge, twin })
    {
      if (h >= 0)
      {
        this->Penalty[h] = before + this->LargestCost;
        ++this->Version[h];
      }
    }
    this->Push(this->StandsForItsEdge(halfedge) ? halfedge : twin);
  }

  CollapsibleMesh& Mesh;
  EdgeCollapse Collapse;
  const int TargetFaces;
  std::vector<CollapseRecord>* const Records;
  const ExecutionContext& Context;

  double LargestCost = 0.0;
  std::vector<double> Penalty; // per halfedge, the same on both of an edge
  std::vector<int> Version;    // per halfedge; entries of older versions are void
  std::priority_queue<Entry, std::vector<Entry>, std::greater<Entry>> Entries;
};

}

void CollapseByQueue(CollapsibleMesh& mesh, SurfaceTracking& tracking, int targetFaces,
  std::vector<CollapseRecord>* records, const ExecutionContext& context)
{
  Queue(mesh, tracking, targetFaces, records, context).Run();
}

}
