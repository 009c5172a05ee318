#include "Discretisations/VertexPowerField.h"

#include "Discretisations/Constraints/VertexConstraints.h"
#include "Discretisations/PowerField.h"
#include "Levels/SampledLevels.h"
#include "Operators/ConnectionLaplacian.h"
#include "Operators/FaceFieldOperators.h"
#include "Operators/PowerFieldOperators.h"
#include "Solvers/Laplacian/LaplacianHierarchy.h"
#include "Solvers/Multigrid/AssembledHierarchy.h"
#include "Support/ComplexPairs.h"
#include "Support/SparseAssembly.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace dmg
{
namespace
{

constexpr int Grain = 4096;

// Linear elements take an interpolation between samples as it is: smoothed, it took more iterations on uneven triangles.
constexpr int ProlongationSteps = 0;
constexpr int FinestSweepsFactor = 3;
constexpr int CoarseCycles = 2;
// The limits of fields on faces, whose factors have as many entries.
constexpr int LargestForCholesky = 20000;
constexpr double SolvesForFactor = 0.06;

/// Directions of the vertices from those of the faces around, carried by the connection and averaged.
TransportOperator MeanOfFaces(
  const TriangleMesh& mesh, const VertexConnection& connection, const ExecutionContext& context)
{
  return AssembleMatrix<Complex>(mesh.NumberOfVertices(), mesh.NumberOfFaces(), context,
    [&](int vertex, RowEntries<Complex>& row)
    {
      mesh.VisitFan(vertex, [&](int h) { row.emplace_back(TriangleMesh::FaceOf(h), connection.TurnFromFace(h)); });
      for (auto& [face, entry] : row)
      {
        entry /= static_cast<double>(row.size());
      }
    });
}

/// The weights of S0 with the turns of another operator, which is where they are not zero.
TransportOperator WithTurns(
  const SparseMatrix<double>& S0, const TransportOperator& turns, const ExecutionContext& context)
{
  return AssembleMatrix<Complex>(static_cast<int>(S0.rows()), static_cast<int>(S0.cols()), context,
    [&](int row, RowEntries<Complex>& entries)
    {
      for (SparseMatrix<double>::InnerIterator entry(S0, row); entry; ++entry)
      {
        const Complex turn = turns.coeff(row, entry.col());
        const double length = std::sqrt(std::norm(turn));
        entries.emplace_back(
          static_cast<int>(entry.col()), length > 0.0 ? entry.value() * (turn / length) : Complex(entry.value()));
      }
    });
}

}

VertexPowerField::VertexPowerField(const FramedMesh& surface, int directions, const VertexConnection* connection)
  : VertexDiscretisation(surface)
  , N(directions)
  , Given(connection)
{
  CheckNumberOfDirections(directions);
}

std::string VertexPowerField::Name() const
{
  return "power fields at points with N = " + std::to_string(this->N);
}

const VertexConnection& VertexPowerField::Connection(const ExecutionContext& context) const
{
  if (this->Given)
  {
    return *this->Given;
  }
  std::call_once(this->IsConnected,
    [&] { this->ConnectionOfSurface = std::make_unique<const VertexConnection>(this->Surface, context); });
  return *this->ConnectionOfSurface;
}

Vector<double> VertexPowerField::Mass(const ExecutionContext& context) const
{
  const Vector<double> areas = this->AreasOfVertices(context);
  const double meanArea = areas.mean();
  return meanArea > 0.0 ? Vector<double>(areas / meanArea) : Vector<double>::Ones(areas.size());
}

ProlongationOperators VertexPowerField::SampledLevels(double distance, const ExecutionContext& context) const
{
  context.Checkpoint(0.0);
  const TriangleMesh& mesh = this->Surface.Mesh;
  return dmg::SampledLevels(mesh, VerticesToSample(mesh, this->Connection(context), context), distance, context);
}

double VertexPowerField::SampleDistance() const
{
  return DistanceOfSamples;
}

std::unique_ptr<const StiffnessHierarchy> VertexPowerField::Coarsen(
  const LinearProlongations& linear, const ExecutionContext& context) const
{
  const TriangleMesh& mesh = this->Surface.Mesh;
  const VertexConnection& connection = this->Connection(context);
  std::vector<SparseMatrix<Complex>> onPowers = this->ProlongationsOfPowers(linear.Whole(), context);
  linear.Forget();
  return std::make_unique<LaplacianHierarchy>(
    CoarsenLaplacian([&mesh, &connection, N = this->N](const std::vector<int>& order, const ExecutionContext& part)
      { return ConnectionLaplacian(mesh, connection, N, order, part); },
      std::move(onPowers), ProlongationSteps, context));
}

std::unique_ptr<const StiffnessHierarchy> VertexPowerField::Assemble(
  const ProlongationOperators* operators, CoarseSpaceKind, const ExecutionContext& context) const
{
  std::vector<SparseMatrix<Complex>> prolongations;
  if (operators)
  {
    CheckOperators(!operators->Linear.empty(), Remedy::PowerFieldOperators);
    prolongations = this->ProlongationsOfPowers(*operators, context);
  }
  SparseMatrix<Complex> L = this->Stiffness(context);
  return std::make_unique<AssembledHierarchy<Complex>>(L, std::move(prolongations));
}

Vector<double> VertexPowerField::AreasOfVertices(const ExecutionContext& context) const
{
  return LumpedMass(this->Surface.Mesh, context);
}

SparseMatrix<Complex> VertexPowerField::Stiffness(const ExecutionContext& context) const
{
  return ConnectionLaplacian(this->Surface.Mesh, this->Connection(context), this->N, context);
}

SparseMatrix<Complex> VertexPowerField::ProlongationOfUnknowns(
  const TransportOperator& transport, const ExecutionContext& context) const
{
  return OnPowers(transport, this->N, context);
}

std::vector<SparseMatrix<Complex>> VertexPowerField::ProlongationsOfPowers(
  const ProlongationOperators& operators, const ExecutionContext& context) const
{
  std::vector<SparseMatrix<Complex>> prolongations = OnPowers(operators.Linear, this->N, context);
  if (!operators.IsLinearAtVertices)
  {
    // The turns of directions, from the faces around; powers of them come last.
    const TransportOperator mean = MeanOfFaces(this->Surface.Mesh, this->Connection(context), context);
    const TransportOperator turns = mean * operators.Linear[0];
    prolongations[0] =
      OnPowers(operators.S0.empty() ? turns : WithTurns(operators.S0[0], turns, context), this->N, context);
  }
  return prolongations;
}

SolverTuning VertexPowerField::Tuning() const
{
  SolverTuning tuning;
  tuning.LargestForCholesky = LargestForCholesky;
  tuning.SolvesForFactor = SolvesForFactor;
  tuning.FinestSweepsFactor = FinestSweepsFactor;
  tuning.CoarseCycles = CoarseCycles;
  tuning.FinestProlongationSteps = ProlongationSteps;
  return tuning;
}

FieldConstraints VertexPowerField::Prescribe(const Constraints& constraints, const ElementNames& names) const
{
  return this->MeansOf(
    this->SumsAtVertices(constraints, SurroundedVertices(this->Surface.Mesh, constraints.OnFaces), names));
}

std::vector<PowerAtVertex> VertexPowerField::SumsAtVertices(
  const Constraints& constraints, const std::vector<char>& isSurrounded, const ElementNames& names) const
{
  return PowersAtVertices(this->Surface, this->Connection(SerialContext()), this->N, constraints, isSurrounded, names);
}

Vector<Complex> VertexPowerField::PowersOfFaces(const Vector<double>& unknowns, const ExecutionContext& context) const
{
  const TriangleMesh& mesh = this->Surface.Mesh;
  const VertexConnection& connection = this->Connection(context);
  const auto ofVertices = AsComplex(unknowns);
  Vector<Complex> ofFaces(mesh.NumberOfFaces());
  context.ParallelFor(0, mesh.NumberOfFaces(), Grain,
    [&](int first, int last)
    {
      for (int face = first; face < last; ++face)
      {
        Complex sum = 0.0;
        for (int h = 3 * face; h < 3 * face + 3; ++h)
        {
          sum += std::conj(Power(connection.TurnFromFace(h), this->N)) * ofVertices[mesh.Tail(h)];
        }
        ofFaces[face] = sum / 3.0;
      }
    });
  return ofFaces;
}

FieldPowers VertexPowerField::Powers(
  const Vector<double>& unknowns, const Unfilled<Corner>&, const ExecutionContext& context) const
{
  return { this->PowersOfFaces(unknowns, context), AsComplex(unknowns) };
}

std::vector<ElementValues> VertexPowerField::Values(const Vector<double>& unknowns, const FieldPowers& powers) const
{
  std::vector<ElementValues> values; // not from a list in braces, which copies all numbers once more
  values.push_back({ "PowerField", ElementKind::Faces, 2, AsPairs(powers.Faces) });
  values.push_back({ "PowerField", ElementKind::Vertices, 2, unknowns });
  return values;
}

Points VertexPowerField::VectorsOnFaces(const Vector<double>& unknowns, const ExecutionContext& context) const
{
  return VectorsFromFaceField(this->Surface.Faces, AsPairs(this->PowersOfFaces(unknowns, context)));
}

}
