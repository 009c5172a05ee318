#include "Quads/Isolines/IndexedQuads.h"

#include "Support/DisjointSets.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace dmg
{

namespace
{

using Quad = std::array<int, 4>;

bool HasVertexTwice(Quad quad)
{
  std::sort(quad.begin(), quad.end());
  return std::adjacent_find(quad.begin(), quad.end()) != quad.end();
}

class Cleaner
{
public:
  Cleaner(IndexedQuads& quads, const std::vector<int>& ranks)
    : Quads(quads)
    , Ranks(ranks)
    , IsAlive(quads.Size(), 1)
    , Around(quads.NumberOfVertices())
    , Queue(quads.NumberOfVertices())
  {
    for (int q = 0; q < quads.Size(); ++q)
    {
      for (const int vertex : quads.Corners[q])
      {
        this->Around[vertex].push_back(q);
      }
    }
    std::iota(this->Queue.begin(), this->Queue.end(), 0);
  }

  void Run()
  {
    while (!this->Queue.empty())
    {
      const int vertex = this->Queue.back();
      this->Queue.pop_back();
      if (this->CloseBook(vertex) || this->JoinDoublet(vertex))
      {
        this->Queue.push_back(vertex);
      }
    }
    this->KeepAlive();
  }

private:
  bool IsInner(int vertex, std::size_t valence) const
  {
    return !this->Quads.IsOnBoundary[vertex] && this->Around[vertex].size() == valence;
  }

  void Remove(int q)
  {
    this->IsAlive[q] = 0;
    for (const int vertex : this->Quads.Corners[q])
    {
      std::vector<int>& around = this->Around[vertex];
      if (const auto place = std::find(around.begin(), around.end(), q); place != around.end())
      {
        around.erase(place);
      }
      this->Queue.push_back(vertex);
    }
  }

  /// Closes a quad around a vertex that has some vertex at two opposite corners: the other two become one. Where one of these has no
  /// other quad, it goes with the quad.
  bool CloseBook(int vertex)
  {
    for (const int q : this->Around[vertex])
    {
      const Quad quad = this->Quads.Corners[q];
      const int spine = quad[0] == quad[2] ? 0 : quad[1] == quad[3] ? 1 : -1;
      if (spine < 0 || quad[spine + 1] == quad[(spine + 3) % 4])
      {
        continue;
      }
      const int a = quad[spine + 1], b = quad[(spine + 3) % 4];
      if (this->IsInner(a, 1) || this->IsInner(b, 1))
      {
        this->Remove(q);
        return true;
      }
      if (!this->Quads.IsOnBoundary[a] || !this->Quads.IsOnBoundary[b])
      {
        this->Remove(q);
        this->IsHigher(b, a) ? this->Merge(b, a) : this->Merge(a, b);
        return true;
      }
    }
    return false;
  }

  bool IsHigher(int a, int b) const
  {
    return std::make_pair(this->Quads.IsOnBoundary[a], this->Ranks[a]) >
      std::make_pair(this->Quads.IsOnBoundary[b], this->Ranks[b]);
  }

  void Merge(int kept, int lost)
  {
    for (const int q : this->Around[lost])
    {
      Quad& quad = this->Quads.Corners[q];
      std::replace(quad.begin(), quad.end(), lost, kept);
      this->Around[kept].push_back(q);
      this->Queue.insert(this->Queue.end(), quad.begin(), quad.end());
    }
    this->Around[lost].clear();
  }

  /// Joins the two quads around a vertex that has no others.
  bool JoinDoublet(int vertex)
  {
    if (!this->IsInner(vertex, 2) || this->Around[vertex][0] == this->Around[vertex][1])
    {
      return false;
    }
    const int q = this->Around[vertex][0], r = this->Around[vertex][1];
    const Quad first = this->FromVertex(q, vertex), second = this->FromVertex(r, vertex);
    if (second[1] != first[3] || second[3] != first[1])
    {
      return false;
    }
    this->Remove(q);
    this->Remove(r);
    this->IsAlive[q] = 1;
    this->Quads.Corners[q] = { first[1], first[2], first[3], second[2] };
    for (const int corner : this->Quads.Corners[q])
    {
      this->Around[corner].push_back(q);
    }
    return true;
  }

  Quad FromVertex(int q, int vertex) const
  {
    Quad quad = this->Quads.Corners[q];
    std::rotate(quad.begin(), std::find(quad.begin(), quad.end(), vertex), quad.end());
    return quad;
  }

  void KeepAlive()
  {
    int size = 0;
    for (int q = 0; q < this->Quads.Size(); ++q)
    {
      if (this->IsAlive[q])
      {
        this->Quads.Corners[size] = this->Quads.Corners[q];
        this->Quads.Faces[size++] = this->Quads.Faces[q];
      }
    }
    this->Quads.Corners.resize(size);
    this->Quads.Faces.resize(size);
  }

  IndexedQuads& Quads;
  const std::vector<int>& Ranks;
  std::vector<char> IsAlive;
  std::vector<std::vector<int>> Around; ///< by vertex: its quads, once per corner
  std::vector<int> Queue;               ///< vertices to look at
};

}

IndexedQuads QuadsOfCells(const IsolineArrangement& isolines, const IsolineCells& cells)
{
  IndexedQuads quads;
  quads.IsOnBoundary = cells.IsOnBoundary;
  quads.Corners.assign(cells.OfDarts.begin(), cells.OfDarts.begin() + isolines.NumberOfCrossings);
  for (int node = 0; node < isolines.NumberOfCrossings; ++node)
  {
    quads.Faces.push_back(isolines.Nodes[node].Face);
  }
  return quads;
}

namespace
{

int TailOf(const IndexedQuads& quads, int side)
{
  return quads.Corners[side / 4][side % 4];
}

int HeadOf(const IndexedQuads& quads, int side)
{
  return quads.Corners[side / 4][(side + 1) % 4];
}

/// The number of fans of quads around each vertex: from side to side around it, of open ones from the boundary on.
std::vector<int> FansAround(const IndexedQuads& quads, const std::vector<int>& twins)
{
  std::vector<int> fans(quads.NumberOfVertices(), 0);
  std::vector<char> isVisited(twins.size(), 0);
  const auto visitFan = [&](int first)
  {
    for (int side = first; side >= 0 && !isVisited[side];)
    {
      isVisited[side] = 1;
      side = twins[side - side % 4 + (side + 3) % 4];
    }
    ++fans[TailOf(quads, first)];
  };
  for (const bool fromBoundary : { true, false })
  {
    for (int side = 0; side < 4 * quads.Size(); ++side)
    {
      if (!isVisited[side] && (!fromBoundary || twins[side] < 0))
      {
        visitFan(side);
      }
    }
  }
  return fans;
}

}

QuadTopology::QuadTopology(const IndexedQuads& quads)
  : Twins(4 * quads.Size(), -1)
  , Valences(quads.NumberOfVertices(), 0)
{
  for (int q = 0; q < quads.Size(); ++q)
  {
    for (const int vertex : quads.Corners[q])
    {
      ++this->Valences[vertex];
    }
    if (HasVertexTwice(quads.Corners[q]))
    {
      this->TwiceInQuad.push_back(q);
    }
  }
  this->PairSides(quads);
  this->Fans = FansAround(quads, this->Twins);
}

void QuadTopology::PairSides(const IndexedQuads& quads)
{
  std::vector<std::array<int, 3>> sides; // by the vertices of their edges
  for (int side = 0; side < 4 * quads.Size(); ++side)
  {
    const int tail = TailOf(quads, side), head = HeadOf(quads, side);
    sides.push_back({ std::min(tail, head), std::max(tail, head), side });
  }
  std::sort(sides.begin(), sides.end());
  for (std::size_t first = 0, last = 0; first < sides.size(); first = last)
  {
    std::array<int, 2> seen{ -1, -1 }; // one side in each direction
    for (; last < sides.size() && sides[last][0] == sides[first][0] && sides[last][1] == sides[first][1]; ++last)
    {
      const int side = sides[last][2], tail = TailOf(quads, side), head = HeadOf(quads, side);
      int& same = seen[tail < head ? 0 : 1];
      if (same >= 0 || tail == head)
      {
        this->Repeated.push_back(side);
      }
      same = side;
    }
    ++this->NumberOfEdges;
    if (seen[0] >= 0 && seen[1] >= 0)
    {
      this->Twins[seen[0]] = seen[1];
      this->Twins[seen[1]] = seen[0];
    }
  }
}

void CleanUp(IndexedQuads& quads, const std::vector<int>& ranks)
{
  Cleaner(quads, ranks).Run();
}

namespace
{

/// Keeps the quads for which isKept is true.
template <class IsKept>
void Keep(IndexedQuads& quads, const IsKept& isKept)
{
  IndexedQuads kept;
  kept.IsOnBoundary = quads.IsOnBoundary;
  for (int q = 0; q < quads.Size(); ++q)
  {
    if (isKept(q))
    {
      kept.Corners.push_back(quads.Corners[q]);
      kept.Faces.push_back(quads.Faces[q]);
    }
  }
  quads = std::move(kept);
}

/// Keeps of each component the most quads that are joined by sides.
void KeepLargestSets(const std::vector<int>& components, IndexedQuads& quads)
{
  const QuadTopology topology(quads);
  DisjointSets sets(quads.Size());
  for (int side = 0; side < 4 * quads.Size(); ++side)
  {
    if (topology.Twins[side] >= 0)
    {
      sets.Unite(side / 4, topology.Twins[side] / 4);
    }
  }
  std::vector<int> sizes(quads.Size(), 0);
  std::vector<int> largest(1 + *std::max_element(components.begin(), components.end()), -1); // set of each component
  for (int q = 0; q < quads.Size(); ++q)
  {
    const int set = sets.Smallest(q);
    int& best = largest[components[quads.Faces[q]]];
    ++sizes[set];
    best = best < 0 || sizes[set] > sizes[best] ? set : best;
  }
  Keep(quads, [&](int q) { return sets.Smallest(q) == largest[components[quads.Faces[q]]]; });
}

/// Drops the quads around vertices of several fans but those of the largest fan there.
void DropAtPinches(IndexedQuads& quads)
{
  const QuadTopology topology(quads);
  DisjointSets fans(4 * quads.Size()); // corners that follow each other around their vertex
  for (int side = 0; side < 4 * quads.Size(); ++side)
  {
    if (const int twin = topology.Twins[side]; twin >= 0)
    {
      fans.Unite(side, twin - twin % 4 + (twin + 1) % 4);
    }
  }
  std::vector<int> sizes(4 * quads.Size(), 0), largest(quads.NumberOfVertices(), -1);
  for (int corner = 0; corner < 4 * quads.Size(); ++corner)
  {
    const int fan = fans.Smallest(corner);
    int& best = largest[quads.Corners[corner / 4][corner % 4]];
    ++sizes[fan];
    best = best < 0 || sizes[fan] > sizes[best] ? fan : best;
  }
  const auto isInLargest = [&](int corner)
  { return fans.Smallest(corner) == largest[quads.Corners[corner / 4][corner % 4]]; };
  Keep(quads,
    [&](int q)
    { return isInLargest(4 * q) && isInLargest(4 * q + 1) && isInLargest(4 * q + 2) && isInLargest(4 * q + 3); });
}

}

void DropLooseQuads(const std::vector<int>& components, IndexedQuads& quads)
{
  for (int former = -1; former != quads.Size();)
  {
    former = quads.Size();
    KeepLargestSets(components, quads);
    DropAtPinches(quads);
  }
  const QuadTopology topology(quads);
  for (int side = 0; side < 4 * quads.Size(); ++side)
  {
    if (topology.Twins[side] < 0)
    {
      const auto& corners = quads.Corners[side / 4];
      quads.IsOnBoundary[corners[side % 4]] = quads.IsOnBoundary[corners[(side + 1) % 4]] = 1;
    }
  }
}

}
