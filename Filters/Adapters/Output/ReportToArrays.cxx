#include "Adapters/Output/ReportToArrays.h"

#include "Adapters/Surface/ElementArrays.h"

#include "vtkFieldData.h"
#include "vtkIntArray.h"
#include "vtkNew.h"
#include "vtkStringArray.h"
#include "vtkTable.h"

#include <algorithm>
#include <cmath>

namespace dmg
{
namespace
{

template <class ArrayType, class Value>
void AddValue(vtkFieldData* fieldData, const char* name, const Value& value)
{
  vtkNew<ArrayType> array;
  array->SetName(name);
  array->InsertNextValue(value);
  AddHidden(fieldData, array);
}

}

void MakeConvergenceTable(const SolveReport& report, vtkTable* table)
{
  const vtkIdType size = static_cast<vtkIdType>(report.Iterations.size());
  vtkNew<vtkIntArray> iterations;
  iterations->SetName(ArrayNames::Iteration);
  iterations->SetNumberOfValues(size);
  table->Initialize();
  table->AddColumn(iterations);
  const auto addColumn = [&](const char* name, double IterationReport::*value)
  {
    const auto column = NewArray(name, 1, size);
    for (vtkIdType i = 0; i < size; ++i)
    {
      column->SetValue(i, report.Iterations[i].*value);
    }
    table->AddColumn(column);
  };
  for (vtkIdType i = 0; i < size; ++i)
  {
    iterations->SetValue(i, report.Iterations[i].Iteration);
  }
  addColumn(ArrayNames::Seconds, &IterationReport::Seconds);
  addColumn(ArrayNames::RelativeResidual, &IterationReport::RelativeResidual);
  const auto addIfMeasured = [&](const char* name, double IterationReport::*value)
  {
    if (size > 0 && !std::isnan(report.Iterations.back().*value))
    {
      addColumn(name, value);
    }
  };
  if (size == 0 || !std::isnan(report.Iterations.back().Energy)) // in pieces, nobody measures it
  {
    addColumn(ArrayNames::Energy, &IterationReport::Energy);
  }
  addIfMeasured(ArrayNames::MassResidual, &IterationReport::MassResidual);
  vtkNew<vtkIntArray> returned;
  returned->SetName(ArrayNames::Returned);
  returned->SetNumberOfValues(size);
  for (vtkIdType i = 0; i < size; ++i)
  {
    returned->SetValue(i, report.Iterations[i].Iteration == report.Returned ? 1 : 0);
  }
  table->AddColumn(returned);
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
  AddValue<vtkStringArray>(fieldData, ArrayNames::Followed, text);
}

void AddReport(const Field& field, double setupSeconds, vtkFieldData* fieldData)
{
  const SolveReport& report = field.Report;
  const vtkIdType levels = static_cast<vtkIdType>(report.Levels.size());
  const auto unknowns = NewArray(ArrayNames::LevelUnknowns, 1, levels);
  const auto nonZeros = NewArray(ArrayNames::LevelNonZeros, 1, levels);
  for (vtkIdType level = 0; level < levels; ++level)
  {
    unknowns->SetValue(level, static_cast<double>(report.Levels[level].Unknowns));
    nonZeros->SetValue(level, static_cast<double>(report.Levels[level].NonZeros));
  }
  AddValue<vtkIntArray>(fieldData, ArrayNames::NumberOfDirections, field.N);
  AddValue<vtkStringArray>(fieldData, ArrayNames::Solver, report.Solver);
  AddValue<vtkIntArray>(fieldData, ArrayNames::Converged, report.Converged ? 1 : 0);
  AddHidden(fieldData, unknowns);
  AddHidden(fieldData, nonZeros);
  AddValue<vtkDoubleArray>(fieldData, ArrayNames::OperatorComplexity, report.OperatorComplexity());
  AddValue<vtkDoubleArray>(fieldData, ArrayNames::SetupSeconds, setupSeconds);
  AddValue<vtkDoubleArray>(fieldData, ArrayNames::PrepareSeconds, report.PrepareSeconds);
  AddValue<vtkDoubleArray>(fieldData, ArrayNames::SolveSeconds, report.SolveSeconds);
  AddValue<vtkDoubleArray>(fieldData, ArrayNames::SolverBytes, static_cast<double>(report.Bytes));
  if (field.HarmonicBasis)
  {
    AddValue<vtkIntArray>(fieldData, ArrayNames::HarmonicBasisSize, static_cast<int>(field.HarmonicBasis->cols()));
  }
  if (!report.Eigenvalues.empty())
  {
    const auto eigenvalues = NewArray(ArrayNames::Eigenvalues, 1, static_cast<vtkIdType>(report.Eigenvalues.size()));
    std::copy(report.Eigenvalues.begin(), report.Eigenvalues.end(), eigenvalues->GetPointer(0));
    AddHidden(fieldData, eigenvalues);
  }
}

}
