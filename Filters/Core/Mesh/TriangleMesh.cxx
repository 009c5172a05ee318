#include "Mesh/TriangleMesh.h"

#include "Support/Errors.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <utility>

namespace dmg
{

namespace
{

/// A halfedge, filed under the smaller vertex of its edge.
struct Side
{
  int Larger;
  int Halfedge;

  bool operator<(const Side& other) const
  {
    return this->Larger != other.Larger ? this->Larger < other.Larger
                                        : this->Halfedge < other.Halfedge;
  }
};

/// All halfedges by edge: those of smaller vertex v are [offsets[v], offsets[v + 1]), ascending.
std::vector<Side> SortedSides(int numberOfVertices, const Triangles& F, std::vector<int>& offsets)
{
  const int numberOfHalfedges = 3 * static_cast<int>(F.rows());
  const int* tails = F.data();
  const auto head = [tails](int h) { return tails[TriangleMesh::Next(h)]; };

  offsets.assign(numberOfVertices + 1, 0);
  for (int h = 0; h < numberOfHalfedges; ++h)
  {
    ++offsets[std::min(tails[h], head(h)) + 1];
  }
  for (int v = 0; v < numberOfVertices; ++v)
  {
    offsets[v + 1] += offsets[v];
  }

  std::vector<Side> sides(numberOfHalfedges);
  std::vector<int> next(offsets.begin(), offsets.end() - 1);
  for (int h = 0; h < numberOfHalfedges; ++h)
  {
    const auto [smaller, larger] = std::minmax({ tails[h], head(h) });
    sides[next[smaller]++] = { larger, h };
  }
  for (int v = 0; v < numberOfVertices; ++v)
  {
    std::sort(sides.begin() + offsets[v], sides.begin() + offsets[v + 1]);
  }
  return sides;
}

bool HaveSameCorners(const Triangles& F, int f, int g)
{
  const int* a = F.data() + 3 * f;
  const int* b = F.data() + 3 * g;
  return std::is_permutation(a, a + 3, b);
}

/// \param first, last the halfedges of one edge, more than one may take.
[[noreturn]] void RefuseEdge(
  const Triangles& F, const ElementNames& names, const Side* first, const Side* last, int smaller)
{
  const std::string edge =
    "the edge between " + names.Vertex(smaller) + " and " + names.Vertex(first->Larger);
  for (const Side* a = first; a != last; ++a)
  {
    for (const Side* b = a + 1; b != last; ++b)
    {
      const int f = TriangleMesh::FaceOf(a->Halfedge);
      const int g = TriangleMesh::FaceOf(b->Halfedge);
      if (HaveSameCorners(F, f, g))
      {
        throw InvalidInput(names.Face(f) + " and " + names.Face(g) +
          " are the same triangle; remove one of them (vtkRemoveDuplicatePolys)");
      }
    }
  }
  const int f = TriangleMesh::FaceOf(first[0].Halfedge);
  const int g = TriangleMesh::FaceOf(first[1].Halfedge);
  if (last - first > 2)
  {
    throw InvalidInput(edge + " belongs to " + std::to_string(last - first) +
      " triangles, among them " + names.Face(f) + ", " + names.Face(g) + " and " +
      names.Face(TriangleMesh::FaceOf(first[2].Halfedge)) +
      "; remove the surplus ones, or cut them apart with Surface Normals (vtkPolyDataNormals), "
      "Splitting on, Feature Angle 180 and Non-Manifold Traversal off");
  }
  throw InvalidInput(names.Face(f) + " and " + names.Face(g) +
    " are oriented against each other along " + edge +
    "; apply Surface Normals (vtkPolyDataNormals) with Consistency on and Splitting off (a surface "
    "with one side only, like a Moebius strip, must be cut)");
}

}

TriangleMesh::TriangleMesh(dmg::Points points, dmg::Triangles triangles, const ElementNames& names)
  : V(std::move(points))
  , F(std::move(triangles))
{
  CheckElements(this->V, this->F, names);
  const int numberOfVertices = this->NumberOfVertices();
  const int numberOfHalfedges = 3 * this->NumberOfFaces();

  std::vector<int> offsets;
  const std::vector<Side> sides = SortedSides(numberOfVertices, this->F, offsets);

  this->Twins.assign(numberOfHalfedges, -1);
  this->HalfedgeEdges.resize(numberOfHalfedges);
  this->EdgeHalfedges.reserve(numberOfHalfedges / 2);
  for (int v = 0; v < numberOfVertices; ++v)
  {
    const Side* const end = sides.data() + offsets[v + 1];
    for (const Side* first = sides.data() + offsets[v]; first != end;)
    {
      const Side* last = first + 1;
      while (last != end && last->Larger == first->Larger)
      {
        ++last;
      }
      const int edge = this->NumberOfEdges();
      this->EdgeHalfedges.push_back(first->Halfedge);
      this->HalfedgeEdges[first->Halfedge] = edge;
      if (last - first == 2 && this->Tail(first[0].Halfedge) != this->Tail(first[1].Halfedge))
      {
        const int a = first[0].Halfedge;
        const int b = first[1].Halfedge;
        this->Twins[a] = b;
        this->Twins[b] = a;
        this->HalfedgeEdges[b] = edge;
        this->EdgeHalfedges.back() = this->Tail(a) == v ? a : b;
      }
      else if (last - first >= 2)
      {
        RefuseEdge(this->F, names, first, last, v);
      }
      first = last;
    }
  }

  std::vector<int> valences(numberOfVertices, 0);
  this->Outgoing.assign(numberOfVertices, -1);
  for (int h = 0; h < numberOfHalfedges; ++h)
  {
    int& outgoing = this->Outgoing[this->Tail(h)];
    if (outgoing < 0 || (this->Twins[h] < 0 && this->Twins[outgoing] >= 0))
    {
      outgoing = h;
    }
    ++valences[this->Tail(h)];
  }
  for (int v = 0; v < numberOfVertices; ++v)
  {
    this->VisitFan(v, [&](int) { --valences[v]; });
    if (valences[v] > 0)
    {
      throw InvalidInput("the triangles around " + names.Vertex(v) +
        " form more than one fan, so the surface is pinched there; split the point with Surface "
        "Normals (vtkPolyDataNormals), Splitting on and Feature Angle 180");
    }
  }
}

Vector3 TriangleMesh::FaceAreaVector(int face) const
{
  const int* corner = this->F.data() + 3 * face;
  const Vector3 p = this->Position(corner[0]);
  return (this->Position(corner[1]) - p).cross(this->Position(corner[2]) - p);
}

Vector<double> TriangleMesh::FaceAreas(const ExecutionContext& context) const
{
  constexpr int grain = 4096;
  Vector<double> areas(this->NumberOfFaces());
  context.ParallelFor(0, this->NumberOfFaces(), grain, [this, &areas](int first, int last) {
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
