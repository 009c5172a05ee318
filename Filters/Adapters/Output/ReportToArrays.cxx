#include "Adapters/Output/ReportToArrays.h"

#include "Adapters/Surface/ArrayNames.h"
#include "Adapters/Surface/NewArrays.h"

#include "vtkFieldData.h"
#include "vtkIntArray.h"
#include "vtkStringArray.h"
#include "vtkTable.h"

#include <cmath>
#include <vector>

namespace dmg
{

void MakeConvergenceTable(const SolveReport& report, vtkTable* table)
{
  std::vector<int> iterations, areReturned;
  for (const IterationReport& iteration : report.Iterations)
  {
    iterations.push_back(iteration.Iteration);
    areReturned.push_back(iteration.Iteration == report.Returned ? 1 : 0);
  }
  const auto addColumn = [&](const char* name, double IterationReport::*value)
  {
    std::vector<double> column;
    for (const IterationReport& iteration : report.Iterations)
    {
      column.push_back(iteration.*value);
    }
    table->AddColumn(NewArray<vtkDoubleArray>(name, 1, column));
  };
  const bool isEmpty = report.Iterations.empty();
  const auto isMeasured = [&](double IterationReport::*value)
  { return !isEmpty && !std::isnan(report.Iterations.back().*value); };
  table->Initialize();
  table->AddColumn(NewArray<vtkIntArray>(ArrayNames::Iteration, 1, iterations));
  addColumn(ArrayNames::Seconds, &IterationReport::Seconds);
  addColumn(ArrayNames::RelativeResidual, &IterationReport::RelativeResidual);
  if (isEmpty || isMeasured(&IterationReport::Energy)) // in pieces, nobody measures it
  {
    addColumn(ArrayNames::Energy, &IterationReport::Energy);
  }
  if (isMeasured(&IterationReport::MassResidual))
  {
    addColumn(ArrayNames::MassResidual, &IterationReport::MassResidual);
  }
  table->AddColumn(NewArray<vtkIntArray>(ArrayNames::Returned, 1, areReturned));
}

void RemoveReport(vtkFieldData* fieldData)
{
  for (const char* const name :
    { ArrayNames::Eigenvalues, ArrayNames::HarmonicBasisSize, ArrayNames::GuidesTaken, ArrayNames::GuidesTooFar,
      ArrayNames::GuidesOnFarSide, ArrayNames::GuidesPerpendicular, ArrayNames::GuidesFarthest })
  {
    fieldData->RemoveArray(name);
  }
}

void AddFollowed(const std::string& text, vtkFieldData* fieldData)
{
  AddHidden(fieldData, NewValue<vtkStringArray>(ArrayNames::Followed, text));
}

void AddReport(const Field& field, double setupSeconds, vtkFieldData* fieldData)
{
  const SolveReport& report = field.Report;
  const auto addNumber = [fieldData](const char* name, double value)
  { AddHidden(fieldData, NewValue<vtkDoubleArray>(name, value)); };
  const auto addCount = [fieldData](const char* name, int value)
  { AddHidden(fieldData, NewValue<vtkIntArray>(name, value)); };
  const auto addNumbers = [fieldData](const char* name, const std::vector<double>& values)
  { AddHidden(fieldData, NewArray<vtkDoubleArray>(name, 1, values)); };
  std::vector<double> unknowns, nonZeros;
  for (const LevelReport& level : report.Levels)
  {
    unknowns.push_back(static_cast<double>(level.Unknowns));
    nonZeros.push_back(static_cast<double>(level.NonZeros));
  }
  addCount(ArrayNames::NumberOfDirections, field.N);
  AddHidden(fieldData, NewValue<vtkStringArray>(ArrayNames::Solver, report.Solver));
  addCount(ArrayNames::Converged, report.Converged ? 1 : 0);
  addNumbers(ArrayNames::LevelUnknowns, unknowns);
  addNumbers(ArrayNames::LevelNonZeros, nonZeros);
  addNumber(ArrayNames::OperatorComplexity, report.OperatorComplexity());
  addNumber(ArrayNames::SetupSeconds, setupSeconds);
  addNumber(ArrayNames::PrepareSeconds, report.PrepareSeconds);
  addNumber(ArrayNames::SolveSeconds, report.SolveSeconds);
  addNumber(ArrayNames::SolverBytes, static_cast<double>(report.Bytes));
  if (field.HarmonicBasis)
  {
    addCount(ArrayNames::HarmonicBasisSize, static_cast<int>(field.HarmonicBasis->cols()));
  }
  if (!report.Eigenvalues.empty())
  {
    addNumbers(ArrayNames::Eigenvalues, report.Eigenvalues);
  }
}

}
