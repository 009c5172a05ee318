#include "Quads/LengthsOfEdges.h"

#include "Quads/SizesOfQuads.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace dmg
{

LengthsOfEdges FindLengthsOfEdges(
  const TriangleMesh& mesh, const std::vector<int>& components, const QuadOptions& options)
{
  constexpr double FewestQuadsOfComponent = 24.0;
  const Vector<double> areas = mesh.FaceAreas();
  Vector<double> ofComponents = Vector<double>::Zero(1 + *std::max_element(components.begin(), components.end()));
  for (int face = 0; face < areas.size(); ++face)
  {
    ofComponents[components[face]] += areas[face];
  }
  Vector<double> sizes = options.Sizes;
  if (sizes.size() == 0)
  {
    sizes = Vector<double>::Ones(areas.size());
  }
  sizes /= sizes.mean(); // keeps squares in range
  LengthsOfEdges lengths;
  lengths.Mean = options.EdgeLength > 0.0 ? options.EdgeLength : std::sqrt(areas.sum() / options.NumberOfQuads);
  lengths.OnFaces = lengths.Mean * sizes;
  // Squares of side Mean on average: as many quads as if all sizes were the same.
  const auto fit = [&]
  { lengths.OnFaces *= lengths.Mean * std::sqrt(ExpectedOnFaces(mesh, lengths.OnFaces).sum() / areas.sum()); };
  fit();
  if (sizes.maxCoeff() > sizes.minCoeff())
  {
    LimitGrowth(mesh, lengths.OnFaces);
    fit();
  }
  for (int face = 0; face < areas.size(); ++face)
  {
    const double area = std::max(ofComponents[components[face]], std::numeric_limits<double>::min());
    lengths.OnFaces[face] = std::min(lengths.OnFaces[face], std::sqrt(area / FewestQuadsOfComponent));
  }
  return lengths;
}

Vector<double> ExpectedOnFaces(const TriangleMesh& mesh, const Vector<double>& lengths)
{
  return mesh.FaceAreas().array() / lengths.array().square();
}

}
