#include "Quads/Crosses/CutSurface.h"

#include "Analysis/TreeCotree.h"

namespace dmg
{

namespace
{

int Modulo4(int number)
{
  return ((number % 4) + 4) % 4;
}

/// The direction of each face that becomes direction 0.
std::vector<int> LabelsAlongTree(const TriangleMesh& mesh, const TreeCotree& trees, const CrossField& field)
{
  std::vector<int> labels(mesh.NumberOfFaces(), 0);
  for (const int face : trees.Faces)
  {
    const int toParent = trees.ParentHalfedges[face];
    if (toParent >= 0)
    {
      const int fromParent = mesh.Twin(toParent);
      labels[face] = Modulo4(labels[TriangleMesh::FaceOf(fromParent)] + field.Matching.Offsets[fromParent]);
    }
  }
  return labels;
}

void Renumber(const TriangleMesh& mesh, const std::vector<int>& labels, CrossField& field)
{
  for (int face = 0; face < mesh.NumberOfFaces(); ++face)
  {
    field.Angles[face] += labels[face] * Pi / 2.0;
  }
  for (int h = 0; h < 3 * mesh.NumberOfFaces(); ++h)
  {
    const int twin = mesh.Twin(h);
    signed char& offset = field.Matching.Offsets[h];
    offset = static_cast<signed char>(
      twin < 0 ? 0 : Modulo4(offset + labels[TriangleMesh::FaceOf(h)] - labels[TriangleMesh::FaceOf(twin)]));
  }
}

/// The edges that the tree over the faces does not cross, less those that lead to nothing: an end of the cut is a singularity or on the
/// boundary.
class CutGraph
{
public:
  CutGraph(const TriangleMesh& mesh, const TreeCotree& trees, const std::vector<int>& indices)
    : IsCut(mesh.NumberOfEdges(), 0)
    , Degrees(mesh.NumberOfVertices(), 0)
    , Mesh(mesh)
    , Indices(indices)
  {
    for (int edge = 0; edge < mesh.NumberOfEdges(); ++edge)
    {
      this->IsCut[edge] = mesh.Twin(mesh.HalfedgeOf(edge)) >= 0;
    }
    for (const int toParent : trees.ParentHalfedges)
    {
      if (toParent >= 0)
      {
        this->IsCut[mesh.EdgeOf(toParent)] = 0;
      }
    }
    this->CountDegrees();
    for (int vertex = 0; vertex < mesh.NumberOfVertices(); ++vertex)
    {
      this->Prune(vertex);
    }
  }

  /// Whether seams end at a vertex of the cut.
  bool IsNode(int vertex) const { return this->Degrees[vertex] != 2 || this->IsHeld(vertex); }

  std::vector<char> IsCut; ///< by edge

private:
  bool IsHeld(int vertex) const { return this->Indices[vertex] != 0 || this->Mesh.IsBoundaryVertex(vertex); }

  void CountDegrees()
  {
    for (int edge = 0; edge < this->Mesh.NumberOfEdges(); ++edge)
    {
      if (this->IsCut[edge])
      {
        for (const int vertex : this->Mesh.EdgeVertices(edge))
        {
          ++this->Degrees[vertex];
        }
      }
    }
  }

  /// Takes back the cut from an end to the next branch.
  void Prune(int vertex)
  {
    while (this->Degrees[vertex] == 1 && !this->IsHeld(vertex))
    {
      int last = -1;
      this->Mesh.VisitFan(vertex, [this, &last](int h) { last = this->IsCut[this->Mesh.EdgeOf(h)] ? h : last; });
      this->IsCut[this->Mesh.EdgeOf(last)] = 0;
      --this->Degrees[vertex];
      vertex = this->Mesh.Head(last);
      --this->Degrees[vertex];
    }
  }

  std::vector<int> Degrees; ///< of vertices in the cut
  const TriangleMesh& Mesh;
  const std::vector<int>& Indices;
};

/// Follows the seam that begins with a halfedge.
void FollowSeam(const TriangleMesh& mesh, const CutGraph& graph, int first, CutSurface& cut)
{
  const int seam = cut.NumberOfSeams++;
  for (int h = first; h >= 0 && cut.Seams[h] < 0;)
  {
    cut.Seams[h] = cut.Seams[mesh.Twin(h)] = seam;
    cut.IsForward[h] = 1;
    const int head = mesh.Head(h), back = mesh.Twin(h);
    h = -1;
    if (!graph.IsNode(head))
    {
      mesh.VisitFan(head,
        [&](int next)
        {
          if (graph.IsCut[mesh.EdgeOf(next)] && next != back)
          {
            h = next;
          }
        });
    }
  }
}

}

CutSurface CutAlongSeams(const TriangleMesh& mesh, CrossField& field)
{
  const TreeCotree trees = MakeTreeCotree(mesh, BoundaryAs::Vertex);
  Renumber(mesh, LabelsAlongTree(mesh, trees, field), field);
  const CutGraph graph(mesh, trees, field.Indices);
  CutSurface cut;
  cut.Matchings = field.Matching.Offsets;
  cut.IsCut = graph.IsCut;
  cut.Seams.assign(3 * mesh.NumberOfFaces(), -1);
  cut.IsForward.assign(3 * mesh.NumberOfFaces(), 0);
  for (const bool fromNodes : { true, false }) // what remains then are closed seams without nodes
  {
    for (int h = 0; h < 3 * mesh.NumberOfFaces(); ++h)
    {
      if (mesh.Twin(h) >= 0 && graph.IsCut[mesh.EdgeOf(h)] && cut.Seams[h] < 0 &&
        (!fromNodes || graph.IsNode(mesh.Tail(h))))
      {
        FollowSeam(mesh, graph, h, cut);
      }
    }
  }
  return cut;
}

}
