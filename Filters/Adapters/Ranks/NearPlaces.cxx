#include "Adapters/Ranks/NearPlaces.h"

#include "Preparation/CoincidingPoints.h"
#include "Support/Hash.h"

#include "vtkPointSet.h"
#include "vtkPoints.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace dmg
{

double RoundOffOfPoints(vtkDataSet* dataset)
{
  auto* const points = vtkPointSet::SafeDownCast(dataset);
  const bool areSingle = points && points->GetPoints() && points->GetPoints()->GetDataType() != VTK_DOUBLE;
  return areSingle ? 4.0 * std::numeric_limits<float>::epsilon() : 8.0 * std::numeric_limits<double>::epsilon();
}

double NearPlaces::Rounding(const std::vector<Place>& places)
{
  Points positions(static_cast<Eigen::Index>(places.size()), 3);
  for (std::size_t k = 0; k < places.size(); ++k)
  {
    positions.row(static_cast<Eigen::Index>(k)) << places[k][0], places[k][1], places[k][2];
  }
  return RoundingOf(positions);
}

std::vector<std::uint64_t> NearPlaces::CellsAt(const Place& place) const
{
  const double tolerance = this->Tolerance;
  const double width = std::max(16.0 * tolerance, std::numeric_limits<double>::min());
  std::vector<std::uint64_t> cells(8);
  for (int corner = 0; corner < 8; ++corner)
  {
    std::uint64_t hash = 0;
    for (int k = 0; k < 3; ++k)
    {
      const double side = ((corner >> k) & 1) != 0 ? tolerance : -tolerance;
      const auto cell = static_cast<std::int64_t>(std::floor((place[k] + side) / width));
      hash = MixHash(hash, static_cast<std::uint64_t>(cell));
    }
    cells[corner] = hash;
  }
  std::sort(cells.begin(), cells.end());
  cells.erase(std::unique(cells.begin(), cells.end()), cells.end());
  return cells;
}

bool NearPlaces::AreNear(const Place& a, const Place& b) const
{
  return std::equal(
    a.begin(), a.end(), b.begin(), [this](double x, double y) { return std::abs(x - y) <= this->Tolerance; });
}

NearPlaces::NearPlaces(const std::vector<Place>& places, double tolerance)
  : Places(places)
  , Tolerance(tolerance)
{
  for (std::size_t k = 0; k < places.size(); ++k)
  {
    for (const std::uint64_t cell : this->CellsAt(places[k]))
    {
      this->Entries.emplace_back(cell, static_cast<int>(k));
    }
  }
  std::sort(this->Entries.begin(), this->Entries.end());
}

int NearPlaces::First(const Place& place) const
{
  int first = -1;
  for (const std::uint64_t cell : this->CellsAt(place))
  {
    auto entry = std::lower_bound(this->Entries.begin(), this->Entries.end(), std::pair(cell, 0));
    for (; entry != this->Entries.end() && entry->first == cell; ++entry)
    {
      if ((first < 0 || entry->second < first) && this->AreNear(this->Places[entry->second], place))
      {
        first = entry->second;
      }
    }
  }
  return first;
}

}
