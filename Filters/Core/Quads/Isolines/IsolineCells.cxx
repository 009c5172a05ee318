#include "Quads/Isolines/IsolineCells.h"

#include "Support/DisjointSets.h"

#include <algorithm>

namespace dmg
{

namespace
{

/// Goes around the cell to the left of a dart.
void GoAroundCell(const IsolineArrangement& isolines, int first, IsolineCells& cells)
{
  const int cell = cells.Size();
  bool isOutside = true, isOnBoundary = false;
  for (int dart = first; cells.OfDarts[dart / 4][dart % 4] < 0;)
  {
    const bool isEnd = isolines.IsEnd(dart / 4);
    cells.OfDarts[dart / 4][dart % 4] = cell;
    isOnBoundary = isOnBoundary || isEnd;
    isOutside = isOutside && isEnd && dart % 4 == 2;
    dart = isolines.Clockwise(isolines.Opposite[dart / 4][dart % 4]);
  }
  cells.IsOutside.push_back(isOutside);
  cells.IsOnBoundary.push_back(isOnBoundary);
}

void FindCellsOfVertices(const TriangleMesh& mesh, const IsolineArrangement& isolines, IsolineCells& cells)
{
  const std::vector<int> sets = UncrossedSets(mesh, isolines);
  std::vector<int> ofSets(mesh.NumberOfVertices(), -1);
  for (int edge = 0; edge < mesh.NumberOfEdges(); ++edge)
  {
    if (isolines.IsCrossed(edge))
    {
      const int h = mesh.HalfedgeOf(edge);
      const int before = cells.BesidePoint(isolines, isolines.Offsets[edge])[0];
      const int after = cells.BesidePoint(isolines, isolines.Offsets[edge + 1] - 1)[1];
      int &tail = ofSets[sets[mesh.Tail(h)]], &head = ofSets[sets[mesh.Head(h)]];
      tail = before >= 0 ? before : tail;
      head = after >= 0 ? after : head;
    }
  }
  cells.OfVertices.resize(mesh.NumberOfVertices());
  for (int vertex = 0; vertex < mesh.NumberOfVertices(); ++vertex)
  {
    cells.OfVertices[vertex] = ofSets[sets[vertex]];
  }
}

}

std::array<int, 2> IsolineCells::BesidePoint(const IsolineArrangement& isolines, int point) const
{
  const IsolineArrangement::EdgePoint& place = isolines.Points[point];
  if (place.Dart < 0)
  {
    return { -1, -1 };
  }
  const int opposite = isolines.Opposite[place.Dart / 4][place.Dart % 4];
  const int left = this->OfDarts[place.Dart / 4][place.Dart % 4];
  const int right = this->OfDarts[opposite / 4][opposite % 4];
  // The face of the halfedge is on its left: who leaves it has the head on the left.
  return place.Leaves ? std::array<int, 2>{ right, left } : std::array<int, 2>{ left, right };
}

int IsolineCells::OnEdge(const TriangleMesh& mesh, const IsolineArrangement& isolines, int edge, double t) const
{
  if (!isolines.IsCrossed(edge))
  {
    return this->OfVertices[mesh.Tail(mesh.HalfedgeOf(edge))];
  }
  const auto begin = isolines.Points.begin() + isolines.Offsets[edge];
  const auto end = isolines.Points.begin() + isolines.Offsets[edge + 1];
  const auto isNearer = [t](const IsolineArrangement::EdgePoint& point)
  { return static_cast<double>(point.Numerator) < t * static_cast<double>(point.Denominator); };
  const auto next = std::partition_point(begin, end, isNearer);
  const int number = static_cast<int>(next - isolines.Points.begin());
  return next == begin ? this->BesidePoint(isolines, number)[0] : this->BesidePoint(isolines, number - 1)[1];
}

IsolineCells FindCells(const TriangleMesh& mesh, const IsolineArrangement& isolines)
{
  IsolineCells cells;
  cells.OfDarts.assign(isolines.Nodes.size(), { -1, -1, -1, -1 });
  for (int dart = 0; dart < isolines.NumberOfDarts(); ++dart)
  {
    if (dart % 4 < isolines.NumberOfSlots(dart / 4) && cells.OfDarts[dart / 4][dart % 4] < 0)
    {
      GoAroundCell(isolines, dart, cells);
    }
  }
  FindCellsOfVertices(mesh, isolines, cells);
  return cells;
}

std::vector<int> UncrossedSets(const TriangleMesh& mesh, const IsolineArrangement& isolines)
{
  DisjointSets sets(mesh.NumberOfVertices());
  for (int edge = 0; edge < mesh.NumberOfEdges(); ++edge)
  {
    if (!isolines.IsCrossed(edge))
    {
      const auto [a, b] = mesh.EdgeVertices(edge);
      sets.Unite(a, b);
    }
  }
  return sets.AllSmallest();
}

}
