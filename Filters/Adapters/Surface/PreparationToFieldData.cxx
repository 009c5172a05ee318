#include "Adapters/Surface/PreparationToFieldData.h"

#include "Adapters/Surface/ArrayNames.h"
#include "Adapters/Surface/NewArrays.h"

#include "vtkAlgorithm.h"
#include "vtkDataSet.h"
#include "vtkFieldData.h"
#include "vtkIntArray.h"
#include "vtkStringArray.h"

#include <string>
#include <vector>

namespace dmg
{

void AddPreparation(const PreparationReport& report, const PreparationOptions& options, vtkFieldData* fieldData)
{
  fieldData->RemoveArray(ArrayNames::SurfacePreparation);
  fieldData->RemoveArray(ArrayNames::SurfaceOptions);
  if (const std::string text = report.Text(); !text.empty())
  {
    AddHidden(fieldData, NewValue<vtkStringArray>(ArrayNames::SurfacePreparation, text));
  }
  if (options.Strict || !options.JoinPoints)
  {
    const std::vector<int> values{ options.JoinPoints ? 1 : 0, options.Strict ? 1 : 0 };
    AddHidden(fieldData, NewArray<vtkIntArray>(ArrayNames::SurfaceOptions, 1, values));
  }
}

void AddPositiveSide(const SidesOfSurface& sides, vtkFieldData* fieldData)
{
  AddHidden(fieldData, NewValue<vtkStringArray>(ArrayNames::PositiveSide, sides.Text()));
}

PreparationOptions PreparationOf(vtkDataSet* surface)
{
  PreparationOptions options;
  auto* const array = vtkDataArray::SafeDownCast(surface->GetFieldData()->GetAbstractArray(ArrayNames::SurfaceOptions));
  if (array && array->GetNumberOfTuples() == 2 && array->GetNumberOfComponents() == 1)
  {
    options.JoinPoints = array->GetComponent(0, 0) != 0.0;
    options.Strict = array->GetComponent(1, 0) != 0.0;
  }
  return options;
}

void WarnOfPreparation(vtkAlgorithm* algorithm, const PreparationReport& report)
{
  if (report.IsChanged())
  {
    const bool isStrictByChoice = algorithm->IsA("vtkOrientedSurfaceAlgorithm");
    vtkWarningWithObjectMacro(algorithm,
      "the surface was not an oriented manifold, and is solved on as one: "
        << report.Text() << "; its own cells and points stay as they are; to have it refused, "
        << (isStrictByChoice ? "switch Strict on" : "take a field of Harmonic Field Solver with Strict on"));
  }
}

}
