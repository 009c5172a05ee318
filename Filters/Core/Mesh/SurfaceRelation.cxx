#include "Mesh/SurfaceRelation.h"

#include "Support/CountingSort.h"
#include "Support/Permutations.h"

#include <algorithm>

namespace dmg
{

SurfaceRelation SurfaceRelation::OneToOne(const TriangleMesh& mesh)
{
  const std::vector<int> faces = Identity(mesh.NumberOfFaces());
  const std::vector<int> vertices = Identity(mesh.NumberOfVertices());
  return { 0, faces, { {}, faces }, vertices, { {}, vertices } };
}

void SurfaceRelation::SetEdges(const TriangleMesh& mesh, const ExecutionContext& context)
{
  int numberOfPoints = 0;
  for (const int point : this->PointsOfVertices)
  {
    numberOfPoints = std::max(numberOfPoints, point + 1);
  }
  const ItemsByPair byPoints = SortByPair(
    mesh.NumberOfEdges(), numberOfPoints,
    [this, &mesh](int edge) -> std::pair<int, int>
    {
      const auto [a, b] = mesh.EdgeVertices(edge);
      return std::minmax({ this->PointOf(a), this->PointOf(b) });
    },
    context);
  const bool hasDiagonals = !this->FacesOfCells.Offsets.empty();
  const auto isDiagonal = [this, &mesh](int edge)
  {
    const int side = mesh.HalfedgeOf(edge);
    const int twin = mesh.Twin(side);
    return twin >= 0 &&
      this->CellsOfFaces[TriangleMesh::FaceOf(side)] == this->CellsOfFaces[TriangleMesh::FaceOf(twin)];
  };
  this->EdgesOfCells.clear();
  this->EdgesOfCells.reserve(byPoints.Items.size());
  for (const ItemOfPair& edge : byPoints.Items)
  {
    if (!hasDiagonals || !isDiagonal(edge.Item))
    {
      this->EdgesOfCells.push_back(edge.Item);
    }
  }
}

ElementNames SurfaceRelation::Names() const
{
  ElementNames names;
  names.Vertices.assign(this->PointsOfVertices.begin(), this->PointsOfVertices.end());
  names.Faces.reserve(this->CellsOfFaces.size());
  for (const int row : this->CellsOfFaces)
  {
    names.Faces.push_back(static_cast<long long>(this->FirstCell) + row);
  }
  return names;
}

}
