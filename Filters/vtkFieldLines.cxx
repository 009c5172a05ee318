#include "vtkFieldLines.h"

#include "Adapters/DrawingToPolyData.h"
#include "Adapters/FieldFromArrays.h"
#include "Adapters/FilterRequests.h"
#include "Drawing/EvenlySpacedLines.h"

#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkPolyData.h"

vtkStandardNewMacro(vtkFieldLines);

//------------------------------------------------------------------------------
int vtkFieldLines::FillInputPortInformation(int, vtkInformation* information)
{
  return dmg::TakeAnyDataSet(information);
}

//------------------------------------------------------------------------------
int vtkFieldLines::RequestUpdateExtent(
  vtkInformation* request, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  return dmg::AskForInputs(this, request, inputVector, outputVector);
}

//------------------------------------------------------------------------------
int vtkFieldLines::RequestData(
  vtkInformation* request, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  vtkPolyData* const output = vtkPolyData::GetData(outputVector);
  return dmg::DrawField(this, request, inputVector, outputVector, this->NumberOfDirections,
    {
      { "Separating Distance", this->SeparatingDistance, 0.0005, 1 },
      { "Separating Distance Ratio", this->SeparatingDistanceRatio, 0.05, 0.9 },
      { "Minimum Length", this->MinimumLength, 0, 1000 },
      { "Lift", this->Lift, 0, 0.1 },
    },
    [this, output](const dmg::SurfaceWithField& given, const dmg::ExecutionContext& context)
    {
      dmg::LineOptions options;
      options.Separation = this->SeparatingDistance * given.Diagonal;
      options.StopRatio = this->SeparatingDistanceRatio;
      options.MinimumLength = this->MinimumLength * options.Separation;
      const dmg::UnfoldedSurface surface(given.Surface.Mesh, given.Faces, context);
      const dmg::LinesOnSurface lines =
        dmg::EvenlySpacedLines(surface, given.Field, options, context);
      dmg::LinesToPolyData(lines, given.Faces, this->Lift * given.Diagonal, output);
    });
}

//------------------------------------------------------------------------------
void vtkFieldLines::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "NumberOfDirections: " << this->NumberOfDirections << "\n";
  os << indent << "SeparatingDistance: " << this->SeparatingDistance << "\n";
  os << indent << "SeparatingDistanceRatio: " << this->SeparatingDistanceRatio << "\n";
  os << indent << "MinimumLength: " << this->MinimumLength << "\n";
  os << indent << "Lift: " << this->Lift << "\n";
}
