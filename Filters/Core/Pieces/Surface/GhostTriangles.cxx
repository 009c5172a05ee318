#include "Pieces/Surface/GhostTriangles.h"

#include <algorithm>
#include <set>

namespace dmg
{

namespace
{

int NextSide(int side)
{
  return side % 3 == 2 ? side - 2 : side + 1;
}

/// A triangle for the owner of one of its vertices.
struct TriangleAt
{
  int Vertex; ///< the number at the owner
  TravellingTriangle Triangle;
};

std::vector<char> FansAtSeams(const FansOfPiece& fans, const std::vector<SeamSide>& seams)
{
  std::vector<char> areAtSeams(fans.OfPoints.size(), 0);
  for (const SeamSide& seam : seams)
  {
    areAtSeams[fans.Corners.data()[seam.Here]] = 1;
    areAtSeams[fans.Corners.data()[NextSide(seam.Here)]] = 1;
  }
  return areAtSeams;
}

TravellingTriangle TriangleOf(
  int rank, const SurfacePiece& piece, const FansOfPiece& fans, const std::vector<PlaceOnRank>& joined, int triangle)
{
  TravellingTriangle travelling;
  travelling.Place = { rank, triangle };
  for (int k = 0; k < 3; ++k)
  {
    travelling.Vertices[k] = joined[fans.Corners(triangle, k)];
    for (int axis = 0; axis < 3; ++axis)
    {
      travelling.Positions[k][axis] = piece.Positions(piece.Corners(triangle, k), axis);
    }
  }
  return travelling;
}

/// Sends all triangles around a vertex to all ranks that have one there.
std::vector<std::vector<TravellingTriangle>> ToAllAround(const Ranks& ranks, std::vector<TriangleAt> collected)
{
  std::sort(collected.begin(), collected.end(),
    [](const TriangleAt& a, const TriangleAt& b)
    { return a.Vertex != b.Vertex ? a.Vertex < b.Vertex : a.Triangle.Place < b.Triangle.Place; });
  std::vector<std::vector<TravellingTriangle>> toRanks(ranks.Size());
  for (auto first = collected.begin(), last = first; first != collected.end(); first = last)
  {
    std::set<int> around;
    for (; last != collected.end() && last->Vertex == first->Vertex; ++last)
    {
      around.insert(last->Triangle.Place.Rank);
    }
    for (const int rank : around)
    {
      for (auto at = first; at != last; ++at)
      {
        if (at->Triangle.Place.Rank != rank)
        {
          toRanks[rank].push_back(at->Triangle);
        }
      }
    }
  }
  return toRanks;
}

}

std::vector<TravellingTriangle> GhostTriangles(const Ranks& ranks, const SurfacePiece& piece, const FansOfPiece& fans,
  const std::vector<SeamSide>& seams, const std::vector<PlaceOnRank>& joined)
{
  const long long triangles = fans.Corners.rows();
  std::vector<TravellingTriangle> first;
  if (ranks.SumBefore(triangles) == 0 && triangles > 0)
  {
    first.push_back(TriangleOf(ranks.Rank(), piece, fans, joined, 0));
  }
  first = ranks.GatherToAll(first).Items;
  const std::vector<char> areAtSeams = FansAtSeams(fans, seams);
  std::vector<std::vector<TriangleAt>> toOwners(ranks.Size());
  for (int triangle = 0; triangle < fans.Corners.rows(); ++triangle)
  {
    for (int k = 0; k < 3; ++k)
    {
      if (const int fan = fans.Corners(triangle, k); areAtSeams[fan])
      {
        toOwners[joined[fan].Rank].push_back(
          { joined[fan].Number, TriangleOf(ranks.Rank(), piece, fans, joined, triangle) });
      }
    }
  }
  std::vector<TravellingTriangle> ghosts = ranks.Exchange(ToAllAround(ranks, ranks.Exchange(toOwners).Items)).Items;
  std::sort(ghosts.begin(), ghosts.end(),
    [](const TravellingTriangle& a, const TravellingTriangle& b) { return a.Place < b.Place; });
  ghosts.erase(std::unique(ghosts.begin(), ghosts.end(),
                 [](const TravellingTriangle& a, const TravellingTriangle& b) { return a.Place == b.Place; }),
    ghosts.end());
  return triangles > 0 ? ghosts : first;
}

}
