#include "Preparation/RepairRelation.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <tuple>
#include <utility>

namespace dmg
{

namespace
{

/// (index of a row, element of it).
using Entry = std::pair<int, int>;

/// Rows of entries, each element once, in the order of the entries.
ElementRows RowsOf(int numberOfRows, const std::vector<Entry>& entries)
{
  std::vector<int> order(entries.size());
  std::iota(order.begin(), order.end(), 0);
  std::sort(
    order.begin(), order.end(), [&entries](int i, int j) { return std::tie(entries[i], i) < std::tie(entries[j], j); });
  const auto end = std::unique(
    order.begin(), order.end(), [&entries](int i, int j) { return entries[i] == entries[j]; }); // the first stays
  order.erase(end, order.end());
  std::sort(order.begin(), order.end(),
    [&entries](int i, int j) { return std::tie(entries[i].first, i) < std::tie(entries[j].first, j); });
  ElementRows rows;
  rows.Offsets.assign(numberOfRows + 1, 0);
  for (const int i : order)
  {
    rows.Items.push_back(entries[i].second);
    ++rows.Offsets[entries[i].first + 1];
  }
  for (int row = 0; row < numberOfRows; ++row)
  {
    rows.Offsets[row + 1] += rows.Offsets[row];
  }
  return rows;
}

class RelationOfRepair
{
public:
  RelationOfRepair(const CellTriangles& given, const UsedPoints& used, const RepairSteps& steps)
    : Input(given)
    , PointsInUse(used)
    , Steps(steps)
    , Size(static_cast<int>(given.Corners.rows()))
  {
  }

  RepairedSurface Make() const
  {
    RepairedSurface result;
    result.Corners = this->Steps.Fans.Corners;
    this->RelatePoints(result);
    this->RelateCells(result.Parts);
    this->Count(result);
    return result;
  }

private:
  /// The point that a corner of a kept triangle was given with, after the triangle was turned.
  int GivenCorner(int i, int k) const
  {
    return this->Input.Corners(this->Steps.Participants[i], this->Steps.Orientation.IsTurned[i] && k > 0 ? 3 - k : k);
  }

  void RelatePoints(RepairedSurface& result) const
  {
    const int rows = static_cast<int>(this->Input.Positions.rows());
    std::vector<int> firstRows(this->Steps.Fans.Points.size(), rows);
    std::vector<Entry> entries;
    for (int i = 0; i < static_cast<int>(this->Steps.Participants.size()); ++i)
    {
      for (int k = 0; k < 3; ++k)
      {
        const int vertex = this->Steps.Fans.Corners(i, k);
        const int row = this->GivenCorner(i, k);
        firstRows[vertex] = std::min(firstRows[vertex], row);
        entries.emplace_back(row, vertex);
      }
    }
    std::sort(entries.begin(), entries.end());
    entries.erase(std::unique(entries.begin(), entries.end()), entries.end());
    this->AddPointsOfOthers(entries);
    for (Entry& entry : entries)
    {
      entry.first = this->PointsInUse.Points[entry.first];
    }
    result.Parts.VerticesOfPoints = RowsOf(static_cast<int>(this->PointsInUse.Rows.size()), entries);
    result.Positions.resize(static_cast<Eigen::Index>(firstRows.size()), 3);
    for (std::size_t vertex = 0; vertex < firstRows.size(); ++vertex)
    {
      result.Positions.row(static_cast<Eigen::Index>(vertex)) = this->Input.Positions.row(firstRows[vertex]);
      result.Parts.PointsOfVertices.push_back(this->PointsInUse.Points[firstRows[vertex]]);
    }
  }

  /// Points that only doubled or collapsed triangles use have the vertices of a point at the same place.
  void AddPointsOfOthers(std::vector<Entry>& entries) const
  {
    const int rows = static_cast<int>(this->Input.Positions.rows());
    std::vector<int> entryOfPlace(rows, -1);
    std::vector<char> isRelated(rows, 0);
    for (int i = static_cast<int>(entries.size()) - 1; i >= 0; --i)
    {
      entryOfPlace[this->Steps.Places[entries[i].first]] = i; // the first one in the end
      isRelated[entries[i].first] = 1;
    }
    const std::size_t related = entries.size();
    for (int row = 0; row < rows; ++row)
    {
      const int first = isRelated[row] ? -1 : entryOfPlace[this->Steps.Places[row]];
      for (std::size_t i = first; first >= 0 && i < related && entries[i].first == entries[first].first; ++i)
      {
        entries.emplace_back(row, entries[i].second);
      }
    }
  }

  void RelateCells(SurfaceParts& parts) const
  {
    parts.FirstCell = this->Input.FirstCell;
    std::vector<int> faces(this->Size, -1);
    std::vector<Entry> entries;
    std::vector<char> hasFaces(this->Input.NumberOfCells, 0);
    for (int i = 0; i < static_cast<int>(this->Steps.Participants.size()); ++i)
    {
      const int cell = this->Input.CellOf(this->Steps.Participants[i]);
      faces[this->Steps.Participants[i]] = i;
      parts.CellsOfFaces.push_back(cell);
      entries.emplace_back(cell, i);
      hasFaces[cell] = 1;
    }
    std::vector<char> isDoubled(this->Input.NumberOfCells, 0);
    for (int t = 0; t < this->Size; ++t)
    {
      const int cell = this->Input.CellOf(t);
      if (!hasFaces[cell] && this->Steps.Twins[t] != t && faces[this->Steps.Twins[t]] >= 0)
      {
        entries.emplace_back(cell, faces[this->Steps.Twins[t]]);
        isDoubled[cell] = 1;
      }
    }
    for (int cell = 0; cell < this->Input.NumberOfCells; ++cell)
    {
      hasFaces[cell] = hasFaces[cell] || isDoubled[cell];
    }
    this->AddFacesAroundCollapsed(hasFaces, entries);
    parts.FacesOfCells = RowsOf(this->Input.NumberOfCells, entries);
  }

  /// The place of a corner of a triangle that was given.
  int PlaceOf(int t, int k) const { return this->Steps.Places[this->Steps.Corners(t, k)]; }

  /// Cells of collapsed triangles have the faces that share the place of a side with them, or else that of a corner.
  void AddFacesAroundCollapsed(const std::vector<char>& hasFaces, std::vector<Entry>& entries) const
  {
    std::vector<int> collapsed;
    std::vector<char> isCorner(this->Input.Positions.rows(), 0);
    for (int t = 0; t < this->Size; ++t)
    {
      if (!hasFaces[this->Input.CellOf(t)] && IsCollapsed(this->Steps.Corners, t) && !this->Input.IsLeftOut(t))
      {
        collapsed.push_back(t);
        for (int k = 0; k < 3; ++k)
        {
          isCorner[this->PlaceOf(t, k)] = 1;
        }
      }
    }
    if (collapsed.empty())
    {
      return;
    }
    std::vector<Entry> around; // (place of a corner, face)
    for (int i = 0; i < static_cast<int>(this->Steps.Participants.size()); ++i)
    {
      for (int k = 0; k < 3; ++k)
      {
        const int place = this->Steps.Places[this->Steps.CornersOfParticipants(i, k)];
        if (isCorner[place])
        {
          around.emplace_back(place, i);
        }
      }
    }
    const ElementRows faces = RowsOf(static_cast<int>(isCorner.size()), around);
    for (const int t : collapsed)
    {
      this->AddFacesAround(t, faces, entries);
    }
  }

  void AddFacesAround(int t, const ElementRows& facesOfCorners, std::vector<Entry>& entries) const
  {
    const int cell = this->Input.CellOf(t);
    const int a = this->PlaceOf(t, 0);
    const int b = this->PlaceOf(t, 1) != a ? this->PlaceOf(t, 1) : this->PlaceOf(t, 2);
    const ElementRow atA = facesOfCorners[a], atB = facesOfCorners[b];
    const std::size_t before = entries.size();
    for (const int face : atA)
    {
      if (std::binary_search(atB.begin(), atB.end(), face)) // faces ascend
      {
        entries.emplace_back(cell, face);
      }
    }
    for (int i = 0; entries.size() == before && i < 2; ++i)
    {
      for (const int face : i == 0 ? atA : atB)
      {
        entries.emplace_back(cell, face);
      }
    }
  }

  /// The number of cells with a triangle that is chosen.
  template <class IsChosen>
  int NumberOfCells(const IsChosen& isChosen) const
  {
    int last = -1, count = 0;
    for (int t = 0; t < this->Size; ++t)
    {
      if (this->Input.CellOf(t) != last && isChosen(t))
      {
        last = this->Input.CellOf(t);
        ++count;
      }
    }
    return count;
  }

  void Count(RepairedSurface& result) const
  {
    PreparationReport& report = result.Report;
    std::vector<char> isTurned(this->Size, 0), isOfCell(this->Input.NumberOfCells, 0);
    for (std::size_t i = 0; i < this->Steps.Participants.size(); ++i)
    {
      isTurned[this->Steps.Participants[i]] = this->Steps.Orientation.IsTurned[i];
      isOfCell[this->Input.CellOf(this->Steps.Participants[i])] = 1;
    }
    const std::vector<int> joined = this->Steps.JoinedPoints.AllSmallest();
    for (int row = 0; row < this->Input.Positions.rows(); ++row)
    {
      report.PointsJoined += joined[row] != row;
    }
    report.CellsTurned = this->NumberOfCells([&](int t) { return isTurned[t] != 0; });
    report.CellsDoubled = this->NumberOfCells([&](int t)
      { return this->Steps.Twins[t] != t && !this->Input.IsLeftOut(t) && !isOfCell[this->Input.CellOf(t)]; });
    report.CellsCollapsed = this->NumberOfCells(
      [&](int t) { return IsCollapsed(this->Steps.Corners, t) && !isOfCell[this->Input.CellOf(t)]; });
    report.EdgesParted = static_cast<int>(this->Steps.Pairs.Crossed.size());
    report.EdgesCut = static_cast<int>(this->Steps.Orientation.Cut.size());
    std::vector<int> vertices(this->Input.Positions.rows(), 0);
    for (const int point : this->Steps.Fans.Points)
    {
      ++vertices[point];
    }
    const auto leaveOut = [&vertices](const std::vector<std::array<int, 2>>& edges)
    {
      for (const auto& [a, b] : edges)
      {
        vertices[a] = vertices[b] = 1;
      }
    };
    leaveOut(this->Steps.Pairs.Crossed);
    leaveOut(this->Steps.Orientation.Cut);
    report.PointsParted =
      static_cast<int>(std::count_if(vertices.begin(), vertices.end(), [](int count) { return count > 1; }));
  }

  const CellTriangles& Input;
  const UsedPoints& PointsInUse;
  const RepairSteps& Steps;
  const int Size; ///< triangles that were given
};

}

RepairedSurface RelateRepaired(const CellTriangles& given, const UsedPoints& used, const RepairSteps& steps)
{
  return RelationOfRepair(given, used, steps).Make();
}

}
