#include "vtkFieldSingularities.h"

#include "Adapters/Input/FieldFromArrays.h"
#include "Adapters/Output/DrawingToPolyData.h"
#include "Adapters/Pipeline/PropertyTable.h"
#include "Directions/FieldTopology.h"
#include "Directions/UnresolvedSingularities.h"
#include "Support/ShortText.h"

#include "vtkDataSet.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkPolyData.h"

vtkStandardNewMacro(vtkFieldSingularities);

namespace
{

void WarnOfUnresolved(vtkAlgorithm* algorithm, const dmg::SurfaceWithField& given, const dmg::FieldTopology& topology)
{
  const dmg::TriangleMesh& mesh = given.View.Mesh();
  const std::vector<int> vertices =
    dmg::UnresolvedSingularities(mesh, topology.Indices, given.Field.N(), !given.IsAtPoints);
  if (!vertices.empty())
  {
    vtkWarningWithObjectMacro(
      algorithm, << "A singularity at " << given.View.Relation().Names().Vertex(vertices.front())
                 << (vertices.size() > 1 ? " and others look" : " looks")
                 << " like several of smaller indices and both signs, as the field turns by more than "
                 << dmg::ShortText(180.0 / given.Field.N())
                 << " degrees across edges; refine the surface there, or choose fewer directions.");
  }
}

dmg::FieldTopology TopologyOf(const dmg::SurfaceWithField& given, const dmg::ExecutionContext& context)
{
  const dmg::TriangleMesh& mesh = given.View.Mesh();
  if (!given.IsAtPoints)
  {
    return dmg::TopologyOfField(
      mesh, given.View.Surface().Geometry.Faces, given.Field.First(), given.Field.N(), context);
  }
  const dmg::FieldAtVertices at = dmg::ReadFieldAtPoints(given, context);
  return dmg::TopologyOfVertexField(mesh, at.Connection, at.First, given.Field.N(), context);
}

}

//------------------------------------------------------------------------------
vtkFieldSingularities::vtkFieldSingularities()
{
  this->SetNumberOfOutputPorts(4);
}

//------------------------------------------------------------------------------
dmg::PropertyTable vtkFieldSingularities::Properties() const
{
  dmg::PropertyTable table;
  table.Number("SphereRadius", this->SphereRadius, 0, 0.1);
  return table;
}

//------------------------------------------------------------------------------
int vtkFieldSingularities::RequestData(
  vtkInformation* request, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  return dmg::DrawField(
    this, request, inputVector, outputVector, this->NumberOfDirections, [this] { return this->Properties(); },
    [this, outputVector](const dmg::SurfaceWithField& given, const dmg::ExecutionContext& context)
    {
      const dmg::FieldTopology topology = TopologyOf(given, context);
      WarnOfUnresolved(this, given, topology);
      dmg::SingularitiesToPolyData(given, topology, vtkPolyData::GetData(outputVector, 0));
      dmg::SpheresToPolyData(vtkPolyData::GetData(outputVector, 0),
        this->SphereRadius * given.View.Given()->GetLength(), vtkPolyData::GetData(outputVector, 3));
      dmg::CutsToPolyData(given, topology, vtkPolyData::GetData(outputVector, 1));
      dmg::BoundaryLoopsToPolyData(given, topology, vtkPolyData::GetData(outputVector, 2));
    },
    dmg::GapsInField::AreHoles);
}

//------------------------------------------------------------------------------
void vtkFieldSingularities::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  this->Properties().Print(os, indent);
}
