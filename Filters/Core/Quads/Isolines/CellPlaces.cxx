#include "Quads/Isolines/CellPlaces.h"

#include <algorithm>

namespace dmg
{

namespace
{

class CellPlacement
{
public:
  CellPlacement(const NearestPlaces& surface, const IsolineArrangement& isolines, const IsolineCells& cells)
    : Surface(surface)
    , Mesh(surface.Surface.Mesh)
    , Isolines(isolines)
    , Cells(cells)
  {
    this->Result.Places.resize(cells.Size());
    this->Result.Holds.assign(cells.Size(), Hold::Free);
    this->Result.Singularities.assign(cells.Size(), 0);
  }

  /// The mean of the nodes around each cell; of those on the boundary, where there are some, and on its line.
  void PlaceAtMeans(const LinesOfEdges& lines)
  {
    Points sums = Points::Zero(this->Cells.Size(), 3);
    std::vector<int> counts(this->Cells.Size(), 0);
    std::vector<SurfacePlace> nodes(this->Cells.Size());
    for (int node = 0; node < static_cast<int>(this->Isolines.Nodes.size()); ++node)
    {
      const SurfacePlace& place = this->Isolines.Nodes[node];
      for (int slot = 0; slot < (this->Isolines.IsEnd(node) ? 2 : 4); ++slot)
      {
        const int cell = this->Cells.OfDarts[node][slot];
        if (this->Cells.IsOnBoundary[cell] == this->Isolines.IsEnd(node))
        {
          sums.row(cell) += PositionOf(this->Mesh, place).transpose();
          ++counts[cell];
          nodes[cell] = place;
        }
      }
    }
    for (int cell = 0; cell < this->Cells.Size(); ++cell)
    {
      if (counts[cell] > 0)
      {
        const Vector3 mean = sums.row(cell).transpose() / counts[cell];
        const NearestPlace nearest = this->Surface.From(nodes[cell].Face, mean);
        this->Result.Places[cell] = this->Cells.IsOnBoundary[cell] && lines.Has(nodes[cell])
          ? lines.From(nodes[cell], mean)
          : PlaceInFace(this->Mesh, nearest.Face, nearest.Position);
        this->Result.Holds[cell] = this->Cells.IsOnBoundary[cell] ? Hold::OnLine : Hold::Free;
      }
    }
  }

  /// Grid points near to corners of faces that are not turned over.
  void PlaceAtGridPoints(const MapOfCorners& map)
  {
    std::vector<char> isPlaced(this->Cells.Size(), 0);
    for (int h = 0; h < static_cast<int>(map.size()); ++h)
    {
      const int face = TriangleMesh::FaceOf(h), cell = this->Cells.OfVertices[this->Mesh.Tail(h)];
      if (cell < 0 || isPlaced[cell] || this->Cells.IsOnBoundary[cell])
      {
        continue;
      }
      const auto nearest = [](FixedPoint number) { return (number + FixedOne / 2) & ~(FixedOne - 1); };
      const std::array<FixedPoint, 2> point{ nearest(map[h][0]), nearest(map[h][1]) };
      if (IsInFace(map, face, point))
      {
        isPlaced[cell] = 1;
        this->Result.Places[cell] = { face, WeightsInFace(map, face, point) };
      }
    }
  }

  void PlaceAtSingularities(const std::vector<int>& indices)
  {
    for (int vertex = 0; vertex < this->Mesh.NumberOfVertices(); ++vertex)
    {
      const int cell = this->Cells.OfVertices[vertex];
      if (indices[vertex] != 0 && cell >= 0 && !this->Cells.IsOnBoundary[cell])
      {
        ++this->Result.Singularities[cell];
        this->Result.Places[cell] = AtTail(this->Mesh.OutgoingHalfedge(vertex));
      }
    }
  }

  void PlaceOnLines(
    const SurfaceAngles& angles, const CrossField& field, const LinesOfEdges& lines, const MapOfCorners& map)
  {
    for (int edge = 0; edge < this->Mesh.NumberOfEdges(); ++edge)
    {
      if (lines.Has(edge))
      {
        const int h = this->Mesh.HalfedgeOf(edge), c = RunsAlongU(angles, field, h) ? 0 : 1;
        this->PlaceAtIntegers(h, map[h][c], map[TriangleMesh::Next(h)][c]);
      }
    }
    for (int vertex = 0; vertex < this->Mesh.NumberOfVertices(); ++vertex)
    {
      const int cell = this->Cells.OfVertices[vertex];
      if (cell >= 0 && lines.IsCorner(vertex) && this->MayTake(cell, this->Mesh.IsBoundaryVertex(vertex)))
      {
        this->Result.Places[cell] = AtTail(this->Mesh.OutgoingHalfedge(vertex));
        this->Result.Holds[cell] = Hold::AtPoint;
      }
    }
  }

  CellPlaces Result;

private:
  /// Whether a cell may stand at a place of a line: one on the boundary stays there, where a line within the surface comes near.
  bool MayTake(int cell, bool isPlaceOnBoundary) const { return isPlaceOnBoundary || !this->Cells.IsOnBoundary[cell]; }

  static bool IsInFace(const MapOfCorners& map, int face, const std::array<FixedPoint, 2>& point)
  {
    if (OrientationInMap(map, face) <= 0)
    {
      return false;
    }
    for (int k = 0; k < 3; ++k)
    {
      const auto &a = map[3 * face + k], &b = map[3 * face + (k + 1) % 3];
      const auto cross = [](double x, double y, double z, double w) { return x * w - y * z; };
      if (cross(b[0] - a[0], b[1] - a[1], point[0] - a[0], point[1] - a[1]) < 0.0)
      {
        return false;
      }
    }
    return true;
  }

  /// Places of an edge where a coordinate is an integer; it is a at the tail and b at the head.
  void PlaceAtIntegers(int h, FixedPoint a, FixedPoint b)
  {
    if (a == b)
    {
      return;
    }
    const FixedPoint lower = std::min(a, b), upper = std::max(a, b);
    for (FixedPoint level = (lower + FixedOne - 1) & ~(FixedOne - 1); level <= upper; level += FixedOne)
    {
      const double t = static_cast<double>(level - a) / static_cast<double>(b - a);
      const int cell = this->Cells.OnEdge(this->Mesh, this->Isolines, this->Mesh.EdgeOf(h), t);
      if (cell >= 0 && this->MayTake(cell, this->Mesh.Twin(h) < 0))
      {
        this->Result.Places[cell] = OnHalfedge(h, t);
        this->Result.Holds[cell] = Hold::OnLine;
      }
    }
  }

  const NearestPlaces& Surface;
  const TriangleMesh& Mesh;
  const IsolineArrangement& Isolines;
  const IsolineCells& Cells;
};

}

CellPlaces PlaceCells(const NearestPlaces& surface, const SurfaceAngles& angles, const CrossField& field,
  const LinesOfEdges& lines, const MapOfCorners& map, const IsolineArrangement& isolines, const IsolineCells& cells)
{
  CellPlacement placement(surface, isolines, cells);
  placement.PlaceAtMeans(lines);
  placement.PlaceAtGridPoints(map);
  placement.PlaceAtSingularities(field.Indices);
  placement.PlaceOnLines(angles, field, lines, map);
  return placement.Result;
}

Points PositionsOf(const TriangleMesh& mesh, const CellPlaces& places)
{
  Points positions = Points::Zero(static_cast<int>(places.Places.size()), 3);
  for (int vertex = 0; vertex < positions.rows(); ++vertex)
  {
    if (places.Places[vertex].Face >= 0)
    {
      positions.row(vertex) = PositionOf(mesh, places.Places[vertex]).transpose();
    }
  }
  return positions;
}

SurfacePlace PlaceInFace(const TriangleMesh& mesh, int face, const Vector3& position)
{
  std::array<Vector3, 3> to;
  for (int k = 0; k < 3; ++k)
  {
    to[k] = mesh.Position(mesh.Tail(3 * face + k)) - position;
  }
  const Vector3 normal = mesh.FaceAreaVector(face);
  Vector3 weights;
  for (int k = 0; k < 3; ++k)
  {
    weights[k] = std::max(0.0, normal.dot(to[(k + 1) % 3].cross(to[(k + 2) % 3])));
  }
  if (!(weights.sum() > 0.0)) // a face without area: its nearest corner
  {
    int nearest = 0;
    Vector3(to[0].norm(), to[1].norm(), to[2].norm()).minCoeff(&nearest);
    return { face, Vector3::Unit(nearest) };
  }
  return { face, weights / weights.sum() };
}

}
