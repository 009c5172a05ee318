#include "Pieces/Surface/PieceOfSurface.h"

#include "Constraints/Constraints.h"
#include "Pieces/Surface/GhostTriangles.h"
#include "Pieces/Surface/JoinedTriangles.h"
#include "Support/AllIndices.h"
#include "Support/Errors.h"

#include <algorithm>
#include <string>

namespace dmg
{

namespace
{

void CheckPiece(const SurfacePiece& piece)
{
  const int points = static_cast<int>(piece.Positions.rows());
  if (!piece.GlobalIds.empty() && static_cast<int>(piece.GlobalIds.size()) != points)
  {
    throw InvalidInput(std::to_string(piece.GlobalIds.size()) + " global ids were given for " + std::to_string(points) +
      " points; give one per point, or none");
  }
  for (Eigen::Index h = 0; h < piece.Corners.size(); ++h)
  {
    if (const int corner = piece.Corners.data()[h]; corner < 0 || corner >= points)
    {
      throw InvalidInput("triangle " + std::to_string(h / 3) + " has the corner " + std::to_string(corner) + " of " +
        std::to_string(points) + " points; corners count from 0");
    }
  }
}

/// CheckElements for the fans of a piece, which are all used.
void CheckFans(const SurfacePiece& piece, const FansOfPiece& fans, const ElementNames& names)
{
  if (fans.Corners.rows() == 0)
  {
    return;
  }
  ElementNames namesOfFans{ {}, names.Faces };
  for (const int point : fans.OfPoints)
  {
    namesOfFans.Vertices.push_back(names.Vertices.empty() ? point : names.Vertices[point]);
  }
  CheckElements(piece.Positions(fans.OfPoints, All), fans.Corners, namesOfFans);
}

/// Writes the labels and positions of all corners, ghosts of lower ranks first.
void CollectCorners(const SurfacePiece& piece, const FansOfPiece& fans, const std::vector<PlaceOnRank>& joined,
  const std::vector<TravellingTriangle>& ghosts, int ghostsBefore, std::vector<PlaceOnRank>& labels,
  std::vector<Vector3>& positions)
{
  const auto addGhosts = [&](int first, int last)
  {
    for (int k = first; k < last; ++k)
    {
      for (int corner = 0; corner < 3; ++corner)
      {
        labels.push_back(ghosts[k].Vertices[corner]);
        positions.emplace_back(ghosts[k].Positions[corner].data());
      }
    }
  };
  addGhosts(0, ghostsBefore);
  for (Eigen::Index h = 0; h < fans.Corners.size(); ++h)
  {
    labels.push_back(joined[fans.Corners.data()[h]]);
    positions.emplace_back(piece.Positions.row(piece.Corners.data()[h]).transpose());
  }
  addGhosts(ghostsBefore, static_cast<int>(ghosts.size()));
}

}

PieceOfSurface::PieceOfSurface(
  const Ranks& ranks, const SurfacePiece& piece, const ElementNames& names, const ExecutionContext& context)
  : All(ranks)
  , OwnFaces(static_cast<int>(piece.Corners.rows()))
  , Vertices(piece.Positions.rows(), -1)
{
  if (!ranks.Any(this->OwnFaces > 0))
  {
    throw InvalidInput("no rank has a triangle of the surface; give at least one a piece");
  }
  FansOfPiece fans;
  const bool someHaveIds = ranks.Any(this->OwnFaces > 0 && !piece.GlobalIds.empty());
  const bool someHaveNone = ranks.Any(this->OwnFaces > 0 && piece.GlobalIds.empty());
  ranks.Together(
    [&]
    {
      if (someHaveIds && someHaveNone)
      {
        throw InvalidInput("some pieces of the surface have global ids of their points and others have none; give all "
                           "pieces some, or none");
      }
      CheckPiece(piece);
      fans = FansAround(static_cast<int>(piece.Positions.rows()), piece.Corners, context);
      CheckFans(piece, fans, names);
    });
  const std::vector<SeamSide> seams = PairSides(ranks, piece, fans);
  const std::vector<PlaceOnRank> joined = JoinFans(ranks, fans, seams);
  const std::vector<TravellingTriangle> ghosts = GhostTriangles(ranks, piece, fans, seams, joined);
  ranks.Checkpoint(context, 0.4);

  this->OwnFacesBegin = static_cast<int>(std::count_if(
    ghosts.begin(), ghosts.end(), [&](const TravellingTriangle& ghost) { return ghost.Place.Rank < ranks.Rank(); }));
  std::vector<PlaceOnRank> placesOfGhosts;
  for (std::size_t k = 0; k < ghosts.size(); ++k)
  {
    placesOfGhosts.push_back(ghosts[k].Place);
    const int place = static_cast<int>(k);
    this->FacesOfOthers.push_back(place < this->OwnFacesBegin ? place : place + this->OwnFaces);
  }
  this->ExchangeOfFaces = std::make_unique<ValuesOfOwners>(ranks, placesOfGhosts);
  ranks.Together(
    [&]
    {
      std::vector<PlaceOnRank> labels;
      std::vector<Vector3> positions;
      CollectCorners(piece, fans, joined, ghosts, this->OwnFacesBegin, labels, positions);
      JoinedTriangles all = Join(labels, positions, context);
      this->Owners = std::move(all.Labels);
      this->Local = std::make_unique<const FramedMesh>(
        TriangleMesh(std::move(all.Positions), std::move(all.Corners), {}, context), context);
      for (int h = 0; h < 3 * this->OwnFaces; ++h)
      {
        this->Vertices[piece.Corners.data()[h]] = this->Local->Mesh.Tail(3 * this->OwnFacesBegin + h);
      }
    });
  this->NumberVertices();
  this->TakeConnection(context);
  ranks.Checkpoint(context, 1.0);
}

int PieceOfSurface::VertexAt(int point, const ElementNames& names) const
{
  CheckElement(point, static_cast<int>(this->Vertices.size()), "vertex");
  if (this->Vertices[point] < 0)
  {
    throw InvalidInput(names.Vertex(point) + " holds a constraint and has no triangle; leave it out");
  }
  return this->Vertices[point];
}

TravellingTriangle PieceOfSurface::Travelling(int triangle) const
{
  TravellingTriangle travelling;
  travelling.Place = { this->All.Rank(), triangle };
  for (int k = 0; k < 3; ++k)
  {
    const int vertex = this->Local->Mesh.Tail(3 * (this->OwnFacesBegin + triangle) + k);
    const Vector3 position = this->Local->Mesh.Position(vertex);
    travelling.Vertices[k] = this->Owners[vertex];
    travelling.Positions[k] = { position[0], position[1], position[2] };
  }
  return travelling;
}

/// Owned vertices follow each other, since labels begin with the rank. Their numbers replace those of fans.
void PieceOfSurface::NumberVertices()
{
  const auto isOfRank = [this](const PlaceOnRank& owner) { return owner.Rank == this->All.Rank(); };
  const auto first = std::find_if(this->Owners.begin(), this->Owners.end(), isOfRank);
  const auto last = std::find_if_not(first, this->Owners.end(), isOfRank);
  this->OwnedBegin = static_cast<int>(first - this->Owners.begin());
  this->Owned = static_cast<int>(last - first);
  std::vector<PlaceOnRank> fansOfOthers;
  for (int vertex = 0; vertex < this->NumberOfVertices(); ++vertex)
  {
    if (!this->IsOwned(vertex))
    {
      this->VerticesNotOwned.push_back(vertex);
      fansOfOthers.push_back(this->Owners[vertex]);
    }
  }
  const ValuesOfOwners exchangeOfFans(this->All, fansOfOthers);
  const std::vector<int> numbers = exchangeOfFans.Fetch<int>(
    [&](int fan)
    {
      const auto place = std::lower_bound(first, last, PlaceOnRank{ this->All.Rank(), fan });
      return static_cast<int>(place - first);
    });
  for (int i = 0; i < this->Owned; ++i)
  {
    this->Owners[this->OwnedBegin + i].Number = i;
  }
  for (std::size_t k = 0; k < numbers.size(); ++k)
  {
    fansOfOthers[k].Number = this->Owners[this->VerticesNotOwned[k]].Number = numbers[k];
  }
  this->ExchangeOfVertices = std::make_unique<ValuesOfOwners>(this->All, fansOfOthers);
  const long long begin = this->All.SumBefore(static_cast<long long>(this->Owned));
  this->GlobalSize = this->All.Sum(static_cast<long long>(this->Owned));
  std::vector<long long> globals(this->Owned);
  for (int i = 0; i < this->Owned; ++i)
  {
    globals[i] = begin + i;
  }
  this->Globals = this->WithGhosts<long long>(globals);
}

void PieceOfSurface::TakeConnection(const ExecutionContext& context)
{
  this->All.Together([&] { this->ConnectionOfLocal = std::make_unique<VertexConnection>(*this->Local, context); });
  using Numbers = std::array<VertexConnection::CornerNumbers, 3>;
  const std::vector<Numbers> ofGhosts = this->ExchangeOfFaces->Fetch<Numbers>(
    [&](int triangle) -> Numbers
    {
      const int h = 3 * (this->OwnFacesBegin + triangle);
      const VertexConnection& connection = *this->ConnectionOfLocal;
      return { connection.Corner(h), connection.Corner(h + 1), connection.Corner(h + 2) };
    });
  for (std::size_t k = 0; k < ofGhosts.size(); ++k)
  {
    for (int corner = 0; corner < 3; ++corner)
    {
      this->ConnectionOfLocal->SetCorner(3 * this->FacesOfOthers[k] + corner, ofGhosts[k][corner]);
    }
  }
}

}
