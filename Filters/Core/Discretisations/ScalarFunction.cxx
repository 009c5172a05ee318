#include "Discretisations/ScalarFunction.h"

#include "Directions/PowerFieldDirections.h"
#include "Operators/CotangentLaplacian.h"
#include "Operators/FaceFieldOperators.h"
#include "Solvers/Multigrid/AssembledHierarchy.h"
#include "Support/ComplexPairs.h"
#include "Support/Errors.h"
#include "Support/SparseAssembly.h"

#include <algorithm>
#include <iterator>
#include <string>
#include <utility>

namespace dmg
{
namespace
{

// The number of unknowns up to which a factorisation from the bare mesh is ready before multigrid (ScalarFunction.md).
constexpr int LargestForCholesky = 100000;
constexpr double SolvesForFactor = 0.025;
// Two cycles halve the iterations and cost the same. They are less sensitive to uneven triangles.
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

/// Inserts the pinned vertices among the elements, with the value zero.
void AddPinned(FieldConstraints& constraints)
{
  std::vector<int> elements;
  std::merge(constraints.Elements.begin(), constraints.Elements.end(), constraints.Pinned.begin(),
    constraints.Pinned.end(), std::back_inserter(elements));
  std::vector<double> weights(elements.size(), 1.0);
  Vector<double> values = Vector<double>::Zero(static_cast<Eigen::Index>(elements.size()));
  for (std::size_t b = 0, k = 0; k < constraints.Elements.size(); ++b)
  {
    if (elements[b] == constraints.Elements[k])
    {
      weights[b] = constraints.Weights[k];
      values[b] = constraints.Values[k++];
    }
  }
  constraints.Elements = std::move(elements);
  constraints.Weights = std::move(weights);
  constraints.Values = std::move(values);
}

}

ScalarFunction::ScalarFunction(const FramedMesh& surface, VertexAreas areas, std::vector<double> conductivity)
  : VertexDiscretisation(surface)
  , Areas(areas)
  , Conductivity(std::move(conductivity))
  , Components(VertexComponents(surface.Mesh))
{
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
  SparseMatrix<double> L0 = CotangentLaplacian(this->Surface.Mesh, context, this->Conductivity);
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
  SparseMatrix<double> L0 = CotangentLaplacian(this->Surface.Mesh, context, this->Conductivity);
  return std::make_unique<AssembledHierarchy<double>>(L0, std::move(prolongations));
}

SolverTuning ScalarFunction::Tuning() const
{
  SolverTuning tuning;
  tuning.LargestForCholesky = LargestForCholesky;
  tuning.SolvesForFactor = SolvesForFactor;
  tuning.CyclesInARow = CyclesInARow;
  return tuning;
}

SparseMatrix<Complex> ScalarFunction::Stiffness(const ExecutionContext& context) const
{
  return CotangentLaplacian(this->Surface.Mesh, context, this->Conductivity).cast<Complex>();
}

SparseMatrix<Complex> ScalarFunction::ProlongationOfUnknowns(
  const TransportOperator& transport, const ExecutionContext&) const
{
  return transport.cwiseAbs().cast<Complex>();
}

FieldConstraints ScalarFunction::Prescribe(const Constraints& given, const ElementNames& names) const
{
  if (given.Values.empty() && given.Source.size() == 0)
  {
    throw InvalidInput("no value is prescribed, so the function of least smoothness energy is zero; " +
      TextOf(Remedy::PrescribedValues));
  }
  FieldConstraints constraints = this->MeansOf(this->SumsAtVertices(given, {}, names));
  if (given.Source.size() > 0)
  {
    this->AddSource(given, names, constraints);
  }
  return constraints;
}

std::vector<PowerAtVertex> ScalarFunction::SumsAtVertices(
  const Constraints& constraints, const std::vector<char>&, const ElementNames& names) const
{
  std::vector<PowerAtVertex> sums(this->Surface.Mesh.NumberOfVertices());
  for (const ValueConstraint& value : constraints.Values)
  {
    CheckElement(value.Vertex, this->Surface.Mesh.NumberOfVertices(), "vertex");
    CheckValue(value, names.Vertex(value.Vertex));
    sums[value.Vertex].Add(value.Weight, value.Value);
  }
  return sums;
}

void ScalarFunction::AddSource(const Constraints& given, const ElementNames& names, FieldConstraints& constraints) const
{
  const TriangleMesh& mesh = this->Surface.Mesh;
  CheckSource(given.Source, mesh.NumberOfVertices(), names);
  constraints.Source = IntegratedSource(mesh, given.Source);
  this->PinFree(given.Net, constraints);
}

void ScalarFunction::PinFree(NetSource net, FieldConstraints& constraints) const
{
  const FreeComponents free(this->Components, constraints.Elements);
  if (!free.AreAny())
  {
    return;
  }
  free.Balance(constraints.Source, IntegratedSource(this->Surface.Mesh), net);
  constraints.Pinned = free.FirstVertices();
  AddPinned(constraints);
}

void ScalarFunction::CentreFree(const FieldConstraints& constraints, Vector<double>& unknowns) const
{
  if (!constraints.Pinned.empty())
  {
    FreeComponents::Of(this->Components, constraints.Pinned).Centre(unknowns, IntegratedSource(this->Surface.Mesh));
  }
}

void ScalarFunction::VanishAtPinned(const FieldConstraints& constraints, Vector<double>& unknowns) const
{
  FreeComponents::Of(this->Components, constraints.Pinned).VanishAt(constraints.Pinned, unknowns);
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
