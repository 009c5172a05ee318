#include "Adapters/Ranks/JoinedPieces.h"

#include "Adapters/Ranks/NearPlaces.h"

#include "vtkAppendFilter.h"
#include "vtkAppendPolyData.h"
#include "vtkBoundingBox.h"
#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkDataSetAttributes.h"
#include "vtkFieldData.h"
#include "vtkIdList.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkUnsignedCharArray.h"
#include "vtkUnstructuredGrid.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <numeric>
#include <utility>

namespace dmg
{

namespace
{

/// Leaves out the arrays that are shorter than the elements of a dataset: VTK would copy tuples that are not there.
void RemoveShortArrays(vtkDataSetAttributes* data, vtkIdType elements)
{
  for (int k = data->GetNumberOfArrays() - 1; k >= 0; --k)
  {
    if (data->GetAbstractArray(k)->GetNumberOfTuples() < elements)
    {
      data->RemoveArray(k);
    }
  }
}

bool HasShortArrays(vtkFieldData* data, vtkIdType elements)
{
  for (int k = 0; k < data->GetNumberOfArrays(); ++k)
  {
    if (data->GetAbstractArray(k)->GetNumberOfTuples() < elements)
    {
      return true;
    }
  }
  return false;
}

vtkUnsignedCharArray* GhostArray(vtkDataSetAttributes* data)
{
  return vtkUnsignedCharArray::SafeDownCast(data->GetAbstractArray(vtkDataSetAttributes::GhostArrayName()));
}

/// Hides the cells of hidden points themselves.
void HideCellsOfHiddenPoints(vtkDataSet* piece)
{
  vtkUnsignedCharArray* const points = GhostArray(piece->GetPointData());
  vtkNew<vtkUnsignedCharArray> cells;
  if (vtkUnsignedCharArray* const given = GhostArray(piece->GetCellData()))
  {
    cells->DeepCopy(given);
  }
  else
  {
    cells->SetNumberOfValues(piece->GetNumberOfCells());
    cells->FillValue(0);
  }
  cells->SetName(vtkDataSetAttributes::GhostArrayName());
  vtkNew<vtkIdList> corners;
  for (vtkIdType cell = 0; cell < piece->GetNumberOfCells(); ++cell)
  {
    piece->GetCellPoints(cell, corners);
    const bool isHidden = std::any_of(corners->begin(), corners->end(),
      [points](vtkIdType point) { return (points->GetValue(point) & vtkDataSetAttributes::HIDDENPOINT) != 0; });
    if (isHidden)
    {
      cells->SetValue(cell, cells->GetValue(cell) | vtkDataSetAttributes::HIDDENCELL);
    }
  }
  piece->GetCellData()->AddArray(cells);
}

template <class DataSet>
vtkSmartPointer<vtkDataObject> CopyWithoutGhosts(DataSet* piece)
{
  auto copy = vtkSmartPointer<DataSet>::New();
  copy->ShallowCopy(piece);
  RemoveShortArrays(copy->GetPointData(), copy->GetNumberOfPoints());
  RemoveShortArrays(copy->GetCellData(), copy->GetNumberOfCells());
  if (GhostArray(copy->GetPointData()))
  {
    HideCellsOfHiddenPoints(copy);
  }
  copy->RemoveGhostCells();
  copy->GetCellData()->RemoveArray(vtkDataSetAttributes::GhostArrayName());
  copy->GetPointData()->RemoveArray(vtkDataSetAttributes::GhostArrayName());
  return copy;
}

template <class DataSet>
bool AreAll(const std::vector<vtkSmartPointer<vtkDataObject>>& pieces)
{
  return std::all_of(
    pieces.begin(), pieces.end(), [](const auto& piece) { return DataSet::SafeDownCast(piece) != nullptr; });
}

template <class Append, class DataSet>
vtkSmartPointer<vtkPointSet> Appended(const std::vector<vtkSmartPointer<vtkDataObject>>& pieces)
{
  vtkNew<Append> append;
  for (const auto& piece : pieces)
  {
    // A copy: the pipeline of this one filter writes into the data what was asked for.
    vtkNew<DataSet> copy;
    copy->ShallowCopy(piece);
    append->AddInputData(copy);
  }
  append->Update();
  auto joined = vtkSmartPointer<DataSet>::New();
  joined->ShallowCopy(append->GetOutput());
  joined->GetFieldData()->ShallowCopy(pieces[0]->GetFieldData());
  return joined;
}

std::vector<vtkCellArray*> CellsOf(vtkPointSet* dataset)
{
  auto* const polyData = vtkPolyData::SafeDownCast(dataset);
  std::vector<vtkCellArray*> cells = polyData
    ? std::vector<vtkCellArray*>{ polyData->GetVerts(), polyData->GetLines(), polyData->GetPolys(),
        polyData->GetStrips() }
    : std::vector<vtkCellArray*>{ vtkUnstructuredGrid::SafeDownCast(dataset)->GetCells() };
  const auto isEmpty = [](vtkCellArray* each) { return !each || each->GetNumberOfCells() == 0; };
  cells.erase(std::remove_if(cells.begin(), cells.end(), isEmpty), cells.end());
  return cells;
}

/// Calls visit(point) for the corners of all cells, which it may change.
template <class Visit>
void ForCorners(vtkPointSet* dataset, const Visit& visit)
{
  for (vtkCellArray* const cells : CellsOf(dataset))
  {
    vtkDataArray* const corners = cells->GetConnectivityArray();
    for (vtkIdType k = 0; k < corners->GetNumberOfValues(); ++k)
    {
      const vtkIdType point = static_cast<vtkIdType>(corners->GetComponent(k, 0));
      const vtkIdType other = visit(point);
      if (other != point)
      {
        corners->SetComponent(k, 0, static_cast<double>(other)); // exact up to 2^53
      }
    }
  }
}

/// Numbers that are joined into groups.
class Groups
{
public:
  explicit Groups(vtkIdType size)
    : Parents(size)
  {
    std::iota(this->Parents.begin(), this->Parents.end(), vtkIdType(0));
  }

  /// The smallest number of the group, as far as Join has brought it there.
  vtkIdType Of(vtkIdType number)
  {
    while (this->Parents[number] != number)
    {
      number = this->Parents[number] = this->Parents[this->Parents[number]];
    }
    return number;
  }

  void Join(vtkIdType a, vtkIdType b)
  {
    a = this->Of(a);
    b = this->Of(b);
    this->Parents[std::max(a, b)] = std::min(a, b);
  }

private:
  std::vector<vtkIdType> Parents;
};

/// The points of a dataset that was made of pieces.
class PointsOfPieces
{
public:
  /// \param begins of the points of each piece, and their number.
  PointsOfPieces(vtkPointSet* joined, std::vector<vtkIdType> begins)
    : Joined(joined)
    , Ids(joined->GetPointData()->GetGlobalIds())
    , Begins(std::move(begins))
    , IsUsed(joined->GetNumberOfPoints(), 0)
    , Tolerance(LargestCoordinate(joined) * RoundOffOfPoints(joined))
  {
    ForCorners(joined,
      [this](vtkIdType point)
      {
        this->IsUsed[point] = 1;
        return point;
      });
  }

  /// For each point the one that stands for it.
  std::vector<vtkIdType> Representatives() const
  {
    Groups groups(this->Joined->GetNumberOfPoints());
    const std::vector<Entry> sorted = this->Ids ? this->SortedByIds() : this->SortedByPlaces();
    std::vector<vtkIdType> joined;
    for (std::size_t begin = 0; begin < sorted.size(); ++begin)
    {
      for (std::size_t next = begin + 1; next < sorted.size() && sorted[next].first == sorted[begin].first; ++next)
      {
        const auto [a, b] = std::pair(sorted[begin].second, sorted[next].second);
        if (a != b && this->AreSame(a, b))
        {
          groups.Join(a, b);
          joined.push_back(a);
          joined.push_back(b);
        }
      }
    }
    return this->Representatives(groups, std::move(joined));
  }

private:
  using Place = NearPlaces::Place;
  using Entry = std::pair<std::uint64_t, vtkIdType>; // a key that points share that may be one, and the point

  static double LargestCoordinate(vtkDataSet* dataset)
  {
    double box[6];
    dataset->GetBounds(box);
    return std::abs(*std::max_element(box, box + 6, [](double a, double b) { return std::abs(a) < std::abs(b); }));
  }

  Place PlaceOf(vtkIdType point) const
  {
    Place place;
    this->Joined->GetPoint(point, place.data());
    return place;
  }

  std::size_t PieceOf(vtkIdType point) const
  {
    return std::upper_bound(this->Begins.begin(), this->Begins.end(), point) - this->Begins.begin() - 1;
  }

  bool AreSame(vtkIdType a, vtkIdType b) const
  {
    if (this->Ids)
    {
      return true;
    }
    return this->PieceOf(a) != this->PieceOf(b) &&
      NearPlaces::AreNear(this->PlaceOf(a), this->PlaceOf(b), this->Tolerance);
  }

  std::vector<Entry> SortedByIds() const
  {
    std::vector<Entry> sorted;
    for (vtkIdType point = 0; point < this->Joined->GetNumberOfPoints(); ++point)
    {
      sorted.emplace_back(static_cast<std::uint64_t>(this->Ids->GetComponent(point, 0)), point);
    }
    std::sort(sorted.begin(), sorted.end());
    return sorted;
  }

  /// The points that lie in the box of another piece, by the cells of a grid that are at most Tolerance from them.
  std::vector<Entry> SortedByPlaces() const
  {
    std::vector<Entry> sorted;
    const std::vector<vtkBoundingBox> boxes = this->BoxesOfPieces();
    for (vtkIdType point = 0; point < this->Joined->GetNumberOfPoints(); ++point)
    {
      const Place place = this->PlaceOf(point);
      const std::size_t own = this->PieceOf(point);
      for (std::size_t piece = 0; piece < boxes.size(); ++piece)
      {
        if (piece != own && boxes[piece].ContainsPoint(place.data()))
        {
          this->AddCells(point, place, sorted);
          break;
        }
      }
    }
    std::sort(sorted.begin(), sorted.end());
    return sorted;
  }

  std::vector<vtkBoundingBox> BoxesOfPieces() const
  {
    std::vector<vtkBoundingBox> boxes(this->Begins.size() - 1);
    for (std::size_t piece = 0; piece < boxes.size(); ++piece)
    {
      for (vtkIdType point = this->Begins[piece]; point < this->Begins[piece + 1]; ++point)
      {
        const Place place = this->PlaceOf(point);
        boxes[piece].AddPoint(place[0], place[1], place[2]);
      }
      boxes[piece].Inflate(2.0 * this->Tolerance);
    }
    return boxes;
  }

  void AddCells(vtkIdType point, const Place& place, std::vector<Entry>& entries) const
  {
    for (const std::uint64_t cell : NearPlaces::CellsAt(place, this->Tolerance))
    {
      entries.emplace_back(cell, point);
    }
  }

  /// \param joined the points of groups of several. A point that cells use stands for ones that only ghosts have used.
  std::vector<vtkIdType> Representatives(Groups& groups, std::vector<vtkIdType> joined) const
  {
    std::vector<vtkIdType> representatives(this->IsUsed.size());
    std::iota(representatives.begin(), representatives.end(), vtkIdType(0));
    std::sort(joined.begin(), joined.end());
    joined.erase(std::unique(joined.begin(), joined.end()), joined.end());
    std::map<vtkIdType, std::vector<vtkIdType>> members;
    for (const vtkIdType point : joined)
    {
      members[groups.Of(point)].push_back(point);
    }
    for (const auto& [first, points] : members)
    {
      const auto ofOnePiece = [this](vtkIdType a, vtkIdType b) { return this->PieceOf(a) == this->PieceOf(b); };
      if (!this->Ids && std::adjacent_find(points.begin(), points.end(), ofOnePiece) != points.end())
      {
        continue; // two of one piece are meant to be two
      }
      const auto used =
        std::find_if(points.begin(), points.end(), [this](vtkIdType point) { return this->IsUsed[point] != 0; });
      for (const vtkIdType point : points)
      {
        representatives[point] = used == points.end() ? first : *used;
      }
    }
    return representatives;
  }

  vtkPointSet* const Joined;
  vtkDataArray* const Ids;
  const std::vector<vtkIdType> Begins;
  std::vector<char> IsUsed;
  const double Tolerance; ///< of places: some roundings
};

/// Keeps the points that stand for themselves.
void JoinPoints(vtkPointSet* joined, const std::vector<vtkIdType>& representatives)
{
  const vtkIdType size = joined->GetNumberOfPoints();
  std::vector<vtkIdType> numbers(size, -1);
  vtkNew<vtkIdList> from;
  vtkNew<vtkIdList> to;
  for (vtkIdType point = 0; point < size; ++point)
  {
    if (representatives[point] == point)
    {
      numbers[point] = from->GetNumberOfIds();
      to->InsertNextId(from->GetNumberOfIds());
      from->InsertNextId(point);
    }
  }
  if (from->GetNumberOfIds() == size)
  {
    return;
  }
  vtkNew<vtkPoints> points;
  points->SetDataType(joined->GetPoints()->GetDataType());
  points->SetNumberOfPoints(from->GetNumberOfIds());
  vtkNew<vtkPointData> arrays;
  arrays->CopyAllOn();
  arrays->CopyAllocate(joined->GetPointData(), from->GetNumberOfIds());
  arrays->CopyData(joined->GetPointData(), from, to);
  for (vtkIdType k = 0; k < from->GetNumberOfIds(); ++k)
  {
    points->SetPoint(k, joined->GetPoint(from->GetId(k)));
  }
  ForCorners(joined, [&](vtkIdType point) { return numbers[representatives[point]]; });
  joined->SetPoints(points);
  joined->GetPointData()->ShallowCopy(arrays);
}

vtkSmartPointer<vtkDataObject> AsBlocks(const std::vector<vtkSmartPointer<vtkDataObject>>& pieces)
{
  auto blocks = vtkSmartPointer<vtkMultiBlockDataSet>::New();
  for (const auto& piece : pieces)
  {
    blocks->SetBlock(blocks->GetNumberOfBlocks(), piece);
  }
  return blocks;
}

}

vtkSmartPointer<vtkDataObject> WithoutGhosts(vtkDataObject* piece)
{
  auto* const dataset = vtkDataSet::SafeDownCast(piece);
  if (!dataset ||
    !(GhostArray(dataset->GetCellData()) || GhostArray(dataset->GetPointData()) ||
      HasShortArrays(dataset->GetPointData(), dataset->GetNumberOfPoints()) ||
      HasShortArrays(dataset->GetCellData(), dataset->GetNumberOfCells())))
  {
    return piece;
  }
  if (auto* const polyData = vtkPolyData::SafeDownCast(piece))
  {
    return CopyWithoutGhosts(polyData);
  }
  auto* const grid = vtkUnstructuredGrid::SafeDownCast(piece);
  return grid ? CopyWithoutGhosts(grid) : vtkSmartPointer<vtkDataObject>(piece);
}

vtkSmartPointer<vtkDataObject> JoinedPieces(const std::vector<vtkSmartPointer<vtkDataObject>>& pieces)
{
  if (pieces.size() == 1)
  {
    return pieces[0];
  }
  const bool arePolyData = AreAll<vtkPolyData>(pieces);
  if (!arePolyData && !AreAll<vtkUnstructuredGrid>(pieces))
  {
    return AsBlocks(pieces);
  }
  std::vector<vtkIdType> begins{ 0 };
  for (const auto& piece : pieces)
  {
    begins.push_back(begins.back() + vtkPointSet::SafeDownCast(piece)->GetNumberOfPoints());
  }
  const vtkSmartPointer<vtkPointSet> joined = arePolyData ? Appended<vtkAppendPolyData, vtkPolyData>(pieces)
                                                          : Appended<vtkAppendFilter, vtkUnstructuredGrid>(pieces);
  JoinPoints(joined, PointsOfPieces(joined, std::move(begins)).Representatives());
  return joined;
}

}
