#include "Pieces/Solvers/PieceLevels.h"

#include "Levels/GraphOfSamples.h"
#include "Levels/PointSampling.h"
#include "Levels/SampleSpacing.h"
#include "Levels/SampledProlongation.h"
#include "Levels/TangentGraph.h"
#include "Mesh/SpatialOrder.h"
#include "Support/Permutations.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace dmg
{

namespace
{

/// The points of a level: those of this rank, and after them those of others that they are linked with, without links of their own.
struct GraphOfPiece
{
  TangentGraph Graph;
  int NumberOfOwn = 0;
  std::vector<PlaceOnRank> PlacesOfGhosts;
};

/// The sample of a ghost point, as its owner reports it.
struct SightOfGhost
{
  PlaceOnRank Sample;
  Complex Place;
  Complex Turn;
};

/// Links between own points and ghosts. Sampling must not follow them, and a second graph would be much memory.
class LinksWithGhosts
{
public:
  /// Takes them out of a graph, which becomes that of own points alone.
  explicit LinksWithGhosts(GraphOfPiece& level)
    : Graph(level.Graph)
    , NumberOfPoints(level.Graph.NumberOfPoints())
  {
    int next = 0;
    int begin = 0;
    for (int point = 0; point < level.NumberOfOwn; ++point)
    {
      const int end = this->Graph.Offsets[point + 1];
      for (int link = begin; link < end; ++link)
      {
        if (this->Graph.Neighbours[link] >= level.NumberOfOwn)
        {
          this->Links.push_back(
            { point, link, this->Graph.Neighbours[link], this->Graph.Steps[link], this->Graph.Turns[link] });
          continue;
        }
        this->Graph.Neighbours[next] = this->Graph.Neighbours[link];
        this->Graph.Steps[next] = this->Graph.Steps[link];
        this->Graph.Turns[next++] = this->Graph.Turns[link];
      }
      begin = end;
      this->Graph.Offsets[point + 1] = next;
    }
    this->Graph.Offsets.resize(level.NumberOfOwn + 1);
    this->Resize(next);
  }

  /// Puts them back where they were, from the last to the first.
  void PutBack()
  {
    int from = this->Graph.NumberOfLinks();
    const int links = from + static_cast<int>(this->Links.size());
    this->Resize(links);
    auto next = this->Links.rbegin();
    for (int link = links - 1; link >= 0; --link)
    {
      const bool isPutBack = next != this->Links.rend() && next->Place == link;
      from -= isPutBack ? 0 : 1;
      this->Graph.Neighbours[link] = isPutBack ? next->Neighbour : this->Graph.Neighbours[from];
      this->Graph.Steps[link] = isPutBack ? next->Step : this->Graph.Steps[from];
      this->Graph.Turns[link] = isPutBack ? next->Turn : this->Graph.Turns[from];
      next += isPutBack ? 1 : 0;
    }
    std::size_t before = 0;
    for (int point = 0; point + 1 < static_cast<int>(this->Graph.Offsets.size()); ++point)
    {
      while (before < this->Links.size() && this->Links[before].Point == point)
      {
        ++before;
      }
      this->Graph.Offsets[point + 1] += static_cast<int>(before);
    }
    this->Graph.Offsets.resize(this->NumberOfPoints + 1, links);
  }

private:
  struct Link
  {
    int Point;
    int Place; ///< among all links
    int Neighbour;
    Complex Step;
    Complex Turn;
  };

  void Resize(int links)
  {
    this->Graph.Neighbours.resize(links);
    this->Graph.Steps.resize(links);
    this->Graph.Turns.resize(links);
  }

  TangentGraph& Graph;
  const int NumberOfPoints;
  std::vector<Link> Links;
};

/// Takes away the links of points that are not owned: these links are not all here.
void DropLinksOfGhosts(GraphOfPiece& level)
{
  TangentGraph& graph = level.Graph;
  const int links = graph.Offsets[level.NumberOfOwn];
  std::fill(graph.Offsets.begin() + level.NumberOfOwn, graph.Offsets.end(), links);
  graph.Neighbours.resize(links);
  graph.Steps.resize(links);
  graph.Turns.resize(links);
}

/// The vertices of a piece, along a curve through space; owned ones first.
std::vector<int> OrderOfVertices(const PieceOfSurface& piece, const ExecutionContext& context)
{
  const TriangleMesh& mesh = piece.Surface().Mesh;
  const SpatialOrder spatial(mesh.VertexPositions(), mesh.FaceCorners(), context);
  std::vector<int> order = spatial.Vertices();
  std::stable_partition(order.begin(), order.end(), [&piece](int vertex) { return piece.IsOwned(vertex); });
  return order;
}

GraphOfPiece GraphOfVertices(
  const PieceOfSurface& piece, const std::vector<int>& order, const ExecutionContext& context)
{
  GraphOfPiece level;
  level.NumberOfOwn = piece.NumberOfOwned();
  level.Graph = VertexGraph(piece.Surface().Mesh, piece.Connection(), order, context);
  DropLinksOfGhosts(level);
  return level;
}

/// A sampling of own points, with the ghosts' samples after the own ones.
void AddGhosts(PointSampling& sampling, const std::vector<SightOfGhost>& ghosts, std::vector<PlaceOnRank>& samples)
{
  for (const SightOfGhost& ghost : ghosts)
  {
    samples.push_back(ghost.Sample);
  }
  std::sort(samples.begin(), samples.end());
  samples.erase(std::unique(samples.begin(), samples.end()), samples.end());
  const int own = static_cast<int>(sampling.Samples.size());
  for (const SightOfGhost& ghost : ghosts)
  {
    const auto place = std::lower_bound(samples.begin(), samples.end(), ghost.Sample) - samples.begin();
    sampling.Owners.push_back(own + static_cast<int>(place));
    sampling.Places.push_back(ghost.Place);
    sampling.Turns.push_back(ghost.Turn);
  }
  sampling.Samples.resize(own + samples.size(), -1);
}

/// Makes one level after the other.
class LevelMaker
{
public:
  LevelMaker(const Ranks& ranks, const ExecutionContext& context)
    : All(ranks)
    , Context(context)
  {
  }

  /// \param points [i] is the point of row i, and of the element that other ranks call number i.
  /// \return whether the level is worth its cost. Then \p level becomes that of its samples.
  bool Add(GraphOfPiece& level, const std::vector<int>& points, const ValuesOfOwners& ghostPoints, double distance,
    double largestCurvature)
  {
    PointSampling sampling;
    this->All.Together(
      [&]
      {
        if (level.NumberOfOwn > 0)
        {
          LinksWithGhosts ghosts(level);
          sampling = SamplePoints(level.Graph, distance, largestCurvature, this->Context);
          ghosts.PutBack();
        }
      });
    const int own = static_cast<int>(sampling.Samples.size());
    const long long samples = this->All.Sum(static_cast<long long>(own));
    if (static_cast<double>(samples) >
      LargestUsefulRatio * static_cast<double>(this->All.Sum(static_cast<long long>(level.NumberOfOwn))))
    {
      return false; // many pieces of surface, of few points each
    }
    const long long first = this->All.SumBefore(static_cast<long long>(own));
    const std::vector<SightOfGhost> ghosts = ghostPoints.Fetch<SightOfGhost>(
      [&](int number) -> SightOfGhost
      {
        const int point = points[number];
        return { { this->All.Rank(), sampling.Owners[point] }, sampling.Places[point], sampling.Turns[point] };
      });
    std::vector<PlaceOnRank> samplesOfGhosts;
    RowsOfRank<Complex> prolongation;
    GraphOfPiece coarse;
    this->All.Together(
      [&]
      {
        AddGhosts(sampling, ghosts, samplesOfGhosts);
        coarse.NumberOfOwn = own;
        coarse.Graph = GraphOfSamples(level.Graph, sampling, this->Context);
        SparseMatrix<Complex> rows = SampledProlongation(sampling, coarse.Graph, points, this->Context);
        prolongation.Rows.swap(rows);
      });
    coarse.PlacesOfGhosts = samplesOfGhosts;
    DropLinksOfGhosts(coarse);
    const ValuesOfOwners columns(this->All, samplesOfGhosts);
    const std::vector<long long> globals = columns.Fetch<long long>([first](int sample) { return first + sample; });
    prolongation.OwnedColumns = own;
    prolongation.GlobalColumns.resize(own);
    std::iota(prolongation.GlobalColumns.begin(), prolongation.GlobalColumns.end(), first);
    prolongation.GlobalColumns.insert(prolongation.GlobalColumns.end(), globals.begin(), globals.end());
    this->Prolongations.push_back(std::move(prolongation));
    level = std::move(coarse);
    return true;
  }

  std::vector<RowsOfRank<Complex>> Prolongations;

private:
  const Ranks& All;
  const ExecutionContext& Context;
};

}

std::vector<RowsOfRank<Complex>> LevelsOfPieces(
  const PieceOfSurface& piece, double distance, const ExecutionContext& context)
{
  const Ranks& ranks = piece.Everyone();
  LevelMaker maker(ranks, context);
  GraphOfPiece level;
  std::vector<int> order, points;
  std::vector<PlaceOnRank> owners;
  ranks.Together(
    [&]
    {
      order = OrderOfVertices(piece, context);
      level = GraphOfVertices(piece, order, context);
      const std::vector<int> places = Inverse(order, context);
      points.assign(places.begin() + piece.FirstOwned(), places.begin() + piece.FirstOwned() + piece.NumberOfOwned());
      for (std::size_t k = piece.NumberOfOwned(); k < order.size(); ++k)
      {
        owners.push_back(piece.OwnerOf(order[k]));
      }
    });
  bool isFirst = true;
  while (ranks.Sum(static_cast<long long>(level.NumberOfOwn)) > FewestSamplesToSample)
  {
    ranks.Checkpoint(context, isFirst ? 0.2 : 0.9);
    std::vector<int> own(level.NumberOfOwn);
    std::iota(own.begin(), own.end(), 0);
    const ValuesOfOwners ghosts(ranks, isFirst ? owners : level.PlacesOfGhosts);
    if (!maker.Add(level, isFirst ? points : own, ghosts, isFirst ? distance : DistanceOfCoarserSamples,
          isFirst ? LargestCurvatureOfElements : LargestCurvatureOfSamples))
    {
      break;
    }
    isFirst = false;
  }
  return std::move(maker.Prolongations);
}

}
