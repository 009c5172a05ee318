#include "Adapters/Ranks/JoinedPieces.h"

#include "Adapters/Data/ShortArrays.h"
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
#include <cstddef>
#include <map>
#include <numeric>

namespace dmg
{

namespace
{

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

/// The number of a point's piece. \param begins of the points of each piece, and their number.
std::ptrdiff_t PieceOf(vtkIdType point, const std::vector<vtkIdType>& begins)
{
  return std::upper_bound(begins.begin(), begins.end(), point) - begins.begin() - 1;
}

std::vector<vtkIdType> AllNumbers(vtkIdType size)
{
  std::vector<vtkIdType> numbers(size);
  std::iota(numbers.begin(), numbers.end(), vtkIdType(0));
  return numbers;
}

/// For each point the first one with the same id.
std::vector<vtkIdType> FirstsByIds(vtkDataArray* ids)
{
  const auto idOf = [ids](vtkIdType point) { return static_cast<vtkIdType>(ids->GetComponent(point, 0)); };
  std::vector<vtkIdType> firsts = AllNumbers(ids->GetNumberOfTuples());
  std::vector<vtkIdType> sorted = firsts;
  std::stable_sort(sorted.begin(), sorted.end(), [&idOf](vtkIdType a, vtkIdType b) { return idOf(a) < idOf(b); });
  for (std::size_t k = 1; k < sorted.size(); ++k)
  {
    if (idOf(sorted[k]) == idOf(sorted[k - 1]))
    {
      firsts[sorted[k]] = firsts[sorted[k - 1]];
    }
  }
  return firsts;
}

std::vector<vtkBoundingBox> BoxesOfPieces(vtkDataSet* joined, const std::vector<vtkIdType>& begins, double margin)
{
  std::vector<vtkBoundingBox> boxes(begins.size() - 1);
  for (std::size_t piece = 0; piece < boxes.size(); ++piece)
  {
    for (vtkIdType point = begins[piece]; point < begins[piece + 1]; ++point)
    {
      boxes[piece].AddPoint(joined->GetPoint(point));
    }
    boxes[piece].Inflate(margin);
  }
  return boxes;
}

/// For each point the first one at the same place, but for some roundings. Only points in the box of another piece are looked at.
std::vector<vtkIdType> FirstsByPlaces(vtkDataSet* joined, const std::vector<vtkIdType>& begins)
{
  double box[6];
  joined->GetBounds(box);
  const double largest =
    std::abs(*std::max_element(box, box + 6, [](double a, double b) { return std::abs(a) < std::abs(b); }));
  const double tolerance = largest * RoundOffOfPoints(joined);
  const std::vector<vtkBoundingBox> boxes = BoxesOfPieces(joined, begins, 2.0 * tolerance);
  std::vector<NearPlaces::Place> places;
  std::vector<vtkIdType> points;
  for (vtkIdType point = 0; point < joined->GetNumberOfPoints(); ++point)
  {
    NearPlaces::Place place;
    joined->GetPoint(point, place.data());
    const auto contains = [&place](const vtkBoundingBox& each) { return each.ContainsPoint(place.data()) != 0; };
    if (std::count_if(boxes.begin(), boxes.end(), contains) > 1) // one is its own
    {
      places.push_back(place);
      points.push_back(point);
    }
  }
  const NearPlaces near(places, tolerance);
  std::vector<vtkIdType> firsts = AllNumbers(joined->GetNumberOfPoints());
  for (std::size_t k = 0; k < places.size(); ++k)
  {
    const int first = near.First(places[k]);
    if (first >= 0) // a coordinate that is not a number is near none, not even itself
    {
      firsts[points[k]] = firsts[points[first]];
    }
  }
  return firsts;
}

/// For each point the one that stands for it, used by cells if any of them is. Two of one piece at the same place are meant to be two.
std::vector<vtkIdType> Representatives(vtkPointSet* joined, const std::vector<vtkIdType>& begins)
{
  vtkDataArray* const ids = joined->GetPointData()->GetGlobalIds();
  std::vector<vtkIdType> firsts = ids ? FirstsByIds(ids) : FirstsByPlaces(joined, begins);
  std::vector<char> isUsed(firsts.size(), 0);
  ForCorners(joined,
    [&isUsed](vtkIdType point)
    {
      isUsed[point] = 1;
      return point;
    });
  std::map<vtkIdType, std::vector<vtkIdType>> groups; // of several points
  for (vtkIdType point = 0; point < joined->GetNumberOfPoints(); ++point)
  {
    if (firsts[point] != point)
    {
      groups.emplace(firsts[point], std::vector<vtkIdType>{ firsts[point] }).first->second.push_back(point);
    }
  }
  const auto areOfOnePiece = [&begins](vtkIdType a, vtkIdType b) { return PieceOf(a, begins) == PieceOf(b, begins); };
  for (const auto& [first, points] : groups)
  {
    const bool areSeveral = !ids && std::adjacent_find(points.begin(), points.end(), areOfOnePiece) != points.end();
    const auto used =
      std::find_if(points.begin(), points.end(), [&isUsed](vtkIdType point) { return isUsed[point] != 0; });
    for (const vtkIdType point : points)
    {
      firsts[point] = areSeveral ? point : used == points.end() ? first : *used;
    }
  }
  return firsts;
}

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
  JoinPoints(joined, Representatives(joined, begins));
  return joined;
}

}
