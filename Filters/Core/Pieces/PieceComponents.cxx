#include "Pieces/PieceComponents.h"

#include "Support/DisjointSets.h"

#include <algorithm>
#include <set>
#include <utility>

namespace dmg
{

PieceComponents ComponentsOfPieces(const PieceOfSurface& piece)
{
  const Ranks& ranks = piece.Everyone();
  std::vector<int> ofVertices(piece.NumberOfVertices());
  int count = 0;
  if (!piece.IsEmpty())
  {
    const TriangleMesh& mesh = piece.Surface().Mesh;
    const std::vector<int> ofFaces = FaceComponents(mesh);
    count = 1 + *std::max_element(ofFaces.begin(), ofFaces.end());
    for (int vertex = 0; vertex < piece.NumberOfVertices(); ++vertex)
    {
      ofVertices[vertex] = ofFaces[TriangleMesh::FaceOf(mesh.OutgoingHalfedge(vertex))];
    }
  }
  const int first = static_cast<int>(ranks.SumBefore(static_cast<long long>(count)));
  PieceComponents components;
  components.NumberBound = static_cast<int>(ranks.Sum(static_cast<long long>(count)));
  for (int i = 0; i < piece.NumberOfOwned(); ++i)
  {
    components.OfOwned.push_back(first + ofVertices[piece.FirstOwned() + i]);
  }
  const std::vector<int> ofOwners = piece.WithGhosts<int>(components.OfOwned);
  std::set<std::pair<int, int>> links;
  for (int vertex = 0; vertex < piece.NumberOfVertices(); ++vertex)
  {
    if (const int here = first + ofVertices[vertex]; ofOwners[vertex] != here)
    {
      links.emplace(here, ofOwners[vertex]);
    }
  }
  struct Link
  {
    int Here;
    int Beyond;
  };
  std::vector<Link> own;
  for (const auto& [here, beyond] : links)
  {
    own.push_back({ here, beyond });
  }
  DisjointSets sets(components.NumberBound);
  for (const Link& link : ranks.GatherToAll(own).Items)
  {
    sets.Unite(link.Here, link.Beyond);
  }
  for (int& component : components.OfOwned)
  {
    component = sets.Smallest(component);
  }
  return components;
}

}
