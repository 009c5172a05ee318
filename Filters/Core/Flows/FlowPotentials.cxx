#include "Flows/FlowPotentials.h"

#include "Analysis/HarmonicForms.h"
#include "Support/Errors.h"

#include <string>
#include <utility>

namespace dmg
{
namespace
{

/// Functions of loops are made once, and all stream functions rest on them.
const StoppingCriteria StopOfFunctions{ 1e-12, 200 };
/// The number of vertices up to which two solves by a factor are faster than by cycles, from the bare surface.
constexpr int LargestForFactor = 300000;

}

FlowPotentials::FlowPotentials(const FramedMesh& surface, const SolverOptions& options)
  : Geometry(surface)
  , Options(options)
  , LoopsOfBoundary(FindBoundaryLoops(surface.Mesh))
  , Setups(surface)
{
  this->Options.ExpectedSolves += NumberOfGenerators(surface.Mesh);
  if (options.Kind == SolverKind::Automatic && surface.Mesh.NumberOfVertices() <= LargestForFactor)
  {
    this->Options.Kind = SolverKind::Cholesky;
  }
}

PoissonSolver& FlowPotentials::Make(
  std::optional<PoissonSolver>& solver, std::vector<int> fixed, const ExecutionContext& context)
{
  if (!solver)
  {
    solver.emplace(this->Setups, std::move(fixed), this->Options, context);
    this->CountsOfStages.Setups += solver->HasNewSetup();
  }
  return *solver;
}

PoissonSolver& FlowPotentials::Free(const ExecutionContext& context)
{
  return this->Make(this->FreeSolver, {}, context);
}

PoissonSolver& FlowPotentials::Fixed(const ExecutionContext& context)
{
  return this->LoopsOfBoundary.empty() ? this->Free(context)
                                       : this->Make(this->FixedSolver, BoundaryVertices(this->Geometry.Mesh), context);
}

Vector<double> FlowPotentials::Solve(
  PoissonSolver& solver, const Vector<double>& source, const StoppingCriteria& stop, const ExecutionContext& context)
{
  // Sources sum to zero but for rounding, which may be all that there is.
  Vector<double> u = solver.Solve(source, {}, stop, context, NetSource::TakeOut);
  this->LastReport = solver.Report();
  return u;
}

Vector<double> FlowPotentials::Potential(
  const FlowDerivatives& of, FlowBoundary boundary, const StoppingCriteria& stop, const ExecutionContext& context)
{
  const PartOfContext first(context, 0.0, 0.4);
  PoissonSolver& solver = boundary == FlowBoundary::Closed ? this->Free(first) : this->Fixed(first);
  return this->Solve(solver, -of.Divergence, stop, PartOfContext(context, 0.4, 1.0));
}

Vector<double> FlowPotentials::StreamFunction(
  const FlowDerivatives& of, FlowBoundary boundary, const StoppingCriteria& stop, const ExecutionContext& context)
{
  const PartOfContext first(context, 0.0, 0.4);
  PoissonSolver& solver = boundary == FlowBoundary::Closed ? this->Fixed(first) : this->Free(first);
  const Vector<double> source = -of.Vorticity;
  Vector<double> psi = this->Solve(solver, source, stop, PartOfContext(context, 0.4, 0.7));
  if (boundary == FlowBoundary::Closed)
  {
    const Eigen::MatrixXd& functions = this->FunctionsOfLoops(PartOfContext(context, 0.7, 1.0));
    if (functions.cols() > 0)
    {
      // psi is zero on the boundary so far, and these functions are orthogonal to all that are.
      psi += functions * this->Energies.solve(functions.transpose() * source);
    }
  }
  return psi;
}

void FlowPotentials::CheckNumber(int functions, const std::string& name) const
{
  if (AreTooManyToHold(functions, this->Geometry.Mesh))
  {
    throw InvalidInput("the surface has " + std::to_string(functions) + name +
      ", and the decomposition needs a function for each: too many to hold; close holes and remove small handles "
      "first");
  }
}

const Eigen::MatrixXd& FlowPotentials::FunctionsOfLoops(const ExecutionContext& context)
{
  if (this->StoredFunctions)
  {
    return *this->StoredFunctions;
  }
  std::vector<const BoundaryLoop*> loops;
  for (std::size_t k = 1; k < this->LoopsOfBoundary.size(); ++k)
  {
    if (this->LoopsOfBoundary[k].Component == this->LoopsOfBoundary[k - 1].Component)
    {
      loops.push_back(&this->LoopsOfBoundary[k]);
    }
  }
  const int number = static_cast<int>(loops.size());
  this->CheckNumber(number, " islands");
  Eigen::MatrixXd functions = Eigen::MatrixXd::Zero(this->Geometry.Mesh.NumberOfVertices(), number);
  Eigen::MatrixXd energies(number, number);
  for (int k = 0; k < number; ++k)
  {
    PoissonSolver& solver = this->Fixed(context);
    Vector<double> values = Vector<double>::Zero(functions.rows());
    values(loops[k]->Vertices).setOnes();
    const Vector<double> fixed = values(solver.Fixed());
    const double step = 1.0 / number;
    functions.col(k) = solver.Solve({}, fixed, StopOfFunctions, PartOfContext(context, step * k, step * (k + 1)));
    const Vector<Complex> gradient = GradientOnFaces(this->Geometry, functions.col(k), context);
    energies.col(k) = -functions.transpose() * IntegratedDerivatives(this->Geometry, gradient, context).Divergence;
  }
  const Eigen::MatrixXd symmetric = energies.selfadjointView<Eigen::Upper>();
  this->Energies.compute(symmetric);
  this->StoredFunctions = std::move(functions);
  this->CountsOfStages.Functions += number > 0 ? 1 : 0;
  return *this->StoredFunctions;
}

}
