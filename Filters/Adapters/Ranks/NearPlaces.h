#ifndef dmgNearPlaces_h
#define dmgNearPlaces_h

#include <array>
#include <cstdint>
#include <utility>
#include <vector>

class vtkDataSet;

namespace dmg
{

/// A bound of the roundings of coordinates, over the largest of them, by the type of numbers that holds the points.
double RoundOffOfPoints(vtkDataSet* dataset);

/// Places that are found by others near them.
class NearPlaces
{
public:
  using Place = std::array<double, 3>;

  /// The distance that the precision of these coordinates does not tell from none (RoundingOf of the core).
  static double Rounding(const std::vector<Place>& places);

  /// Borrows the places. \param tolerance two are near each other if no coordinates differ by more. Cost: n log n.
  NearPlaces(const std::vector<Place>& places, double tolerance);

  /// The smallest number of a place near this one; -1 where there is none.
  int First(const Place& place) const;

private:
  /// The keys of the cells of a grid that are at most Tolerance from a place. Two places that are near each other share one.
  std::vector<std::uint64_t> CellsAt(const Place& place) const;
  bool AreNear(const Place& a, const Place& b) const;

  const std::vector<Place>& Places;
  const double Tolerance;
  std::vector<std::pair<std::uint64_t, int>> Entries;
};

}

#endif
