#include "Adapters/Input/FlowFromArrays.h"

#include "Adapters/Input/EastAndNorth.h"
#include "Adapters/Pipeline/FilterRequests.h"
#include "Support/Errors.h"

#include "vtkDataArray.h"
#include "vtkDataSet.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>

namespace dmg
{
namespace
{

/// The vector of a tuple at a place.
using VectorOfTuple = std::function<Vector3(vtkIdType, const Vector3&)>;

/// The vector of a face: of its cell, or the mean over its corners.
Vector3 VectorOnFace(const FramedSurface& surface, int face, bool onPoints, const VectorOfTuple& vectorAt)
{
  const TriangleMesh& mesh = surface.Geometry.Mesh;
  Vector3 sum = Vector3::Zero();
  Vector3 centre = Vector3::Zero();
  for (int corner = 0; corner < 3; ++corner)
  {
    const int vertex = mesh.FaceCorners()(face, corner);
    const Vector3 place = mesh.Position(vertex);
    centre += place / 3.0;
    if (onPoints)
    {
      sum += vectorAt(surface.Relation.PointOf(vertex), place) / 3.0;
    }
  }
  return onPoints ? sum : vectorAt(surface.Relation.CellOf(face), centre);
}

/// \throw InvalidInput a vector is not finite.
void CheckIsFinite(const FaceFlow& flow, const SurfaceRelation& relation, bool onPoints)
{
  int wrong = -1; // the first cell of the caller's
  for (int face = 0; face < flow.Normal.size(); ++face)
  {
    const Complex tangential = flow.Tangential[face];
    if (!std::isfinite(tangential.real()) || !std::isfinite(tangential.imag()) || !std::isfinite(flow.Normal[face]))
    {
      wrong = wrong < 0 ? relation.CellOf(face) : std::min(wrong, relation.CellOf(face));
    }
  }
  if (wrong >= 0)
  {
    throw InvalidInput("the flow is not finite on cell " + std::to_string(wrong) +
      (onPoints ? " or at its points" : "") + "; repair it, or take cells without a flow away with Threshold first");
  }
}

FaceFlow OnFaces(
  const FramedSurface& surface, bool onPoints, const VectorOfTuple& vectorAt, const ExecutionContext& context)
{
  constexpr int Grain = 4096;
  const int faces = surface.Geometry.Mesh.NumberOfFaces();
  FaceFlow flow{ Vector<Complex>(faces), Vector<double>(faces) };
  context.ParallelFor(0, faces, Grain,
    [&](int first, int last)
    {
      for (int face = first; face < last; ++face)
      {
        const Vector3 vector = VectorOnFace(surface, face, onPoints, vectorAt);
        flow.Tangential[face] = surface.Geometry.Faces.ToComplex(face, vector);
        flow.Normal[face] = surface.Geometry.Faces.Normal(face).dot(vector);
      }
    });
  CheckIsFinite(flow, surface.Relation, onPoints);
  return flow;
}

}

FaceFlow FlowFromArrays(vtkAlgorithm* algorithm, vtkDataSet* input, const FramedSurface& surface, const Vector3& axis,
  const ExecutionContext& context)
{
  const std::string whose = "the surface";
  const EastAndNorth components = FindEastAndNorth(ChoiceOf(algorithm, 1), ChoiceOf(algorithm, 2), axis, input, whose);
  if (components.Eastward.Array)
  {
    return OnFaces(
      surface, components.Eastward.OnPoints(),
      [&](vtkIdType tuple, const Vector3& place) { return components.At(tuple, place); }, context);
  }
  const ChosenArray vectors = FindVectors(ChoiceOf(algorithm, 0), input, "flow", whose);
  if (!vectors.Array)
  {
    throw WrongChoice(
      "there is no flow to decompose: no array of vectors is chosen, and none is active; choose one, or eastward and "
      "northward components, or connect Edges");
  }
  if (const std::string problem = ProblemOfPlaneVectors(vectors.Array, surface.Geometry.Mesh.VertexPositions());
      !problem.empty())
  {
    throw WrongChoice(problem);
  }
  return OnFaces(
    surface, vectors.OnPoints(),
    [&](vtkIdType tuple, const Vector3&)
    {
      Vector3 vector = Vector3::Zero();
      vectors.Array->GetTuple(tuple, vector.data());
      return vector;
    },
    context);
}

}
