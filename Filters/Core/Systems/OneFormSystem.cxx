#include "Systems/OneFormSystem.h"

#include "Support/Errors.h"

#include <cassert>
#include <string>
#include <utility>

namespace dmg
{

PrescribedUnknowns PrescribedUnknownsOf(
  const TriangleMesh& mesh, const PrescribedEdges& prescribed, const FieldWeights& weights)
{
  CheckWeights(weights);
  if (prescribed.Edges.empty())
  {
    throw InvalidInput("no direction is prescribed, so the smoothest field is zero; "
                       "prescribe a direction on at least one cell or point");
  }
  assert(prescribed.Edges.size() == prescribed.Weights.size());
  PrescribedUnknowns unknowns{ weights.Constraints, prescribed.Edges, {} };
  if (weights.Constraints == ConstraintKind::Soft)
  {
    const double scale = weights.Alignment / (2.0 * Star2(mesh).cwiseInverse().mean());
    unknowns.Alignment.resize(prescribed.Edges.size());
    for (Eigen::Index b = 0; b < unknowns.Alignment.size(); ++b)
    {
      unknowns.Alignment[b] = scale * prescribed.Weights[b] *
        PositiveStar1OfEdge(mesh, prescribed.Edges[b]);
    }
  }
  return unknowns;
}

HarmonicSystem<double> MakeOneFormSystem(const TriangleMesh& mesh,
  const PrescribedEdges& prescribed, const FieldWeights& weights, const ExecutionContext& context,
  VertexAreas areas)
{
  PrescribedUnknowns unknowns = PrescribedUnknownsOf(mesh, prescribed, weights);
  SparseMatrix<double> smoothness = OneFormLaplacian(mesh, context, areas);
  if (weights.Constraints == ConstraintKind::Soft)
  {
    smoothness *= weights.Smoothness;
  }
  HarmonicSystem<double> system = HarmonicSystem<double>::Make(
    std::move(smoothness), PositiveStar1(mesh, context), std::move(unknowns));
  CheckAnyIsFree(system.NumberOfFree(), weights.Constraints, "edge");
  return system;
}

}
