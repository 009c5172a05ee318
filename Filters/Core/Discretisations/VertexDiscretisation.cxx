#include "Discretisations/VertexDiscretisation.h"

#include "Support/ComplexPairs.h"

namespace dmg
{

FieldConstraints VertexDiscretisation::MeansOf(const std::vector<PowerAtVertex>& sums) const
{
  FieldConstraints constraints;
  Vector<Complex> values(static_cast<Eigen::Index>(sums.size()));
  Eigen::Index count = 0;
  for (std::size_t vertex = 0; vertex < sums.size(); ++vertex)
  {
    if (sums[vertex].Weight > 0.0)
    {
      constraints.Elements.push_back(static_cast<int>(vertex));
      constraints.Weights.push_back(sums[vertex].Weight);
      values[count++] = sums[vertex].Power / sums[vertex].Weight;
    }
  }
  constraints.Values = this->AsUnknowns(values.head(count));
  return constraints;
}

Vector<double> VertexDiscretisation::AsUnknowns(const Vector<Complex>& numbers) const
{
  return this->UnknownsPerElement() == 1 ? Vector<double>(numbers.real()) : Vector<double>(AsPairs(numbers));
}

Discretisation::IntegralWeights VertexDiscretisation::WeightsOfIntegral() const
{
  const double meanArea = this->AreasOfVertices(SerialContext()).mean();
  return { meanArea, meanArea };
}

Vector<double> VertexDiscretisation::PenaltiesOfElements(
  const std::vector<int>& vertices, const ExecutionContext& context) const
{
  const Vector<double> areas = this->AreasOfVertices(context);
  const double meanArea = areas.mean();
  return meanArea > 0.0 ? Vector<double>(areas(vertices) / meanArea)
                        : Vector<double>::Ones(static_cast<Eigen::Index>(vertices.size()));
}

}
