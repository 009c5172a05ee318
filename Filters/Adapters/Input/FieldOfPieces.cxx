#include "Adapters/Input/FieldOfPieces.h"

#include "Adapters/Input/ConstraintsFromArrays.h"
#include "Adapters/Pipeline/PanelWords.h"
#include "Adapters/Ranks/GatheredInputs.h"

#include "vtkAlgorithm.h"
#include "vtkDataSet.h"
#include "vtkInformationVector.h"

#include <numeric>

namespace dmg
{

namespace
{

long long Sum(const RanksOfPipeline& ranks, long long here)
{
  const std::vector<long long> all = ranks.Gather(here);
  return std::accumulate(all.begin(), all.end(), 0LL);
}

/// Reads what the field follows. \return the directions that are left out on all ranks.
UnusableDirections ReadPieces(
  const FieldInputs& inputs, const SolverOfPieces& kept, const RanksOfPipeline& ranks, FieldProblem& problem)
{
  UnusableDirections unusable;
  ranks.Together([&] { unusable = ReadInputs(inputs, kept.Own(), problem); });
  if (Sum(ranks, problem.Constraints.AreEmpty() && problem.Guides.AreEmpty() ? 0 : 1) == 0)
  {
    ranks.Together(
      [&]
      {
        if (kept.Own())
        {
          CheckPrescribes(inputs);
        }
      });
  }
  unusable.NotFinite = Sum(ranks, unusable.NotFinite);
  unusable.Zero = Sum(ranks, unusable.Zero);
  unusable.Perpendicular = Sum(ranks, unusable.Perpendicular);
  unusable.NotSymmetric = Sum(ranks, unusable.NotSymmetric);
  unusable.FillValues = ranks.FirstText(unusable.FillValues);
  return unusable;
}

void Warn(vtkAlgorithm* filter, const RanksOfPipeline& ranks, const std::string& text)
{
  if (ranks.Rank() == 0)
  {
    vtkWarningWithObjectMacro(filter, << text);
  }
}

}

FieldOfPieces SolveInPieces(vtkAlgorithm* filter, const FieldProperties& properties, SolverOfPieces& kept,
  const RanksOfPipeline& ranks, vtkInformationVector** inputs, const ExecutionContext& context)
{
  FieldOfPieces result;
  FieldProblem problem = properties.Problem;
  result.ReasonToGather = ReasonToGather(problem);
  if (result.ReasonToGather.empty() && filter->GetNumberOfInputConnections(2) > 0)
  {
    result.ReasonToGather = "fields with prescribed singularities are found on one process";
  }
  if (!result.ReasonToGather.empty())
  {
    return result;
  }
  GatheredInputs shared(ranks, filter, inputs, GatheredInputs::Place::SurfaceApart);
  vtkDataSet* const surface = vtkDataSet::GetData(inputs[0]);
  result.ReasonToGather = kept.SetSurface(ranks, surface, properties.Preparation, PartOfContext(context, 0.0, 0.3));
  if (!result.ReasonToGather.empty())
  {
    return result;
  }
  ranks.Together([&] { result.Inputs = InputsOf(properties, surface, shared.Get()); });
  if (const UnusableDirections unusable = ReadPieces(result.Inputs, kept, ranks, problem); !unusable.AreNone())
  {
    Warn(filter, ranks, TextOf(unusable));
  }
  for (const std::string& text : WarningsOf(result.Inputs.Guides))
  {
    Warn(filter, ranks, text);
  }
  result.Solution = &kept.Solver().Solve(problem, PartOfContext(context, 0.3, 1.0));
  for (const std::string& text : result.Solution->Warnings)
  {
    Warn(filter, ranks, InPanelWords(text));
  }
  result.Followed = ranks.FirstText(kept.Own() ? WhatIsFollowed(result.Inputs, result.Solution->Features) : "");
  return result;
}

}
