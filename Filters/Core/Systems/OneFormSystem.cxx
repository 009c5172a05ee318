#include "Systems/OneFormSystem.h"

#include "Support/Errors.h"

#include <cassert>
#include <cmath>
#include <string>
#include <utility>

namespace dmg
{

HarmonicSystem<double> MakeOneFormSystem(const TriangleMesh& mesh,
  const PrescribedEdges& prescribed, const FieldWeights& weights, const ExecutionContext& context,
  VertexAreas areas)
{
  CheckWeights(weights);
  if (prescribed.Edges.empty())
  {
    throw InvalidInput("no direction is prescribed, so the smoothest field is zero; "
                       "prescribe a direction on at least one cell or point");
  }
  assert(prescribed.Edges.size() == prescribed.Weights.size());

  SparseMatrix<double> smoothness = OneFormLaplacian(mesh, context, areas);
  SparseMatrix<double> factor = OneFormLaplacianFactor(mesh, context, areas);
  const Vector<double> mass = PositiveStar1(mesh);
  if (weights.Constraints == ConstraintKind::Hard)
  {
    HarmonicSystem<double> system = HarmonicSystem<double>::Hard(
      std::move(smoothness), mass, prescribed.Edges, std::move(factor));
    if (system.NumberOfFree() == 0)
    {
      throw InvalidInput("hard constraints leave no edge to solve for; prescribe fewer cells or "
                         "points or make the constraints soft");
    }
    return system;
  }
  smoothness *= weights.Smoothness;
  factor *= std::sqrt(weights.Smoothness);
  const double scale = weights.Alignment / (2.0 * Star2(mesh).cwiseInverse().mean());
  Vector<double> alignment(prescribed.Edges.size());
  for (Eigen::Index b = 0; b < alignment.size(); ++b)
  {
    alignment[b] = scale * prescribed.Weights[b] * mass[prescribed.Edges[b]];
  }
  return HarmonicSystem<double>::Soft(std::move(smoothness), mass, prescribed.Edges,
    std::move(alignment), std::move(factor));
}

}
