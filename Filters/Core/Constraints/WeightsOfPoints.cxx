#include "Constraints/WeightsOfPoints.h"

#include <algorithm>

namespace dmg
{
namespace
{

int VertexOf(const Constraint& constraint)
{
  return constraint.Element;
}

int VertexOf(const ValueConstraint& constraint)
{
  return constraint.Vertex;
}

template <class AnyConstraint>
void ShareWeights(std::vector<AnyConstraint>& constraints, const TriangleMesh& mesh, const SurfaceRelation& relation)
{
  std::vector<int> numbers(mesh.NumberOfVertices(), 0);
  for (const AnyConstraint& constraint : constraints)
  {
    ++numbers[VertexOf(constraint)];
  }
  for (AnyConstraint& constraint : constraints)
  {
    const int vertex = VertexOf(constraint);
    const int fans = std::max(relation.VerticesOf(relation.PointOf(vertex)).size(), 1);
    constraint.Weight /= static_cast<double>(numbers[vertex]) * fans;
  }
}

}

void WeighPlacesOnce(std::vector<Constraint>& atVertices, const TriangleMesh& mesh, const SurfaceRelation& relation)
{
  ShareWeights(atVertices, mesh, relation);
}

void WeighPlacesOnce(std::vector<ValueConstraint>& values, const TriangleMesh& mesh, const SurfaceRelation& relation)
{
  ShareWeights(values, mesh, relation);
}

}
