#include "Mesh/NormalParts.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace dmg
{
namespace
{

/// The cosine of 30 degrees.
constexpr double SharpCosine = 0.86602540378443865;
/// The cosine of half a degree.
constexpr double FlatCosine = 0.99996192306417131;

/// The least cosine between the normal of a vertex and those of the faces around; 1 where these have no area.
double LeastCosine(const TriangleMesh& mesh, int vertex, const Vector3& normal)
{
  double least = 1.0;
  mesh.VisitFan(vertex,
    [&](int h)
    {
      const Vector3 area = mesh.FaceAreaVector(TriangleMesh::FaceOf(h));
      const double length = area.norm();
      least = length > 0.0 ? std::min(least, area.dot(normal) / length) : least;
    });
  return least;
}

/// Whether a vector is perpendicular to a unit normal, up to rounding of single precision.
bool IsAcross(const Vector3& normal, const Vector3& vector)
{
  constexpr double Rounding = 1e-5;
  return std::abs(vector.dot(normal)) <= Rounding * vector.stableNorm();
}

/// A vector without its part along a unit normal; zero where less than 1e-6 of it is left.
Vector3 PerpendicularTo(const Vector3& normal, const Vector3& vector)
{
  constexpr double SmallestTangentialPart = 1e-6;
  const Vector3 tangential = vector - vector.dot(normal) * normal;
  return tangential.stableNorm() > SmallestTangentialPart * vector.stableNorm() ? tangential : Vector3(Vector3::Zero());
}

/// A cell, and the normals at its middle or at a place in one of its faces.
class PlaneOfCell
{
public:
  PlaneOfCell(const TriangleMesh& mesh, const SurfaceRelation& relation, int face)
    : Own(AreaOf(mesh, relation.FacesOf(relation.CellOf(face))).stableNormalized())
    , Mesh(mesh)
  {
    for (const int part : relation.FacesOf(relation.CellOf(face)))
    {
      this->Corners.insert(
        this->Corners.end(), mesh.FaceCorners().row(part).begin(), mesh.FaceCorners().row(part).end());
    }
    std::sort(this->Corners.begin(), this->Corners.end());
    this->Corners.erase(std::unique(this->Corners.begin(), this->Corners.end()), this->Corners.end());
    this->Weights.assign(this->Corners.size(), 1.0);
  }

  /// At a place in a face alone.
  PlaneOfCell(const TriangleMesh& mesh, int face, const Vector3& place)
    : Own(mesh.FaceAreaVector(face).stableNormalized())
    , Mesh(mesh)
    , Corners(mesh.FaceCorners().row(face).begin(), mesh.FaceCorners().row(face).end())
  {
    for (int k = 0; k < 3; ++k)
    {
      const Vector3 a = mesh.Position(this->Corners[(k + 1) % 3]) - place;
      const Vector3 b = mesh.Position(this->Corners[(k + 2) % 3]) - place;
      this->Weights.push_back(std::max(0.0, a.cross(b).dot(this->Own)));
    }
  }

  Vector3 TangentialPart(const Vector3& vector) const
  {
    const bool stays = !vector.allFinite() || !this->Own.allFinite() || IsAcross(this->Own, vector);
    return stays ? vector : PerpendicularTo(this->NormalAtPlace(), vector);
  }

  bool IsTriangleAtRim() const { return this->Corners.size() == 3 && this->IsAtRim(); }

  bool Bends() const
  {
    return std::any_of(this->Corners.begin(), this->Corners.end(),
      [this](int vertex)
      {
        const double cosine = LeastCosine(this->Mesh, vertex, NormalOfVertex(this->Mesh, vertex));
        return cosine > SharpCosine && cosine < FlatCosine;
      });
  }

  const Vector3 Own; ///< its normal, the mean of its faces

private:
  static Vector3 AreaOf(const TriangleMesh& mesh, const ElementRow& faces)
  {
    Vector3 area = Vector3::Zero();
    for (const int face : faces)
    {
      area += mesh.FaceAreaVector(face);
    }
    return area;
  }

  bool IsAtRim() const
  {
    return std::any_of(
      this->Corners.begin(), this->Corners.end(), [this](int vertex) { return this->Mesh.IsBoundaryVertex(vertex); });
  }

  Vector3 NormalAtPlace() const
  {
    Vector3 sum = Vector3::Zero();
    for (std::size_t k = 0; k < this->Corners.size(); ++k)
    {
      const int vertex = this->Corners[k];
      const Vector3 normal = NormalOfVertex(this->Mesh, vertex);
      if (this->Mesh.IsBoundaryVertex(vertex) || !(LeastCosine(this->Mesh, vertex, normal) > SharpCosine))
      {
        return this->Own;
      }
      sum += this->Weights[k] * normal;
    }
    return sum.stableNormalized();
  }

  const TriangleMesh& Mesh;
  std::vector<int> Corners;
  std::vector<double> Weights; ///< of their normals
};

/// The plane at the place where a cell's vector stands.
PlaneOfCell PlaneOf(const TriangleMesh& mesh, const SurfaceRelation& relation, int face)
{
  const Vector3* const centre = relation.CentreOf(relation.CellOf(face)); // where a corner counts twice
  return centre ? PlaneOfCell(mesh, face, *centre) : PlaneOfCell(mesh, relation, face);
}

/// Sums of squares at a boundary that bends.
struct SharesAtRim
{
  double Along = 0.0, Tangential = 0.0;

  void Add(double part, const Vector3& tangential)
  {
    this->Along += part * part;
    this->Tangential += tangential.squaredNorm();
  }

  /// SplitVectors::RatioAtRim
  double Ratio() const { return this->Along > 0.0 ? std::sqrt(this->Along / std::max(this->Tangential, 1e-300)) : 0.0; }
};

}

Vector3 NormalOfVertex(const TriangleMesh& mesh, int vertex)
{
  Vector3 sum = Vector3::Zero(), areas = Vector3::Zero();
  mesh.VisitFan(vertex,
    [&](int h)
    {
      const Vector3 a = mesh.Position(mesh.Head(h)) - mesh.Position(vertex);
      const Vector3 b = mesh.Position(mesh.Tail(TriangleMesh::Previous(h))) - mesh.Position(vertex);
      const double weight = a.squaredNorm() * b.squaredNorm();
      sum += weight > 0.0 ? Vector3(a.cross(b) / weight) : Vector3::Zero();
      areas += a.cross(b);
    });
  const Vector3 normal = sum.stableNormalized();
  return normal.allFinite() ? normal : Vector3(areas.stableNormalized());
}

Points NormalsOfVertices(const TriangleMesh& mesh)
{
  Points normals(mesh.NumberOfVertices(), 3);
  for (int vertex = 0; vertex < normals.rows(); ++vertex)
  {
    normals.row(vertex) = NormalOfVertex(mesh, vertex).transpose();
  }
  return normals;
}

Vector3 WithoutNormalPart(const TriangleMesh& mesh, int vertex, const Vector3& vector)
{
  const Vector3 normal = NormalOfVertex(mesh, vertex);
  if (!vector.allFinite() || !(LeastCosine(mesh, vertex, normal) > SharpCosine))
  {
    return vector;
  }
  return PerpendicularTo(normal, vector);
}

Vector3 WithoutNormalPart(const TriangleMesh& mesh, const TangentFrames& ofVertices, int vertex, const Vector3& vector)
{
  return IsAcross(ofVertices.Normal(vertex), vector) ? vector : WithoutNormalPart(mesh, vertex, vector);
}

SplitVectors WithoutNormalParts(const TriangleMesh& mesh, const Points& vectors, const Points& atCorners)
{
  const Points normals = NormalsOfVertices(mesh);
  SplitVectors split{ vectors, atCorners };
  SharesAtRim shares;
  for (int vertex = 0; vertex < vectors.rows(); ++vertex)
  {
    const Vector3 normal = normals.row(vertex).transpose();
    const double cosine = LeastCosine(mesh, vertex, normal);
    if (!(cosine > SharpCosine))
    {
      continue;
    }
    const double part = vectors.row(vertex) * normal;
    split.Tangential.row(vertex) -= part * normal.transpose();
    if (mesh.IsBoundaryVertex(vertex) && cosine < FlatCosine)
    {
      shares.Add(part, split.Tangential.row(vertex).transpose());
    }
    if (atCorners.rows() > 0)
    {
      mesh.VisitFan(
        vertex, [&](int h) { split.AtCorners.row(h) -= (atCorners.row(h) * normal).value() * normal.transpose(); });
    }
  }
  split.RatioAtRim = shares.Ratio();
  return split;
}

Vector3 WithoutNormalPartOfCell(
  const TriangleMesh& mesh, const SurfaceRelation& relation, int face, const Vector3& vector)
{
  return PlaneOf(mesh, relation, face).TangentialPart(vector);
}

Vector3 WithoutNormalPartAt(const TriangleMesh& mesh, int face, const Vector3& place, const Vector3& vector)
{
  return PlaneOfCell(mesh, face, place).TangentialPart(vector);
}

SplitVectors WithoutNormalPartsOfCells(const TriangleMesh& mesh, const SurfaceRelation& relation, const Points& vectors)
{
  SplitVectors split{ vectors, {} };
  SharesAtRim shares;
  for (int face = 0; face < vectors.rows(); ++face)
  {
    const PlaneOfCell plane = PlaneOf(mesh, relation, face);
    const Vector3 vector = vectors.row(face).transpose(), tangential = plane.TangentialPart(vector);
    split.Tangential.row(face) = tangential.transpose();
    if (plane.IsTriangleAtRim() && plane.Bends())
    {
      shares.Add(vector.dot(plane.Own), tangential);
    }
  }
  split.RatioAtRim = shares.Ratio();
  return split;
}

}
