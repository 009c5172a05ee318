#include "Adapters/Output/GuidesToArrays.h"

#include "Adapters/Surface/ArrayNames.h"
#include "Adapters/Surface/PolyDataBuilder.h"

#include <utility>

namespace dmg
{

void PathsToPolyData(const GuidePaths& paths, vtkPolyData* output)
{
  PolyDataBuilder drawing(PolyDataBuilder::Cells::Lines);
  for (const Vector3& position : paths.Positions)
  {
    drawing.AddPoint(position);
  }
  vtkIdType first = 0;
  for (const int end : paths.Ends)
  {
    drawing.AddLine(first, end, false);
    first = end;
  }
  drawing.Finish(output);
}

void AddGuidesReport(const GuidesReport& report, vtkFieldData* fieldData)
{
  const std::pair<const char*, long long> counts[] = { { ArrayNames::GuidesTaken, report.Taken },
    { ArrayNames::GuidesTooFar, report.TooFar }, { ArrayNames::GuidesOnFarSide, report.OnFarSide },
    { ArrayNames::GuidesPerpendicular, report.Perpendicular } };
  for (const auto& [name, count] : counts)
  {
    AddHidden(fieldData, NewValue<vtkIntArray>(name, static_cast<int>(count)));
  }
  AddHidden(fieldData, NewValue<vtkDoubleArray>(ArrayNames::GuidesFarthest, report.Farthest));
}

}
