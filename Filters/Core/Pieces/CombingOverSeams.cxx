#include "Pieces/CombingOverSeams.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

namespace dmg
{

namespace
{

/// Two parts of pieces that have a triangle in common.
struct Touch
{
  int Part;   ///< numbered over all ranks
  int Beyond; ///< the part of the rank that has the triangle
  int Turns;  ///< by which direction 0 of this part is behind, in N-ths of a turn
};

int TurnsBetween(const Complex& from, const Complex& to, int N)
{
  const int turns = static_cast<int>(std::lround(N * std::arg(to / from) / (2.0 * Pi)));
  return ((turns % N) + N) % N;
}

/// A touch for each pair of parts that have some.
std::vector<Touch> TouchesOf(
  const PieceOfSurface& piece, const Field& field, const std::vector<int>& partsOfFaces, int firstPart)
{
  struct Sight
  {
    Complex Direction;
    int Part;
  };
  const std::vector<Sight> ofOwners = piece.OwnersOfGhostFaces().Fetch<Sight>(
    [&](int triangle) -> Sight
    {
      const int face = piece.FirstOwnFace() + triangle;
      return { field.OnFaces[face], firstPart + partsOfFaces[face] };
    });
  std::map<std::pair<int, int>, int> turns;
  for (std::size_t k = 0; k < ofOwners.size(); ++k)
  {
    const int face = piece.GhostFaces()[k];
    if (field.OnFaces[face] != 0.0 && ofOwners[k].Direction != 0.0)
    {
      turns.emplace(std::make_pair(firstPart + partsOfFaces[face], ofOwners[k].Part),
        TurnsBetween(field.OnFaces[face], ofOwners[k].Direction, field.N));
    }
  }
  std::vector<Touch> touches;
  for (const auto& [parts, by] : turns)
  {
    touches.push_back({ parts.first, parts.second, by });
  }
  return touches;
}

/// The turns of all parts along a tree of touches, which all ranks find alike.
std::vector<int> TurnsOfParts(const std::vector<Touch>& touches, int parts, int N)
{
  struct Link
  {
    int To;
    int Turns;
  };
  std::vector<std::vector<Link>> links(parts);
  for (const auto& [part, beyond, by] : touches)
  {
    links[part].push_back({ beyond, (N - by) % N });
    links[beyond].push_back({ part, by });
  }
  std::vector<int> turns(parts, -1);
  for (int root = 0; root < parts; ++root)
  {
    std::vector<int> reached;
    if (turns[root] < 0)
    {
      turns[root] = 0;
      reached.push_back(root);
    }
    for (std::size_t i = 0; i < reached.size(); ++i) // grows meanwhile
    {
      for (const auto& [to, by] : links[reached[i]])
      {
        if (turns[to] < 0)
        {
          turns[to] = (turns[reached[i]] + by) % N;
          reached.push_back(to);
        }
      }
    }
  }
  return turns;
}

void TakeDirectionsOfOwners(const PieceOfSurface& piece, Field& field)
{
  const std::vector<Complex> ofOwners =
    piece.WithGhosts<Complex>(field.AtVertices.segment(piece.FirstOwned(), piece.NumberOfOwned()));
  std::copy(ofOwners.begin(), ofOwners.end(), field.AtVertices.begin());
}

}

void CombOverSeams(const PieceOfSurface& piece, Field& field)
{
  const Ranks& ranks = piece.Everyone();
  const std::vector<int> partsOfFaces = FaceComponents(piece.Surface().Mesh);
  const int parts = 1 + *std::max_element(partsOfFaces.begin(), partsOfFaces.end());
  const int first = static_cast<int>(ranks.SumBefore(static_cast<long long>(parts)));
  const int all = static_cast<int>(ranks.Sum(static_cast<long long>(parts)));
  const std::vector<int> turns =
    TurnsOfParts(ranks.GatherToAll(TouchesOf(piece, field, partsOfFaces, first)).Items, all, field.N);
  const auto turnOf = [&](int face) { return std::polar(1.0, 2.0 * Pi * turns[first + partsOfFaces[face]] / field.N); };
  for (std::size_t face = 0; face < partsOfFaces.size(); ++face)
  {
    field.OnFaces[face] *= turnOf(static_cast<int>(face));
  }
  for (int vertex = 0; vertex < piece.NumberOfVertices(); ++vertex)
  {
    const TriangleMesh& mesh = piece.Surface().Mesh;
    field.AtVertices[vertex] *= turnOf(TriangleMesh::FaceOf(mesh.OutgoingHalfedge(vertex)));
  }
  TakeDirectionsOfOwners(piece, field);
}

}
