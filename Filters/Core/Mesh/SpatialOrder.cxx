#include "Mesh/SpatialOrder.h"

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

/// Stable counting sort by 15 of the bits of the keys.
std::vector<int> SortByBits(
  const std::vector<int>& order, const std::vector<std::uint32_t>& keys, int shift)
{
  constexpr std::uint32_t mask = (1u << 15) - 1;
  std::vector<int> next(mask + 2, 0);
  for (std::uint32_t key : keys)
  {
    ++next[((key >> shift) & mask) + 1];
  }
  for (std::uint32_t bucket = 0; bucket < mask; ++bucket)
  {
    next[bucket + 1] += next[bucket];
  }
  std::vector<int> sorted(order.size());
  for (int i : order)
  {
    sorted[next[(keys[i] >> shift) & mask]++] = i;
  }
  return sorted;
}

}

SpatialOrder::SpatialOrder(const TriangleMesh& mesh, const ExecutionContext& context)
  : NewVertices(mesh.NumberOfVertices(), -1)
{
  const Points& V = mesh.VertexPositions();
  const Triangles& F = mesh.FaceCorners();
  const Eigen::RowVector3d low = V.colwise().minCoeff();
  const double size = (V.colwise().maxCoeff() - low).maxCoeff();
  const double scale = size > 0.0 ? ((1 << BitsPerAxis) - 1) / size : 0.0;

  std::vector<std::uint32_t> keys(mesh.NumberOfFaces());
  this->OldFaces.resize(mesh.NumberOfFaces());
  context.ParallelFor(0, mesh.NumberOfFaces(), Grain, [&](int first, int last) {
    for (int f = first; f < last; ++f)
    {
      const Eigen::RowVector3d center =
        ((V.row(F(f, 0)) + V.row(F(f, 1)) + V.row(F(f, 2))) / 3.0 - low) * scale;
      keys[f] = Spread(static_cast<std::uint32_t>(center[0])) |
        (Spread(static_cast<std::uint32_t>(center[1])) << 1) |
        (Spread(static_cast<std::uint32_t>(center[2])) << 2);
      this->OldFaces[f] = f;
    }
  });
  this->OldFaces = SortByBits(SortByBits(this->OldFaces, keys, 0), keys, 15);

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
  TangentFrames result{ Points(faces, 3), Points(faces, 3), Points(faces, 3) };
  context.ParallelFor(0, faces, Grain, [&](int first, int last) {
    for (int f = first; f < last; ++f)
    {
      result.X.row(f) = faceFrames.X.row(this->OldFaces[f]);
      result.Y.row(f) = faceFrames.Y.row(this->OldFaces[f]);
      result.N.row(f) = faceFrames.N.row(this->OldFaces[f]);
    }
  });
  return result;
}

}
