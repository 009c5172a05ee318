#include "Pieces/PieceConstraints.h"

#include "Support/Errors.h"
#include "Support/ShortText.h"

#include <algorithm>
#include <cmath>
#include <string>

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
  onMesh.Faces.assign(piece.IsEmpty() ? 0 : piece.Surface().Mesh.NumberOfFaces(), -1);
  for (int i = 0; i < piece.NumberOfOwnFaces(); ++i)
  {
    onMesh.Faces[piece.FirstOwnFace() + i] = names.Faces.empty() ? i : names.Faces[i];
  }
  return onMesh;
}

/// Directions and values that are wrong by themselves are told by the rank that gives them, which has their names.
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
    if (!std::isfinite(value.Value) || !(value.Weight > 0.0) || !std::isfinite(value.Weight))
    {
      throw InvalidInput("the value " + ShortText(value.Value) + " with the weight " + ShortText(value.Weight) +
        ", prescribed on " + names.Vertex(value.Vertex) + ", is not finite or its weight not positive; repair it");
    }
  }
  CheckSizes(constraints, names);
}

/// The constraint of the lowest rank for each vertex, ascending by vertex.
std::vector<ConstraintForOwner> AtOwners(
  const Ranks& ranks, const std::vector<std::vector<ConstraintForOwner>>& toOwners)
{
  std::vector<ConstraintForOwner> all = ranks.Exchange(toOwners).Items;
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

std::vector<PowerAtVertex> PowersAtOwned(
  const PieceOfSurface& piece, int N, const Constraints& constraints, const ElementNames& names)
{
  const Ranks& ranks = piece.Everyone();
  std::vector<std::vector<ConstraintForOwner>> toOwners(ranks.Size());
  for (const Constraint& atPoint : constraints.AtVertices)
  {
    const PlaceOnRank& owner = piece.OwnerOf(piece.VertexAt(atPoint.Element, names));
    const Vector3& v = atPoint.Direction;
    toOwners[owner.Rank].push_back({ owner.Number, ranks.Rank(), { v[0], v[1], v[2] }, atPoint.Weight });
  }
  Constraints onMesh;
  for (const ConstraintForOwner& constraint : AtOwners(ranks, toOwners))
  {
    onMesh.AtVertices.push_back(
      { piece.FirstOwned() + constraint.Vertex, Vector3(constraint.Numbers), constraint.Weight });
  }
  onMesh.OnFaces = OnFacesWithGhosts(piece, constraints.OnFaces);

  std::vector<char> isSurrounded;
  ranks.Together(
    [&]
    {
      if (!piece.IsEmpty())
      {
        isSurrounded = SurroundedVertices(piece.Surface().Mesh, onMesh.OnFaces);
      }
    });
  // The fans of some ghosts' vertices are cut off; their owners see all of them.
  isSurrounded.erase(
    isSurrounded.begin(), isSurrounded.begin() + std::min<std::size_t>(piece.FirstOwned(), isSurrounded.size()));
  isSurrounded = piece.WithGhosts<char>(isSurrounded);
  std::vector<PowerAtVertex> sums;
  ranks.Together(
    [&]
    {
      if (!piece.IsEmpty())
      {
        sums =
          PowersAtVertices(piece.Surface(), piece.Connection(), N, onMesh, isSurrounded, NamesOnMesh(piece, names));
        sums = { sums.begin() + piece.FirstOwned(), sums.begin() + piece.FirstOwned() + piece.NumberOfOwned() };
      }
    });
  return sums;
}

std::vector<PowerAtVertex> ValuesAtOwned(
  const PieceOfSurface& piece, const Constraints& constraints, const ElementNames& names)
{
  const Ranks& ranks = piece.Everyone();
  std::vector<std::vector<ConstraintForOwner>> toOwners(ranks.Size());
  for (const ValueConstraint& value : constraints.Values)
  {
    const PlaceOnRank& owner = piece.OwnerOf(piece.VertexAt(value.Vertex, names));
    toOwners[owner.Rank].push_back({ owner.Number, ranks.Rank(), { value.Value, 0.0, 0.0 }, value.Weight });
  }
  std::vector<PowerAtVertex> sums(piece.NumberOfOwned());
  for (const ConstraintForOwner& constraint : AtOwners(ranks, toOwners))
  {
    sums[constraint.Vertex].Add(constraint.Weight, constraint.Numbers[0]);
  }
  return sums;
}

}

std::vector<PowerAtVertex> ConstraintsAtOwned(const PieceOfSurface& piece, const DiscretisationOptions& field,
  const Constraints& constraints, const ElementNames& names)
{
  piece.Everyone().Together([&] { CheckOwn(piece, constraints, names); });
  return field.Kind == DiscretisationKind::ScalarFunction ? ValuesAtOwned(piece, constraints, names)
                                                          : PowersAtOwned(piece, field.N, constraints, names);
}

FieldConstraints ConstraintsAtVertices(
  const PieceOfSurface& piece, const DiscretisationOptions& field, const std::vector<PowerAtVertex>& atOwned)
{
  const std::vector<PowerAtVertex> all = piece.WithGhosts<PowerAtVertex>(atOwned);
  const bool isFunction = field.Kind == DiscretisationKind::ScalarFunction;
  FieldConstraints constraints;
  std::vector<double> values;
  for (int vertex = 0; vertex < piece.NumberOfVertices(); ++vertex)
  {
    const PowerAtVertex& at = all[vertex];
    if (at.Weight > 0.0)
    {
      constraints.Elements.push_back(vertex);
      constraints.Weights.push_back(at.Weight);
      const Complex value = at.Power / at.Weight;
      values.push_back(value.real());
      if (!isFunction)
      {
        values.push_back(value.imag());
      }
    }
  }
  constraints.Values = Eigen::Map<const Vector<double>>(values.data(), static_cast<Eigen::Index>(values.size()));
  return constraints;
}

}
