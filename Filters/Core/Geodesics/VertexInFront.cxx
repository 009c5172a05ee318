#include "Geodesics/VertexInFront.h"

#include "Operators/FunctionSource.h"

#include <Eigen/Geometry>

#include <tuple>
#include <vector>

namespace dmg
{

namespace
{

/// The vertices on the components of the largest area.
std::vector<int> VerticesOfLargestComponents(const TriangleMesh& mesh)
{
  constexpr double SameArea = 1.0 - 1e-9;
  const std::vector<int> components = VertexComponents(mesh);
  const Vector<double> areas = FreeComponents(components, {}).Sums(IntegratedSource(mesh));
  const double large = SameArea * areas.maxCoeff();
  std::vector<int> vertices;
  for (int v = 0; v < mesh.NumberOfVertices(); ++v)
  {
    if (areas[components[v]] >= large)
    {
      vertices.push_back(v);
    }
  }
  return vertices;
}

}

int VertexInFront(const TriangleMesh& mesh)
{
  const std::vector<int> vertices = VerticesOfLargestComponents(mesh);
  Eigen::AlignedBox3d bounds;
  for (const int v : vertices)
  {
    bounds.extend(Vector3(mesh.VertexPositions().row(v)));
  }
  const Vector3 front(bounds.center().x(), bounds.center().y(), bounds.max().z());
  const auto rank = [&](int v)
  {
    const Vector3 place = mesh.VertexPositions().row(v);
    return std::make_tuple((place - front).stableNorm(), place.x(), place.y(), place.z());
  };
  int nearest = vertices.front();
  for (const int v : vertices)
  {
    if (rank(v) < rank(nearest))
    {
      nearest = v;
    }
  }
  return nearest;
}

}
