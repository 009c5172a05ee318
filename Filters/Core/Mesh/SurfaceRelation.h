#ifndef dmgSurfaceRelation_h
#define dmgSurfaceRelation_h

#include "Mesh/MeshChecks.h"
#include "Mesh/TriangleMesh.h"
#include "Support/ExecutionContext.h"

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

namespace dmg
{

/// Numbers of elements that stand side by side in memory; borrowed.
struct ElementRow
{
  const int* First = nullptr;
  const int* Last = nullptr;

  const int* begin() const { return this->First; }
  const int* end() const { return this->Last; }
  int size() const { return static_cast<int>(this->Last - this->First); }
  bool empty() const { return this->First == this->Last; }
  int front() const { return *this->First; }
};

/// A row of elements for each index. Where no row has more than one element, there are no offsets.
struct ElementRows
{
  std::vector<int> Offsets; ///< empty: row i is Items[i], or empty where that is -1
  std::vector<int> Items;

  int Size() const { return static_cast<int>(this->Offsets.empty() ? this->Items.size() : this->Offsets.size() - 1); }
  ElementRow operator[](int i) const
  {
    const int* const items = this->Items.data();
    return this->Offsets.empty() ? ElementRow{ items + i, items + i + (items[i] < 0 ? 0 : 1) }
                                 : ElementRow{ items + this->Offsets[i], items + this->Offsets[i + 1] };
  }
};

/// The elements of a mesh against the cells and points of the surface that it was made from.
///
/// A polygon has several faces. A doubled cell has the faces of its twin. A cell that has collapsed to a line or a point
/// has the faces around it. Points that were joined share a vertex, and a point at which sheets were parted has several.
/// In the special case of one to one, the relation is a permutation and takes no more memory than that.
class SurfaceRelation
{
public:
  SurfaceRelation() = default;

  /// \param firstCell cell of row 0 of \p facesOfCells; the cells before it have no faces.
  /// \param cellsOfFaces, pointsOfVertices rows of the face's cell and of the vertex's point.
  SurfaceRelation(int firstCell, std::vector<int> cellsOfFaces, ElementRows facesOfCells,
    std::vector<int> pointsOfVertices, ElementRows verticesOfPoints)
    : FirstCell(firstCell)
    , CellsOfFaces(std::move(cellsOfFaces))
    , FacesOfCells(std::move(facesOfCells))
    , PointsOfVertices(std::move(pointsOfVertices))
    , VerticesOfPoints(std::move(verticesOfPoints))
  {
  }

  /// The relation of a mesh whose faces are the cells, and whose vertices are the points.
  static SurfaceRelation OneToOne(const TriangleMesh& mesh);

  int NumberOfFaces() const { return static_cast<int>(this->CellsOfFaces.size()); }
  int NumberOfVertices() const { return static_cast<int>(this->PointsOfVertices.size()); }

  /// The cell that a face is a part of.
  int CellOf(int face) const { return this->FirstCell + this->CellsOfFaces[face]; }
  /// The point where a vertex is; the first one of those that were joined.
  int PointOf(int vertex) const { return this->PointsOfVertices[vertex]; }
  /// Empty for a cell that is no part of the surface, as a line.
  ElementRow FacesOf(long long cell) const
  {
    const long long row = cell - this->FirstCell;
    return row >= 0 && row < this->FacesOfCells.Size() ? this->FacesOfCells[static_cast<int>(row)] : ElementRow();
  }
  /// Empty for a point that no face has as a corner.
  ElementRow VerticesOf(long long point) const { return this->VerticesOfPoints[static_cast<int>(point)]; }

  /// Whether a cell consists of faces, rather than having those of its twin or of its neighbours.
  bool IsPartOfSurface(long long cell) const
  {
    const ElementRow faces = this->FacesOf(cell);
    return !faces.empty() && this->CellOf(faces.front()) == cell;
  }
  /// Whether each cell has one face at most, and each point one vertex, and no two share any.
  bool IsOneToOne() const { return this->FacesOfCells.Offsets.empty() && this->VerticesOfPoints.Offsets.empty(); }

  /// The place of the data of a cell, if some of its corners coincide and so are one vertex: the mean of the corners as they were written, as of a
  /// quadrilateral at a pole. Null for other cells, whose vertices have this mean.
  const Vector3* CentreOf(long long cell) const
  {
    const auto found = std::lower_bound(this->Centres.begin(), this->Centres.end(), cell,
      [](const std::pair<long long, Vector3>& centre, long long other) { return centre.first < other; });
    return found == this->Centres.end() || found->first != cell ? nullptr : &found->second;
  }
  /// \param centres (cell, place), in ascending order of the cells.
  void SetCentres(std::vector<std::pair<long long, Vector3>>&& centres) { this->Centres = std::move(centres); }

  /// The first vertex at the place of a vertex. Where other ranks have triangles between them, several vertices of this surface are the
  /// same vertex of the whole one, and have one place; else each vertex is a place of its own.
  int PlaceOf(int vertex) const { return this->Places.empty() ? vertex : this->Places[vertex]; }
  void SetPlaces(std::vector<int>&& places) { this->Places = std::move(places); }

  /// Whether a face was turned to be seen from the positive side: its corners are the second, the first and the third one of the triangle before.
  /// The frame of such a face (FaceFrames) has the first axis reversed, and the second one as it was.
  bool IsTurned(int face) const { return !this->TurnedFaces.empty() && this->TurnedFaces[face] != 0; }
  /// For all faces; empty where none is turned.
  const std::vector<char>& Turned() const { return this->TurnedFaces; }
  void SetTurned(std::vector<char>&& faces) { this->TurnedFaces = std::move(faces); }

  /// The edges of the cells, without the diagonals that cut polygons into triangles, in ascending order of their
  /// (smaller, larger) point.
  const std::vector<int>& Edges() const { return this->EdgesOfCells; }
  /// Finds these edges. \pre the mesh is that of the relation. Cost: linear.
  void SetEdges(const TriangleMesh& mesh, const ExecutionContext& context);
  /// +1 where an edge of the mesh runs from its smaller to its larger point, else -1.
  int EdgeSign(const TriangleMesh& mesh, int edge) const
  {
    const auto [tail, head] = mesh.EdgeVertices(edge);
    return this->PointOf(tail) < this->PointOf(head) ? 1 : -1;
  }

  /// The names by which messages about the mesh call the caller's cells and points.
  ElementNames Names() const;

private:
  int FirstCell = 0;
  std::vector<int> CellsOfFaces;
  ElementRows FacesOfCells;
  std::vector<int> PointsOfVertices;
  ElementRows VerticesOfPoints;
  std::vector<int> Places;
  std::vector<char> TurnedFaces;
  std::vector<std::pair<long long, Vector3>> Centres;
  std::vector<int> EdgesOfCells;
};

}

#endif
