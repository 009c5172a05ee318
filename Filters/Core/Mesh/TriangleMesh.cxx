#include "Mesh/TriangleMesh.h"

#include "Support/CountingSort.h"
#include "Support/Errors.h"
#include "Support/Remedy.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <atomic>
#include <numeric>
#include <unordered_map>
#include <utility>

namespace dmg
{

namespace
{

constexpr int Grain = 4096;

/// A halfedge under the larger vertex of its edge.
using Side = ItemOfPair;

/// All halfedges by edge, under its smaller vertex.
ItemsByPair SortedSides(int numberOfVertices, const Triangles& F, const ExecutionContext& context)
{
  const int* const tails = F.data();
  return SortByPair(
    3 * static_cast<int>(F.rows()), numberOfVertices,
    [tails](int h) -> std::pair<int, int> {
      return std::minmax({ tails[h], tails[TriangleMesh::Next(h)] });
    },
    context);
}

/// Calls visit(first, last) for the sides of each edge of smaller vertex v.
template <class Visit>
void VisitEdges(const ItemsByPair& sides, int v, const Visit& visit)
{
  const Side* const end = sides.Items.data() + sides.Begins[v + 1];
  for (const Side* first = sides.Items.data() + sides.Begins[v]; first != end;)
  {
    const Side* last = first + 1;
    while (last != end && last->Second == first->Second)
    {
      ++last;
    }
    visit(first, last);
    first = last;
  }
}

/// One face or two that run along the edge in opposite directions.
bool IsManifold(const Triangles& F, const Side* first, const Side* last)
{
  return last - first == 1 || (last - first == 2 && F.data()[first[0].Item] != F.data()[first[1].Item]);
}

/// \param first, last the halfedges of one edge, more than one may take.
[[noreturn]] void RefuseEdge(
  const Triangles& F, const ElementNames& names, const Side* first, const Side* last, int smaller)
{
  const std::string edge = "the edge between " + names.Vertex(smaller) + " and " + names.Vertex(first->Second);
  std::unordered_map<int, int> faces; // by the corner that is not on the edge
  for (const Side* side = first; side != last; ++side)
  {
    const int third = F.data()[TriangleMesh::Previous(side->Item)];
    const auto [found, isFirst] = faces.emplace(third, TriangleMesh::FaceOf(side->Item));
    if (!isFirst)
    {
      throw InvalidInput(names.Face(found->second) + " and " + names.Face(TriangleMesh::FaceOf(side->Item)) +
        " are the same triangle; " + TextOf(Remedy::DropTwin));
    }
  }
  const int f = TriangleMesh::FaceOf(first[0].Item);
  const int g = TriangleMesh::FaceOf(first[1].Item);
  if (last - first > 2)
  {
    throw InvalidInput(edge + " belongs to " + std::to_string(last - first) + " triangles, among them " +
      names.Face(f) + ", " + names.Face(g) + " and " + names.Face(TriangleMesh::FaceOf(first[2].Item)) +
      "; remove the surplus ones, or cut them apart with " + TextOf(Remedy::CutApart));
  }
  throw InvalidInput(names.Face(f) + " and " + names.Face(g) + " are oriented against each other along " + edge + "; " +
    TextOf(Remedy::Orient));
}

}

TriangleMesh::TriangleMesh(
  dmg::Points points, dmg::Triangles triangles, const ElementNames& names, const ExecutionContext& context)
  : V(std::move(points))
  , F(std::move(triangles))
{
  CheckElements(this->V, this->F, names);
  this->JoinFaces(names, context);
  this->StartFans(names, context);
}

void TriangleMesh::JoinFaces(const ElementNames& names, const ExecutionContext& context)
{
  const int numberOfVertices = this->NumberOfVertices();
  const int numberOfHalfedges = 3 * this->NumberOfFaces();
  const ItemsByPair sides = SortedSides(numberOfVertices, this->F, context);

  std::vector<int> edgeBegins(numberOfVertices + 1, 0);
  std::atomic<bool> isManifold{ true };
  context.ParallelFor(0, numberOfVertices, Grain,
    [&](int firstVertex, int lastVertex)
    {
      for (int v = firstVertex; v < lastVertex; ++v)
      {
        VisitEdges(sides, v,
          [&](const Side* first, const Side* last)
          {
            ++edgeBegins[v + 1];
            if (!IsManifold(this->F, first, last))
            {
              isManifold = false;
            }
          });
      }
    });
  for (int v = 0; v < numberOfVertices && !isManifold; ++v) // the first one is named
  {
    VisitEdges(sides, v,
      [&](const Side* first, const Side* last)
      {
        if (!IsManifold(this->F, first, last))
        {
          RefuseEdge(this->F, names, first, last, v);
        }
      });
  }
  std::partial_sum(edgeBegins.begin(), edgeBegins.end(), edgeBegins.begin());

  this->Twins.assign(numberOfHalfedges, -1);
  this->HalfedgeEdges.resize(numberOfHalfedges);
  this->EdgeHalfedges.resize(edgeBegins.back());
  context.ParallelFor(0, numberOfVertices, Grain,
    [&](int firstVertex, int lastVertex)
    {
      for (int v = firstVertex; v < lastVertex; ++v)
      {
        int edge = edgeBegins[v];
        VisitEdges(sides, v,
          [&](const Side* first, const Side* last)
          {
            const int a = first->Item;
            const int b = last[-1].Item;
            this->HalfedgeEdges[a] = this->HalfedgeEdges[b] = edge;
            this->EdgeHalfedges[edge++] = this->Tail(a) == v ? a : b;
            if (a != b)
            {
              this->Twins[a] = b;
              this->Twins[b] = a;
            }
          });
      }
    });
}

void TriangleMesh::StartFans(const ElementNames& names, const ExecutionContext& context)
{
  const int numberOfVertices = this->NumberOfVertices();
  const int numberOfHalfedges = 3 * this->NumberOfFaces();
  this->Outgoing.assign(numberOfVertices, -1);
  for (int h = 0; h < numberOfHalfedges; ++h)
  {
    int& outgoing = this->Outgoing[this->Tail(h)];
    if (outgoing < 0 || (this->Twins[h] < 0 && this->Twins[outgoing] >= 0))
    {
      outgoing = h;
    }
  }

  std::vector<int> sizes(numberOfVertices, 0);
  context.ParallelFor(0, numberOfVertices, Grain,
    [&](int first, int last)
    {
      for (int v = first; v < last; ++v)
      {
        this->VisitFan(v, [&](int) { ++sizes[v]; });
      }
    });
  if (std::accumulate(sizes.begin(), sizes.end(), 0) == numberOfHalfedges)
  {
    return;
  }
  for (int h = 0; h < numberOfHalfedges; ++h)
  {
    --sizes[this->Tail(h)];
  }
  const auto pinched = std::find_if(sizes.begin(), sizes.end(), [](int size) { return size < 0; });
  throw InvalidInput("the triangles around " + names.Vertex(static_cast<int>(pinched - sizes.begin())) +
    " form more than one fan, so the surface is pinched there; split the point with " + TextOf(Remedy::CutApart));
}

Vector3 TriangleMesh::FaceAreaVector(int face) const
{
  const int* corner = this->F.data() + 3 * face;
  const Vector3 p = this->Position(corner[0]);
  return (this->Position(corner[1]) - p).cross(this->Position(corner[2]) - p);
}

Vector<double> TriangleMesh::FaceAreas(const ExecutionContext& context) const
{
  Vector<double> areas(this->NumberOfFaces());
  context.ParallelFor(0, this->NumberOfFaces(), Grain,
    [this, &areas](int first, int last)
    {
      for (int f = first; f < last; ++f)
      {
        areas[f] = this->FaceArea(f);
      }
    });
  return areas;
}

std::vector<int> FaceComponents(const TriangleMesh& mesh)
{
  std::vector<int> components(mesh.NumberOfFaces(), -1);
  std::vector<int> stack;
  int number = 0;
  for (int seed = 0; seed < mesh.NumberOfFaces(); ++seed)
  {
    if (components[seed] >= 0)
    {
      continue;
    }
    components[seed] = number;
    stack.push_back(seed);
    while (!stack.empty())
    {
      const int face = stack.back();
      stack.pop_back();
      for (int h = 3 * face; h < 3 * face + 3; ++h)
      {
        const int twin = mesh.Twin(h);
        if (twin >= 0 && components[TriangleMesh::FaceOf(twin)] < 0)
        {
          components[TriangleMesh::FaceOf(twin)] = number;
          stack.push_back(TriangleMesh::FaceOf(twin));
        }
      }
    }
    ++number;
  }
  return components;
}

}
