#include "Pieces/Surface/JoinedTriangles.h"

#include "Pieces/Surface/SeamSides.h"

#include <algorithm>

namespace dmg
{

JoinedTriangles Join(
  const std::vector<PlaceOnRank>& labels, const std::vector<Vector3>& positions, const ExecutionContext& context)
{
  std::vector<PlaceOnRank> ascending = labels;
  std::sort(ascending.begin(), ascending.end());
  ascending.erase(std::unique(ascending.begin(), ascending.end()), ascending.end());
  Triangles corners(static_cast<Eigen::Index>(labels.size() / 3), 3);
  std::vector<Vector3> places(ascending.size());
  for (std::size_t h = 0; h < labels.size(); ++h)
  {
    const auto place = std::lower_bound(ascending.begin(), ascending.end(), labels[h]) - ascending.begin();
    corners.data()[h] = static_cast<int>(place);
    places[place] = positions[h];
  }
  const FansOfPiece fans = FansAround(static_cast<int>(ascending.size()), corners, context);
  JoinedTriangles result{ Points(static_cast<Eigen::Index>(fans.OfPoints.size()), 3), fans.Corners, {} };
  for (std::size_t vertex = 0; vertex < fans.OfPoints.size(); ++vertex)
  {
    result.Positions.row(vertex) = places[fans.OfPoints[vertex]].transpose();
    result.Labels.push_back(ascending[fans.OfPoints[vertex]]);
  }
  return result;
}

}
