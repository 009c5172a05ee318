#include "Mesh/NormalParts.h"

#include <algorithm>
#include <cmath>

namespace dmg
{
namespace
{

/// The cosine of 30 degrees.
constexpr double SharpCosine = 0.86602540378443865;

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
  constexpr double SmallestTangentialPart = 1e-6;
  const Vector3 normal = NormalOfVertex(mesh, vertex);
  if (!vector.allFinite() || !(LeastCosine(mesh, vertex, normal) > SharpCosine))
  {
    return vector;
  }
  const Vector3 tangential = vector - vector.dot(normal) * normal;
  return tangential.stableNorm() > SmallestTangentialPart * vector.stableNorm() ? tangential : Vector3(Vector3::Zero());
}

SplitVectors WithoutNormalParts(const TriangleMesh& mesh, const Points& vectors, const Points& atCorners)
{
  static const double FlatCosine = std::cos(Pi / 360.0); // half a degree
  const Points normals = NormalsOfVertices(mesh);
  SplitVectors split{ vectors, atCorners };
  double along = 0.0, tangential = 0.0;
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
      along += part * part;
      tangential += split.Tangential.row(vertex).squaredNorm();
    }
    if (atCorners.rows() > 0)
    {
      mesh.VisitFan(
        vertex, [&](int h) { split.AtCorners.row(h) -= (atCorners.row(h) * normal).value() * normal.transpose(); });
    }
  }
  split.RatioAtRim = along > 0.0 ? std::sqrt(along / std::max(tangential, 1e-300)) : 0.0;
  return split;
}

}
