#include "Adapters/Input/FlowFromArrays.h"

#include "Adapters/Pipeline/FilterOutputs.h"

#include <utility>

namespace dmg
{
namespace
{

FaceFlow FlowOf(const FramedMesh& surface, const Points& vectors)
{
  const int faces = surface.Mesh.NumberOfFaces();
  FaceFlow flow{ Vector<Complex>(faces), Vector<double>(faces), {} };
  for (int face = 0; face < faces; ++face)
  {
    const Vector3 vector = vectors.row(face).transpose();
    flow.Tangential[face] = surface.Faces.ToComplex(face, vector);
    flow.Normal[face] = surface.Faces.Normal(face).dot(vector);
  }
  return flow;
}

}

VectorArrays ArraysOfFlow(vtkAlgorithm* algorithm, vtkDataSet* dataset, const Vector3& axis)
{
  VectorArrays flow(
    { ChoiceOf(algorithm, 0), ChoiceOf(algorithm, 1), ChoiceOf(algorithm, 2), axis }, dataset, "flow", "the surface");
  if (flow.AreNone())
  {
    throw WrongChoice(
      "there is no flow to decompose: no array of vectors is chosen, and none is active; choose one, or eastward and "
      "northward components, or connect Edges");
  }
  return flow;
}

FaceFlow FlowFromArrays(const SurfaceView& view, const VectorArrays& arrays, const ExecutionContext& context)
{
  const FramedSurface surface = view.Surface();
  const VectorsOnSurface vectors = view.Vectors(arrays);
  FaceFlow flow = FlowOf(surface.Geometry, vectors.OnFaces(view.Mesh()));
  flow.Derivatives = [surface, vectors](const ExecutionContext& loops)
  {
    const auto derivatives = vectors.AreAtVertices ? DerivativesOfVertexVectors : DerivativesOfCellVectors;
    return derivatives(surface.Geometry, surface.Relation, vectors.Values, loops);
  };
  context.Checkpoint(1.0);
  return flow;
}

}
