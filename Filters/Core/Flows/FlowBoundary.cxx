#include "Flows/FlowBoundary.h"

#include <algorithm>
#include <cstddef>
#include <tuple>

namespace dmg
{
namespace
{

/// Cuts a loop where closed edges and open ones meet.
class PartsOfLoop
{
public:
  PartsOfLoop(const TriangleMesh& mesh, const BoundaryLoop& loop, const std::vector<char>& isOpen)
    : Mesh(mesh)
    , Loop(loop)
    , IsOpen(isOpen)
    , Size(loop.Vertices.size())
  {
  }

  void AddTo(std::vector<BoundaryPart>& parts) const
  {
    std::size_t start = 0; // of an arc
    while (start < this->Size && this->IsOpenAfter(start) == this->IsOpenAfter(start + this->Size - 1))
    {
      ++start;
    }
    if (start == this->Size)
    {
      parts.push_back({ this->Loop, this->IsOpenAfter(0), true });
      return;
    }
    for (std::size_t from = start; from < start + this->Size;)
    {
      parts.push_back(this->ArcFrom(from));
      from += parts.back().Vertices.size() - 1;
    }
  }

private:
  int Vertex(std::size_t place) const { return this->Loop.Vertices[place % this->Size]; }
  /// Whether the edge from this place of the loop to the next is open.
  bool IsOpenAfter(std::size_t place) const
  {
    return this->IsOpen[this->Mesh.EdgeOf(this->Mesh.OutgoingHalfedge(this->Vertex(place)))] != 0;
  }

  BoundaryPart ArcFrom(std::size_t from) const
  {
    BoundaryPart arc;
    arc.Component = this->Loop.Component;
    arc.IsOpen = this->IsOpenAfter(from);
    arc.IsLoop = false;
    arc.Vertices.push_back(this->Vertex(from));
    for (std::size_t place = from; this->IsOpenAfter(place) == arc.IsOpen; ++place)
    {
      arc.Vertices.push_back(this->Vertex(place + 1));
      arc.Length += (this->Mesh.Position(this->Vertex(place + 1)) - this->Mesh.Position(this->Vertex(place))).norm();
    }
    return arc;
  }

  const TriangleMesh& Mesh;
  const BoundaryLoop& Loop;
  const std::vector<char>& IsOpen;
  const std::size_t Size;
};

}

std::vector<int> BoundaryPart::OwnVertices() const
{
  return this->IsLoop ? this->Vertices : std::vector<int>(this->Vertices.begin() + 1, this->Vertices.end() - 1);
}

std::vector<char> OpenEdges(const TriangleMesh& mesh, FlowBoundary boundary)
{
  return std::vector<char>(mesh.NumberOfEdges(), boundary == FlowBoundary::Open ? 1 : 0);
}

std::vector<BoundaryPart> PartsOfBoundary(const TriangleMesh& mesh, const std::vector<char>& isOpen)
{
  std::vector<BoundaryPart> parts;
  for (const BoundaryLoop& loop : FindBoundaryLoops(mesh))
  {
    PartsOfLoop(mesh, loop, isOpen).AddTo(parts);
  }
  std::stable_sort(parts.begin(), parts.end(),
    [](const BoundaryPart& a, const BoundaryPart& b)
    { return std::make_tuple(a.Component, -a.Length) < std::make_tuple(b.Component, -b.Length); });
  return parts;
}

std::vector<int> VerticesOfParts(const std::vector<BoundaryPart>& parts, bool areOpen)
{
  std::vector<int> vertices;
  for (const BoundaryPart& part : parts)
  {
    if (part.IsOpen == areOpen)
    {
      vertices.insert(vertices.end(), part.Vertices.begin(), part.Vertices.end());
    }
  }
  std::sort(vertices.begin(), vertices.end());
  vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
  return vertices;
}

}
