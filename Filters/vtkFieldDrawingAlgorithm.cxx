#include "vtkFieldDrawingAlgorithm.h"

#include "Adapters/Pipeline/FilterRequests.h"

//------------------------------------------------------------------------------
int vtkFieldDrawingAlgorithm::FillInputPortInformation(int, vtkInformation* information)
{
  return dmg::TakeAnyDataSet(information);
}

//------------------------------------------------------------------------------
int vtkFieldDrawingAlgorithm::RequestUpdateExtent(
  vtkInformation* request, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  return dmg::AskForInputs(this, request, inputVector, outputVector);
}

//------------------------------------------------------------------------------
void vtkFieldDrawingAlgorithm::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "NumberOfDirections: " << this->NumberOfDirections << "\n";
}
