#include "StructurePreserving/Decimation/CollapseRounds.h"

#include "StructurePreserving/Decimation/EdgeCollapse.h"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <limits>
#include <numeric>
#include <utility>

namespace dmg
{

namespace
{

// The share of the collapsible edges that a round looks at. A smaller one keeps closer to the order of
// cost and takes more rounds.
constexpr double CandidateShare = 0.6;

// Rounds that collapse less than this part of what is left to do call for looser limits.
constexpr double LeastProgress = 0.01;

constexpr int FacesPerBlock = 4096;
constexpr int CollapsesPerCheckpoint = 8192;
constexpr int CollapsesPerPiece = 64;

/// Exponent and first two bits of a positive float: ordered like the floats, to a quarter. Edges of
/// one key are taken in the order of memory, which is worth more than their order of cost.
int CostKey(double cost)
{
  const float value = static_cast<float>(cost);
  std::uint32_t bits;
  std::memcpy(&bits, &value, sizeof bits);
  return static_cast<int>(bits >> 21);
}
constexpr int NumberOfKeys = 1 << 10;

class Rounds
{
public:
  Rounds(CollapsibleMesh& mesh, SurfaceTracking& tracking, int targetFaces, std::vector<CollapseRecord>* records,
    const ExecutionContext& context)
    : Mesh(mesh)
    , Tracking(tracking)
    , TargetFaces(targetFaces)
    , Records(records)
    , Context(context)
    , Keys(mesh.NumberOfHalfedgeSlots())
    , Counts((mesh.NumberOfFaceSlots() + FacesPerBlock - 1) / FacesPerBlock)
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
        (this->Mesh.Position(this->Mesh.Head(h)) - this->Mesh.Position(this->Mesh.Tail(h))).squaredNorm();
      sum += squared * squared;
    }
    return sum > 0.0 ? sum / this->Mesh.NumberOfHalfedgeSlots() : 1.0;
  }

  // The key of each edge stands at one of its halfedges; NumberOfKeys elsewhere.
  void ComputeKeys()
  {
    this->ForBlocks(
      [this](std::vector<int>& counts, int firstHalfedge, int lastHalfedge)
      {
        counts.assign(NumberOfKeys + 1, 0);
        for (int h = firstHalfedge; h < lastHalfedge; ++h)
        {
          this->Keys[h] = static_cast<std::uint16_t>(this->KeyOf(h));
          ++counts[this->Keys[h]];
        }
      });
  }

  int KeyOf(int halfedge) const
  {
    const int twin = this->Mesh.Twin(halfedge);
    if (!this->Mesh.IsLive(TriangleMesh::FaceOf(halfedge)) || (twin >= 0 && twin < halfedge) ||
      this->WasRejected(halfedge))
    {
      return NumberOfKeys;
    }
    const double cost = this->Mesh.CollapseCost(halfedge);
    return cost < std::numeric_limits<double>::infinity() ? std::min(CostKey(cost * this->CostScale), NumberOfKeys - 1)
                                                          : NumberOfKeys;
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
    return this->ChangedIn[halfedge / 3] <= rejected && (twin < 0 || this->ChangedIn[twin / 3] <= rejected);
  }

  // Counting sort; among equal keys the order of halfedges decides.
  void SortCandidates()
  {
    int edges = 0;
    for (const std::vector<int>& counts : this->Counts)
    {
      edges = std::accumulate(counts.begin(), counts.end() - 1, edges);
    }
    // Counts become places.
    const int wanted = static_cast<int>(CandidateShare * edges) + 1;
    int keyLimit = 0;
    int place = 0;
    for (; keyLimit < NumberOfKeys && place < wanted; ++keyLimit)
    {
      for (std::vector<int>& counts : this->Counts)
      {
        place += std::exchange(counts[keyLimit], place);
      }
    }
    this->Candidates.resize(place);
    this->ForBlocks(
      [&](std::vector<int>& places, int firstHalfedge, int lastHalfedge)
      {
        for (int h = firstHalfedge; h < lastHalfedge; ++h)
        {
          if (this->Keys[h] < keyLimit)
          {
            this->Candidates[places[this->Keys[h]]++] = h;
          }
        }
      });
  }

  // Calls body(counts of the block, first halfedge, last halfedge) for fixed blocks of faces.
  template <class Body>
  void ForBlocks(Body body)
  {
    const int blocks = static_cast<int>(this->Counts.size());
    this->Context.ParallelFor(0, blocks, 1,
      [&](int first, int last)
      {
        for (int block = first; block < last; ++block)
        {
          const int end = std::min((block + 1) * FacesPerBlock, this->Mesh.NumberOfFaceSlots());
          body(this->Counts[block], 3 * block * FacesPerBlock, 3 * end);
        }
      });
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
        this->Mesh.VisitNeighbours(end, [this](int v) { this->BlockedIn[v] = this->Round; });
      }
    }
    // The order is that of memory, not that of cost.
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
      this->Context.ParallelFor(begin, end, CollapsesPerPiece,
        [&](int first, int last)
        {
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
  std::vector<std::uint16_t> Keys;      // per halfedge
  std::vector<std::vector<int>> Counts; // per block of faces and key
  std::vector<int> Candidates;          // halfedges, cheapest first
  std::vector<int> Selected;            // halfedges
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
