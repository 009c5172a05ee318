#include "Adapters/Input/FlowFromArrays.h"

#include "Adapters/Pipeline/FilterOutputs.h"
#include "Support/ShortText.h"

#include <utility>

namespace dmg
{
namespace
{

/// From this part along the normal over the tangential one on, a warning tells of the boundary.
constexpr double LargestRatioAtRim = 0.5;

std::string WarningOfRim(double ratio)
{
  return ratio > LargestRatioAtRim ? "Parts along the normal are " + ShortText(ratio) +
      " times the tangential ones at a boundary that bends: divergence and vorticity are off there by half of them "
      "times the curvature. "
      "Take them out of the vectors first."
                                   : "";
}

/// \param vectors the given ones. \param tangential those that are decomposed.
FaceFlow FlowOf(const FramedMesh& surface, const Points& vectors, const Points& tangential)
{
  const int faces = surface.Mesh.NumberOfFaces();
  FaceFlow flow{ Vector<Complex>(faces), Vector<double>(faces), {} };
  for (int face = 0; face < faces; ++face)
  {
    flow.Tangential[face] = surface.Faces.ToComplex(face, tangential.row(face).transpose());
    flow.Normal[face] = surface.Faces.Normal(face).dot(vectors.row(face).transpose());
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
  VectorsOnSurface vectors = view.Vectors(arrays);
  const Points onFaces = vectors.OnFaces(view.Mesh());
  const double ratioAtRim = vectors.TakeOutNormalParts(view.Mesh(), surface.Relation);
  FaceFlow flow = FlowOf(surface.Geometry, onFaces, vectors.OnFaces(view.Mesh()));
  flow.Warning = WarningOfRim(ratioAtRim);
  flow.Derivatives = [surface, vectors](const ExecutionContext& loops)
  {
    return vectors.AreAtVertices
      ? DerivativesOfVertexVectors(surface.Geometry, surface.Relation, vectors.Values, loops)
      : DerivativesOfCellVectors(surface.Geometry, surface.Relation, vectors.Values, vectors.Places, loops);
  };
  context.Checkpoint(1.0);
  return flow;
}

}
