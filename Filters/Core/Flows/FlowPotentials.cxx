#include "Flows/FlowPotentials.h"

#include "Analysis/HarmonicForms.h"
#include "Support/Errors.h"

#include <algorithm>
#include <string>
#include <utility>

namespace dmg
{
namespace
{

/// Functions of coasts are made once, and all stream functions rest on them.
const StoppingCriteria StopOfFunctions{ 1e-12, 200 };

}

FlowPotentials::FlowPotentials(const FramedMesh& surface, const SolverOptions& options)
  : Geometry(surface)
  , Options(options)
  , Boundary(BoundaryVertices(surface.Mesh))
  , Setups(surface)
{
  this->Options.ExpectedSolves += NumberOfGenerators(surface.Mesh);
  this->SetBoundary(OpenEdges(surface.Mesh, FlowBoundary::Closed));
}

void FlowPotentials::SetBoundary(const std::vector<char>& isOpen)
{
  this->PartsOfSurface = PartsOfBoundary(this->Geometry.Mesh, isOpen);
  this->OpenVertices = VerticesOfParts(this->PartsOfSurface, true);
  this->ClosedVertices = VerticesOfParts(this->PartsOfSurface, false);
  this->StoredFunctions.reset();
  this->Solvers.remove_if(
    [this](const PoissonSolver& each)
    {
      return each.Fixed() != this->OpenVertices && each.Fixed() != this->ClosedVertices &&
        each.Fixed() != this->Boundary;
    });
}

PoissonSolver& FlowPotentials::With(const std::vector<int>& fixed, const ExecutionContext& context)
{
  const auto known = std::find_if(
    this->Solvers.begin(), this->Solvers.end(), [&fixed](const PoissonSolver& each) { return each.Fixed() == fixed; });
  if (known != this->Solvers.end())
  {
    return *known;
  }
  this->Solvers.emplace_back(this->Setups, fixed, this->Options, context);
  this->CountsOfStages.Setups += this->Solvers.back().HasNewSetup() ? 1 : 0;
  return this->Solvers.back();
}

Vector<double> FlowPotentials::Solve(PoissonSolver& solver, const Vector<double>& source, const StoppingCriteria& stop,
  const ExecutionContext& context, const Vector<double>& fixed)
{
  // Sources sum to zero but for rounding, which may be all that there is.
  Vector<double> u = solver.Solve(source, fixed, stop, context, NetSource::TakeOut);
  this->LastReport = solver.Report();
  return u;
}

Vector<double> FlowPotentials::Potential(const FlowDerivatives& of, const StoppingCriteria& stop,
  const ExecutionContext& context, const Vector<double>& onOpenParts)
{
  PoissonSolver& solver = this->With(this->OpenVertices, PartOfContext(context, 0.0, 0.4));
  const Vector<double> fixed =
    onOpenParts.size() > 0 ? Vector<double>(onOpenParts(this->OpenVertices)) : Vector<double>();
  return this->Solve(solver, -of.Divergence, stop, PartOfContext(context, 0.4, 1.0), fixed);
}

Vector<double> FlowPotentials::StreamFunction(
  const FlowDerivatives& of, const StoppingCriteria& stop, const ExecutionContext& context)
{
  PoissonSolver& solver = this->With(this->ClosedVertices, PartOfContext(context, 0.0, 0.4));
  const Vector<double> source = -of.Vorticity;
  Vector<double> psi = this->Solve(solver, source, stop, PartOfContext(context, 0.4, 0.7));
  const Eigen::MatrixXd& functions = this->FunctionsOfCoasts(PartOfContext(context, 0.7, 1.0));
  if (functions.cols() > 0)
  {
    // psi is zero on the coasts so far, and these functions are orthogonal to all that are.
    psi += functions * this->Energies.solve(functions.transpose() * source);
  }
  return psi;
}

FlowFunctions FlowPotentials::ZeroOnBoundary(
  const FlowDerivatives& of, const StoppingCriteria& stop, const ExecutionContext& context)
{
  PoissonSolver& solver = this->With(this->Boundary, PartOfContext(context, 0.0, 0.4));
  Vector<double> u = this->Solve(solver, -of.Divergence, stop, PartOfContext(context, 0.4, 0.7));
  Vector<double> psi = this->Solve(solver, -of.Vorticity, stop, PartOfContext(context, 0.7, 1.0));
  return { std::move(u), std::move(psi) };
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

Eigen::MatrixXd FlowPotentials::FunctionsOf(bool areOpen, const ExecutionContext& context)
{
  std::vector<const BoundaryPart*> parts;
  int component = -1; // the last one that has such a part
  for (const BoundaryPart& part : this->PartsOfSurface)
  {
    if (part.IsOpen == areOpen && part.Component == component)
    {
      parts.push_back(&part);
    }
    component = part.IsOpen == areOpen ? part.Component : component;
  }
  const int number = static_cast<int>(parts.size());
  this->CheckNumber(number, areOpen ? " open parts of the boundary" : " islands");
  Eigen::MatrixXd functions = Eigen::MatrixXd::Zero(this->Geometry.Mesh.NumberOfVertices(), number);
  const std::vector<int>& fixed = areOpen ? this->OpenVertices : this->ClosedVertices;
  for (int k = 0; k < number; ++k)
  {
    Vector<double> values = Vector<double>::Zero(functions.rows());
    values(parts[k]->Vertices).setOnes();
    const double step = 1.0 / number;
    functions.col(k) = this->With(fixed, context)
                         .Solve({}, values(fixed), StopOfFunctions, PartOfContext(context, step * k, step * (k + 1)));
  }
  return functions;
}

const Eigen::MatrixXd& FlowPotentials::FunctionsOfCoasts(const ExecutionContext& context)
{
  if (!this->StoredFunctions)
  {
    Eigen::MatrixXd functions = this->FunctionsOf(false, context);
    Eigen::MatrixXd energies(functions.cols(), functions.cols());
    for (Eigen::Index k = 0; k < functions.cols(); ++k)
    {
      const Vector<Complex> gradient = GradientOnFaces(this->Geometry, functions.col(k), context);
      energies.col(k) = -functions.transpose() * IntegratedDerivatives(this->Geometry, gradient, context).Divergence;
    }
    const Eigen::MatrixXd symmetric = energies.selfadjointView<Eigen::Upper>();
    this->Energies.compute(symmetric);
    this->CountsOfStages.Functions += functions.cols() > 0 ? 1 : 0;
    this->StoredFunctions = std::move(functions);
  }
  return *this->StoredFunctions;
}

Eigen::MatrixXd FlowPotentials::FunctionsOfOpenParts(const ExecutionContext& context)
{
  return this->FunctionsOf(true, context);
}

}
