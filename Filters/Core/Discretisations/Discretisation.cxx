#include "Discretisations/Discretisation.h"

#include "Levels/SampledLevels.h"
#include "Support/Errors.h"
#include "Support/SparseAssembly.h"

#include <cassert>

namespace dmg
{

int Discretisation::NumberOfElements() const
{
  switch (this->Elements())
  {
    case ElementKind::Vertices:
      return this->Surface.Mesh.NumberOfVertices();
    case ElementKind::Edges:
      return this->Surface.Mesh.NumberOfEdges();
    default:
      return this->Surface.Mesh.NumberOfFaces();
  }
}

ProlongationOperators Discretisation::SampledLevels(double distance, const ExecutionContext& context) const
{
  return dmg::SampledLevels(this->Surface.Mesh, distance, context);
}

Eigen::MatrixXd Discretisation::HarmonicFields(const ProlongationOperators*, const ExecutionContext&) const
{
  return Eigen::MatrixXd(this->NumberOfUnknowns(), 0);
}

Eigen::MatrixXd Discretisation::HarmonicBasis(Eigen::MatrixXd basis, const ExecutionContext&) const
{
  return basis;
}

Penalties Discretisation::PenaltiesOf(
  const FieldConstraints& constraints, const FieldWeights& weights, const ExecutionContext& context) const
{
  CheckWeights(weights);
  assert(constraints.Elements.size() == constraints.Weights.size());
  const int parts = this->UnknownsPerElement();
  Penalties unknowns{ weights.Constraints, parts == 2 ? PairsOf(constraints.Elements) : constraints.Elements, {} };
  if (weights.Constraints == ConstraintKind::Soft)
  {
    const Vector<double> penalties = this->PenaltiesOfElements(constraints.Elements, context);
    unknowns.Alignment.resize(unknowns.Unknowns.size());
    for (Eigen::Index b = 0; b < unknowns.Alignment.size(); ++b)
    {
      unknowns.Alignment[b] = weights.Alignment * constraints.Weights[b / parts] * penalties[b / parts];
    }
  }
  return unknowns;
}

void Discretisation::CheckOperators(bool areThere, Remedy remedy)
{
  if (!areThere)
  {
    throw InvalidInput("the operators of the surface do not include those that are needed; " + TextOf(remedy));
  }
}

}
