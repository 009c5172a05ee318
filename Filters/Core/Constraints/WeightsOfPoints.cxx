#include "Constraints/WeightsOfPoints.h"

#include <algorithm>
#include <cstddef>

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

/// The vertices of a point.
struct FansOfPoint
{
  int AtPlace = 1; ///< vertices at one place
  int Places = 1;  ///< of all

  FansOfPoint(int vertex, const SurfaceRelation& relation)
  {
    std::vector<int> places;
    for (const int each : relation.VerticesOf(relation.PointOf(vertex)))
    {
      places.push_back(relation.PlaceOf(each));
    }
    if (places.size() > 1)
    {
      this->AtPlace = static_cast<int>(std::count(places.begin(), places.end(), relation.PlaceOf(vertex)));
      std::sort(places.begin(), places.end());
      this->Places = static_cast<int>(std::unique(places.begin(), places.end()) - places.begin());
    }
  }
};

template <class AnyConstraint>
void ShareWeights(std::vector<AnyConstraint>& constraints, const TriangleMesh& mesh, const SurfaceRelation& relation)
{
  std::vector<FansOfPoint> fans;
  std::vector<double> points(mesh.NumberOfVertices(), 0.0); // of each place, with a constraint
  for (const AnyConstraint& constraint : constraints)
  {
    const int vertex = VertexOf(constraint);
    fans.emplace_back(vertex, relation);
    points[relation.PlaceOf(vertex)] += 1.0 / fans.back().AtPlace;
  }
  for (std::size_t k = 0; k < constraints.size(); ++k)
  {
    const double number = points[relation.PlaceOf(VertexOf(constraints[k]))];
    constraints[k].Weight /= number * fans[k].AtPlace * fans[k].Places;
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
