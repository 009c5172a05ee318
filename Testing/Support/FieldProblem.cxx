#include "Support/FieldProblem.h"

#include "Discretisations/MakeDiscretisation.h"
#include "Support/ComplexPairs.h"

#include <utility>

namespace dmg::test
{
namespace
{

SolverPlan PlanOf(const FramedMesh& surface, const Discretisation& field, const ProlongationOperators* operators,
  const FieldOptions& options)
{
  return PlanSolver(field, options, operators, ObstaclesOf(surface.Mesh, true, SerialContext()));
}

}

std::shared_ptr<const MultigridSetup> SetupOf(const FramedMesh& surface, const ProlongationOperators* operators,
  const FieldOptions& options, const ExecutionContext& context)
{
  const auto field = MakeDiscretisation(options.Field, surface);
  return MakeSetup(
    surface, *field, operators, PlanOf(surface, *field, operators, options), options.CoarseSpace, context);
}

bool SplitsOperator(const FramedMesh& surface, const ProlongationOperators* operators, const FieldOptions& options)
{
  const auto field = MakeDiscretisation(options.Field, surface);
  return PlanOf(surface, *field, operators, options).SplitsOperator;
}

FieldConstraints MakeFieldConstraints(
  const FramedMesh& surface, const Constraints& directions, const FieldOptions& options)
{
  return MakeDiscretisation(options.Field, surface)->Prescribe(directions, {});
}

FieldProblem::FieldProblem(const FramedMesh& surface, const ProlongationOperators* operators,
  const FieldConstraints& constraints, const FieldOptions& options, const ExecutionContext& context,
  std::shared_ptr<const MultigridSetup> setup)
  : Field(MakeDiscretisation(options.Field, surface))
{
  const SolverPlan plan = PlanOf(surface, *this->Field, operators, options);
  Penalties penalties = this->Field->PenaltiesOf(constraints, options.Weights(), context);
  const double half = setup ? 0.0 : 0.6;
  if (!setup)
  {
    setup = MakeSetup(surface, *this->Field, operators, plan, options.CoarseSpace, PartOfContext(context, 0.0, half));
  }
  const SolverChoice choice = plan.ChoiceOn(*setup);
  this->Problem = std::make_unique<HarmonicProblem>(std::move(setup), std::move(penalties), options.Smoothness,
    options.Solver, choice, PartOfContext(context, half, 1.0));
}

void FieldProblem::Update(
  const FieldConstraints& constraints, const FieldOptions& options, const ExecutionContext& context)
{
  this->Problem->Update(this->Field->PenaltiesOf(constraints, options.Weights(), context), options.Smoothness, context);
}

Vector<double> FieldProblem::Solve(const Vector<double>& values, const Vector<double>& start,
  const StoppingCriteria& stop, const ExecutionContext& context, const ReferenceSolution& reference)
{
  return this->Problem->Solve(values, start, reference, stop, context);
}

Vector<Complex> PowerFieldProblem::Solve(const Vector<Complex>& values, const Vector<Complex>& start,
  const StoppingCriteria& stop, const ExecutionContext& context)
{
  return AsComplex(this->Problem.Solve(AsPairs(values), AsPairs(start), stop, context));
}

}
