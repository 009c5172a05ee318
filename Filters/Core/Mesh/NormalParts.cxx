#include "Mesh/NormalParts.h"

#include <algorithm>
#include <cmath>

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

/// The normal at a place in a face: that of its corners, interpolated; its own at the boundary and at sharp edges.
Vector3 NormalAt(const TriangleMesh& mesh, int face, const Vector3& place)
{
  const Vector3 own = mesh.FaceAreaVector(face).stableNormalized();
  Vector3 sum = Vector3::Zero();
  for (int k = 0; k < 3; ++k)
  {
    const int vertex = mesh.FaceCorners()(face, k);
    const Vector3 normal = NormalOfVertex(mesh, vertex);
    if (mesh.IsBoundaryVertex(vertex) || !(LeastCosine(mesh, vertex, normal) > SharpCosine))
    {
      return own;
    }
    const Vector3 a = mesh.Position(mesh.FaceCorners()(face, (k + 1) % 3)) - place;
    const Vector3 b = mesh.Position(mesh.FaceCorners()(face, (k + 2) % 3)) - place;
    sum += std::max(0.0, a.cross(b).dot(own)) * normal;
  }
  return sum.stableNormalized();
}

/// \param own the normal of the cell or face, in whose plane vectors stay as they are.
Vector3 TangentialPart(const Vector3& own, const Vector3& normal, const Vector3& vector)
{
  const bool stays = !vector.allFinite() || !normal.allFinite() || !own.allFinite() || IsAcross(own, vector);
  return stays ? vector : PerpendicularTo(normal, vector);
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
  Vector3 area = Vector3::Zero();
  for (const int part : relation.FacesOf(relation.CellOf(face)))
  {
    area += mesh.FaceAreaVector(part);
  }
  const Vector3 own = area.stableNormalized();
  return TangentialPart(own, own, vector);
}

Vector3 WithoutNormalPartAt(const TriangleMesh& mesh, int face, const Vector3& place, const Vector3& vector)
{
  const Vector3 own = mesh.FaceAreaVector(face).stableNormalized();
  return TangentialPart(own, NormalAt(mesh, face, place), vector);
}

Points WithoutNormalPartsOfCells(const TriangleMesh& mesh, const SurfaceRelation& relation, const Points& vectors)
{
  Points tangential = vectors;
  for (int face = 0; face < vectors.rows(); ++face)
  {
    tangential.row(face) = WithoutNormalPartOfCell(mesh, relation, face, vectors.row(face).transpose()).transpose();
  }
  return tangential;
}

}
