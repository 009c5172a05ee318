#ifndef dmgEarClipping_h
#define dmgEarClipping_h

#include "Support/Types.h"

#include <set>
#include <utility>
#include <vector>

namespace dmg
{

/// Cuts one polygon after another into triangles; see Triangulate. Keeps its memory for the next one.
class PolygonCutter
{
public:
  explicit PolygonCutter(const Points& positions)
    : Positions(positions)
  {
  }

  /// \param triangles gets 3 corners for each of n - 2 triangles, one for n of 1 or 2.
  void operator()(const int* corners, int n, int* triangles);

private:
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
  void Rate(int corner);
  void RateAll();

  const Points& Positions;
  std::vector<int> Ring; ///< corners, from the smallest on, without repeated ones
  int* Next = nullptr;   ///< where the next triangle goes

  std::vector<Vector2> Plane; ///< the ring in the plane
  std::vector<int> After, Before;
  std::vector<char> IsReflex;
  std::vector<int> Reflex;
  std::vector<double> Qualities;
  std::set<std::pair<double, int>> Ears; ///< (minus quality, corner of the ring)
};

}

#endif
