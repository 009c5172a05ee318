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
  // The rows of the matrix say how depth goes with distance. VTK replaces its marks by assignments where shaders have normals, else by
  // nothing, so in the blocks they write to variables that are zero before. The other side of a thin wall goes behind this one.
  return R"(//VTK::PositionVC::Impl
  vec3 depthRow = vec3(MCDCMatrix[0].z, MCDCMatrix[1].z, MCDCMatrix[2].z);
  vec3 distanceRow = vec3(MCDCMatrix[0].w, MCDCMatrix[1].w, MCDCMatrix[2].w);
  float isPerspective = dot(distanceRow, distanceRow);
  float nearer = isPerspective > 0.0 ? 0.002 * (gl_Position.z - dot(depthRow, distanceRow) / isPerspective * gl_Position.w) : -0.004 * gl_Position.w;
  vec3 normal = vec3(0.0);
  vec3 seenNormal = vec3(0.0);
  vec4 seen = vec4(0.0);
  {
    vec4 vertexVCVSOutput = seen;
    vec3 normalVCVSOutput = normal;
    //VTK::PositionVC::Impl
    //VTK::Normal::Impl
    seen = vertexVCVSOutput;
    seenNormal = normalVCVSOutput;
  }
  {
    mat3 normalMatrix = mat3(1.0);
    vec3 normalVCVSOutput = normal;
    //VTK::Normal::Impl
    normal = normalVCVSOutput;
  }
  bool facesAway = isPerspective > 0.0 ? dot(seenNormal, seen.xyz) > 0.0 : seenNormal.z < 0.0;
  gl_Position.z += facesAway && dot(normal, normal) < 0.5 ? -5.0 * nearer : nearer;
)";
}

//------------------------------------------------------------------------------
void vtkFieldDrawingAlgorithm::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "NumberOfDirections: " << this->NumberOfDirections << "\n";
}
