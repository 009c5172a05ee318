#include "Discretisations/ScalarFunction.h"

#include "Operators/CotangentLaplacian.h"
#include "Operators/FaceFieldOperators.h"
#include "Operators/PowerFieldDirections.h"
#include "Solvers/Multigrid/AssembledHierarchy.h"
#include "Support/ComplexPairs.h"
#include "Support/Errors.h"
#include "Support/ShortText.h"
#include "Support/SparseAssembly.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <string>
#include <utility>

namespace dmg
{
namespace
{

// Up to so many unknowns a factorisation is ready before multigrid, from the bare mesh (ScalarFunction.md).
constexpr int LargestForCholesky = 100000;
constexpr int SolvesForCholesky = 30;
// Two cycles halve the iterations, and take as long; they mind uneven triangles less.
constexpr int CyclesInARow = 2;

/// The mean over the faces around each vertex of what these take from the columns.
SparseMatrix<double> MeanOfFaces(
  const TriangleMesh& mesh, const SparseMatrix<double>& ofFaces, const ExecutionContext& context)
{
  return AssembleMatrix<double>(mesh.NumberOfVertices(), static_cast<int>(ofFaces.cols()), context,
    [&](int vertex, RowEntries<double>& row)
    {
      int faces = 0;
      mesh.VisitFan(vertex,
        [&](int h)
        {
          ++faces;
          for (SparseMatrix<double>::InnerIterator entry(ofFaces, TriangleMesh::FaceOf(h)); entry; ++entry)
          {
            AddTo(row, static_cast<int>(entry.col()), entry.value());
          }
        });
      for (auto& [column, value] : row)
      {
        value /= faces;
      }
    });
}

/// The weights of transports, without their turns.
std::vector<SparseMatrix<double>> WeightsOf(const std::vector<TransportOperator>& transports)
{
  std::vector<SparseMatrix<double>> weights;
  for (const TransportOperator& transport : transports)
  {
    weights.emplace_back(transport.cwiseAbs());
  }
  return weights;
}

std::vector<SparseMatrix<double>> ProlongationsOfNodes(
  const TriangleMesh& mesh, const std::vector<TransportOperator>& linear, const ExecutionContext& context)
{
  std::vector<SparseMatrix<double>> prolongations = WeightsOf(linear);
  prolongations[0] = MeanOfFaces(mesh, prolongations[0], context);
  return prolongations;
}

}

Vector<double> ScalarFunction::Mass(const ExecutionContext&) const
{
  return Star0(this->Surface.Mesh, this->Areas);
}

std::unique_ptr<const StiffnessHierarchy> ScalarFunction::Coarsen(
  const LinearProlongations& linear, const ExecutionContext& context) const
{
  std::vector<SparseMatrix<double>> prolongations = ProlongationsOfNodes(this->Surface.Mesh, linear.All(), context);
  linear.Forget();
  SparseMatrix<double> L0 = CotangentLaplacian(this->Surface.Mesh, context);
  return std::make_unique<AssembledHierarchy<double>>(L0, std::move(prolongations));
}

std::unique_ptr<const StiffnessHierarchy> ScalarFunction::Assemble(
  const ProlongationOperators* operators, CoarseSpaceKind space, const ExecutionContext& context) const
{
  std::vector<SparseMatrix<double>> prolongations;
  if (operators && space == CoarseSpaceKind::LinearInterpolation)
  {
    CheckOperators(!operators->Linear.empty(), Remedy::PowerFieldOperators);
    prolongations = ProlongationsOfNodes(this->Surface.Mesh, operators->Linear, context);
  }
  else if (operators)
  {
    CheckOperators(!operators->S0.empty(), Remedy::PowerFieldOperators);
    prolongations = operators->S0;
  }
  SparseMatrix<double> L0 = CotangentLaplacian(this->Surface.Mesh, context);
  return std::make_unique<AssembledHierarchy<double>>(L0, std::move(prolongations));
}

SolverTuning ScalarFunction::Tuning() const
{
  SolverTuning tuning;
  tuning.LargestForCholesky = LargestForCholesky;
  tuning.SolvesForCholesky = SolvesForCholesky;
  tuning.CyclesInARow = CyclesInARow;
  return tuning;
}

FieldConstraints ScalarFunction::Prescribe(const Constraints& given, const ElementNames& names) const
{
  if (given.Values.empty() && given.Source.size() == 0)
  {
    throw InvalidInput("no value is prescribed, so the function of least smoothness energy is zero; " +
      TextOf(Remedy::PrescribedValues));
  }
  FieldConstraints constraints = this->ConstraintsOfValues(given.Values, names);
  if (given.Source.size() > 0)
  {
    this->AddSource(given, names, constraints);
  }
  return constraints;
}

FieldConstraints ScalarFunction::ConstraintsOfValues(
  std::vector<ValueConstraint> values, const ElementNames& names) const
{
  std::stable_sort(values.begin(), values.end(),
    [](const ValueConstraint& a, const ValueConstraint& b) { return a.Vertex < b.Vertex; });
  FieldConstraints constraints;
  std::vector<double> sums;
  for (const auto& [vertex, value, weight] : values)
  {
    CheckElement(vertex, this->Surface.Mesh.NumberOfVertices(), "vertex");
    if (!std::isfinite(value) || !(weight > 0.0) || !std::isfinite(weight))
    {
      throw InvalidInput("the value " + ShortText(value) + " with the weight " + ShortText(weight) +
        ", prescribed on " + names.Vertex(vertex) +
        ", is not finite or its weight not positive; repair it, or leave the point out, " +
        TextOf(Remedy::MaskOfValues));
    }
    if (constraints.Elements.empty() || constraints.Elements.back() != vertex)
    {
      constraints.Elements.push_back(vertex);
      constraints.Weights.push_back(0.0);
      sums.push_back(0.0);
    }
    constraints.Weights.back() += weight;
    sums.back() += weight * value;
  }
  constraints.Values.resize(sums.size());
  for (std::size_t b = 0; b < sums.size(); ++b)
  {
    constraints.Values[b] = sums[b] / constraints.Weights[b];
  }
  return constraints;
}

Discretisation::IntegralWeights ScalarFunction::WeightsOfIntegral() const
{
  const double meanArea = this->Mass(SerialContext()).mean();
  return { meanArea, meanArea };
}

/// On a component without values, the first vertex is held at zero, as the sum of the equations there says that a penalty holds it
/// exactly.
void ScalarFunction::AddSource(const Constraints& given, const ElementNames& names, FieldConstraints& constraints) const
{
  const TriangleMesh& mesh = this->Surface.Mesh;
  if (given.Source.size() != mesh.NumberOfVertices())
  {
    throw InvalidInput("the source has " + std::to_string(given.Source.size()) +
      " numbers in place of one for each of the " + std::to_string(mesh.NumberOfVertices()) + " vertices");
  }
  for (int vertex = 0; vertex < given.Source.size(); ++vertex)
  {
    if (!(std::abs(given.Source[vertex]) <= LargestPrescribed))
    {
      throw InvalidInput("the source is " + ShortText(given.Source[vertex]) + " at " + names.Vertex(vertex) +
        ", which is not finite or too large; repair it");
    }
  }
  const std::vector<int> components = VertexComponents(mesh);
  const FreeComponents free(components, constraints.Elements);
  constraints.Source = IntegratedSource(mesh, given.Source);
  free.Balance(constraints.Source, IntegratedSource(mesh), given.Net);
  constraints.Grounded = free.FirstVertices();
  for (const int vertex : constraints.Grounded)
  {
    const auto place = std::lower_bound(constraints.Elements.begin(), constraints.Elements.end(), vertex);
    const auto index = place - constraints.Elements.begin();
    constraints.Elements.insert(place, vertex);
    constraints.Weights.insert(constraints.Weights.begin() + index, 1.0);
    Vector<double> values(constraints.Values.size() + 1);
    values << constraints.Values.head(index), 0.0, constraints.Values.tail(constraints.Values.size() - index);
    constraints.Values = std::move(values);
  }
}

void ScalarFunction::CentreFree(const FieldConstraints& constraints, Vector<double>& unknowns) const
{
  if (constraints.Grounded.empty())
  {
    return;
  }
  const std::vector<int> components = VertexComponents(this->Surface.Mesh);
  std::vector<int> held;
  std::set_difference(constraints.Elements.begin(), constraints.Elements.end(), constraints.Grounded.begin(),
    constraints.Grounded.end(), std::back_inserter(held));
  FreeComponents(components, held).Centre(unknowns, IntegratedSource(this->Surface.Mesh));
}

Vector<double> ScalarFunction::PenaltiesOfElements(
  const std::vector<int>& vertices, const ExecutionContext& context) const
{
  const Vector<double> areas = this->Mass(context);
  return areas(vertices) / areas.mean();
}

FieldPowers ScalarFunction::Powers(
  const Vector<double>& unknowns, const Unfilled<Corner>& corners, const ExecutionContext& context) const
{
  const Vector<double> gradient = FaceGradient(this->Surface.Mesh, this->Surface.Faces, context) * unknowns;
  Vector<Complex> faces = AsComplex(gradient);
  Vector<Complex> vertices = PowersAtVertices(this->Surface.Mesh, corners, faces, 1, context);
  return { std::move(faces), std::move(vertices) };
}

std::vector<ElementValues> ScalarFunction::Values(const Vector<double>& unknowns, const FieldPowers&) const
{
  return { { "ScalarFunction", ElementKind::Vertices, 1, unknowns } };
}

Points ScalarFunction::VectorsOnFaces(const Vector<double>& unknowns, const ExecutionContext& context) const
{
  return VectorsFromFaceField(
    this->Surface.Faces, FaceGradient(this->Surface.Mesh, this->Surface.Faces, context) * unknowns);
}

}
