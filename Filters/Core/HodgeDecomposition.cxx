#include "HodgeDecomposition.h"

#include "Analysis/FlowOperators.h"
#include "Analysis/HarmonicBasis.h"
#include "Analysis/HarmonicForms.h"
#include "Operators/FaceFieldOperators.h"
#include "PoissonSolver.h"
#include "Support/ComplexPairs.h"
#include "Support/Errors.h"
#include "Support/ShortText.h"

#include <Eigen/Cholesky>
#include <Eigen/QR>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

namespace dmg
{
namespace
{

constexpr Complex QuarterTurn(0.0, 1.0);
/// Bases are made once, and all parts rest on them.
const StoppingCriteria StopOfBases{ 1e-12, 200 };
/// A larger share of the energy that parts have in common is said.
constexpr double LargestOverlap = 1e-8;

/// The vectors of a closed 1-form: on each face the one whose integrals along its sides are the form's.
Vector<Complex> VectorsOfClosedForm(
  const SparseMatrix<double>& pseudoInverse, const TriangleMesh& mesh, const Vector<double>& form)
{
  Vector<double> alongHalfedges(3 * mesh.NumberOfFaces());
  for (int h = 0; h < alongHalfedges.size(); ++h)
  {
    alongHalfedges[h] = mesh.EdgeSign(h) * form[mesh.EdgeOf(h)];
  }
  const Vector<double> field = pseudoInverse * alongHalfedges;
  return AsComplex(field);
}

void CheckFlow(const Vector<Complex>& flow, int faces)
{
  if (flow.size() != faces)
  {
    throw InvalidInput("the flow has " + std::to_string(flow.size()) + " vectors in place of one for each of the " +
      std::to_string(faces) + " faces");
  }
  for (int face = 0; face < faces; ++face)
  {
    if (!std::isfinite(flow[face].real()) || !std::isfinite(flow[face].imag()))
    {
      throw InvalidInput("the flow is not finite on face " + std::to_string(face) + "; repair it");
    }
  }
}

}

class HodgeDecomposition::Internals
{
public:
  Internals(const FramedMesh& surface, FlowBoundary boundary, const SolverOptions& options);

  void AddGradient(
    const Vector<Complex>& flow, const StoppingCriteria& stop, DecomposedFlow& parts, const ExecutionContext& context);
  void AddRotational(
    const Vector<Complex>& flow, const StoppingCriteria& stop, DecomposedFlow& parts, const ExecutionContext& context);
  void AddHarmonic(const Vector<Complex>& flow, DecomposedFlow& parts, const ExecutionContext& context);
  void AddBoundaries(const Vector<Complex>& flow, DecomposedFlow& parts, const ExecutionContext& context) const;
  void MakeBasis(const ExecutionContext& context);
  double Norm(const Vector<Complex>& X) const { return FlowProduct(this->Areas, X, X); }

  const FramedMesh& On;
  const bool IsClosed; ///< what the boundary is
  SolverOptions Options;
  const Vector<double> Areas;
  const std::vector<BoundaryLoop> Loops;
  std::optional<Eigen::MatrixXd> Basis;
  StageCounts Counts;
  std::optional<PoissonSolver> Free; ///< nothing is held
  std::optional<PoissonSolver> Held; ///< all boundaries are

private:
  PoissonSolver& FreeSolver(const ExecutionContext& context);
  /// The same where there is no boundary.
  PoissonSolver& HeldSolver(const ExecutionContext& context);
  Vector<double> Solve(PoissonSolver& solver, const Vector<double>& source, const StoppingCriteria& stop,
    DecomposedFlow& parts, const ExecutionContext& context);
  /// The functions that are 1 on one loop and 0 on all others, of all but the first loop of each component.
  void MakeFunctionsOfLoops(const ExecutionContext& context);
  void AddFunctionsOfLoops(const Vector<Complex>& flow, Vector<double>& psi, const ExecutionContext& context);
  Eigen::MatrixXd HarmonicFields(const ExecutionContext& context);
  /// The combinations of \p fields through which nothing flows from one loop to another.
  Eigen::MatrixXd WithoutTransports(const Eigen::MatrixXd& fields, const ExecutionContext& context);
  void CheckNumber(int functions, const std::string& name) const;

  std::optional<Eigen::MatrixXd> FunctionsOfLoops; ///< #V x those
  Eigen::LDLT<Eigen::MatrixXd> Energies;           ///< of them
};

HodgeDecomposition::Internals::Internals(const FramedMesh& surface, FlowBoundary boundary, const SolverOptions& options)
  : On(surface)
  , IsClosed(boundary == FlowBoundary::Closed)
  , Options(options)
  , Areas(surface.Mesh.FaceAreas())
  , Loops(FindBoundaryLoops(surface.Mesh))
{
  this->Options.ExpectedSolves += NumberOfGenerators(surface.Mesh);
}

PoissonSolver& HodgeDecomposition::Internals::FreeSolver(const ExecutionContext& context)
{
  if (!this->Free && this->Held)
  {
    this->Free.emplace(*this->Held, std::vector<int>(), context);
  }
  else if (!this->Free)
  {
    this->Free.emplace(this->On, std::vector<int>(), this->Options, context);
    ++this->Counts.Setups;
  }
  return *this->Free;
}

PoissonSolver& HodgeDecomposition::Internals::HeldSolver(const ExecutionContext& context)
{
  if (this->Loops.empty())
  {
    return this->FreeSolver(context);
  }
  std::vector<int> held;
  for (const BoundaryLoop& loop : this->Loops)
  {
    held.insert(held.end(), loop.Vertices.begin(), loop.Vertices.end());
  }
  std::sort(held.begin(), held.end());
  if (!this->Held && this->Free)
  {
    this->Held.emplace(*this->Free, std::move(held), context);
  }
  else if (!this->Held)
  {
    this->Held.emplace(this->On, std::move(held), this->Options, context);
    ++this->Counts.Setups;
  }
  return *this->Held;
}

Vector<double> HodgeDecomposition::Internals::Solve(PoissonSolver& solver, const Vector<double>& source,
  const StoppingCriteria& stop, DecomposedFlow& parts, const ExecutionContext& context)
{
  // Sources sum to zero but for rounding, which may be all that there is.
  Vector<double> u = solver.Solve(source, {}, stop, context, NetSource::TakeOut);
  ++this->Counts.Solves;
  const SolveReport& report = solver.Report();
  parts.Converged &= report.Converged || report.EndedByRounding;
  parts.Warnings.insert(parts.Warnings.end(), report.Warnings.begin(), report.Warnings.end());
  return u;
}

void HodgeDecomposition::Internals::AddGradient(
  const Vector<Complex>& flow, const StoppingCriteria& stop, DecomposedFlow& parts, const ExecutionContext& context)
{
  const PartOfContext first(context, 0.0, 0.4);
  PoissonSolver& solver = this->IsClosed ? this->FreeSolver(first) : this->HeldSolver(first);
  parts.Potential =
    this->Solve(solver, -IntegratedDivergence(this->On, flow, context), stop, parts, PartOfContext(context, 0.4, 1.0));
  parts.Gradient = GradientOnFaces(this->On, parts.Potential, context);
  parts.GradientEnergy = this->Norm(parts.Gradient);
}

void HodgeDecomposition::Internals::AddRotational(
  const Vector<Complex>& flow, const StoppingCriteria& stop, DecomposedFlow& parts, const ExecutionContext& context)
{
  const PartOfContext first(context, 0.0, 0.4);
  PoissonSolver& solver = this->IsClosed ? this->HeldSolver(first) : this->FreeSolver(first);
  const Vector<double> source = IntegratedDivergence(this->On, QuarterTurn * flow, context);
  parts.StreamFunction = this->Solve(solver, source, stop, parts, PartOfContext(context, 0.4, 0.7));
  if (this->IsClosed)
  {
    this->AddFunctionsOfLoops(flow, parts.StreamFunction, PartOfContext(context, 0.7, 1.0));
  }
  parts.Rotational = QuarterTurn * GradientOnFaces(this->On, parts.StreamFunction, context);
  parts.RotationalEnergy = this->Norm(parts.Rotational);
}

void HodgeDecomposition::Internals::CheckNumber(int functions, const std::string& name) const
{
  if (AreTooManyToHold(functions, this->On.Mesh))
  {
    throw InvalidInput("the surface has " + std::to_string(functions) + name +
      ", and the decomposition needs a function for each: too many to hold; close holes and remove small handles "
      "first");
  }
}

void HodgeDecomposition::Internals::MakeFunctionsOfLoops(const ExecutionContext& context)
{
  if (this->FunctionsOfLoops)
  {
    return;
  }
  std::vector<const BoundaryLoop*> loops;
  for (std::size_t k = 1; k < this->Loops.size(); ++k)
  {
    if (this->Loops[k].Component == this->Loops[k - 1].Component)
    {
      loops.push_back(&this->Loops[k]);
    }
  }
  const int number = static_cast<int>(loops.size());
  this->CheckNumber(number, " islands");
  Eigen::MatrixXd functions = Eigen::MatrixXd::Zero(this->On.Mesh.NumberOfVertices(), number);
  Eigen::MatrixXd energies(number, number);
  for (int k = 0; k < number; ++k)
  {
    PoissonSolver& solver = this->HeldSolver(context);
    Vector<double> values = Vector<double>::Zero(functions.rows());
    values(loops[k]->Vertices).setOnes();
    const Vector<double> held = values(solver.Held());
    const double step = 1.0 / number;
    functions.col(k) = solver.Solve({}, held, StopOfBases, PartOfContext(context, step * k, step * (k + 1)));
    const Vector<Complex> gradient = GradientOnFaces(this->On, functions.col(k), context);
    energies.col(k) = -functions.transpose() * IntegratedDivergence(this->On, gradient, context);
  }
  const Eigen::MatrixXd symmetric = energies.selfadjointView<Eigen::Upper>();
  this->Energies.compute(symmetric);
  this->FunctionsOfLoops = std::move(functions);
  this->Counts.Bases += number > 0 ? 1 : 0;
}

void HodgeDecomposition::Internals::AddFunctionsOfLoops(
  const Vector<Complex>& flow, Vector<double>& psi, const ExecutionContext& context)
{
  this->MakeFunctionsOfLoops(context);
  if (this->FunctionsOfLoops->cols() == 0)
  {
    return;
  }
  // The rest of the flow, which psi has no part in yet, is orthogonal to them but for rounding.
  const Vector<Complex> rest = flow - QuarterTurn * GradientOnFaces(this->On, psi, context);
  const Vector<double> products =
    this->FunctionsOfLoops->transpose() * IntegratedDivergence(this->On, QuarterTurn * rest, context);
  psi += *this->FunctionsOfLoops * this->Energies.solve(products);
}

Eigen::MatrixXd HodgeDecomposition::Internals::HarmonicFields(const ExecutionContext& context)
{
  const TriangleMesh& mesh = this->On.Mesh;
  this->CheckNumber(NumberOfGenerators(mesh), " loops around its handles and holes");
  const Eigen::MatrixXd forms = ClosedForms(mesh, context);
  Eigen::MatrixXd fields(2 * mesh.NumberOfFaces(), forms.cols());
  const SparseMatrix<double> pseudoInverse = HalfedgePseudoInverse(mesh, this->On.Faces, context);
  for (int k = 0; k < forms.cols(); ++k)
  {
    const double step = 1.0 / static_cast<double>(forms.cols());
    const PartOfContext part(context, step * k, step * (k + 1));
    Vector<Complex> field = VectorsOfClosedForm(pseudoInverse, mesh, forms.col(k));
    const Vector<double> u = this->FreeSolver(part).Solve(
      -IntegratedDivergence(this->On, field, context), {}, StopOfBases, part, NetSource::TakeOut);
    field -= GradientOnFaces(this->On, u, context);
    fields.col(k) = AsPairs(field);
  }
  return fields;
}

Eigen::MatrixXd HodgeDecomposition::Internals::WithoutTransports(
  const Eigen::MatrixXd& fields, const ExecutionContext& context)
{
  this->MakeFunctionsOfLoops(context);
  const Eigen::MatrixXd& functions = *this->FunctionsOfLoops;
  if (functions.cols() == 0)
  {
    return fields;
  }
  Eigen::MatrixXd transports(fields.cols(), functions.cols());
  for (int k = 0; k < fields.cols(); ++k)
  {
    const Vector<double> field = fields.col(k);
    const Vector<Complex> turned = QuarterTurn * AsComplex(field);
    transports.row(k) = (functions.transpose() * IntegratedDivergence(this->On, turned, context)).transpose();
  }
  const Eigen::HouseholderQR<Eigen::MatrixXd> qr(transports);
  const Eigen::MatrixXd Q = qr.householderQ() * Eigen::MatrixXd::Identity(fields.cols(), fields.cols());
  return fields * Q.rightCols(fields.cols() - functions.cols());
}

void HodgeDecomposition::Internals::MakeBasis(const ExecutionContext& context)
{
  if (this->Basis)
  {
    return;
  }
  Eigen::MatrixXd fields(2 * this->On.Mesh.NumberOfFaces(), 0);
  if (NumberOfGenerators(this->On.Mesh) > 0)
  {
    fields = this->HarmonicFields(PartOfContext(context, 0.0, 0.8));
    fields = this->IsClosed ? this->WithoutTransports(fields, PartOfContext(context, 0.8, 0.9)) : fields;
    for (int k = 0; k < fields.cols() && !this->IsClosed; ++k)
    {
      const Vector<double> field = fields.col(k);
      const Vector<Complex> turned = QuarterTurn * AsComplex(field);
      fields.col(k) = AsPairs(turned);
    }
    ++this->Counts.Bases;
  }
  this->Basis = HarmonicBasisOfFaceFields(this->On.Mesh, std::move(fields), PartOfContext(context, 0.9, 1.0));
}

void HodgeDecomposition::Internals::AddHarmonic(
  const Vector<Complex>& flow, DecomposedFlow& parts, const ExecutionContext& context)
{
  this->MakeBasis(context);
  Vector<Complex> weighted = flow;
  for (Eigen::Index face = 0; face < flow.size(); ++face)
  {
    weighted[face] *= this->Areas[face];
  }
  parts.Coefficients = this->Basis->transpose() * AsPairs(weighted);
  const Vector<double> field = *this->Basis * parts.Coefficients;
  parts.Harmonic = AsComplex(field);
  parts.HarmonicEnergy = this->Norm(parts.Harmonic);
}

void HodgeDecomposition::Internals::AddBoundaries(
  const Vector<Complex>& flow, DecomposedFlow& parts, const ExecutionContext& context) const
{
  const auto number = static_cast<Eigen::Index>(this->Loops.size());
  parts.Flux.resize(number);
  parts.Circulation.resize(number);
  parts.StreamValues.setZero(number);
  const Vector<double> divergence = IntegratedDivergence(this->On, flow, context);
  const Vector<double> vorticity = IntegratedDivergence(this->On, -QuarterTurn * flow, context);
  for (Eigen::Index k = 0; k < number; ++k)
  {
    const std::vector<int>& vertices = this->Loops[k].Vertices;
    parts.Flux[k] = -divergence(vertices).sum();
    parts.Circulation[k] = -vorticity(vertices).sum();
    if (parts.StreamFunction.size() > 0)
    {
      parts.StreamValues[k] = parts.StreamFunction(vertices).mean();
    }
  }
}

HodgeDecomposition::HodgeDecomposition(const FramedMesh& surface, FlowBoundary boundary, const SolverOptions& options)
  : Internal(std::make_unique<Internals>(surface, boundary, options))
{
}

HodgeDecomposition::~HodgeDecomposition() = default;

HodgeDecomposition::HodgeDecomposition(HodgeDecomposition&&) noexcept = default;

DecomposedFlow HodgeDecomposition::Decompose(
  const Vector<Complex>& flow, const FlowParts& wanted, const StoppingCriteria& stop, const ExecutionContext& context)
{
  Internals& of = *this->Internal;
  CheckFlow(flow, of.On.Mesh.NumberOfFaces());
  DecomposedFlow parts;
  parts.Energy = of.Norm(flow);
  parts.Residual = flow;
  if (wanted.Gradient)
  {
    of.AddGradient(flow, stop, parts, PartOfContext(context, 0.0, 0.5));
    parts.Residual -= parts.Gradient;
  }
  if (wanted.Rotational)
  {
    of.AddRotational(flow, stop, parts, PartOfContext(context, 0.5, 0.8));
    parts.Residual -= parts.Rotational;
  }
  if (wanted.Harmonic)
  {
    of.AddHarmonic(flow, parts, PartOfContext(context, 0.8, 0.95));
    parts.Residual -= parts.Harmonic;
  }
  parts.ResidualEnergy = of.Norm(parts.Residual);
  of.AddBoundaries(flow, parts, context);
  const double overlap = std::abs(
    parts.Energy - parts.GradientEnergy - parts.RotationalEnergy - parts.HarmonicEnergy - parts.ResidualEnergy);
  if (overlap > LargestOverlap * parts.Energy)
  {
    parts.Warnings.push_back("The parts have " + ShortText(overlap / parts.Energy) +
      " of the energy in common, as some triangles are too thin, or the solver has not converged.");
  }
  context.Checkpoint(1.0);
  return parts;
}

const Eigen::MatrixXd& HodgeDecomposition::HarmonicBasis(const ExecutionContext& context)
{
  this->Internal->MakeBasis(context);
  return *this->Internal->Basis;
}

const std::vector<BoundaryLoop>& HodgeDecomposition::Boundaries() const
{
  return this->Internal->Loops;
}

std::string HodgeDecomposition::SolverName() const
{
  const Internals& of = *this->Internal;
  const std::optional<PoissonSolver>& solver = of.Free ? of.Free : of.Held;
  return solver ? solver->Report().Solver : std::string();
}

const HodgeDecomposition::StageCounts& HodgeDecomposition::Counts() const
{
  return this->Internal->Counts;
}

}
