#include "Setup/FieldSetup.h"

#include "Analysis/HarmonicForms.h"
#include "Support/AllIndices.h"
#include "Support/Errors.h"
#include "Support/FreedMemory.h"

#include <string>
#include <utility>

namespace dmg
{
namespace
{

/// Harmonic fields, and why they are left out.
void AddKernel(const FramedMesh& surface, const Discretisation& discretisation, const ProlongationOperators* operators,
  MultigridSetup& setup, const ExecutionContext& context)
{
  const int loops = discretisation.NumberOfHarmonicFields();
  if (loops > 0 && AreTooManyToHold(loops, surface.Mesh))
  {
    setup.KernelNote = ", without its " + std::to_string(loops) + " harmonic fields, which are too many to hold";
  }
  else if (loops > LargestNumberOfGenerators && !setup.HasLevels)
  {
    // A factor does not need them, and is made faster than they are.
    setup.KernelNote = ", without looking at its " + std::to_string(loops) + " harmonic fields";
  }
  else if (loops > 0)
  {
    setup.Kernel = discretisation.HarmonicFields(operators, context)(setup.Hierarchy->Order, All);
  }
}

/// The mass of equations, in the order of the hierarchy's unknowns.
Vector<double> MassInOrder(const Vector<double>& mass, const std::vector<int>& order, const ExecutionContext& context)
{
  constexpr int Grain = 8192;
  const int parts = static_cast<int>(order.size() / mass.size()); // unknowns of an equation
  Vector<double> inOrder(mass.size());
  context.ParallelFor(0, static_cast<int>(mass.size()), Grain,
    [&](int first, int last)
    {
      for (int k = first; k < last; ++k)
      {
        inOrder[k] = mass[order[parts * k] / parts];
      }
    });
  return inOrder;
}

std::shared_ptr<MultigridSetup> NewSetup(const Discretisation& discretisation, CoarseSpaceKind space)
{
  const auto setup = std::make_shared<MultigridSetup>();
  setup->Fields = discretisation.Name();
  setup->Name = space == CoarseSpaceKind::LinearInterpolation ? "linear levels" : discretisation.NameOfLevels();
  setup->Tuning = discretisation.Tuning();
  if (space != CoarseSpaceKind::LinearInterpolation)
  {
    setup->Tuning = {}; // all that was measured is about linear levels
  }
  return setup;
}

std::shared_ptr<const MultigridSetup> FinishSetup(const FramedMesh& surface, const Discretisation& discretisation,
  const ProlongationOperators* operators, std::shared_ptr<MultigridSetup> setup, const ExecutionContext& context)
{
  setup->Mass = MassInOrder(discretisation.Mass(context), setup->Hierarchy->Order, context);
  setup->HasSmoothest = discretisation.HasSmoothest();
  setup->Area = surface.Mesh.FaceAreas(context).sum();
  setup->SquaredNormOfUnit = discretisation.SquaredNormOfUnit(setup->Mass);
  AddKernel(surface, discretisation, operators, *setup, context);
  GiveBackFreedMemory();
  context.Checkpoint(1.0);
  return setup;
}

std::shared_ptr<const MultigridSetup> MakeAssembled(const FramedMesh& surface, const Discretisation& discretisation,
  const ProlongationOperators* operators, CoarseSpaceKind space, const ExecutionContext& context)
{
  context.Checkpoint(0.0);
  const auto setup = NewSetup(discretisation, space);
  setup->HasLevels = operators != nullptr;
  setup->Hierarchy = discretisation.Assemble(operators, space, context);
  return FinishSetup(surface, discretisation, operators, setup, PartOfContext(context, 0.8, 1.0));
}

std::shared_ptr<const MultigridSetup> MakeCoarsened(const FramedMesh& surface, const Discretisation& discretisation,
  const LinearProlongations& linear, const ProlongationOperators* operators, const ExecutionContext& context)
{
  context.Checkpoint(0.0);
  const auto setup = NewSetup(discretisation, CoarseSpaceKind::LinearInterpolation);
  const double most = discretisation.HasHarmonicFields() ? 0.8 : 0.99;
  setup->Hierarchy = discretisation.Coarsen(linear, PartOfContext(context, 0.0, most));
  return FinishSetup(surface, discretisation, operators, setup, PartOfContext(context, most, 1.0));
}

}

/// Whether a solver needs decimated surfaces: samples are made faster, and suffice for cycles.
bool WantsDecimation(const FieldOptions& options)
{
  const SolverMethod& method = MethodOf(options.Solver.Kind);
  return method.NeedsLevels &&
    (method.NeedsMatrix || options.CoarseSpace != CoarseSpaceKind::LinearInterpolation ||
      options.Solver.StartingLevel >= 0);
}

SolverPlan PlanSolver(const Discretisation& discretisation, const FieldOptions& options,
  const ProlongationOperators* given, const CycleObstacles& obstacles)
{
  SolverPlan plan;
  plan.Selection = options.CoarseSpace == CoarseSpaceKind::StructurePreserving
    ? discretisation.StructurePreservingOperators()
    : OperatorSelection{ false, false, false };
  const bool hasLevels = !given || given->NumberOfLevels() > 1;
  CycleObstacles ofCycles = obstacles;
  ofCycles.Loops = discretisation.HasHarmonicFields() ? obstacles.Loops : 0;
  const auto choose = [&](bool areThere)
  {
    return ChooseSolver(options.Solver, discretisation.Tuning(), discretisation.NumberOfEquations(), areThere,
      WhyFactorIsBetter(ofCycles));
  };
  plan.Choice = choose(hasLevels);
  plan.Fallback = choose(false);
  plan.SampleDistance = discretisation.SampleDistance();
  plan.SplitsOperator =
    !plan.Choice.Method->NeedsMatrix && !WantsDecimation(options) && (!given || !given->Linear.empty());
  plan.BuildsSamples = plan.SplitsOperator && !given;
  return plan;
}

std::shared_ptr<const MultigridSetup> MakeSetup(const FramedMesh& surface, const Discretisation& discretisation,
  const ProlongationOperators* operators, const SolverPlan& plan, CoarseSpaceKind space,
  const ExecutionContext& context)
{
  if (!plan.SplitsOperator)
  {
    if (plan.NeedsLevels() && !operators)
    {
      throw InvalidInput("multigrid needs the prolongation operators of the surface");
    }
    const bool hasLevels = plan.NeedsLevels() && operators->NumberOfLevels() > 1;
    return MakeAssembled(surface, discretisation, hasLevels ? operators : nullptr, space, context);
  }
  if (operators)
  {
    return MakeCoarsened(surface, discretisation, LinearProlongations::Borrowed(*operators), operators, context);
  }
  context.Checkpoint(0.0);
  ProlongationOperators samples = discretisation.SampledLevels(plan.SampleDistance, PartOfContext(context, 0.0, 0.3));
  const PartOfContext rest(context, 0.3, 1.0);
  if (samples.Linear.empty())
  {
    return MakeAssembled(surface, discretisation, nullptr, space, rest);
  }
  GiveBackFreedMemory();
  return MakeCoarsened(surface, discretisation, LinearProlongations::Owned(samples), &samples, rest);
}

}
