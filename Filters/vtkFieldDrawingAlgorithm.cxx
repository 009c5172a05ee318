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
const char* vtkFieldDrawingAlgorithm::GetInkShader()
{
  // The rows of the matrix say how depth goes with distance.
  return R"(//VTK::PositionVC::Impl
  vec3 depthRow = vec3(MCDCMatrix[0].z, MCDCMatrix[1].z, MCDCMatrix[2].z);
  vec3 distanceRow = vec3(MCDCMatrix[0].w, MCDCMatrix[1].w, MCDCMatrix[2].w);
  float isPerspective = dot(distanceRow, distanceRow);
  gl_Position.z += isPerspective > 0.0 ? 0.002 * (gl_Position.z - dot(depthRow, distanceRow) / isPerspective * gl_Position.w) : -0.004 * gl_Position.w;
)";
}

//------------------------------------------------------------------------------
void vtkFieldDrawingAlgorithm::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "NumberOfDirections: " << this->NumberOfDirections << "\n";
}
