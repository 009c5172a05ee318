#include "Pieces/Surface/PieceComponents.h"

#include "Operators/FunctionSource.h"
#include "Support/DisjointSets.h"

#include <algorithm>
#include <set>
#include <utility>

namespace dmg
{

PieceComponents ComponentsOfPieces(const PieceOfSurface& piece)
{
  const Ranks& ranks = piece.Everyone();
  const std::vector<int> ofVertices = VertexComponents(piece.Surface().Mesh);
  const int count = 1 + *std::max_element(ofVertices.begin(), ofVertices.end());
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
