#include "Adapters/Input/FlowFromArrays.h"

#include "Adapters/Pipeline/FilterOutputs.h"

#include <utility>

namespace dmg
{
namespace
{

FaceFlow OnFaces(const FramedMesh& surface, const Points& vectors)
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

/// The means over the corners of the faces.
Points MeansOfCorners(const TriangleMesh& mesh, const Points& ofVertices)
{
  Points means(mesh.NumberOfFaces(), 3);
  for (int face = 0; face < means.rows(); ++face)
  {
    const auto corners = mesh.FaceCorners().row(face);
    means.row(face) = (ofVertices.row(corners[0]) + ofVertices.row(corners[1]) + ofVertices.row(corners[2])) / 3.0;
  }
  return means;
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
  FaceFlow flow =
    OnFaces(surface.Geometry, vectors.AreAtVertices ? MeansOfCorners(view.Mesh(), vectors.Values) : vectors.Values);
  flow.Derivatives = [surface, vectors](const ExecutionContext& loops)
  {
    const auto derivatives = vectors.AreAtVertices ? DerivativesOfVertexVectors : DerivativesOfCellVectors;
    return derivatives(surface.Geometry, surface.Relation, vectors.Values, loops);
  };
  context.Checkpoint(1.0);
  return flow;
}

}
