#include "Partitions.h"

#include "Support/AllIndices.h"

#include <algorithm>
#include <limits>
#include <random>

namespace dmg::test
{

namespace
{

Vector3 CentreOf(const Surface& surface, int triangle)
{
  Vector3 sum = Vector3::Zero();
  for (int k = 0; k < 3; ++k)
  {
    sum += surface.V.row(surface.F(triangle, k)).transpose();
  }
  return sum / 3.0;
}

std::vector<int> InOrder(const Surface& surface, int numberOfRanks)
{
  const long long triangles = surface.F.rows();
  std::vector<int> ranks;
  for (long long triangle = 0; triangle < triangles; ++triangle)
  {
    ranks.push_back(static_cast<int>(triangle * numberOfRanks / triangles));
  }
  return ranks;
}

/// Five tiles for each rank, around random triangles.
std::vector<int> RandomTiles(const Surface& surface, int numberOfRanks)
{
  std::mt19937 random(20261126);
  std::uniform_int_distribution<int> any(0, static_cast<int>(surface.F.rows()) - 1);
  std::vector<Vector3> centres;
  for (int tile = 0; tile < 5 * numberOfRanks; ++tile)
  {
    centres.push_back(CentreOf(surface, any(random)));
  }
  std::vector<int> ranks;
  for (int triangle = 0; triangle < surface.F.rows(); ++triangle)
  {
    const Vector3 centre = CentreOf(surface, triangle);
    double nearest = std::numeric_limits<double>::infinity();
    int rank = 0;
    for (std::size_t tile = 0; tile < centres.size(); ++tile)
    {
      if (const double distance = (centres[tile] - centre).squaredNorm(); distance < nearest)
      {
        nearest = distance;
        rank = static_cast<int>(tile) % numberOfRanks;
      }
    }
    ranks.push_back(rank);
  }
  return ranks;
}

std::vector<int> OneTriangleOnTheLast(const Surface& surface, int numberOfRanks)
{
  std::vector<int> ranks = InOrder(surface, std::max(1, numberOfRanks - 1));
  ranks[ranks.size() / 3] = numberOfRanks - 1;
  return ranks;
}

std::vector<int> NoneOnTheFirst(const Surface& surface, int numberOfRanks)
{
  std::vector<int> ranks = InOrder(surface, std::max(1, numberOfRanks - 1));
  for (int& rank : ranks)
  {
    rank = std::min(rank + 1, numberOfRanks - 1);
  }
  return ranks;
}

}

CutPiece CutOut(const Surface& surface, const std::vector<int>& rankOfTriangles, int rank)
{
  CutPiece cut;
  std::vector<int> numbers(surface.V.rows(), -1);
  for (int triangle = 0; triangle < surface.F.rows(); ++triangle)
  {
    if (rankOfTriangles[triangle] != rank)
    {
      continue;
    }
    cut.Triangles.push_back(triangle);
    for (int k = 0; k < 3; ++k)
    {
      if (int& number = numbers[surface.F(triangle, k)]; number < 0)
      {
        number = static_cast<int>(cut.Points.size());
        cut.Points.push_back(surface.F(triangle, k));
      }
    }
  }
  cut.Piece.Positions = surface.V(cut.Points, All);
  cut.Piece.Corners.resize(static_cast<Eigen::Index>(cut.Triangles.size()), 3);
  for (std::size_t i = 0; i < cut.Triangles.size(); ++i)
  {
    for (int k = 0; k < 3; ++k)
    {
      cut.Piece.Corners(static_cast<Eigen::Index>(i), k) = numbers[surface.F(cut.Triangles[i], k)];
    }
  }
  return cut;
}

std::vector<NamedPartition> Partitions()
{
  return { { "in order", InOrder }, { "random tiles", RandomTiles },
    { "one triangle on the last", OneTriangleOnTheLast }, { "none on the first", NoneOnTheFirst } };
}

CutPiece PieceHere(const Surface& surface, MPI_Comm communicator)
{
  const Ranks all(communicator);
  return CutOut(surface, Partitions()[0].RanksOfTriangles(surface, all.Size()), all.Rank());
}

Constraints OneDirection(const PieceOfSurface& piece, int triangle)
{
  Constraints constraints;
  if (piece.NumberOfOwnFaces() > triangle)
  {
    const int face = piece.FirstOwnFace() + triangle;
    constraints.OnFaces.push_back({ triangle, piece.Surface().Faces.X.row(face).transpose(), 1.0 });
  }
  return constraints;
}

}
