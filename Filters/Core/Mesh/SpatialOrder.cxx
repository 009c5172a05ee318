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
std::vector<int> SortByBits(
  const std::vector<int>& order, const Unfilled<std::uint32_t>& keys, int shift, const ExecutionContext& context)
{
  constexpr int buckets = 1 << BitsPerSort;
  return SortByKey(
    order, buckets, [&keys, shift](int i) { return static_cast<int>((keys[i] >> shift) % buckets); }, context)
    .Items;
}

}

std::vector<int> InSpatialOrder(int number, const std::function<Vector3(int)>& placeOf, const Vector3& low, double size,
  const ExecutionContext& context)
{
  const double scale = ((1 << BitsPerAxis) - 1) / size;
  // The case of a coordinate that is not finite, and that of one position for all.
  const auto bits = [](double place)
  { return place >= 0.0 && place < (1 << BitsPerAxis) ? static_cast<std::uint32_t>(place) : 0; };

  Unfilled<std::uint32_t> keys(number);
  context.ParallelFor(0, number, Grain,
    [&](int first, int last)
    {
      for (int i = first; i < last; ++i)
      {
        const Vector3 place = (placeOf(i) - low) * scale;
        keys[i] = Spread(bits(place[0])) | (Spread(bits(place[1])) << 1) | (Spread(bits(place[2])) << 2);
      }
    });
  const std::vector<int> byLowBits = SortByBits(Identity(number), keys, 0, context);
  return SortByBits(byLowBits, keys, BitsPerSort, context);
}

std::vector<int> FacesInSpatialOrder(const Points& points, const Triangles& triangles, const ExecutionContext& context)
{
  const Vector3 low = points.colwise().minCoeff();
  const Vector3 high = points.colwise().maxCoeff();
  const auto centerOf = [&points, &triangles](int f)
  {
    const auto& corners = triangles.row(f);
    return Vector3((points.row(corners[0]) + points.row(corners[1]) + points.row(corners[2])) / 3.0);
  };
  return InSpatialOrder(static_cast<int>(triangles.rows()), centerOf, low, (high - low).maxCoeff(), context);
}

SpatialOrder::SpatialOrder(const Points& points, const Triangles& triangles, const ExecutionContext& context)
  : OldFaces(FacesInSpatialOrder(points, triangles, context))
  , NewVertices(points.rows(), -1)
{
  this->OldVertices.reserve(points.rows());
  for (int f : this->OldFaces)
  {
    for (int k = 0; k < 3; ++k)
    {
      int& number = this->NewVertices[triangles(f, k)];
      if (number < 0)
      {
        number = static_cast<int>(this->OldVertices.size());
        this->OldVertices.push_back(triangles(f, k));
      }
    }
  }
}

SpatialOrder::SignedEdges SpatialOrder::Edges(const TriangleMesh& mesh, const TriangleMesh& sorted) const
{
  SignedEdges edges{ std::vector<int>(sorted.NumberOfEdges()), Vector<double>(sorted.NumberOfEdges()) };
  for (int edge = 0; edge < sorted.NumberOfEdges(); ++edge)
  {
    const int h = sorted.HalfedgeOf(edge);
    const int oldHalfedge = 3 * this->OldFaces[TriangleMesh::FaceOf(h)] + h % 3;
    edges.Numbers[edge] = mesh.EdgeOf(oldHalfedge);
    edges.Signs[edge] = sorted.EdgeSign(h) * mesh.EdgeSign(oldHalfedge);
  }
  return edges;
}

TriangleMesh SpatialOrder::Apply(
  const Points& points, const Triangles& triangles, const ExecutionContext& context) const
{
  Points newPoints(points.rows(), 3);
  context.ParallelFor(0, static_cast<int>(points.rows()), Grain,
    [&](int first, int last)
    {
      for (int v = first; v < last; ++v)
      {
        newPoints.row(v) = points.row(this->OldVertices[v]);
      }
    });
  Triangles newTriangles(triangles.rows(), 3);
  context.ParallelFor(0, static_cast<int>(triangles.rows()), Grain,
    [&](int first, int last)
    {
      for (int f = first; f < last; ++f)
      {
        for (int k = 0; k < 3; ++k)
        {
          newTriangles(f, k) = this->NewVertices[triangles(this->OldFaces[f], k)];
        }
      }
    });
  return TriangleMesh(std::move(newPoints), std::move(newTriangles), {}, context);
}

TangentFrames SpatialOrder::ApplyToFaces(const TangentFrames& faceFrames, const ExecutionContext& context) const
{
  const int faces = static_cast<int>(faceFrames.X.rows());
  TangentFrames result{ Points(faces, 3), Points(faces, 3) };
  context.ParallelFor(0, faces, Grain,
    [&](int first, int last)
    {
      for (int f = first; f < last; ++f)
      {
        result.X.row(f) = faceFrames.X.row(this->OldFaces[f]);
        result.Y.row(f) = faceFrames.Y.row(this->OldFaces[f]);
      }
    });
  return result;
}

}
