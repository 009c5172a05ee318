#include "vtkFieldSingularities.h"

#include "Adapters/Input/FieldFromArrays.h"
#include "Adapters/Output/DrawingToPolyData.h"
#include "Adapters/Pipeline/FilterRequests.h"
#include "Operators/FieldTopology.h"
#include "Operators/VertexFieldTopology.h"

#include "vtkDataSet.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkPolyData.h"

vtkStandardNewMacro(vtkFieldSingularities);

//------------------------------------------------------------------------------
vtkFieldSingularities::vtkFieldSingularities()
{
  this->SetNumberOfOutputPorts(4);
}

//------------------------------------------------------------------------------
int vtkFieldSingularities::FillInputPortInformation(int, vtkInformation* information)
{
  return dmg::TakeAnyDataSet(information);
}

//------------------------------------------------------------------------------
int vtkFieldSingularities::RequestUpdateExtent(
  vtkInformation* request, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  return dmg::AskForInputs(this, request, inputVector, outputVector);
}

//------------------------------------------------------------------------------
int vtkFieldSingularities::RequestData(
  vtkInformation* request, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  return dmg::DrawField(this, request, inputVector, outputVector, this->NumberOfDirections,
    { { "Sphere Radius", this->SphereRadius, 0, 0.1 } },
    [this, inputVector, outputVector](const dmg::SurfaceWithField& given, const dmg::ExecutionContext& context)
    {
      const dmg::FieldTopology topology = given.Connection
        ? dmg::TopologyOfVertexField(given.Surface.Mesh, *given.Connection, given.AtVertices, given.Field.N(), context)
        : dmg::TopologyOfField(given.Surface.Mesh, given.Faces, given.Field.First(), given.Field.N(), context);
      dmg::SingularitiesToPolyData(given, topology, vtkPolyData::GetData(outputVector, 0));
      dmg::SpheresToPolyData(vtkPolyData::GetData(outputVector, 0),
        this->SphereRadius * vtkDataSet::GetData(inputVector[0])->GetLength(), vtkPolyData::GetData(outputVector, 3));
      dmg::CutsToPolyData(given, topology, vtkPolyData::GetData(outputVector, 1));
      dmg::BoundaryLoopsToPolyData(given, topology, vtkPolyData::GetData(outputVector, 2));
    });
}

//------------------------------------------------------------------------------
void vtkFieldSingularities::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "NumberOfDirections: " << this->NumberOfDirections << "\n";
  os << indent << "SphereRadius: " << this->SphereRadius << "\n";
}
