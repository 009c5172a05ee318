#ifndef dmgPieceOfSurface_h
#define dmgPieceOfSurface_h

#include "Mesh/FramedMesh.h"
#include "Mesh/VertexConnection.h"
#include "Pieces/Surface/GhostTriangles.h"
#include "Pieces/Surface/Ranks.h"
#include "Pieces/Surface/SeamSides.h"
#include "Pieces/Surface/ValuesOfOwners.h"
#include "Support/ExecutionContext.h"

#include <memory>
#include <optional>
#include <vector>

namespace dmg
{

/// A rank's part of a surface in pieces: the triangles of its own piece and, from other pieces, those that share a vertex with
/// them, the ghosts.
///
/// The vertices of own triangles have all their triangles here, so frames, angles and areas are those of the whole surface.
/// Frames agree without communication: every rank orders triangles by owner. A vertex of ghosts alone may lack some of its triangles;
/// Connection has the numbers of their owners there. A rank without triangles has the first triangle of the surface as a ghost.
///
/// Each vertex of an own triangle is owned by the lowest rank that has such a triangle. Owned vertices are numbered from 0 on
/// every rank; their global numbers continue from rank to rank.
class PieceOfSurface
{
public:
  /// Collective. \param names how messages call the triangles and points of the piece.
  /// \throw InvalidInput as CheckElements, FansAround and PairSides, or no rank has a triangle.
  /// Messages: two exchanges of about 110 bytes per triangle at a partition boundary, and a few smaller ones.
  PieceOfSurface(
    const Ranks& ranks, const SurfacePiece& piece, const ElementNames& names, const ExecutionContext& context);

  const Ranks& Everyone() const { return this->All; }

  const FramedMesh& Surface() const { return *this->Local; }
  const VertexConnection& Connection() const { return *this->ConnectionOfLocal; }

  /// Own triangle i is face FirstOwnFace() + i.
  int FirstOwnFace() const { return this->OwnFacesBegin; }
  int NumberOfOwnFaces() const { return this->OwnFaces; }
  bool IsOwnFace(int face) const { return face >= this->OwnFacesBegin && face < this->OwnFacesBegin + this->OwnFaces; }
  /// An own triangle as other ranks get it, with owners of vertices.
  TravellingTriangle Travelling(int triangle) const;
  /// A vertex at each point of the piece, -1 where no triangle is; one of them where the piece is pinched.
  const std::vector<int>& VerticesOfPoints() const { return this->Vertices; }

  /// The vertex of a point with a constraint.
  /// \throw InvalidInput there is no such point, or no triangle at it.
  int VertexAt(int point, const ElementNames& names) const;

  int NumberOfVertices() const { return static_cast<int>(this->Owners.size()); }
  /// Owned vertex i is vertex FirstOwned() + i.
  int FirstOwned() const { return this->OwnedBegin; }
  int NumberOfOwned() const { return this->Owned; }
  bool IsOwned(int vertex) const { return vertex >= this->OwnedBegin && vertex < this->OwnedBegin + this->Owned; }
  /// The rank that owns a vertex, and the vertex's number among those that it owns.
  const PlaceOnRank& OwnerOf(int vertex) const { return this->Owners[vertex]; }
  /// The number of owned vertices of all ranks.
  long long GlobalNumberOfVertices() const { return this->GlobalSize; }
  /// Per vertex.
  const std::vector<long long>& GlobalNumbers() const { return this->Globals; }

  /// Collective. The values of all vertices here from those of owned ones.
  template <class Value, class Values>
  std::vector<Value> WithGhosts(const Values& owned) const;

  /// Faces that are ghosts, ascending.
  const std::vector<int>& GhostFaces() const { return this->FacesOfOthers; }
  /// Values of their owners, by the numbers of own triangles there.
  const ValuesOfOwners& OwnersOfGhostFaces() const { return *this->ExchangeOfFaces; }

private:
  void NumberVertices();
  void TakeConnection(const ExecutionContext& context);

  const Ranks& All;
  std::unique_ptr<const FramedMesh> Local;
  std::unique_ptr<VertexConnection> ConnectionOfLocal;
  int OwnFacesBegin = 0;
  int OwnFaces = 0;
  std::vector<int> Vertices; // of points
  int OwnedBegin = 0;
  int Owned = 0;
  std::vector<PlaceOnRank> Owners; // per vertex
  long long GlobalSize = 0;
  std::vector<long long> Globals;    // per vertex
  std::vector<int> VerticesNotOwned; // ascending
  std::vector<int> FacesOfOthers;
  std::unique_ptr<ValuesOfOwners> ExchangeOfVertices;
  std::unique_ptr<ValuesOfOwners> ExchangeOfFaces;
};

template <class Value, class Values>
std::vector<Value> PieceOfSurface::WithGhosts(const Values& owned) const
{
  const std::vector<Value> ghosts =
    this->ExchangeOfVertices->Fetch<Value>([&owned](int number) -> Value { return owned[number]; });
  std::vector<Value> all(this->NumberOfVertices());
  for (int i = 0; i < this->Owned; ++i)
  {
    all[this->OwnedBegin + i] = owned[i];
  }
  for (std::size_t k = 0; k < ghosts.size(); ++k)
  {
    all[this->VerticesNotOwned[k]] = ghosts[k];
  }
  return all;
}

}

#endif
