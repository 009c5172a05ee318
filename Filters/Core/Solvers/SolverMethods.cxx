#include "Solvers/Krylov/ConjugateGradient.h"
#include "Solvers/Krylov/StationaryIteration.h"
#include "Solvers/SolverMethod.h"

#include <array>

namespace dmg
{
namespace
{

StiffnessCycleOptions OptionsOfCycle(const SolverOptions& options, const SolverTuning& tuning)
{
  StiffnessCycleOptions cycle;
  cycle.Sweeps = options.Sweeps * tuning.FinestSweepsFactor;
  cycle.Coarse.Smoothing.PreSweeps = options.Sweeps;
  cycle.Coarse.Smoothing.PostSweeps = options.Sweeps;
  cycle.Coarse.Repetitions = tuning.CoarseCycles;
  cycle.LargestFactor = tuning.LargestCoarseFactor;
  cycle.CyclesInARow = tuning.CyclesInARow;
  cycle.Coarsening.FinestProlongationSteps = tuning.FinestProlongationSteps;
  if (options.StartingLevel >= 0)
  {
    cycle.Coarsening.CoarsestLevel = options.StartingLevel;
  }
  return cycle;
}

/// A V-cycle, or the factor where the hierarchy has no coarse levels.
std::unique_ptr<StiffnessCycle> Cycle(
  const MultigridSetup& setup, const Vector<double>& D, const SolverOptions& options, const ExecutionContext& context)
{
  return setup.Hierarchy->Cycle(D, OptionsOfCycle(options, setup.Tuning), context);
}

template <bool MaySweep>
std::unique_ptr<StiffnessNestedIteration> FullMultigrid(
  const MultigridSetup& setup, const Vector<double>& D, const SolverOptions& options, const ExecutionContext& context)
{
  return setup.Hierarchy->NestedIterations(D, OptionsOfCycle(options, setup.Tuning), MaySweep, context);
}

SolverMethod Factorisation(const std::string& name)
{
  SolverMethod method;
  method.Name = name;
  method.NeedsLevels = false;
  method.NeedsMatrix = true;
  method.MakePreconditioner = &Cycle;
  method.Iterate = &ConjugateGradient<double>;
  method.IsDirect = true;
  return method;
}

SolverMethod Iterated(const std::string& name, SolverMethod::Iteration* iteration, bool hasFallback)
{
  SolverMethod method;
  method.Name = name;
  method.MakePreconditioner = &Cycle;
  method.Iterate = iteration;
  method.HasFallback = hasFallback;
  return method;
}

SolverMethod Approximation(const std::string& name, SolverMethod::ApproximationMaker* approximation, bool hasSweeps)
{
  SolverMethod method;
  method.Name = name;
  method.NeedsMatrix = true;
  method.MakePreconditioner = &Cycle;
  method.MakeApproximation = approximation;
  method.HasSweeps = hasSweeps;
  return method;
}

}

const SolverMethod& MethodOf(SolverKind kind)
{
  // Rows are in the order of SolverKind, after Automatic.
  static const std::array<SolverMethod, 5> table = { {
    Factorisation("supernodal Cholesky"),
    Iterated("V-cycles", &StationaryIteration<double>, false),
    Iterated("conjugate gradients with a V-cycle", &ConjugateGradient<double>, true),
    Approximation("nested iterations", &FullMultigrid<true>, true),
    Approximation("coarse prolongation", &FullMultigrid<false>, false),
  } };
  const SolverKind row = kind == SolverKind::Automatic ? SolverKind::ConjugateGradients : kind;
  return table.at(static_cast<std::size_t>(row) - 1);
}

}
