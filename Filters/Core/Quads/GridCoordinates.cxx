#include "Quads/GridCoordinates.h"

namespace dmg
{

namespace
{

/// The square to the right of side k of another one, with its own side j there.
CornersInGrid SquareBeyond(const CornersInGrid& square, int k, int j)
{
  const std::array<int, 2> tail = square[k], head = square[(k + 1) % 4];
  const std::array<int, 2> outward{ head[1] - tail[1], tail[0] - head[0] };
  CornersInGrid beyond;
  beyond[j] = head;
  beyond[(j + 1) % 4] = tail;
  beyond[(j + 2) % 4] = { tail[0] + outward[0], tail[1] + outward[1] };
  beyond[(j + 3) % 4] = { head[0] + outward[0], head[1] + outward[1] };
  return beyond;
}

}

std::vector<CornersInGrid> LayOutOnGrid(const QuadTopology& topology)
{
  constexpr CornersInGrid UnitSquare{ { { 0, 0 }, { 1, 0 }, { 1, 1 }, { 0, 1 } } };
  const int size = static_cast<int>(topology.Twins.size()) / 4;
  std::vector<CornersInGrid> squares(size, UnitSquare);
  std::vector<char> isLaidOut(size, 0);
  std::vector<int> queue;
  for (int first = 0; first < size; ++first)
  {
    if (isLaidOut[first])
    {
      continue;
    }
    isLaidOut[first] = 1;
    queue.assign(1, first);
    for (std::size_t next = 0; next < queue.size(); ++next)
    {
      const int quad = queue[next];
      for (int k = 0; k < 4; ++k)
      {
        const int twin = topology.Twins[4 * quad + k];
        if (twin >= 0 && !isLaidOut[twin / 4])
        {
          isLaidOut[twin / 4] = 1;
          squares[twin / 4] = SquareBeyond(squares[quad], k, twin % 4);
          queue.push_back(twin / 4);
        }
      }
    }
  }
  return squares;
}

}
