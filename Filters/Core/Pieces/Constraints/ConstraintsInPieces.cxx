#include "Pieces/Constraints/ConstraintsInPieces.h"

#include "Mesh/NormalParts.h"
#include "Pieces/Constraints/CurvaturesInPieces.h"
#include "Pieces/Constraints/GuidesInPieces.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace dmg
{

SurfaceSizes SizesOf(const PieceOfSurface& piece)
{
  constexpr double Infinity = std::numeric_limits<double>::infinity();
  const Ranks& ranks = piece.Everyone();
  double area = 0.0, edges = 0.0, lengths = 0.0;
  std::vector<double> corners(6, Infinity); // of the box: the lower one, and the upper one, negative
  for (int i = 0; i < piece.NumberOfOwnFaces(); ++i)
  {
    const TriangleMesh& mesh = piece.Surface().Mesh;
    const int face = piece.FirstOwnFace() + i;
    area += mesh.FaceArea(face);
    for (int h = 3 * face; h < 3 * face + 3; ++h)
    {
      const Vector3 position = mesh.Position(mesh.Tail(h));
      const double share = mesh.Twin(h) < 0 ? 1.0 : 0.5; // of this side in its edge
      edges += share;
      lengths += share * (mesh.Position(mesh.Head(h)) - position).norm();
      for (int k = 0; k < 3; ++k)
      {
        corners[k] = std::min(corners[k], position[k]);
        corners[3 + k] = std::min(corners[3 + k], -position[k]);
      }
    }
  }
  ranks.Min(corners);
  SurfaceSizes sizes;
  sizes.Area = ranks.Sum(area);
  sizes.MeanFaceArea = sizes.Area / static_cast<double>(ranks.Sum(static_cast<long long>(piece.NumberOfOwnFaces())));
  sizes.MeanEdge = ranks.Sum(lengths) / ranks.Sum(edges);
  sizes.Lower = Vector3(corners[0], corners[1], corners[2]);
  sizes.Upper = -Vector3(corners[3], corners[4], corners[5]);
  sizes.NumberOfVertices = piece.GlobalNumberOfVertices();
  return sizes;
}

double MeanAreaOfVertices(const PieceOfSurface& piece, const VertexDiscretisation& fields)
{
  double sum = 0.0;
  piece.Everyone().Together(
    [&] { sum = fields.AreasOfVertices(SerialContext()).segment(piece.FirstOwned(), piece.NumberOfOwned()).sum(); });
  return piece.Everyone().Sum(sum) / static_cast<double>(piece.GlobalNumberOfVertices());
}

SurfaceSizes ConstraintsInPieces::Sizes()
{
  if (!this->SizesOfSurface)
  {
    this->SizesOfSurface = SizesOf(this->Piece);
  }
  return *this->SizesOfSurface;
}

Discretisation::IntegralWeights ConstraintsInPieces::WeightsOfIntegral(const Discretisation& discretisation)
{
  const double mean = MeanAreaOfVertices(this->Piece, *discretisation.AtVertices());
  return { mean, mean };
}

FollowedGuides ConstraintsInPieces::DirectionsOfGuides(const Guides& guides, const ExecutionContext& context)
{
  const SurfaceSizes sizes = this->Sizes();
  this->Piece.Everyone().Together(
    [&]
    {
      if (!this->Places)
      {
        this->Places = std::make_unique<const NearestPlaces>(this->Piece.Surface(), sizes);
      }
    });
  return FollowGuidesInPieces(guides, this->Piece, *this->Places, sizes, context);
}

/// The directions on own triangles, in the numbers of these.
std::vector<Constraint> ConstraintsInPieces::OnOwn(std::vector<Constraint> onMesh) const
{
  onMesh.erase(std::remove_if(onMesh.begin(), onMesh.end(),
                 [this](const Constraint& direction) { return !this->Piece.IsOwnFace(direction.Element); }),
    onMesh.end());
  for (Constraint& direction : onMesh)
  {
    direction.Element -= this->Piece.FirstOwnFace();
  }
  return onMesh;
}

FollowedFeatures ConstraintsInPieces::DirectionsOfFeatures(
  const FeatureOptions& options, int N, const ExecutionContext& context)
{
  const Ranks& ranks = this->Piece.Everyone();
  const SurfaceSizes sizes = this->Sizes();
  return FollowFeatures(N, options,
    [&](SurfaceFeature feature, std::vector<Constraint>& directions)
    {
      const PrincipalCurvatures* const curvatures =
        feature == SurfaceFeature::PrincipalDirections ? &this->Curvatures(options.CurvatureScale, context) : nullptr;
      if (curvatures && !ranks.Any(AreClear(*curvatures)))
      {
        return false;
      }
      std::vector<Constraint> own;
      ranks.Together(
        [&]
        {
          const FramedMesh& surface = this->Piece.Surface();
          own = this->OnOwn(AlongFeature(feature, surface, WeightsOfFaces(surface.Mesh, sizes), options, curvatures));
        });
      directions.insert(directions.end(), own.begin(), own.end());
      return ranks.Any(!own.empty());
    });
}

const PrincipalCurvatures& ConstraintsInPieces::Curvatures(double scale, const ExecutionContext& context)
{
  if (!this->CurvaturesAtScale || this->CurvaturesAtScale->first != scale)
  {
    this->CurvaturesAtScale.emplace(scale, CurvaturesInPieces(this->Piece, scale, this->Sizes(), context));
  }
  return this->CurvaturesAtScale->second;
}

/// Vertices of own triangles have all their triangles here.
void ConstraintsInPieces::TakeOutNormalParts(std::vector<Constraint>& atVertices)
{
  const std::vector<int>& vertices = this->Piece.VerticesOfPoints();
  for (Constraint& at : atVertices)
  {
    const bool isPoint = at.Element >= 0 && at.Element < static_cast<int>(vertices.size());
    if (isPoint && vertices[at.Element] >= 0)
    {
      at.Direction = WithoutNormalPart(this->Piece.Surface().Mesh, vertices[at.Element], at.Direction);
    }
  }
}

void ConstraintsInPieces::Turn(Constraints& constraints, const RotationAngles& angles, const ElementNames& names)
{
  const auto angleAt = [&angles](const Vector<double>& ofElements, int element)
  { return angles.Everywhere + (ofElements.size() > 0 ? ofElements[element] : 0.0); };
  const PieceOfSurface& piece = this->Piece;
  piece.Everyone().Together(
    [&]
    {
      for (Constraint& on : constraints.OnFaces)
      {
        CheckElement(on.Element, piece.NumberOfOwnFaces(), "face");
        const double angle = angleAt(angles.Faces, on.Element);
        if (!std::isfinite(angle))
        {
          RefuseRotation(names.Face(on.Element));
        }
        on.Direction = Turned(on.Direction, piece.Surface().Faces, piece.FirstOwnFace() + on.Element, angle);
      }
      for (Constraint& at : constraints.AtVertices)
      {
        const int vertex = piece.VertexAt(at.Element, names);
        const double angle = angleAt(angles.Vertices, at.Element);
        if (!std::isfinite(angle))
        {
          RefuseRotation(names.Vertex(at.Element));
        }
        at.Direction = Turned(at.Direction, piece.Surface().Vertices, vertex, angle);
      }
    });
}

/// Only the rank that has a triangle gives directions on it.
CancellingFaces ConstraintsInPieces::TakeOutCancelling(
  std::vector<Constraint>& onFaces, int N, const ElementNames& names)
{
  const Ranks& ranks = this->Piece.Everyone();
  std::vector<int> faces;
  ranks.Together(
    [&]
    {
      if (onFaces.empty())
      {
        return;
      }
      for (Constraint& on : onFaces)
      {
        CheckElement(on.Element, this->Piece.NumberOfOwnFaces(), "face");
        on.Element += this->Piece.FirstOwnFace();
      }
      faces = LeaveOutCancelling(onFaces, this->Piece.Surface().Faces, N);
      onFaces = this->OnOwn(std::move(onFaces));
    });
  const std::string first = faces.empty() ? "" : names.Face(faces[0] - this->Piece.FirstOwnFace());
  return { ranks.Sum(static_cast<long long>(faces.size())), ranks.FirstText(first) };
}

}
