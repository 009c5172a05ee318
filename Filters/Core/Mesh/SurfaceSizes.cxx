#include "Mesh/SurfaceSizes.h"

namespace dmg
{

SurfaceSizes SizesOf(const TriangleMesh& mesh)
{
  const Vector<double> areas = mesh.FaceAreas();
  const Points& points = mesh.VertexPositions();
  SurfaceSizes sizes;
  sizes.Area = areas.sum();
  sizes.MeanFaceArea = areas.mean();
  for (int edge = 0; edge < mesh.NumberOfEdges(); ++edge)
  {
    const auto [tail, head] = mesh.EdgeVertices(edge);
    sizes.MeanEdge += (mesh.Position(head) - mesh.Position(tail)).norm();
  }
  sizes.MeanEdge /= mesh.NumberOfEdges();
  sizes.Lower = points.colwise().minCoeff().transpose();
  sizes.Upper = points.colwise().maxCoeff().transpose();
  sizes.NumberOfVertices = mesh.NumberOfVertices();
  return sizes;
}

}
