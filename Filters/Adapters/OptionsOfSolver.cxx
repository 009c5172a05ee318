#include "Adapters/OptionsOfSolver.h"

#include "vtkHarmonicFieldSolver.h"

namespace dmg
{

FieldOptions OptionsOf(vtkHarmonicFieldSolver* filter)
{
  FieldOptions options;
  options.Field.Kind = static_cast<DiscretisationKind>(filter->GetDiscretisation());
  options.Field.N = filter->GetNumberOfDirections();
  options.Field.Areas = filter->GetVertexAreas() == vtkHarmonicFieldSolver::MixedVoronoi
    ? VertexAreas::MixedVoronoi
    : VertexAreas::Barycentric;
  options.Alignment = filter->GetAlignment();
  options.Constraints = static_cast<ConstraintKind>(filter->GetConstraintType());
  options.CoarseSpace = static_cast<CoarseSpaceKind>(filter->GetCoarseSpace());
  options.Solver.Kind = static_cast<SolverKind>(filter->GetSolver());
  options.Solver.Sweeps = filter->GetSweeps();
  options.Solver.Nested.Cycles = filter->GetNestedCycles();
  options.Solver.Nested.Rule = static_cast<SweepRule>(filter->GetNestedRule());
  options.Solver.Nested.Sweeps = filter->GetNestedSweeps();
  options.Solver.Nested.MaximumSweeps = filter->GetMaximumNumberOfNestedSweeps();
  options.Solver.StartingLevel = filter->GetStartingLevel();
  options.Solver.ExpectedSolves = filter->GetExpectedSolves();
  options.Solver.CompareWithCholesky = filter->GetCompareWithCholesky();
  return options;
}

}
