#include "Discretisations/ScalarFunction.h"

#include "Operators/FaceFieldOperators.h"
#include "Operators/PowerFieldDirections.h"
#include "Solvers/Multigrid/AssembledHierarchy.h"
#include "Support/ComplexPairs.h"
#include "Support/Errors.h"
#include "Support/ShortText.h"
#include "Support/SparseAssembly.h"

#include <algorithm>
#include <cmath>
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

/// d0^T star1 d0.
SparseMatrix<double> CotangentLaplacian(const TriangleMesh& mesh, const ExecutionContext& context)
{
  const SparseMatrix<double> d0 = D0(mesh, context);
  return SparseMatrix<double>(d0.transpose()) * Star1(mesh).asDiagonal() * d0;
}

/// The mean over the faces around each vertex, #V x #F.
SparseMatrix<double> MeanOfFaces(const TriangleMesh& mesh)
{
  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(3 * mesh.NumberOfFaces());
  std::vector<int> numbers(mesh.NumberOfVertices(), 0);
  for (int h = 0; h < 3 * mesh.NumberOfFaces(); ++h)
  {
    ++numbers[mesh.Tail(h)];
  }
  for (int h = 0; h < 3 * mesh.NumberOfFaces(); ++h)
  {
    entries.emplace_back(mesh.Tail(h), TriangleMesh::FaceOf(h), 1.0 / numbers[mesh.Tail(h)]);
  }
  SparseMatrix<double> mean(mesh.NumberOfVertices(), mesh.NumberOfFaces());
  mean.setFromTriplets(entries.begin(), entries.end());
  return mean;
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
  const TriangleMesh& mesh, const std::vector<TransportOperator>& linear)
{
  std::vector<SparseMatrix<double>> prolongations = WeightsOf(linear);
  prolongations[0] = SparseMatrix<double>(MeanOfFaces(mesh) * prolongations[0]);
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
  std::vector<SparseMatrix<double>> prolongations = ProlongationsOfNodes(this->Surface.Mesh, linear.All());
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
    CheckOperators(!operators->Linear.empty(), "Power Fields");
    prolongations = ProlongationsOfNodes(this->Surface.Mesh, operators->Linear);
  }
  else if (operators)
  {
    CheckOperators(!operators->S0.empty(), "Power Fields");
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
  if (given.Values.empty())
  {
    throw InvalidInput("no value is prescribed, so the function of least smoothness energy is zero; choose an array of "
                       "points for Values, and a Mask and Weights that are not zero everywhere");
  }
  std::vector<ValueConstraint> values = given.Values;
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
        ", is not finite or its weight not positive; repair it, or leave the point out, by Mask or a value of NaN "
        "where there is no mask");
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
