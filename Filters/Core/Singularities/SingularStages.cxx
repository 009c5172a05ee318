#include "Singularities/SingularStages.h"

#include "Support/ComplexPairs.h"
#include "Support/Stopwatch.h"

#include <utility>

namespace dmg
{
namespace
{

bool AreSame(const FieldConstraints& a, const FieldConstraints& b)
{
  return a.Elements == b.Elements && a.Weights == b.Weights && a.Values.size() == b.Values.size() &&
    a.Values == b.Values;
}

}

SingularStages::SingularStages(const FramedMesh& surface, SetupCache& setups)
  : Surface(surface)
  , Setups(setups)
{
}

std::shared_ptr<const FieldSolution> SingularStages::Solve(const SingularProblem& problem,
  std::shared_ptr<const Discretisation> discretisation, const Constraints& constraints, const ExecutionContext& context,
  const ElementNames& names)
{
  const int N = problem.N;
  Key key{ TimesByVertex(this->Surface.Mesh, problem.Singularities, names), N, problem.Stop };
  const FieldConstraints onFaces = discretisation->Prescribe(constraints, names);
  CheckSizes(constraints, names);
  this->MakeSystem(key, problem.Solver, PartOfContext(context, 0.0, 0.7), names);
  const bool isConnected = this->KeyOfConnection && *this->KeyOfConnection == key;
  if (!isConnected)
  {
    this->Connection = std::make_shared<const SingularField>(
      this->System->Solve(key.Times, N, key.Stop, this->Connection.get(), PartOfContext(context, 0.7, 0.95), names));
    this->KeyOfConnection = std::move(key);
  }
  if (!this->Solution || this->Solution->Connection != this->Connection ||
    !AreSame(this->Solution->Constraints, onFaces))
  {
    const Vector<double> weights = discretisation->PenaltiesOf(onFaces, {}, context).Alignment;
    this->Solution = std::make_shared<const FieldSolution>(FieldSolution{ std::move(discretisation), onFaces,
      AsPairs(this->System->RotatedTo(onFaces, weights, *this->Connection)), this->Connection->Report,
      this->SetupSeconds, this->Connection });
    ++this->Completed.Solves;
  }
  context.Checkpoint(1.0);
  return this->Solution;
}

void SingularStages::MakeSystem(
  const Key& key, const SolverOptions& options, const ExecutionContext& context, const ElementNames& names)
{
  const bool isFirst = !this->System;
  const Stopwatch watch;
  if (!this->Holonomy)
  {
    this->Holonomy.emplace(this->Surface, context);
  }
  this->Holonomy->CheckSums(key.Times, key.N, names);
  if (!isFirst && this->System->HasOptions(options))
  {
    return;
  }
  auto system = std::make_unique<SingularFieldSolver>(this->Setups, *this->Holonomy, options, context);
  this->KeyOfConnection.reset();
  this->Connection.reset();
  this->System = std::move(system);
  this->SetupSeconds = watch.Seconds();
  this->Completed.Setups += isFirst || this->System->HasNewSetup();
  ++this->Completed.Systems;
}

}
