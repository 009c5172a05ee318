#include "Adapters/View/GlobeLayout.h"

#include "Adapters/Data/HiddenCells.h"
#include "Adapters/Ranks/NearPlaces.h"
#include "Adapters/View/EastAndNorth.h"
#include "Flows/PeriodicSurfaces.h"
#include "Mesh/Globe.h"

#include "vtkIdList.h"
#include "vtkNew.h"
#include "vtkPointSet.h"
#include "vtkPoints.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <numeric>

namespace dmg
{
namespace
{

constexpr double Rounding = 16.0 / (1 << 23); // of single precision

Vector3 PointOf(vtkDataSet* dataset, vtkIdType point)
{
  Vector3 place;
  dataset->GetPoint(point, place.data());
  return place;
}

/// Calls visit(cell, points) for all cells that may be polygons.
template <class Visit>
void ForCells(vtkDataSet* dataset, const Visit& visit)
{
  vtkNew<vtkIdList> points;
  for (vtkIdType cell = 0; cell < dataset->GetNumberOfCells(); ++cell)
  {
    dataset->GetCellPoints(cell, points);
    if (points->GetNumberOfIds() > 2)
    {
      visit(cell, points.Get());
    }
  }
}

/// The mean of points, at their mean distance from the origin.
Vector3 MeanOnSphere(vtkDataSet* dataset, vtkIdList* points)
{
  Vector3 sum = Vector3::Zero();
  double distances = 0.0;
  for (const vtkIdType point : *points)
  {
    const Vector3 place = PointOf(dataset, point);
    sum += place;
    distances += place.norm();
  }
  return distances / static_cast<double>(points->GetNumberOfIds()) * sum.stableNormalized();
}

/// Whether two points face each other across an axis.
bool AreOpposite(const Vector3& p, const Vector3& q, const Vector3& axis)
{
  constexpr double Straight = 1e-3; // an angle, as coordinates near a pole are rounded
  const Vector3 a = axis.cross(p), b = axis.cross(q);
  const double lengths = a.norm() * b.norm();
  return lengths > Rounding * Rounding * p.squaredNorm() && a.dot(b) < 0.0 && a.cross(b).norm() < Straight * lengths &&
    axis.dot(p) * axis.dot(q) > 0.0;
}

/// Whether two sides at least go through the axis.
bool ReachesOverPole(vtkDataSet* globe, vtkIdList* points, const Vector3& axis)
{
  int sides = 0;
  const vtkIdType size = points->GetNumberOfIds();
  for (vtkIdType k = 0; k < size; ++k)
  {
    const Vector3 p = PointOf(globe, points->GetId(k)), q = PointOf(globe, points->GetId((k + 1) % size));
    sides += AreOpposite(p, q, axis) ? 1 : 0;
  }
  return sides > 1;
}

/// The area of the cells over that of the sphere, about.
double ShareOfSphere(vtkDataSet* globe)
{
  Vector3 sum;
  double areas = 0.0, squares = 0.0;
  ForCells(globe,
    [&](vtkIdType, vtkIdList* points)
    {
      sum.setZero();
      const Vector3 first = PointOf(globe, points->GetId(0));
      for (vtkIdType k = 1; k + 1 < points->GetNumberOfIds(); ++k)
      {
        const Vector3 p = PointOf(globe, points->GetId(k)), q = PointOf(globe, points->GetId(k + 1));
        sum += 0.5 * (p - first).cross(q - first);
      }
      areas += sum.norm();
      squares = std::max(squares, first.squaredNorm());
    });
  return areas / (4.0 * Pi * squares);
}

/// Finds, for places, the first of some points there.
class PointsAtPlaces
{
public:
  PointsAtPlaces(vtkDataSet* dataset, std::vector<vtkIdType> points)
    : Points(std::move(points))
    , Places(PlacesOf(dataset, this->Points))
    , Near(this->Places, RoundingOfAll(dataset))
  {
  }

  /// -1 where there is none.
  vtkIdType At(vtkDataSet* dataset, vtkIdType point) const
  {
    NearPlaces::Place place;
    dataset->GetPoint(point, place.data());
    const int first = this->Near.First(place);
    return first < 0 ? -1 : this->Points[first];
  }

private:
  static double RoundingOfAll(vtkDataSet* dataset)
  {
    std::vector<vtkIdType> all(dataset->GetNumberOfPoints());
    std::iota(all.begin(), all.end(), 0);
    return NearPlaces::Rounding(PlacesOf(dataset, all));
  }

  static std::vector<NearPlaces::Place> PlacesOf(vtkDataSet* dataset, const std::vector<vtkIdType>& points)
  {
    std::vector<NearPlaces::Place> places(points.size());
    for (std::size_t k = 0; k < points.size(); ++k)
    {
      dataset->GetPoint(points[k], places[k].data());
    }
    return places;
  }

  const std::vector<vtkIdType> Points;
  const std::vector<NearPlaces::Place> Places;
  const NearPlaces Near;
};

}

GlobeLayout::GlobeLayout(vtkDataSet* globe, const Vector3& axis)
  : Axis(UnitAxis(axis))
{
  this->Result = globe;
  if (vtkPointSet::SafeDownCast(globe) && vtkPointSet::SafeDownCast(globe)->GetPoints())
  {
    this->MovePointsBeyondPoles();
    this->HideTwins();
  }
}

std::optional<Vector3> GlobeLayout::PlaceOfCell(vtkIdType cell) const
{
  const auto found = std::lower_bound(this->CellsOverPoles.begin(), this->CellsOverPoles.end(), cell,
    [](const auto& entry, vtkIdType other) { return entry.first < other; });
  return found == this->CellsOverPoles.end() || found->first != cell ? std::nullopt
                                                                     : std::optional<Vector3>(found->second);
}

void GlobeLayout::MovePointsBeyondPoles()
{
  vtkDataSet* const globe = this->Result;
  const Vector3& axis = this->Axis;
  enum Use : char
  {
    Over = 1,     // by cells that reach over a pole
    Elsewhere = 2 // by others
  };
  std::vector<char> uses(globe->GetNumberOfPoints(), 0);
  ForCells(globe,
    [&](vtkIdType cell, vtkIdList* points)
    {
      const char use = ReachesOverPole(globe, points, axis) ? Over : Elsewhere;
      if (use == Over)
      {
        this->CellsOverPoles.emplace_back(cell, MeanOnSphere(globe, points));
      }
      std::for_each(points->begin(), points->end(), [&](vtkIdType point) { uses[point] |= use; });
    });
  std::vector<vtkIdType> around, beyond;
  for (vtkIdType point = 0; point < globe->GetNumberOfPoints(); ++point)
  {
    if ((uses[point] & Over) != 0)
    {
      ((uses[point] & Elsewhere) != 0 ? around : beyond).push_back(point);
    }
  }
  if (beyond.empty())
  {
    this->CellsOverPoles.clear();
    return;
  }
  const PointsAtPlaces twins(globe, std::move(around));
  const auto copy = vtk::TakeSmartPointer(vtkPointSet::SafeDownCast(globe->NewInstance()));
  copy->ShallowCopy(globe);
  vtkNew<vtkPoints> points;
  points->DeepCopy(copy->GetPoints());
  for (const vtkIdType point : beyond)
  {
    const Vector3 place = PointOf(globe, point);
    const Vector3 pole = std::copysign(place.norm(), axis.dot(place)) * axis;
    points->SetPoint(point, pole.data());
    if (const vtkIdType twin = twins.At(globe, point); twin >= 0)
    {
      this->TwinPoints.emplace_back(point, twin);
    }
  }
  copy->SetPoints(points);
  this->Result = copy;
}

void GlobeLayout::HideTwins()
{
  vtkDataSet* const globe = this->Result;
  if (ShareOfSphere(globe) <= 1.0)
  {
    return;
  }
  std::vector<vtkIdType> all(globe->GetNumberOfPoints());
  for (vtkIdType point = 0; point < globe->GetNumberOfPoints(); ++point)
  {
    all[point] = point;
  }
  const PointsAtPlaces firsts(globe, all);
  std::vector<char> isHidden(globe->GetNumberOfCells(), 0), isUsed(all.size(), 0);
  std::map<std::vector<vtkIdType>, vtkIdType> known; // by the points that stand for their corners
  ForCells(globe,
    [&](vtkIdType cell, vtkIdList* points)
    {
      std::vector<vtkIdType> corners;
      std::for_each(
        points->begin(), points->end(), [&](vtkIdType point) { corners.push_back(firsts.At(globe, point)); });
      std::sort(corners.begin(), corners.end());
      const auto [first, isNew] = known.emplace(std::move(corners), cell);
      if (!isNew)
      {
        isHidden[cell] = 1;
        this->TwinCells.emplace_back(cell, first->second);
        return;
      }
      std::for_each(points->begin(), points->end(), [&](vtkIdType point) { isUsed[point] = 1; });
    });
  if (this->TwinCells.empty())
  {
    return;
  }
  for (const vtkIdType point : all)
  {
    if (const vtkIdType first = firsts.At(globe, point); !isUsed[point] && first >= 0 && isUsed[first])
    {
      this->TwinPoints.emplace_back(point, first);
    }
  }
  this->Result = WithHidden(globe, isHidden);
}

bool GlobeLayout::IsPole(const Vector3& place) const
{
  return DirectionsOnGlobe(this->Axis, place).East.isZero(0.0);
}

void GlobeLayout::ArrayBack(const AddedArray& added, const SurfaceRelation&) const
{
  for (const auto& [twin, other] : added.IsOfPoints ? this->TwinPoints : this->TwinCells)
  {
    added.Array->SetTuple(twin, other, added.Array);
  }
}

std::string GlobeLayout::Warning(const TriangleMesh& mesh) const
{
  return WarningOfSlit(mesh, this->Axis);
}

}
