#include "Pieces/Constraints/CurvaturesInPieces.h"

#include "Directions/BendOfRegions.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <utility>
#include <vector>

namespace dmg
{

namespace
{

/// A bend on its way.
struct TravellingBend
{
  double Bend[9];
  double Area;

  TravellingBend() = default;
  explicit TravellingBend(const BendOfPart& part)
    : Area(part.Area)
  {
    std::copy(part.Bend.data(), part.Bend.data() + 9, this->Bend);
  }
  BendOfPart Part() const { return { Eigen::Map<const Eigen::Matrix3d>(this->Bend), this->Area }; }
};

struct TravellingVertex
{
  double Position[3];
  TravellingBend Bend;

  TravellingVertex() = default;
  TravellingVertex(const Vector3& position, const BendOfPart& part)
    : Position{ position[0], position[1], position[2] }
    , Bend(part)
  {
  }
};

/// The vertices that this rank owns, by their numbers, and after them those of others that it has heard of.
class BendsOverSeams
{
public:
  /// \param parts of the vertices of the mesh, which owned ones have as a whole.
  BendsOverSeams(const PieceOfSurface& piece, std::vector<BendOfPart> parts)
    : Piece(piece)
    , Parts(std::move(parts))
  {
    for (int vertex = 0; vertex < piece.NumberOfVertices(); ++vertex)
    {
      this->NodesOfVertices.push_back(this->NodeAt(piece.OwnerOf(vertex)));
    }
  }

  int Size() const { return this->Piece.NumberOfOwned() + static_cast<int>(this->Others.size()); }
  Vector3 Position(int node) const
  {
    return this->IsOwned(node) ? this->Piece.Surface().Mesh.Position(this->Piece.FirstOwned() + node)
                               : this->Other(node).Position;
  }
  const BendOfPart& Part(int node) const
  {
    return this->IsOwned(node) ? this->Parts[this->Piece.FirstOwned() + node] : this->Other(node).Part;
  }
  template <class Visit>
  void VisitNeighbours(int node, const Visit& visit) const
  {
    const auto visitKnown = [&](int neighbour)
    {
      if (this->IsOwned(neighbour) || this->Other(neighbour).IsKnown)
      {
        return visit(neighbour);
      }
      this->Missing.push_back(neighbour);
      return true;
    };
    if (this->IsOwned(node))
    {
      VisitVerticesAround(this->Piece.Surface().Mesh, this->Piece.FirstOwned() + node,
        [&](int vertex) { return visitKnown(this->NodesOfVertices[vertex]); });
      return;
    }
    for (const int neighbour : this->Other(node).Neighbours)
    {
      if (!visitKnown(neighbour))
      {
        return;
      }
    }
  }

  /// The nodes that were asked for since the last call and are not known.
  std::vector<int> TakeMissing() { return std::exchange(this->Missing, {}); }

  /// Collective. Fetches the data of some nodes from their owners.
  void Learn(std::vector<int> nodes)
  {
    std::sort(nodes.begin(), nodes.end());
    nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
    std::vector<PlaceOnRank> places;
    for (const int node : nodes)
    {
      places.push_back(this->Other(node).Place);
    }
    const ValuesOfOwners owners(this->Piece.Everyone(), places);
    const std::vector<TravellingVertex> vertices = owners.Fetch<TravellingVertex>(
      [&](int number) { return TravellingVertex(this->Position(number), this->Part(number)); });
    const std::vector<std::vector<PlaceOnRank>> around = owners.FetchLists<PlaceOnRank>(
      [&](int number, std::vector<PlaceOnRank>& list)
      {
        VisitVerticesAround(this->Piece.Surface().Mesh, this->Piece.FirstOwned() + number,
          [&](int vertex)
          {
            list.push_back(this->Piece.OwnerOf(vertex));
            return true;
          });
      });
    for (std::size_t k = 0; k < nodes.size(); ++k)
    {
      std::vector<int> neighbours;
      for (const PlaceOnRank& place : around[k])
      {
        neighbours.push_back(this->NodeAt(place));
      }
      VertexOfOther& other = this->Others[nodes[k] - this->Piece.NumberOfOwned()];
      other.Position = Vector3(vertices[k].Position);
      other.Part = vertices[k].Bend.Part();
      other.Neighbours = std::move(neighbours);
      other.IsKnown = true;
    }
  }

private:
  struct VertexOfOther
  {
    PlaceOnRank Place;
    bool IsKnown = false;
    Vector3 Position = Vector3::Zero();
    BendOfPart Part = {};
    std::vector<int> Neighbours = {};
  };

  bool IsOwned(int node) const { return node < this->Piece.NumberOfOwned(); }
  const VertexOfOther& Other(int node) const { return this->Others[node - this->Piece.NumberOfOwned()]; }

  int NodeAt(const PlaceOnRank& place)
  {
    if (place.Rank == this->Piece.Everyone().Rank())
    {
      return place.Number;
    }
    const auto [at, isNew] = this->NodesOfPlaces.emplace(place, this->Size());
    if (isNew)
    {
      this->Others.push_back({ place });
    }
    return at->second;
  }

  const PieceOfSurface& Piece;
  const std::vector<BendOfPart> Parts;
  std::vector<int> NodesOfVertices; ///< of the mesh
  std::map<PlaceOnRank, int> NodesOfPlaces;
  std::vector<VertexOfOther> Others;
  mutable std::vector<int> Missing;
};

/// The bends around the vertices of the mesh that owners have as a whole.
std::vector<BendOfPart> BendsAtOwned(const PieceOfSurface& piece, const ExecutionContext& context)
{
  struct Normal
  {
    double Numbers[3];
    char IsOnBoundary; ///< which owners know alone
  };
  std::vector<Normal> owned;
  for (int i = 0; i < piece.NumberOfOwned(); ++i)
  {
    const Vector3 normal = piece.Surface().Vertices.Normal(piece.FirstOwned() + i);
    const bool isOnBoundary = piece.Surface().Mesh.IsBoundaryVertex(piece.FirstOwned() + i);
    owned.push_back({ { normal[0], normal[1], normal[2] }, static_cast<char>(isOnBoundary ? 1 : 0) });
  }
  const std::vector<Normal> all = piece.WithGhosts<Normal>(owned);
  std::vector<BendOfPart> bends;
  piece.Everyone().Together(
    [&]
    {
      Points normals(piece.NumberOfVertices(), 3);
      std::vector<char> isOnBoundary(piece.NumberOfVertices());
      for (int vertex = 0; vertex < piece.NumberOfVertices(); ++vertex)
      {
        normals.row(vertex) = Eigen::Map<const Eigen::RowVector3d>(all[vertex].Numbers);
        isOnBoundary[vertex] = all[vertex].IsOnBoundary;
      }
      bends = BendsOfVertices(piece.Surface(), normals, isOnBoundary, context);
    });
  return bends;
}

/// The sums over the regions of owned vertices.
std::vector<BendOfPart> BendsOfOwnedRegions(
  const PieceOfSurface& piece, const RegionSize& region, const ExecutionContext& context)
{
  constexpr int Batch = 4096;
  const Ranks& ranks = piece.Everyone();
  BendsOverSeams graph(piece, BendsAtOwned(piece, context));
  std::vector<BendOfPart> sums(piece.NumberOfOwned());
  std::vector<int> pending(piece.NumberOfOwned());
  std::iota(pending.begin(), pending.end(), 0);
  while (ranks.Any(!pending.empty()))
  {
    std::vector<int> missing, incomplete;
    ranks.Together(
      [&]
      {
        SumsOverRegions<BendsOverSeams> regions(graph, graph.Size(), region);
        for (std::size_t k = 0; k < pending.size(); ++k)
        {
          if (k % Batch == 0)
          {
            context.Checkpoint(static_cast<double>(k) / static_cast<double>(pending.size()));
          }
          sums[pending[k]] = regions.Around(pending[k]);
          if (const std::vector<int> more = graph.TakeMissing(); !more.empty())
          {
            missing.insert(missing.end(), more.begin(), more.end());
            incomplete.push_back(pending[k]);
          }
        }
      });
    graph.Learn(std::move(missing));
    pending = std::move(incomplete);
  }
  return sums;
}

}

PrincipalCurvatures CurvaturesInPieces(
  const PieceOfSurface& piece, double scale, const SurfaceSizes& sizes, const ExecutionContext& context)
{
  const std::vector<BendOfPart> sums = BendsOfOwnedRegions(piece, RegionSize(scale, sizes), context);
  const std::vector<TravellingBend> travelling =
    piece.WithGhosts<TravellingBend>(std::vector<TravellingBend>(sums.begin(), sums.end()));
  PrincipalCurvatures curvatures;
  piece.Everyone().Together(
    [&]
    {
      std::vector<BendOfPart> regions;
      for (const TravellingBend& bend : travelling)
      {
        regions.push_back(bend.Part());
      }
      curvatures = CurvaturesOfFaces(piece.Surface(), regions, sizes.Diagonal(), context);
      for (const int ghost : piece.GhostFaces())
      {
        curvatures.Confidence[ghost] = 0.0;
      }
    });
  return curvatures;
}

}
