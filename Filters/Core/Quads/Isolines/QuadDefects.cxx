#include "Quads/Isolines/QuadDefects.h"

#include <algorithm>
#include <cstdlib>

namespace dmg
{

namespace
{

/// A component of fewer quads can hardly be a closed surface.
constexpr int FewestQuads = 6;
constexpr int FewestEdgesOfHole = 3;

class DefectSearch
{
public:
  DefectSearch(const TriangleMesh& mesh, const std::vector<int>& components, const IsolineArrangement& isolines,
    const IsolineCells& cells, bool isBoundaryAligned)
    : Mesh(mesh)
    , Components(components)
    , Isolines(isolines)
    , Cells(cells)
    , IsBoundaryAligned(isBoundaryAligned)
  {
    this->Found.AreBad.assign(mesh.NumberOfFaces(), 0);
    this->Found.AreComponentsBad.assign(1 + *std::max_element(components.begin(), components.end()), 0);
  }

  void CheckComponents(const IndexedQuads& quads, const QuadTopology& topology)
  {
    const int count = static_cast<int>(this->Found.AreComponentsBad.size());
    std::vector<int> sizes(count, 0);
    for (const int face : quads.Faces)
    {
      ++sizes[this->Components[face]];
    }
    const std::vector<int> wanted = EulerNumbers(this->Mesh, this->Components, count);
    const std::vector<int> given = EulerNumbers(this->Components, count, quads, topology);
    for (int component = 0; component < count; ++component)
    {
      this->Add(sizes[component] == 0 ? 2 : std::abs(wanted[component] - given[component]), component);
    }
    for (int face = 0; face < this->Mesh.NumberOfFaces(); ++face)
    {
      const int component = this->Components[face];
      const bool isSmall = sizes[component] < FewestQuads;
      this->SmallComponents.push_back(isSmall);
      this->Found.LostComponent =
        sizes[component] == 0 && this->Found.LostComponent < 0 ? face : this->Found.LostComponent;
    }
  }

  void CheckIndices(const QuadTopology& topology, const IndexedQuads& quads)
  {
    for (const int side : topology.Repeated)
    {
      this->Add(1, this->Components[quads.Faces[side / 4]]);
    }
    for (const int quad : topology.TwiceInQuad)
    {
      this->Add(1, this->Components[quads.Faces[quad]]);
    }
    std::vector<int> ofVertices(quads.NumberOfVertices(), 0);
    for (int quad = 0; quad < quads.Size(); ++quad)
    {
      for (const int vertex : quads.Corners[quad])
      {
        ofVertices[vertex] = this->Components[quads.Faces[quad]];
      }
    }
    for (int vertex = 0; vertex < quads.NumberOfVertices(); ++vertex)
    {
      const bool isLow = !quads.IsOnBoundary[vertex] && topology.Valences[vertex] > 0 && topology.Valences[vertex] < 3;
      this->Add(isLow || topology.Fans[vertex] > 1 ? 1 : 0, ofVertices[vertex]);
    }
  }

  void CheckHoles()
  {
    for (std::size_t k = 0; k < this->Isolines.Loops.size(); ++k)
    {
      if (static_cast<int>(this->Isolines.Loops[k].size()) < FewestEdgesOfHole)
      {
        const int h = this->Isolines.LoopHalfedges[k], vertex = this->Mesh.Tail(h);
        this->Add(1, this->Components[TriangleMesh::FaceOf(h)]);
        this->Found.SmallHole = this->Found.SmallHole < 0 ? vertex : this->Found.SmallHole;
      }
    }
    for (int node = this->Isolines.NumberOfCrossings; node < static_cast<int>(this->Isolines.Nodes.size()); ++node)
    {
      this->Found.CutOff += this->IsBare(node) ? 1 : 0;
    }
  }

  /// \pre there are defects, or parts that may be lost.
  void MarkFaces(const IndexedQuads& before, const QuadTopology& topology, const IndexedQuads& quads)
  {
    this->MarkCells();
    this->MarkQuads(before, topology, quads);
    this->MarkHoles();
    for (int face = 0; face < this->Mesh.NumberOfFaces(); ++face)
    {
      this->Found.AreBad[face] = this->Found.AreBad[face] || this->SmallComponents[face];
    }
    if (std::find(this->Found.AreBad.begin(), this->Found.AreBad.end(), 1) == this->Found.AreBad.end())
    {
      this->Found.AreBad.assign(this->Mesh.NumberOfFaces(), 1);
    }
    const auto bad = std::find(this->Found.AreBad.begin(), this->Found.AreBad.end(), 1);
    this->Found.Handle = this->Mesh.Tail(3 * static_cast<int>(bad - this->Found.AreBad.begin()));
  }

  QuadDefects Found;

private:
  void Add(int defects, int component)
  {
    this->Found.Number += defects;
    this->Found.AreComponentsBad[component] = this->Found.AreComponentsBad[component] || defects > 0;
  }

  /// Whether an isoline goes from an aligned boundary to another one and crosses no other isoline.
  bool IsBare(int end) const
  {
    return this->IsBoundaryAligned && this->Isolines.IsEnd(this->Isolines.Opposite[end][1] / 4);
  }

  /// Marks cells that are no discs: the vertices, edges and faces that no isoline crosses have another Euler number than 1.
  void MarkCells()
  {
    const std::vector<int> sets = UncrossedSets(this->Mesh, this->Isolines);
    std::vector<int> euler(this->Mesh.NumberOfVertices(), 0);
    for (int vertex = 0; vertex < this->Mesh.NumberOfVertices(); ++vertex)
    {
      ++euler[sets[vertex]];
    }
    for (int edge = 0; edge < this->Mesh.NumberOfEdges(); ++edge)
    {
      euler[sets[this->Mesh.EdgeVertices(edge)[0]]] -= this->Isolines.IsCrossed(edge) ? 0 : 1;
    }
    for (int h = 0; h < 3 * this->Mesh.NumberOfFaces(); h += 3)
    {
      const auto isCrossed = [this](int side) { return this->Isolines.IsCrossed(this->Mesh.EdgeOf(side)); };
      euler[sets[this->Mesh.Tail(h)]] += isCrossed(h) || isCrossed(h + 1) || isCrossed(h + 2) ? 0 : 1;
    }
    for (int h = 0; h < 3 * this->Mesh.NumberOfFaces(); ++h)
    {
      this->Mark(TriangleMesh::FaceOf(h), euler[sets[this->Mesh.Tail(h)]] != 1);
    }
  }

  /// Marks the places of quads that have a vertex in common with one that does not fit.
  void MarkQuads(const IndexedQuads& before, const QuadTopology& topology, const IndexedQuads& quads)
  {
    std::vector<char> isBad(quads.NumberOfVertices(), 0);
    for (const int side : topology.Repeated)
    {
      isBad[quads.Corners[side / 4][side % 4]] = isBad[quads.Corners[side / 4][(side + 1) % 4]] = 1;
    }
    for (const int quad : topology.TwiceInQuad)
    {
      for (const int vertex : quads.Corners[quad])
      {
        isBad[vertex] = 1;
      }
    }
    for (int vertex = 0; vertex < quads.NumberOfVertices(); ++vertex)
    {
      isBad[vertex] = isBad[vertex] || topology.Fans[vertex] > 1;
    }
    for (int quad = 0; quad < before.Size(); ++quad)
    {
      for (const int vertex : before.Corners[quad])
      {
        this->Mark(before.Faces[quad], isBad[vertex]);
      }
    }
  }

  /// Marks holes with few edges, and vertices at which the boundary touches itself.
  void MarkHoles()
  {
    for (std::size_t k = 0; k < this->Isolines.Loops.size(); ++k)
    {
      if (static_cast<int>(this->Isolines.Loops[k].size()) < FewestEdgesOfHole)
      {
        this->MarkAroundLoop(this->Isolines.LoopHalfedges[k]);
      }
    }
    std::vector<int> stretches(this->Cells.Size(), 0);
    const int first = this->Isolines.NumberOfCrossings, last = static_cast<int>(this->Isolines.Nodes.size());
    for (int node = first; node < last; ++node)
    {
      ++stretches[this->Cells.OfDarts[node][0]];
    }
    for (int node = first; node < last; ++node)
    {
      this->Mark(this->Isolines.Nodes[node].Face, stretches[this->Cells.OfDarts[node][0]] > 1 || this->IsBare(node));
    }
  }

  void MarkAroundLoop(int start)
  {
    int h = start;
    do
    {
      this->Mesh.VisitFan(this->Mesh.Tail(h), [this](int around) { this->Mark(TriangleMesh::FaceOf(around), true); });
      h = this->Mesh.OutgoingHalfedge(this->Mesh.Head(h));
    } while (h != start);
  }

  void Mark(int face, bool isBad) { this->Found.AreBad[face] = this->Found.AreBad[face] || isBad; }

  const TriangleMesh& Mesh;
  const std::vector<int>& Components;
  const IsolineArrangement& Isolines;
  const IsolineCells& Cells;
  const bool IsBoundaryAligned;
  std::vector<char> SmallComponents; ///< by face: whether its component has too few quads
};

}

QuadDefects FindDefects(const TriangleMesh& mesh, const std::vector<int>& components,
  const IsolineArrangement& isolines, const IsolineCells& cells, const IndexedQuads& before, const IndexedQuads& quads,
  const QuadTopology& topology, bool isBoundaryAligned)
{
  DefectSearch search(mesh, components, isolines, cells, isBoundaryAligned);
  search.CheckComponents(quads, topology);
  search.CheckIndices(topology, quads);
  search.CheckHoles();
  if (search.Found.Number > 0 || search.Found.CutOff > 0)
  {
    search.MarkFaces(before, topology, quads);
  }
  return search.Found;
}

std::vector<int> EulerNumbers(
  const std::vector<int>& components, int numberOfComponents, const IndexedQuads& quads, const QuadTopology& topology)
{
  std::vector<int> numbers(numberOfComponents, 0);
  std::vector<int> ofVertices(quads.NumberOfVertices(), -1);
  for (int quad = 0; quad < quads.Size(); ++quad)
  {
    const int component = components[quads.Faces[quad]];
    ++numbers[component];
    for (int k = 0; k < 4; ++k)
    {
      ofVertices[quads.Corners[quad][k]] = component;
      const int side = 4 * quad + k;
      numbers[component] -= topology.Twins[side] < side ? 1 : 0;
    }
  }
  for (const int component : ofVertices)
  {
    if (component >= 0)
    {
      ++numbers[component];
    }
  }
  return numbers;
}

std::vector<int> EulerNumbers(const TriangleMesh& mesh, const std::vector<int>& components, int numberOfComponents)
{
  std::vector<int> numbers(numberOfComponents, 0);
  for (const int component : components)
  {
    ++numbers[component];
  }
  for (int edge = 0; edge < mesh.NumberOfEdges(); ++edge)
  {
    --numbers[components[TriangleMesh::FaceOf(mesh.HalfedgeOf(edge))]];
  }
  for (int vertex = 0; vertex < mesh.NumberOfVertices(); ++vertex)
  {
    ++numbers[components[TriangleMesh::FaceOf(mesh.OutgoingHalfedge(vertex))]];
  }
  return numbers;
}

}
