#include "Adapters/Output/OutputOfPieces.h"

#include "Adapters/Input/ConstraintsFromArrays.h"
#include "Adapters/Output/FieldToArrays.h"
#include "Adapters/Output/ReportToArrays.h"
#include "Adapters/Pipeline/PanelWords.h"
#include "Adapters/Ranks/GatheredInputs.h"
#include "Adapters/Surface/PreparationToFieldData.h"

#include "vtkAlgorithm.h"
#include "vtkDataSet.h"
#include "vtkFieldData.h"
#include "vtkInformationVector.h"
#include "vtkPolyData.h"
#include "vtkTable.h"

#include <algorithm>

namespace dmg
{

namespace
{

/// The text of the first rank that has one.
std::string FirstOf(const RanksOfPipeline& ranks, const std::string& text)
{
  const std::vector<std::string> all = ranks.Gather(text);
  const auto isGiven = [](const std::string& each) { return !each.empty(); };
  const auto first = std::find_if(all.begin(), all.end(), isGiven);
  return first == all.end() ? std::string() : *first;
}

long long Sum(const RanksOfPipeline& ranks, long long here)
{
  long long sum = 0;
  for (const long long each : ranks.Gather(here))
  {
    sum += each;
  }
  return sum;
}

/// Reads what the field follows. \return the directions that are left out on all ranks.
UnusableDirections ReadPieces(
  const FieldInputs& inputs, const SolverOfPieces& kept, const RanksOfPipeline& ranks, FieldProblem& problem)
{
  UnusableDirections unusable;
  ranks.Together(
    [&]
    {
      if (kept.HasSurface())
      {
        const FramedSurface own = kept.Own();
        unusable = ReadInputs(inputs, &own, problem);
      }
      else
      {
        unusable = ReadInputs(inputs, nullptr, problem);
      }
    });
  if (Sum(ranks, problem.Constraints.AreEmpty() && problem.Guides.AreEmpty() ? 0 : 1) == 0)
  {
    ranks.Together(
      [&]
      {
        if (kept.HasSurface())
        {
          CheckPrescribes(inputs);
        }
      });
  }
  unusable.NotFinite = Sum(ranks, unusable.NotFinite);
  unusable.Zero = Sum(ranks, unusable.Zero);
  unusable.Perpendicular = Sum(ranks, unusable.Perpendicular);
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

std::string SolveInPieces(vtkAlgorithm* filter, const FieldProperties& properties, SolverOfPieces& kept,
  const RanksOfPipeline& ranks, vtkInformationVector** inputs, vtkInformationVector* outputs, std::string& followed,
  const ExecutionContext& context)
{
  FieldProblem problem = properties.Problem;
  std::string reason = ReasonToGather(problem);
  if (reason.empty() && filter->GetNumberOfInputConnections(2) > 0)
  {
    reason = "fields with prescribed singularities are found on one process";
  }
  if (!reason.empty())
  {
    return reason;
  }
  GatheredInputs shared(ranks, filter, inputs, GatheredInputs::Place::SurfaceApart);
  vtkDataSet* const input = vtkDataSet::GetData(inputs[0]);
  reason = kept.SetSurface(ranks, input, properties.Preparation, PartOfContext(context, 0.0, 0.3));
  if (!reason.empty())
  {
    return reason;
  }
  FieldInputs given;
  ranks.Together([&] { given = InputsOf(properties, input, shared.Get()); });
  if (const UnusableDirections unusable = ReadPieces(given, kept, ranks, problem); !unusable.AreNone())
  {
    Warn(filter, ranks, TextOf(unusable));
  }
  const Field* field = nullptr;
  ranks.Together( // its errors come from all ranks at once
    [&] { field = &kept.Solver().Solve(problem, PartOfContext(context, 0.3, 0.95)); });
  for (const std::string& text : field->Warnings)
  {
    Warn(filter, ranks, InPanelWords(text));
  }

  vtkDataSet* const output = vtkDataSet::GetData(outputs, 0);
  vtkTable* const convergence = vtkTable::GetData(outputs, 2);
  std::string followedHere;
  ranks.Together(
    [&]
    {
      output->ShallowCopy(input);
      MakeConvergenceTable(field->Report, convergence);
      if (kept.HasSurface())
      {
        const FramedSurface surface = kept.Surface();
        const FieldSolution& solution = *field->Solution;
        vtkPolyData* const edges = vtkPolyData::GetData(outputs, 1);
        AddFieldArrays(MakeFieldArrays(surface.Geometry, surface.Relation, *solution.Discretisation, solution.Unknowns,
                         *field, input, PartOfContext(context, 0.95, 1.0)),
          output, edges);
        AddPrescribed(surface.Relation, solution.Constraints, solution.Discretisation->Elements(), output, edges);
        AddPreparation(kept.Preparation(), properties.Preparation, output->GetFieldData());
        followedHere = WhatIsFollowed(given, problem.Features);
      }
    });
  followed = FirstOf(ranks, followedHere);
  for (vtkFieldData* const data : { output->GetFieldData(), convergence->GetFieldData() })
  {
    RemoveReport(data);
    AddFollowed(followed, data);
    AddReport(field->Report, field->N, kept.SetupSeconds(*field), data);
    if (!given.Guides.Data.empty())
    {
      AddGuidesReport(field->Guides, data);
    }
  }
  return "";
}

}
