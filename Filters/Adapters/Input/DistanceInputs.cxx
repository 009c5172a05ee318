#include "Adapters/Input/DistanceInputs.h"

#include "Adapters/Data/WithoutStrips.h"
#include "Adapters/Input/GuideDataSets.h"
#include "Mesh/PositiveSide.h"
#include "Places/NearestPlaces.h"
#include "Support/Errors.h"

#include "vtkCell.h"
#include "vtkCellType.h"
#include "vtkDataArray.h"
#include "vtkDataSet.h"
#include "vtkGenericCell.h"
#include "vtkIdList.h"
#include "vtkNew.h"

#include <algorithm>
#include <iterator>
#include <map>
#include <optional>
#include <utility>

namespace dmg
{
namespace
{

using Polyline = std::vector<vtkIdType>;

/// Segments between points of a dataset, in the order in which they come.
using Segments = std::vector<std::pair<vtkIdType, vtkIdType>>;

/// Joins segments at points where one of them ends and one begins. \return closed ones have their first point again at their end.
std::vector<Polyline> Joined(const Segments& segments)
{
  std::map<vtkIdType, std::size_t> from; // a segment that begins at a point
  std::map<vtkIdType, int> beginnings, ends;
  for (std::size_t k = 0; k < segments.size(); ++k)
  {
    from[segments[k].first] = k;
    ++beginnings[segments[k].first];
    ++ends[segments[k].second];
  }
  const auto next = [&](vtkIdType point)
  {
    const bool goesOn = beginnings[point] == 1 && ends[point] == 1;
    return goesOn ? from[point] : segments.size();
  };
  std::vector<char> isTaken(segments.size(), 0);
  std::vector<Polyline> lines;
  const auto follow = [&](std::size_t k)
  {
    Polyline line = { segments[k].first };
    for (; k < segments.size() && !isTaken[k]; k = next(line.back()))
    {
      isTaken[k] = 1;
      line.push_back(segments[k].second);
    }
    lines.push_back(std::move(line));
  };
  for (const bool isOpen : { true, false }) // loops have no beginning
  {
    for (std::size_t k = 0; k < segments.size(); ++k)
    {
      if (!isTaken[k] && !(isOpen && next(segments[k].first) == k))
      {
        follow(k);
      }
    }
  }
  return lines;
}

/// Reads the cells of a dataset as sources.
class CellReader
{
public:
  explicit CellReader(vtkDataSet* dataset)
  {
    vtkNew<vtkGenericCell> cell;
    vtkNew<vtkIdList> points;
    for (vtkIdType k = 0; k < dataset->GetNumberOfCells(); ++k)
    {
      const int type = dataset->GetCellType(k);
      dataset->GetCellPoints(k, points);
      if (type == VTK_VERTEX || type == VTK_POLY_VERTEX)
      {
        this->Points.insert(this->Points.end(), points->begin(), points->end());
      }
      else if (type == VTK_LINE && points->GetNumberOfIds() == 2)
      {
        this->Lines.emplace_back(points->GetId(0), points->GetId(1));
      }
      else if (type == VTK_POLY_LINE && points->GetNumberOfIds() > 1)
      {
        this->Polylines.emplace_back(points->begin(), points->end());
      }
      else if (type != VTK_EMPTY_CELL)
      {
        dataset->GetCell(k, cell);
        this->AddPolygon(cell, k);
      }
    }
  }

  /// Polylines, and lines that follow each other.
  std::vector<Polyline> AllLines() const
  {
    std::vector<Polyline> all = this->Polylines;
    const std::vector<Polyline> joined = Joined(this->Lines);
    all.insert(all.end(), joined.begin(), joined.end());
    return all;
  }

  /// With polygons to the left, seen from where their corners run counter-clockwise.
  std::vector<Polyline> Outlines() const
  {
    Segments outline;
    for (const auto& [tail, head] : this->SidesInOrder)
    {
      if (this->Polygons.count({ head, tail }) == 0)
      {
        outline.emplace_back(tail, head);
      }
    }
    return Joined(outline);
  }

  /// The polygon beside a side of an outline.
  vtkIdType PolygonOf(vtkIdType tail, vtkIdType head) const { return this->Polygons.at({ tail, head }); }

  Polyline Points;

private:
  void AddPolygon(vtkCell* cell, vtkIdType number)
  {
    const bool isPixel = cell->GetCellType() == VTK_PIXEL; // its two last sides run backwards
    for (int k = 0; cell->GetCellDimension() == 2 && k < cell->GetNumberOfEdges(); ++k)
    {
      vtkIdList* const side = cell->GetEdge(k)->GetPointIds();
      std::pair<vtkIdType, vtkIdType> ends(side->GetId(0), side->GetId(1));
      if (isPixel && k > 1)
      {
        std::swap(ends.first, ends.second);
      }
      if (ends.first != ends.second && this->Polygons.emplace(ends, number).second)
      {
        this->SidesInOrder.push_back(ends);
      }
    }
  }

  Segments Lines;
  std::vector<Polyline> Polylines;
  Segments SidesInOrder;                                         ///< of polygons, each with its polygon to the left
  std::map<std::pair<vtkIdType, vtkIdType>, vtkIdType> Polygons; ///< by side
};

/// Says on which side of outlines the polygons of a dataset lie.
class SideOfPolygons
{
public:
  /// Borrows all.
  SideOfPolygons(const SurfaceView& view, const GuideDataSet& dataset, const CellReader& cells)
    : View(view)
    , DataSet(dataset)
    , Cells(cells)
    , Nearest(view.Surface().Geometry)
    , Sides(FindSides(view.Mesh()))
  {
  }

  /// Whether they are to the left of a line, seen from the positive side of the surface, along most of its length.
  bool IsLeft(const Polyline& line, const std::vector<Vector3>& places) const
  {
    double left = 0.0;
    for (std::size_t k = 0; k + 1 < line.size(); ++k)
    {
      const Vector3 along = places[k + 1] - places[k], middle = 0.5 * (places[k + 1] + places[k]);
      const Vector3 inwards = this->CentreOf(this->Cells.PolygonOf(line[k], line[k + 1])) - middle;
      left += along.norm() * (along.cross(inwards).dot(this->UpAt(middle)) > 0.0 ? 1.0 : -1.0);
    }
    return left >= 0.0;
  }

private:
  Vector3 CentreOf(vtkIdType polygon) const
  {
    vtkNew<vtkIdList> corners;
    this->DataSet.Data->GetCellPoints(polygon, corners);
    Vector3 sum = Vector3::Zero();
    for (const vtkIdType point : *corners)
    {
      sum += this->View.PlaceForth(PositionOf(this->DataSet, point));
    }
    return sum / static_cast<double>(corners->GetNumberOfIds());
  }

  /// A normal of the positive side, of any length.
  Vector3 UpAt(const Vector3& position) const
  {
    const int face = this->Nearest(position).Face;
    const auto corner = [&](int k) { return this->View.Mesh().Position(this->View.Mesh().Tail(3 * face + k)); };
    if (face < 0)
    {
      return Vector3::Zero();
    }
    const Vector3 normal = (corner(1) - corner(0)).cross(corner(2) - corner(0));
    return this->Sides.OfFaces.size() == 0 || this->Sides.OfFaces[face] > 0.0 ? normal : Vector3(-normal);
  }

  const SurfaceView& View;
  const GuideDataSet& DataSet;
  const CellReader& Cells;
  const NearestPlaces Nearest;
  const SidesOfSurface Sides;
};

const InputWords SourceWords{ "source", "points, lines or polygons to Sources" };
const InputWords TargetWords{ "target", "points to Targets" };

}

void AddSourcesFrom(const std::vector<vtkDataObject*>& datasets, const SurfaceView& view, DistanceSources& sources)
{
  for (GuideDataSet dataset : DataSetsOf(datasets, SourceWords))
  {
    dataset.Data = WithoutStrips(dataset.Data);
    const CellReader cells(dataset.Data);
    const auto placeOf = [&](vtkIdType point) { return view.PlaceForth(PositionOf(dataset, point)); };
    const auto placesOf = [&](const Polyline& line)
    {
      std::vector<Vector3> places;
      std::transform(line.begin(), line.end(), std::back_inserter(places), placeOf);
      return places;
    };
    for (const vtkIdType point : cells.Points)
    {
      sources.Points.push_back(placeOf(point));
    }
    const std::vector<Polyline> lines = cells.AllLines();
    std::transform(lines.begin(), lines.end(), std::back_inserter(sources.Lines), placesOf);
    const std::vector<Polyline> outlines = cells.Outlines();
    std::optional<SideOfPolygons> side;
    for (const Polyline& outline : outlines)
    {
      std::vector<Vector3> places = placesOf(outline);
      if (!side)
      {
        side.emplace(view, dataset, cells);
      }
      if (!side->IsLeft(outline, places))
      {
        std::reverse(places.begin(), places.end());
      }
      sources.Lines.push_back(std::move(places));
    }
    const bool isOfPoints = cells.Points.empty() && lines.empty() && outlines.empty();
    for (vtkIdType point = 0; isOfPoints && point < dataset.Data->GetNumberOfPoints(); ++point)
    {
      sources.Points.push_back(placeOf(point));
    }
  }
}

bool AddMaskedSources(const ChosenArray& mask, const SurfaceView& view, DistanceSources& sources)
{
  const ChosenArray chosen = FindArray(mask, view.Given(), 1, "mask", "the surface");
  if (!chosen.Array)
  {
    return false;
  }
  const TriangleMesh& mesh = view.Mesh();
  const auto isChosen = [&chosen](vtkIdType element)
  {
    const double number = chosen.Array->GetComponent(element, 0);
    return number < 0.0 || number > 0.0;
  };
  std::vector<char> isAt(mesh.NumberOfVertices(), 0);
  for (vtkIdType point = 0; chosen.OnPoints() && point < view.Given()->GetNumberOfPoints(); ++point)
  {
    for (const int vertex : view.Relation().VerticesOf(point))
    {
      isAt[vertex] |= isChosen(point) ? 1 : 0; // also where the point was joined to another one
    }
  }
  std::vector<char> isInRegion(mesh.NumberOfVertices(), 0);
  sources.Region.assign(mesh.NumberOfFaces(), 0);
  for (int face = 0; face < mesh.NumberOfFaces(); ++face)
  {
    const auto corner = [&](int k) { return mesh.Tail(3 * face + k); };
    sources.Region[face] = chosen.OnPoints() ? isAt[corner(0)] & isAt[corner(1)] & isAt[corner(2)]
                                             : static_cast<char>(isChosen(view.Relation().CellOf(face)));
    for (int k = 0; k < 3; ++k)
    {
      isInRegion[corner(k)] |= sources.Region[face];
    }
  }
  for (int vertex = 0; vertex < mesh.NumberOfVertices(); ++vertex)
  {
    if (isAt[vertex] && !isInRegion[vertex])
    {
      sources.Vertices.push_back(vertex);
    }
  }
  return true;
}

void AddNearestSource(const Vector3& point, const SurfaceView& view, DistanceSources& sources)
{
  if (!point.allFinite())
  {
    throw InvalidInput("Point is not finite; give three numbers");
  }
  const NearestPlace place = NearestPlaces(view.Surface().Geometry)(view.PlaceForth(point));
  if (place.Face < 0)
  {
    throw InvalidInput("Point is too far from the surface to compute with; move it nearer");
  }
  sources.Points.push_back(place.Position);
}

std::vector<Vector3> TargetsFrom(const std::vector<vtkDataObject*>& datasets, const SurfaceView& view)
{
  std::vector<Vector3> targets;
  for (const GuideDataSet& dataset : DataSetsOf(datasets, TargetWords))
  {
    for (vtkIdType point = 0; point < dataset.Data->GetNumberOfPoints(); ++point)
    {
      targets.push_back(view.PlaceForth(PositionOf(dataset, point)));
    }
  }
  return targets;
}

}
