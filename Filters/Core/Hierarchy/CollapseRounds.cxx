#include "Hierarchy/CollapseRounds.h"

#include "Hierarchy/EdgeCollapse.h"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <limits>
#include <utility>

namespace dmg
{

namespace
{

// Of the collapsible edges, the share that a round looks at. Less keeps closer to the order of
// cost and takes more rounds.
constexpr double CandidateShare = 0.6;

// Rounds that collapse less than this part of what is left to do call for looser limits.
constexpr double LeastProgress = 0.01;

constexpr int Grain = 4096;
constexpr int CollapsesPerCheckpoint = 8192;
constexpr int CollapsesPerPiece = 64;

/// The first 16 bits of a positive float below its sign: ordered like the floats, to 1/256.
std::uint32_t CostKey(double cost)
{
  const float value = static_cast<float>(cost);
  std::uint32_t bits;
  std::memcpy(&bits, &value, sizeof bits);
  return bits >> 15;
}
constexpr std::uint32_t NumberOfKeys = 1u << 16;

class Rounds
{
public:
  Rounds(CollapsibleMesh& mesh, SurfaceTracking& tracking, int targetFaces,
    std::vector<CollapseRecord>* records, const ExecutionContext& context)
    : Mesh(mesh)
    , Tracking(tracking)
    , TargetFaces(targetFaces)
    , Records(records)
    , Context(context)
    , Keys(mesh.NumberOfHalfedgeSlots())
    , RejectedIn(mesh.NumberOfHalfedgeSlots(), -1)
    , ChangedIn(mesh.NumberOfFaceSlots(), 0)
    , BlockedIn(mesh.NumberOfVertexSlots(), -1)
  {
  }

  void Run()
  {
    const int start = this->Mesh.NumberOfLiveFaces();
    this->CostScale = 1.0 / this->MeanFourthPowerOfLength();
    int step = 0;
    for (this->Round = 0; this->Mesh.NumberOfLiveFaces() > this->TargetFaces; ++this->Round)
    {
      const int surplus = this->Mesh.NumberOfLiveFaces() - this->TargetFaces;
      this->Progress = 1.0 - static_cast<double>(surplus) / (start - this->TargetFaces);
      this->Context.Checkpoint(this->Progress);
      this->ComputeKeys();
      this->SortCandidates();
      this->SelectIndependent((surplus + 1) / 2);
      const int removed = this->CollapseSelected(CollapseLimits::Step(step));
      if (removed < LeastProgress * surplus)
      {
        if (removed == 0 && step + 1 == CollapseLimits::NumberOfSteps)
        {
          break;
        }
        step = std::min(step + 1, CollapseLimits::NumberOfSteps - 1);
        std::fill(this->RejectedIn.begin(), this->RejectedIn.end(), -1);
      }
    }
  }

private:
  // Costs are compared as floats, so they are brought near 1.
  double MeanFourthPowerOfLength() const
  {
    double sum = 0.0;
    for (int h = 0; h < this->Mesh.NumberOfHalfedgeSlots(); ++h)
    {
      const double squared =
        (this->Mesh.Position(this->Mesh.Head(h)) - this->Mesh.Position(this->Mesh.Tail(h)))
          .squaredNorm();
      sum += squared * squared;
    }
    return sum > 0.0 ? sum / this->Mesh.NumberOfHalfedgeSlots() : 1.0;
  }

  // The key of each edge stands at one of its halfedges; NumberOfKeys elsewhere.
  void ComputeKeys()
  {
    this->Context.ParallelFor(0, this->Mesh.NumberOfFaceSlots(), Grain, [this](int first, int last) {
      for (int f = first; f < last; ++f)
      {
        for (int h = 3 * f; h < 3 * f + 3; ++h)
        {
          this->Keys[h] = NumberOfKeys;
          const int twin = this->Mesh.Twin(h);
          if (!this->Mesh.IsLive(f) || (twin >= 0 && twin < h) || this->WasRejected(h))
          {
            continue;
          }
          const double cost = this->Mesh.CollapseCost(h);
          if (cost < std::numeric_limits<double>::infinity())
          {
            this->Keys[h] = std::min(CostKey(cost * this->CostScale), NumberOfKeys - 1);
          }
        }
      }
    });
  }

  // An edge that failed is tried again when a face beside it has changed.
  bool WasRejected(int halfedge) const
  {
    const int rejected = this->RejectedIn[halfedge];
    if (rejected < 0)
    {
      return false;
    }
    const int twin = this->Mesh.Twin(halfedge);
    return this->ChangedIn[halfedge / 3] <= rejected &&
      (twin < 0 || this->ChangedIn[twin / 3] <= rejected);
  }

  // Counting sort; among equal keys the order of halfedges decides.
  void SortCandidates()
  {
    std::vector<int>& start = this->KeyStart;
    start.assign(NumberOfKeys + 1, 0);
    int edges = 0;
    for (std::uint32_t key : this->Keys)
    {
      if (key < NumberOfKeys)
      {
        ++start[key + 1];
        ++edges;
      }
    }
    const int wanted = static_cast<int>(CandidateShare * edges) + 1;
    std::uint32_t keyLimit = 0;
    for (; keyLimit < NumberOfKeys && start[keyLimit] < wanted; ++keyLimit)
    {
      start[keyLimit + 1] += start[keyLimit];
    }
    this->Candidates.resize(start[keyLimit]);
    for (std::size_t h = 0; h < this->Keys.size(); ++h)
    {
      if (this->Keys[h] < keyLimit)
      {
        this->Candidates[start[this->Keys[h]]++] = static_cast<int>(h);
      }
    }
  }

  // Two one-rings share a face exactly if an end of one edge is an end of the other or adjacent to
  // one.
  void SelectIndependent(int limit)
  {
    this->Selected.clear();
    for (int h : this->Candidates)
    {
      const int i = this->Mesh.Tail(h);
      const int j = this->Mesh.Head(h);
      if (this->BlockedIn[i] == this->Round || this->BlockedIn[j] == this->Round)
      {
        continue;
      }
      this->Selected.push_back(h);
      if (static_cast<int>(this->Selected.size()) == limit)
      {
        break;
      }
      for (int end : { i, j })
      {
        this->Mesh.VisitOutgoing(end, [this](int g) {
          this->BlockedIn[this->Mesh.Head(g)] = this->Round;
          this->BlockedIn[this->Mesh.Tail(TriangleMesh::Previous(g))] = this->Round;
        });
      }
    }
    // In the order of memory, not of cost.
    std::sort(this->Selected.begin(), this->Selected.end());
  }

  int CollapseSelected(const CollapseLimits& limits)
  {
    const int count = static_cast<int>(this->Selected.size());
    this->Results.assign(count, {});
    std::vector<CollapseRecord> records(this->Records ? count : 0);
    for (int begin = 0; begin < count; begin += CollapsesPerCheckpoint)
    {
      const int end = std::min(count, begin + CollapsesPerCheckpoint);
      this->Context.ParallelFor(begin, end, CollapsesPerPiece, [&](int first, int last) {
        EdgeCollapse collapse(this->Mesh, this->Tracking);
        for (int i = first; i < last; ++i)
        {
          if (const auto result = collapse.Try(this->Selected[i], limits))
          {
            this->Results[i] = *result;
            if (this->Records)
            {
              records[i] = collapse.Record();
            }
            for (const OneRing::Sector& sector : collapse.Ring().Sectors)
            {
              this->ChangedIn[sector.Face] = this->Round;
            }
          }
        }
      });
      this->Context.Checkpoint(this->Progress);
    }
    int removed = 0;
    for (int i = 0; i < count; ++i)
    {
      if (this->Results[i].DeadFaces > 0)
      {
        this->Mesh.FinishCollapse(this->Results[i]);
        removed += this->Results[i].DeadFaces;
        if (this->Records)
        {
          this->Records->push_back(std::move(records[i]));
        }
      }
      else
      {
        this->RejectedIn[this->Selected[i]] = this->Round;
      }
    }
    return removed;
  }

  CollapsibleMesh& Mesh;
  SurfaceTracking& Tracking;
  const int TargetFaces;
  std::vector<CollapseRecord>* const Records;
  const ExecutionContext& Context;

  int Round = 0;
  double Progress = 0.0;
  double CostScale = 1.0;
  std::vector<std::uint32_t> Keys; // per halfedge
  std::vector<int> KeyStart;
  std::vector<int> Candidates; // halfedges, cheapest first
  std::vector<int> Selected;   // halfedges
  std::vector<CollapsibleMesh::Afterwork> Results;
  std::vector<int> RejectedIn; // per halfedge: round
  std::vector<int> ChangedIn;  // per face: round
  std::vector<int> BlockedIn;  // per vertex: round
};

}

void CollapseInRounds(CollapsibleMesh& mesh, SurfaceTracking& tracking, int targetFaces,
  std::vector<CollapseRecord>* records, const ExecutionContext& context)
{
  Rounds(mesh, tracking, targetFaces, records, context).Run();
}

}
