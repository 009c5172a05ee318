#include "Pieces/Constraints/ConstraintsAtOwned.h"

#include "Operators/FunctionSource.h"

#include <algorithm>

namespace dmg
{

namespace
{

/// A constraint at a vertex on its way to the owner.
struct ConstraintForOwner
{
  int Vertex; ///< the number at the owner
  int Rank;   ///< that gives it
  double Numbers[3];
  double Weight;
};

/// Names the own triangles of a piece as the caller does.
ElementNames NamesOnMesh(const PieceOfSurface& piece, const ElementNames& names)
{
  ElementNames onMesh;
  onMesh.Faces.assign(piece.Surface().Mesh.NumberOfFaces(), -1);
  for (int i = 0; i < piece.NumberOfOwnFaces(); ++i)
  {
    onMesh.Faces[piece.FirstOwnFace() + i] = names.Faces.empty() ? i : names.Faces[i];
  }
  return onMesh;
}

/// The rank that gives a direction or a value reports its errors, as it alone has the names.
void CheckOwn(const PieceOfSurface& piece, const Constraints& constraints, const ElementNames& names)
{
  for (const Constraint& onFace : constraints.OnFaces)
  {
    CheckElement(onFace.Element, piece.NumberOfOwnFaces(), "face");
    TangentialPart(piece.Surface().Faces, piece.FirstOwnFace() + onFace.Element, onFace.Direction, onFace.Weight,
      names.Face(onFace.Element), "cell");
  }
  for (const Constraint& atPoint : constraints.AtVertices)
  {
    TangentialPart(piece.Surface().Vertices, piece.VertexAt(atPoint.Element, names), atPoint.Direction, atPoint.Weight,
      names.Vertex(atPoint.Element), "point");
  }
  for (const ValueConstraint& value : constraints.Values)
  {
    piece.VertexAt(value.Vertex, names);
    CheckValue(value, names.Vertex(value.Vertex));
  }
  CheckSizes(constraints, names);
}

/// Constraints at points on their way to the owners.
class ToOwners
{
public:
  explicit ToOwners(const PieceOfSurface& piece)
    : Piece(piece)
    , ToRanks(piece.Everyone().Size())
  {
  }

  void Add(int vertex, const Vector3& numbers, double weight)
  {
    const PlaceOnRank& owner = this->Piece.OwnerOf(vertex);
    this->ToRanks[owner.Rank].push_back(
      { owner.Number, this->Piece.Everyone().Rank(), { numbers[0], numbers[1], numbers[2] }, weight });
  }

  /// Collective. The constraints of the lowest rank for each vertex, ascending by owned vertex.
  std::vector<ConstraintForOwner> Send() const
  {
    std::vector<ConstraintForOwner> all = this->Piece.Everyone().Exchange(this->ToRanks).Items;
    std::stable_sort(all.begin(), all.end(),
      [](const ConstraintForOwner& a, const ConstraintForOwner& b)
      { return a.Vertex != b.Vertex ? a.Vertex < b.Vertex : a.Rank < b.Rank; });
    std::vector<ConstraintForOwner> chosen;
    for (const ConstraintForOwner& constraint : all)
    {
      if (chosen.empty() || chosen.back().Vertex != constraint.Vertex || chosen.back().Rank == constraint.Rank)
      {
        chosen.push_back(constraint);
      }
    }
    return chosen;
  }

private:
  const PieceOfSurface& Piece;
  std::vector<std::vector<ConstraintForOwner>> ToRanks;
};

/// All directions on faces of the mesh, those of ghosts included.
std::vector<Constraint> OnFacesWithGhosts(const PieceOfSurface& piece, const std::vector<Constraint>& own)
{
  struct Direction
  {
    double Numbers[3];
    double Weight;
    int Side;
  };
  std::vector<std::vector<Direction>> ofTriangles(piece.NumberOfOwnFaces());
  std::vector<Constraint> all;
  for (const Constraint& onFace : own)
  {
    const Vector3& v = onFace.Direction;
    ofTriangles[onFace.Element].push_back({ { v[0], v[1], v[2] }, onFace.Weight, onFace.Side });
    all.push_back(onFace);
    all.back().Element += piece.FirstOwnFace();
  }
  const std::vector<std::vector<Direction>> ofGhosts =
    piece.OwnersOfGhostFaces().FetchLists<Direction>([&](int triangle, std::vector<Direction>& list)
      { list.insert(list.end(), ofTriangles[triangle].begin(), ofTriangles[triangle].end()); });
  for (std::size_t k = 0; k < ofGhosts.size(); ++k)
  {
    for (const auto& [numbers, weight, side] : ofGhosts[k])
    {
      all.push_back({ piece.GhostFaces()[k], Vector3(numbers), weight, side });
    }
  }
  // All ranks add up in the same order.
  std::stable_sort(
    all.begin(), all.end(), [](const Constraint& a, const Constraint& b) { return a.Element < b.Element; });
  return all;
}

/// The constraints that hold owned vertices, in the numbers of the mesh.
Constraints OnMesh(const PieceOfSurface& piece, const Constraints& constraints, const ElementNames& names)
{
  ToOwners directions(piece), values(piece);
  for (const Constraint& atPoint : constraints.AtVertices)
  {
    directions.Add(piece.VertexAt(atPoint.Element, names), atPoint.Direction, atPoint.Weight);
  }
  for (const ValueConstraint& value : constraints.Values)
  {
    values.Add(piece.VertexAt(value.Vertex, names), Vector3::Constant(value.Value), value.Weight);
  }
  Constraints onMesh;
  onMesh.OnFaces = OnFacesWithGhosts(piece, constraints.OnFaces);
  for (const ConstraintForOwner& each : directions.Send())
  {
    onMesh.AtVertices.push_back({ piece.FirstOwned() + each.Vertex, Vector3(each.Numbers), each.Weight });
  }
  for (const ConstraintForOwner& each : values.Send())
  {
    onMesh.Values.push_back({ piece.FirstOwned() + each.Vertex, each.Numbers[0], each.Weight });
  }
  return onMesh;
}

/// Whether all faces around have directions. The fans of some ghosts' vertices are cut off; their owners see all of them.
std::vector<char> AreSurrounded(const PieceOfSurface& piece, const std::vector<Constraint>& onFaces)
{
  std::vector<char> owned;
  piece.Everyone().Together(
    [&]
    {
      owned = SurroundedVertices(piece.Surface().Mesh, onFaces);
      owned.erase(owned.begin(), owned.begin() + piece.FirstOwned());
    });
  return piece.WithGhosts<char>(owned);
}

}

std::vector<PowerAtVertex> ConstraintsAtOwned(const PieceOfSurface& piece, const VertexDiscretisation& fields,
  const Constraints& constraints, const ElementNames& names)
{
  piece.Everyone().Together([&] { CheckOwn(piece, constraints, names); });
  const Constraints onMesh = OnMesh(piece, constraints, names);
  const std::vector<char> areSurrounded = AreSurrounded(piece, onMesh.OnFaces);
  std::vector<PowerAtVertex> sums;
  piece.Everyone().Together(
    [&]
    {
      sums = fields.SumsAtVertices(onMesh, areSurrounded, NamesOnMesh(piece, names));
      sums = { sums.begin() + piece.FirstOwned(), sums.begin() + piece.FirstOwned() + piece.NumberOfOwned() };
    });
  return sums;
}

Vector<double> SourceAtOwned(const PieceOfSurface& piece, const Vector<double>& source, const ElementNames& names)
{
  if (!piece.Everyone().Any(source.size() > 0))
  {
    return {};
  }
  const std::vector<int>& vertices = piece.VerticesOfPoints();
  std::vector<double> owned(piece.NumberOfOwned(), 0.0);
  piece.Everyone().Together(
    [&]
    {
      CheckSource(source, static_cast<int>(vertices.size()), names);
      for (Eigen::Index point = source.size() - 1; point >= 0; --point) // of several at a vertex the first counts
      {
        if (const int vertex = vertices[point]; vertex >= 0 && piece.IsOwned(vertex))
        {
          owned[vertex - piece.FirstOwned()] = source[point];
        }
      }
    });
  const std::vector<double> all = piece.WithGhosts<double>(owned);
  Vector<double> integrals;
  piece.Everyone().Together(
    [&]
    {
      const Eigen::Map<const Vector<double>> f(all.data(), static_cast<Eigen::Index>(all.size()));
      integrals = IntegratedSource(piece.Surface().Mesh, f).segment(piece.FirstOwned(), piece.NumberOfOwned());
    });
  return integrals;
}

}
