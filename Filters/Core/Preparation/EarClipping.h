#ifndef dmgEarClipping_h
#define dmgEarClipping_h

#include "Support/ExecutionContext.h"
#include "Support/Types.h"

#include <functional>
#include <set>
#include <utility>
#include <vector>

namespace dmg
{

/// Cuts one polygon after another into triangles; see Triangulate. Keeps its memory for the next one.
class PolygonCutter
{
public:
  /// \param context whose Checkpoint is called now and then; null inside of a ParallelFor.
  explicit PolygonCutter(const Points& positions, const ExecutionContext* context = nullptr)
    : Positions(positions)
    , Context(context)
  {
  }

  /// \param triangles gets 3 corners for each of n - 2 triangles, one for n of 1 or 2.
  void operator()(const int* corners, int n, int* triangles);

  /// Takes a diagonal between two points for which \p isTaken only where there is no other.
  void Avoid(std::function<bool(int, int)> isTaken) { this->IsTaken = std::move(isTaken); }

private:
  bool Avoids(int a, int b) const { return this->IsTaken && this->IsTaken(a, b); }
  void Start(const int* corners, int n);
  void Add(int a, int b, int c);
  void CutQuad();
  void CutEars();
  /// Projects the corners along the mean normal. \return whether there is one.
  bool Project();
  double Cross(int a, int b, int c) const;
  /// The shape of an ear; negative where it is none.
  double Quality(int corner) const;
  bool HasCornerInside(int a, int b, int c) const;
  /// Sorts the reflex corners into the cells of a grid over the plane.
  void SortReflex();
  /// The cell of a grid along an axis, in [0, GridSize).
  int Along(int axis, double x) const;
  void Rate(int corner);
  void RateAll();

  const Points& Positions;
  const ExecutionContext* const Context;
  std::function<bool(int, int)> IsTaken;
  std::vector<int> Ring; ///< corners, from the smallest on, without repeated ones
  int* Next = nullptr;   ///< where the next triangle goes

  std::vector<Vector2> Plane; ///< the ring in the plane
  std::vector<int> After, Before;
  std::vector<char> IsReflex;
  std::vector<std::vector<int>> Reflex; ///< by cell of the grid
  int GridSize = 1;                     ///< cells along each axis
  Vector2 GridOrigin, GridStep;
  std::vector<double> Qualities;
  std::set<std::pair<double, int>> Ears; ///< (minus quality, corner of the ring)
};

}

#endif
