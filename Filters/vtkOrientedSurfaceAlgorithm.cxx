#include "vtkOrientedSurfaceAlgorithm.h"

#include "Adapters/Pipeline/FilterRequests.h"

//------------------------------------------------------------------------------
int vtkOrientedSurfaceAlgorithm::FillInputPortInformation(int, vtkInformation* information)
{
  return dmg::TakeAnyDataSet(information);
}

//------------------------------------------------------------------------------
int vtkOrientedSurfaceAlgorithm::RequestDataObject(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  return dmg::MakeOutputLikeInput(inputVector, outputVector);
}

//------------------------------------------------------------------------------
int vtkOrientedSurfaceAlgorithm::RequestInformation(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  return dmg::GatherTimes(this, inputVector, outputVector);
}

//------------------------------------------------------------------------------
int vtkOrientedSurfaceAlgorithm::RequestUpdateExtent(
  vtkInformation* request, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  return dmg::AskForInputs(this, request, inputVector, outputVector);
}

//------------------------------------------------------------------------------
void vtkOrientedSurfaceAlgorithm::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "JoinPoints: " << (this->JoinPoints ? "On" : "Off") << "\n";
  os << indent << "Strict: " << (this->Strict ? "On" : "Off") << "\n";
}
