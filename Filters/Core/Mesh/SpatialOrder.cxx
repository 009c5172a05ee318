#include "Mesh/SpatialOrder.h"

#include "Support/CountingSort.h"
#include "Support/Permutations.h"
#include "Support/Unfilled.h"

#include <cstdint>

namespace dmg
{

namespace
{

constexpr int BitsPerAxis = 10;
constexpr int Grain = 4096;

/// Spreads the bits of a number three apart.
std::uint32_t Spread(std::uint32_t x)
{
  x = (x | (x << 16)) & 0x030000ff;
  x = (x | (x << 8)) & 0x0300f00f;
  x = (x | (x << 4)) & 0x030c30c3;
  x = (x | (x << 2)) & 0x09249249;
  return x;
}

constexpr int BitsPerSort = 15;

/// Sorts by some bits of the keys, and keeps the order of those where these are equal.
std::vector<int> SortByBits(const std::vector<int>& order, const Unfilled<std::uint32_t>& keys,
  int shift, const ExecutionContext& context)
{
  constexpr int buckets = 1 << BitsPerSort;
  return SortByKey(order, buckets,
    [&keys, shift](int i) { return static_cast<int>((keys[i] >> shift) % buckets); }, context)
    .Items;
}

}

std::vector<int> FacesInSpatialOrder(const TriangleMesh& mesh, const ExecutionContext& context)
{
  const Points& V = mesh.VertexPositions();
  const Triangles& F = mesh.FaceCorners();
  const Eigen::RowVector3d low = V.colwise().minCoeff();
  const double size = (V.colwise().maxCoeff() - low).maxCoeff();
  const double scale = size > 0.0 ? ((1 << BitsPerAxis) - 1) / size : 0.0;

  Unfilled<std::uint32_t> keys(mesh.NumberOfFaces());
  context.ParallelFor(0, mesh.NumberOfFaces(), Grain, [&](int first, int last) {
    for (int f = first; f < last; ++f)
    {
      const Eigen::RowVector3d center =
        ((V.row(F(f, 0)) + V.row(F(f, 1)) + V.row(F(f, 2))) / 3.0 - low) * scale;
      keys[f] = Spread(static_cast<std::uint32_t>(center[0])) |
        (Spread(static_cast<std::uint32_t>(center[1])) << 1) |
        (Spread(static_cast<std::uint32_t>(center[2])) << 2);
    }
  });
  const std::vector<int> byLowBits =
    SortByBits(Identity(mesh.NumberOfFaces()), keys, 0, context);
  return SortByBits(byLowBits, keys, BitsPerSort, context);
}

SpatialOrder::SpatialOrder(const TriangleMesh& mesh, const ExecutionContext& context)
  : OldFaces(FacesInSpatialOrder(mesh, context))
  , NewVertices(mesh.NumberOfVertices(), -1)
{
  const Triangles& F = mesh.FaceCorners();
  this->OldVertices.reserve(mesh.NumberOfVertices());
  for (int f : this->OldFaces)
  {
    for (int k = 0; k < 3; ++k)
    {
      int& number = this->NewVertices[F(f, k)];
      if (number < 0)
      {
        number = static_cast<int>(this->OldVertices.size());
        this->OldVertices.push_back(F(f, k));
      }
    }
  }
}

SpatialOrder::SignedEdges SpatialOrder::Edges(
  const TriangleMesh& mesh, const TriangleMesh& sorted) const
{
  SignedEdges edges{ std::vector<int>(sorted.NumberOfEdges()),
    Vector<double>(sorted.NumberOfEdges()) };
  for (int edge = 0; edge < sorted.NumberOfEdges(); ++edge)
  {
    const int h = sorted.HalfedgeOf(edge);
    const int oldHalfedge = 3 * this->OldFaces[TriangleMesh::FaceOf(h)] + h % 3;
    edges.Numbers[edge] = mesh.EdgeOf(oldHalfedge);
    edges.Signs[edge] = sorted.EdgeSign(h) * mesh.EdgeSign(oldHalfedge);
  }
  return edges;
}

TriangleMesh SpatialOrder::Apply(const TriangleMesh& mesh) const
{
  Points points(mesh.NumberOfVertices(), 3);
  Triangles triangles(mesh.NumberOfFaces(), 3);
  for (int v = 0; v < mesh.NumberOfVertices(); ++v)
  {
    points.row(v) = mesh.VertexPositions().row(this->OldVertices[v]);
  }
  for (int f = 0; f < mesh.NumberOfFaces(); ++f)
  {
    for (int k = 0; k < 3; ++k)
    {
      triangles(f, k) = this->NewVertices[mesh.FaceCorners()(this->OldFaces[f], k)];
    }
  }
  return TriangleMesh(std::move(points), std::move(triangles));
}

TangentFrames SpatialOrder::ApplyToFaces(
  const TangentFrames& faceFrames, const ExecutionContext& context) const
{
  const int faces = static_cast<int>(faceFrames.X.rows());
  TangentFrames result{ Points(faces, 3), Points(faces, 3) };
  context.ParallelFor(0, faces, Grain, [&](int first, int last) {
    for (int f = first; f < last; ++f)
    {
      result.X.row(f) = faceFrames.X.row(this->OldFaces[f]);
      result.Y.row(f) = faceFrames.Y.row(this->OldFaces[f]);
    }
  });
  return result;
}

}
