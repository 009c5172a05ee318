#include "Analysis/TreeCotree.h"

#include <cassert>
#include <utility>

namespace dmg
{

namespace
{

constexpr int None = -1;

/// Marks the edges of a spanning forest of the vertices.
class VertexForest
{
public:
  explicit VertexForest(const TriangleMesh& mesh)
    : IsInTree(mesh.NumberOfEdges(), 0)
    , Mesh(mesh)
    , IsReached(mesh.NumberOfVertices(), 0)
  {
  }

  /// Marks the edges of a spanning forest whose roots are the boundaries, joined by their own edges.
  void GrowFromBoundary()
  {
    std::vector<int> roots;
    for (int vertex = 0; vertex < this->Mesh.NumberOfVertices(); ++vertex)
    {
      if (this->Mesh.IsBoundaryVertex(vertex))
      {
        this->IsReached[vertex] = 1;
        this->IsInTree[this->Mesh.EdgeOf(this->Mesh.OutgoingHalfedge(vertex))] = 1;
        roots.push_back(vertex);
      }
    }
    this->Grow(std::move(roots));
  }

  void GrowFromOthers()
  {
    for (int root = 0; root < this->Mesh.NumberOfVertices(); ++root)
    {
      if (!this->IsReached[root])
      {
        this->IsReached[root] = 1;
        this->Grow({ root });
      }
    }
  }

  std::vector<char> IsInTree;

private:
  void Grow(std::vector<int> queue)
  {
    for (std::size_t k = 0; k < queue.size(); ++k)
    {
      const auto visit = [&](int edge, int vertex)
      {
        if (!this->IsReached[vertex])
        {
          this->IsReached[vertex] = 1;
          this->IsInTree[edge] = 1;
          queue.push_back(vertex);
        }
      };
      this->Mesh.VisitFan(queue[k],
        [&](int h)
        {
          visit(this->Mesh.EdgeOf(h), this->Mesh.Head(h));
          const int incoming = TriangleMesh::Previous(h);
          if (this->Mesh.Twin(incoming) < 0)
          {
            visit(this->Mesh.EdgeOf(incoming), this->Mesh.Tail(incoming));
          }
        });
    }
  }

  const TriangleMesh& Mesh;
  std::vector<char> IsReached;
};

/// A spanning forest of the faces that does not cross the edges that are taken, and takes those that it crosses.
void GrowOverFaces(const TriangleMesh& mesh, std::vector<char>& isTaken, TreeCotree& trees)
{
  trees.ParentHalfedges.assign(mesh.NumberOfFaces(), None);
  std::vector<char> reached(mesh.NumberOfFaces(), 0);
  const auto grow = [&](std::size_t k)
  {
    for (; k < trees.Faces.size(); ++k)
    {
      for (int h = 3 * trees.Faces[k]; h < 3 * trees.Faces[k] + 3; ++h)
      {
        const int twin = mesh.Twin(h);
        if (twin < 0 || isTaken[mesh.EdgeOf(h)] || reached[TriangleMesh::FaceOf(twin)])
        {
          continue;
        }
        reached[TriangleMesh::FaceOf(twin)] = 1;
        trees.ParentHalfedges[TriangleMesh::FaceOf(twin)] = twin;
        isTaken[mesh.EdgeOf(h)] = 1;
        trees.Faces.push_back(TriangleMesh::FaceOf(twin));
      }
    }
  };
  // The root beyond the boundary comes first.
  for (int h = 0; h < 3 * mesh.NumberOfFaces(); ++h)
  {
    const int face = TriangleMesh::FaceOf(h);
    if (mesh.Twin(h) < 0 && !isTaken[mesh.EdgeOf(h)] && !reached[face])
    {
      reached[face] = 1;
      trees.ParentHalfedges[face] = h;
      isTaken[mesh.EdgeOf(h)] = 1;
      trees.Faces.push_back(face);
    }
  }
  grow(0);
  for (int face = 0; face < mesh.NumberOfFaces(); ++face)
  {
    if (!reached[face])
    {
      reached[face] = 1;
      trees.Faces.push_back(face);
      grow(trees.Faces.size() - 1);
    }
  }
}

}

TreeCotree MakeTreeCotree(const TriangleMesh& mesh, BoundaryAs boundary)
{
  VertexForest vertices(mesh);
  if (boundary == BoundaryAs::Vertex)
  {
    vertices.GrowFromBoundary();
  }
  vertices.GrowFromOthers();
  std::vector<char>& isTaken = vertices.IsInTree;
  TreeCotree trees;
  GrowOverFaces(mesh, isTaken, trees);
  for (int edge = 0; edge < mesh.NumberOfEdges(); ++edge)
  {
    if (!isTaken[edge])
    {
      trees.Generators.push_back(edge);
    }
  }
  return trees;
}

SparseMatrix<double> GeneratorsOverFaces(const TriangleMesh& mesh, const TreeCotree& trees)
{
  std::vector<int> places(mesh.NumberOfFaces()); // in the tree's order
  for (int k = 0; k < mesh.NumberOfFaces(); ++k)
  {
    places[trees.Faces[k]] = k;
  }
  std::vector<Eigen::Triplet<double>> entries;
  for (std::size_t k = 0; k < trees.Generators.size(); ++k)
  {
    const auto cross = [&, k](int h, double sign)
    {
      const int edge = mesh.EdgeOf(h);
      entries.emplace_back(edge, static_cast<int>(k), mesh.HalfedgeOf(edge) == h ? sign : -sign);
    };
    const int start = mesh.HalfedgeOf(trees.Generators[k]);
    int there = TriangleMesh::FaceOf(mesh.Twin(start));
    int here = TriangleMesh::FaceOf(start);
    cross(start, 1.0);
    while (there != here) // whichever is farther from the root goes up
    {
      const bool isThere = places[there] > places[here];
      int& face = isThere ? there : here;
      const int toParent = trees.ParentHalfedges[face];
      assert(toParent != None && mesh.Twin(toParent) >= 0);
      cross(toParent, isThere ? 1.0 : -1.0);
      face = TriangleMesh::FaceOf(mesh.Twin(toParent));
    }
  }
  SparseMatrix<double> loops(mesh.NumberOfEdges(), static_cast<int>(trees.Generators.size()));
  loops.setFromTriplets(entries.begin(), entries.end());
  return loops;
}

}
