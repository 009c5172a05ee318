#include "vtkFieldAngles.h"

#include "Adapters/Input/FieldFromArrays.h"
#include "Adapters/Pipeline/FilterRequests.h"
#include "Adapters/Pipeline/PropertyTable.h"
#include "Adapters/View/ChosenArrays.h"
#include "Drawing/AnglesOfField.h"
#include "Mesh/PositiveSide.h"

#include "vtkCellData.h"
#include "vtkDataSet.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"

vtkStandardNewMacro(vtkFieldAngles);

//------------------------------------------------------------------------------
int vtkFieldAngles::FillInputPortInformation(int, vtkInformation* information)
{
  return dmg::TakeAnyDataSet(information);
}

//------------------------------------------------------------------------------
int vtkFieldAngles::RequestDataObject(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  return dmg::MakeOutputLikeInput(inputVector, outputVector);
}

//------------------------------------------------------------------------------
int vtkFieldAngles::RequestUpdateExtent(
  vtkInformation* request, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  return dmg::AskForInputs(this, request, inputVector, outputVector);
}

//------------------------------------------------------------------------------
int vtkFieldAngles::RequestData(
  vtkInformation* request, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  return dmg::DrawField(
    this, request, inputVector, outputVector, this->NumberOfDirections, [] { return dmg::PropertyTable(); },
    [this, outputVector](const dmg::SurfaceWithField& given, const dmg::ExecutionContext& context)
    {
      const dmg::Points references =
        dmg::ReferenceVectors(this, dmg::ChoiceOf(this, 1), given.View, dmg::Vector3(this->Axis));
      const dmg::SidesOfSurface sides = dmg::FindSides(given.View.Mesh());
      dmg::Vector<double> angles = 180.0 / dmg::Pi *
        dmg::AnglesOfField(given.View.Surface().Geometry.Faces, given.Field, references, sides, context);
      if (const auto undefined = angles.array().isNaN().count())
      {
        vtkWarningMacro("there is no angle on " << undefined << " of " << angles.size()
                                                << " triangles, where Angle is 0: the field has no direction, or the "
                                                   "reference is zero or perpendicular there; "
                                                   "choose another Axis or other Reference Vectors");
        angles = angles.array().isNaN().select(0.0, angles);
      }
      this->Period = 360.0 / given.Field.N();
      given.View.StartOutput(vtkDataSet::GetData(outputVector), this->GetClassName());
      vtkDataSet* const output = given.View.Output();
      given.View.OfCells(context).AddOfLargest("Angle", angles.data());
      output->GetCellData()->SetActiveScalars("Angle");
    });
}

//------------------------------------------------------------------------------
void vtkFieldAngles::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "NumberOfDirections: " << this->NumberOfDirections << "\n";
  os << indent << "Period: " << this->Period << "\n";
  os << indent << "Axis: " << this->Axis[0] << " " << this->Axis[1] << " " << this->Axis[2] << "\n";
}
