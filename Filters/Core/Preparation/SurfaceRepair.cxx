#include "Preparation/SurfaceRepair.h"

#include "Mesh/PointChecks.h"
#include "Preparation/CoincidingPoints.h"
#include "Preparation/DoubledTriangles.h"
#include "Preparation/Orientation.h"
#include "Preparation/SheetPairs.h"
#include "Preparation/VerticesOfFans.h"
#include "Support/CountingSort.h"
#include "Support/DisjointSets.h"
#include "Support/Errors.h"

#include <algorithm>
#include <array>
#include <string>
#include <utility>

namespace dmg
{

namespace
{

/// (index of a row, element of it).
using Entry = std::pair<int, int>;

/// Rows of entries, each element once, in the order of the entries.
ElementRows RowsOf(int numberOfRows, std::vector<Entry> entries)
{
  std::stable_sort(entries.begin(), entries.end(), [](const Entry& a, const Entry& b) { return a.first < b.first; });
  ElementRows rows;
  rows.Offsets.assign(numberOfRows + 1, 0);
  for (std::size_t i = 0; i < entries.size(); ++i)
  {
    const auto begin = rows.Items.end() - rows.Offsets[entries[i].first + 1];
    if (std::find(begin, rows.Items.end(), entries[i].second) == rows.Items.end())
    {
      rows.Items.push_back(entries[i].second);
      ++rows.Offsets[entries[i].first + 1];
    }
  }
  for (int row = 0; row < numberOfRows; ++row)
  {
    rows.Offsets[row + 1] += rows.Offsets[row];
  }
  return rows;
}

class Repairer
{
public:
  Repairer(const CellTriangles& given, const UsedPoints& used, bool joinPoints, const ExecutionContext& context)
    : Given(given)
    , Used(used)
    , JoinsPoints(joinPoints)
    , Context(context)
    , Size(static_cast<int>(given.Corners.rows()))
    , Joined(static_cast<int>(given.Positions.rows()))
    , Corners(given.Corners)
    , Twins(this->Size)
    , TakesPart(this->Size, 1)
  {
  }

  RepairedSurface Run()
  {
    this->CheckPositions();
    this->Equal = this->JoinsPoints ? FirstOfEqual(this->Given.Positions) : std::vector<int>();
    this->JoinSidesWithoutLength();
    this->LeaveOut();
    this->PairKept();
    if (this->JoinsPoints && this->JoinPoints())
    {
      this->LeaveOut();
      this->PairKept();
    }
    if (this->Kept.empty())
    {
      RefuseSurfaceWithoutArea();
    }
    const Orientation orientation = Orient(this->Given.Positions, this->KeptCorners, this->Pairs);
    TurnOver(this->KeptCorners, this->Pairs, orientation.IsTurned);
    const FanVertices fans =
      VerticesOfFans(static_cast<int>(this->Given.Positions.rows()), this->KeptCorners, this->Pairs, this->Context);
    RepairedSurface result;
    result.Corners = fans.Corners;
    this->RelatePoints(fans, orientation, result);
    this->RelateCells(result.Parts);
    this->Count(fans, orientation, result);
    return result;
  }

private:
  void CheckPositions() const
  {
    ElementNames names;
    names.Vertices.assign(this->Used.Points.begin(), this->Used.Points.end());
    CheckPoints(this->Given.Positions, names);
  }

  /// Corners become the first of the points that they were joined with.
  void RenumberCorners()
  {
    const std::vector<int> first = this->Joined.AllSmallest();
    for (int i = 0; i < 3 * this->Size; ++i)
    {
      this->Corners.data()[i] = first[this->Given.Corners.data()[i]];
    }
  }

  /// Joins the ends of sides that are as short as rounding, so that no triangle lies in one place.
  void JoinSidesWithoutLength()
  {
    constexpr double Smallest = 1e-60;
    const double rounding = this->JoinsPoints ? RoundingOf(this->Given.Positions) : Smallest;
    for (int t = 0; t < this->Size; ++t)
    {
      const auto at = [&](int k) { return this->Given.Positions.row(this->Given.Corners(t, k % 3)); };
      const std::array<double, 3> lengths{ (at(1) - at(0)).stableNorm(), (at(2) - at(1)).stableNorm(),
        (at(0) - at(2)).stableNorm() };
      const double longest = *std::max_element(lengths.begin(), lengths.end());
      for (int k = 0; k < 3; ++k)
      {
        if (lengths[k] <= std::max(Smallest, std::min(rounding, PartOfEdge * longest)))
        {
          this->Joined.Unite(this->Given.Corners(t, k), this->Given.Corners(t, (k + 1) % 3));
        }
      }
    }
    this->RenumberCorners();
  }

  bool IsCollapsed(int t) const
  {
    const auto& c = this->Corners.row(t);
    return c[0] == c[1] || c[1] == c[2] || c[2] == c[0];
  }

  /// Decides which triangles take part. Those of duplicate cells come last, so that they are twins of others.
  void LeaveOut()
  {
    for (int t = 0; t < this->Size; ++t)
    {
      this->TakesPart[t] = !this->IsCollapsed(t);
    }
    DisjointSets places = this->Joined;
    for (int row = 0; row < static_cast<int>(this->Equal.size()); ++row)
    {
      places.Unite(row, this->Equal[row]);
    }
    this->Places = places.AllSmallest();
    this->Twins = FirstOfDoubled(this->Corners, this->Places, this->TakesPart, this->Context);
    this->PreferCells();
    for (int t = 0; t < this->Size; ++t)
    {
      this->TakesPart[t] = this->TakesPart[t] && this->Twins[t] == t && !this->Given.IsLeftOut(t);
    }
  }

  /// The first of doubled triangles shall not be one of a duplicate cell, if there is another.
  void PreferCells()
  {
    std::vector<int> chosen(this->Twins);
    for (int t = 0; t < this->Size; ++t)
    {
      int& first = chosen[this->Twins[t]];
      first = this->Given.IsLeftOut(first) && !this->Given.IsLeftOut(t) ? t : first;
    }
    for (int t = 0; t < this->Size; ++t)
    {
      this->Twins[t] = chosen[this->Twins[t]];
    }
  }

  void PairKept()
  {
    this->Kept = Choose(
      this->Size, [this](int t) { return this->TakesPart[t] != 0; }, this->Context);
    this->KeptCorners.resize(static_cast<Eigen::Index>(this->Kept.size()), 3);
    for (std::size_t i = 0; i < this->Kept.size(); ++i)
    {
      this->KeptCorners.row(static_cast<Eigen::Index>(i)) = this->Corners.row(this->Kept[i]);
    }
    this->Pairs = PairSheets(this->Given.Positions, this->KeptCorners, this->Context);
  }

  bool JoinPoints()
  {
    BoundaryPoints boundary;
    for (int side = 0; side < 3 * static_cast<int>(this->Kept.size()); ++side)
    {
      if (this->Pairs.Of(side) < 0)
      {
        const auto& c = this->KeptCorners.row(side / 3);
        const int k = side % 3;
        boundary.Add(this->Given.Positions, c[k], c[(k + 1) % 3], c[(k + 2) % 3]);
      }
    }
    if (!JoinBoundary(this->Given.Positions, boundary.Take(), this->Joined))
    {
      return false;
    }
    this->RenumberCorners();
    return true;
  }

  /// The point that a corner of a kept triangle was given with, after the triangle was turned.
  int GivenCorner(int i, int k, const Orientation& orientation) const
  {
    return this->Given.Corners(this->Kept[i], orientation.IsTurned[i] && k > 0 ? 3 - k : k);
  }

  void RelatePoints(const FanVertices& fans, const Orientation& orientation, RepairedSurface& result) const
  {
    const int rows = static_cast<int>(this->Given.Positions.rows());
    std::vector<int> firstRows(fans.OfVertices.size(), rows);
    std::vector<Entry> entries;
    for (int i = 0; i < static_cast<int>(this->Kept.size()); ++i)
    {
      for (int k = 0; k < 3; ++k)
      {
        const int vertex = fans.Corners(i, k);
        const int row = this->GivenCorner(i, k, orientation);
        firstRows[vertex] = std::min(firstRows[vertex], row);
        entries.emplace_back(row, vertex);
      }
    }
    std::sort(entries.begin(), entries.end());
    entries.erase(std::unique(entries.begin(), entries.end()), entries.end());
    this->AddPointsOfOthers(entries);
    for (Entry& entry : entries)
    {
      entry.first = this->Used.Points[entry.first];
    }
    result.Parts.VerticesOfPoints = RowsOf(static_cast<int>(this->Used.Rows.size()), std::move(entries));
    result.Positions.resize(static_cast<Eigen::Index>(firstRows.size()), 3);
    for (std::size_t vertex = 0; vertex < firstRows.size(); ++vertex)
    {
      result.Positions.row(static_cast<Eigen::Index>(vertex)) = this->Given.Positions.row(firstRows[vertex]);
      result.Parts.PointsOfVertices.push_back(this->Used.Points[firstRows[vertex]]);
    }
  }

  /// Points that only doubled or collapsed triangles use have the vertices of a point at the same place.
  void AddPointsOfOthers(std::vector<Entry>& entries) const
  {
    const int rows = static_cast<int>(this->Given.Positions.rows());
    std::vector<int> entryOfPlace(rows, -1);
    std::vector<char> isRelated(rows, 0);
    for (int i = static_cast<int>(entries.size()) - 1; i >= 0; --i)
    {
      entryOfPlace[this->Places[entries[i].first]] = i; // the first one in the end
      isRelated[entries[i].first] = 1;
    }
    const std::size_t related = entries.size();
    for (int row = 0; row < rows; ++row)
    {
      const int first = isRelated[row] ? -1 : entryOfPlace[this->Places[row]];
      for (std::size_t i = first; first >= 0 && i < related && entries[i].first == entries[first].first; ++i)
      {
        entries.emplace_back(row, entries[i].second);
      }
    }
  }

  void RelateCells(SurfaceParts& parts) const
  {
    parts.FirstCell = this->Given.FirstCell;
    std::vector<int> faces(this->Size, -1);
    std::vector<Entry> entries;
    std::vector<char> hasFaces(this->Given.NumberOfCells, 0);
    for (int i = 0; i < static_cast<int>(this->Kept.size()); ++i)
    {
      const int cell = this->Given.CellOf(this->Kept[i]);
      faces[this->Kept[i]] = i;
      parts.CellsOfFaces.push_back(cell);
      entries.emplace_back(cell, i);
      hasFaces[cell] = 1;
    }
    std::vector<char> isDoubled(this->Given.NumberOfCells, 0);
    for (int t = 0; t < this->Size; ++t)
    {
      const int cell = this->Given.CellOf(t);
      if (!hasFaces[cell] && this->Twins[t] != t && faces[this->Twins[t]] >= 0)
      {
        entries.emplace_back(cell, faces[this->Twins[t]]);
        isDoubled[cell] = 1;
      }
    }
    for (int cell = 0; cell < this->Given.NumberOfCells; ++cell)
    {
      hasFaces[cell] = hasFaces[cell] || isDoubled[cell];
    }
    this->AddFacesAroundCollapsed(hasFaces, entries);
    parts.FacesOfCells = RowsOf(this->Given.NumberOfCells, std::move(entries));
  }

  /// Cells of collapsed triangles have the faces that share a side with them, or else a corner.
  void AddFacesAroundCollapsed(const std::vector<char>& hasFaces, std::vector<Entry>& entries) const
  {
    std::vector<int> collapsed;
    std::vector<char> isCorner(this->Given.Positions.rows(), 0);
    for (int t = 0; t < this->Size; ++t)
    {
      if (!hasFaces[this->Given.CellOf(t)] && this->IsCollapsed(t) && !this->Given.IsLeftOut(t))
      {
        collapsed.push_back(t);
        for (int k = 0; k < 3; ++k)
        {
          isCorner[this->Corners(t, k)] = 1;
        }
      }
    }
    if (collapsed.empty())
    {
      return;
    }
    std::vector<Entry> around; // (corner, face)
    for (int i = 0; i < static_cast<int>(this->Kept.size()); ++i)
    {
      for (int k = 0; k < 3; ++k)
      {
        if (isCorner[this->KeptCorners(i, k)])
        {
          around.emplace_back(this->KeptCorners(i, k), i);
        }
      }
    }
    const ElementRows faces = RowsOf(static_cast<int>(isCorner.size()), std::move(around));
    for (const int t : collapsed)
    {
      this->AddFacesAround(t, faces, entries);
    }
  }

  void AddFacesAround(int t, const ElementRows& facesOfCorners, std::vector<Entry>& entries) const
  {
    const int cell = this->Given.CellOf(t);
    const int a = this->Corners(t, 0);
    const int b = this->Corners(t, 1) != a ? this->Corners(t, 1) : this->Corners(t, 2);
    const ElementRow atA = facesOfCorners[a], atB = facesOfCorners[b];
    const std::size_t before = entries.size();
    for (const int face : atA)
    {
      if (std::find(atB.begin(), atB.end(), face) != atB.end())
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

  /// How many cells have a triangle that is chosen.
  template <class IsChosen>
  int NumberOfCells(const IsChosen& isChosen) const
  {
    int last = -1, count = 0;
    for (int t = 0; t < this->Size; ++t)
    {
      if (this->Given.CellOf(t) != last && isChosen(t))
      {
        last = this->Given.CellOf(t);
        ++count;
      }
    }
    return count;
  }

  void Count(const FanVertices& fans, const Orientation& orientation, RepairedSurface& result)
  {
    PreparationReport& report = result.Report;
    std::vector<char> isTurned(this->Size, 0), isOfCell(this->Given.NumberOfCells, 0);
    for (std::size_t i = 0; i < this->Kept.size(); ++i)
    {
      isTurned[this->Kept[i]] = orientation.IsTurned[i];
      isOfCell[this->Given.CellOf(this->Kept[i])] = 1;
    }
    for (int row = 0; row < this->Given.Positions.rows(); ++row)
    {
      report.PointsJoined += this->Joined.Smallest(row) != row;
    }
    report.CellsTurned = this->NumberOfCells([&](int t) { return isTurned[t] != 0; });
    report.CellsDoubled = this->NumberOfCells(
      [&](int t) { return this->Twins[t] != t && !this->Given.IsLeftOut(t) && !isOfCell[this->Given.CellOf(t)]; });
    report.CellsCollapsed =
      this->NumberOfCells([&](int t) { return this->IsCollapsed(t) && !isOfCell[this->Given.CellOf(t)]; });
    report.EdgesParted = static_cast<int>(this->Pairs.Crossed.size());
    report.EdgesCut = static_cast<int>(orientation.Cut.size());
    report.CellsDetached = fans.TrianglesDetached;
    std::vector<int> vertices(this->Given.Positions.rows(), 0);
    for (const int point : fans.OfVertices)
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
    leaveOut(this->Pairs.Crossed);
    leaveOut(orientation.Cut);
    report.PointsParted =
      static_cast<int>(std::count_if(vertices.begin(), vertices.end(), [](int count) { return count > 1; }));
  }

  const CellTriangles& Given;
  const UsedPoints& Used;
  const bool JoinsPoints;
  const ExecutionContext& Context;
  const int Size;
  DisjointSets Joined;
  std::vector<int> Equal;      ///< the first point of each place; empty where points are not joined
  Triangles Corners;           ///< of all triangles, after points were joined
  std::vector<int> Places;     ///< equal for points at one place
  std::vector<int> Twins;      ///< per triangle: the one that has its place, or itself
  std::vector<char> TakesPart; ///< per triangle
  std::vector<int> Kept;       ///< the triangles that take part
  Triangles KeptCorners;
  SheetPairs Pairs; ///< of kept triangles
};

}

UsedPoints DropUnusedPoints(CellTriangles& triangles)
{
  UsedPoints used;
  used.Rows.assign(triangles.Positions.rows(), -1);
  for (int i = 0; i < static_cast<int>(triangles.Corners.size()); ++i)
  {
    used.Rows[triangles.Corners.data()[i]] = 0;
  }
  for (int point = 0; point < static_cast<int>(used.Rows.size()); ++point)
  {
    if (used.Rows[point] == 0)
    {
      used.Rows[point] = static_cast<int>(used.Points.size());
      used.Points.push_back(point);
    }
  }
  const int size = static_cast<int>(used.Points.size());
  if (size == triangles.Positions.rows())
  {
    return used;
  }
  for (int i = 0; i < static_cast<int>(triangles.Corners.size()); ++i)
  {
    triangles.Corners.data()[i] = used.Rows[triangles.Corners.data()[i]];
  }
  for (int row = 0; row < size; ++row)
  {
    triangles.Positions.row(row) = triangles.Positions.row(used.Points[row]).eval();
  }
  triangles.Positions.conservativeResize(size, 3);
  return used;
}

ElementRows RowsOf(int numberOfCells, const std::vector<int>& cellsOfFaces)
{
  ElementRows rows;
  const int size = static_cast<int>(cellsOfFaces.size());
  const bool isSingle = std::adjacent_find(cellsOfFaces.begin(), cellsOfFaces.end()) == cellsOfFaces.end();
  if (isSingle)
  {
    rows.Items.assign(numberOfCells, -1);
    for (int face = 0; face < size; ++face)
    {
      rows.Items[cellsOfFaces[face]] = face;
    }
    return rows;
  }
  rows.Offsets.assign(numberOfCells + 1, 0);
  rows.Items.resize(size);
  for (int face = 0; face < size; ++face)
  {
    ++rows.Offsets[cellsOfFaces[face] + 1];
    rows.Items[face] = face;
  }
  for (int cell = 0; cell < numberOfCells; ++cell)
  {
    rows.Offsets[cell + 1] += rows.Offsets[cell];
  }
  return rows;
}

RepairedSurface Repair(
  const CellTriangles& given, const UsedPoints& used, bool joinPoints, const ExecutionContext& context)
{
  return Repairer(given, used, joinPoints, context).Run();
}

void RefuseSurfaceWithoutArea()
{
  throw InvalidInput("no triangle of the surface has an area, as the corners of each lie on a line; undo what has "
                     "flattened the surface, or take another");
}

}
