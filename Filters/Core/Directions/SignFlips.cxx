#include "Directions/SignFlips.h"

#include <cmath>

namespace dmg
{

bool FlipsLikeAxes(
  const TriangleMesh& mesh, const TangentFrames& frames, const Vector<Complex>& directions, bool areAtVertices)
{
  constexpr double LargestShare = 0.05;
  constexpr double LeastRatio = 2.0;
  long long pairs = 0, flips = 0, turns = 0;
  for (int edge = 0; edge < mesh.NumberOfEdges(); ++edge)
  {
    const int h = mesh.HalfedgeOf(edge);
    if (!areAtVertices && mesh.Twin(h) < 0)
    {
      continue;
    }
    const int a = areAtVertices ? mesh.Tail(h) : TriangleMesh::FaceOf(h);
    const int b = areAtVertices ? mesh.Head(h) : TriangleMesh::FaceOf(mesh.Twin(h));
    if (directions[a] == 0.0 || directions[b] == 0.0)
    {
      continue;
    }
    const double angle = std::abs(std::arg(TransportTurn(frames, a, frames, b) * directions[a] / directions[b]));
    ++pairs;
    flips += angle > 0.75 * Pi ? 1 : 0;
    turns += angle > 0.25 * Pi && angle <= 0.75 * Pi ? 1 : 0;
  }
  return flips > LargestShare * pairs && flips >= LeastRatio * turns;
}

}
