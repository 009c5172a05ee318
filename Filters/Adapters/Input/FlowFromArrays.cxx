#include "Adapters/Input/FlowFromArrays.h"

#include "Adapters/Input/ChosenArrays.h"
#include "Support/Errors.h"

#include "vtkDataArray.h"
#include "vtkDataSet.h"

#include <algorithm>
#include <functional>
#include <limits>
#include <string>

namespace dmg
{
namespace
{

/// Zero on the axis, where there is no east.
Vector3 FromComponents(const Vector3& place, const Vector3& axis, double eastward, double northward)
{
  const Vector3 east = axis.cross(place);
  const double length = east.norm();
  if (!(length > 0.0) || !(place.norm() > 0.0))
  {
    return Vector3::Zero();
  }
  return eastward * east / length + northward * place.normalized().cross(east / length);
}

/// \param vectorAt the vector of a tuple at a place.
Points OnFaces(
  const FramedSurface& surface, bool onPoints, const std::function<Vector3(vtkIdType, const Vector3&)>& vectorAt)
{
  const TriangleMesh& mesh = surface.On.Mesh;
  Points vectors(mesh.NumberOfFaces(), 3);
  vtkIdType wrong = std::numeric_limits<vtkIdType>::max(); // the first cell of the caller's
  for (int face = 0; face < mesh.NumberOfFaces(); ++face)
  {
    Vector3 sum = Vector3::Zero();
    Vector3 centre = Vector3::Zero();
    for (int corner = 0; corner < 3; ++corner)
    {
      const int vertex = mesh.FaceCorners()(face, corner);
      centre += mesh.Position(vertex) / 3.0;
      sum +=
        onPoints ? Vector3(vectorAt(surface.Relation.PointOf(vertex), mesh.Position(vertex)) / 3.0) : Vector3::Zero();
    }
    vectors.row(face) = (onPoints ? sum : vectorAt(surface.Relation.CellOf(face), centre)).transpose();
    if (!vectors.row(face).allFinite())
    {
      wrong = std::min(wrong, static_cast<vtkIdType>(surface.Relation.CellOf(face)));
    }
  }
  if (wrong < std::numeric_limits<vtkIdType>::max())
  {
    throw InvalidInput("the flow is not finite on cell " + std::to_string(wrong) +
      (onPoints ? " or at its points" : "") + "; repair it, or take cells without a flow away with Threshold first");
  }
  return vectors;
}

}

Points FlowVectors(vtkAlgorithm* algorithm, vtkDataSet* input, const FramedSurface& surface, const Vector3& axis)
{
  const std::string whose = "the surface";
  if (const ChosenArray eastward = FindArray(ChoiceOf(algorithm, 1), input, 1, "eastward component", whose);
      eastward.Array)
  {
    const ChosenArray northward = FindArray(ChoiceOf(algorithm, 2), input, 1, "northward component", whose);
    if (!northward.Array || northward.OnPoints != eastward.OnPoints)
    {
      throw InvalidInput(
        "the eastward component is chosen, and no northward component of the same points or cells; choose both");
    }
    if (axis.isZero(0.0))
    {
      throw InvalidInput("Axis is (0, 0, 0), which has no direction; give it another value");
    }
    return OnFaces(surface, eastward.OnPoints,
      [&](vtkIdType tuple, const Vector3& place)
      {
        return FromComponents(
          place, axis, eastward.Array->GetComponent(tuple, 0), northward.Array->GetComponent(tuple, 0));
      });
  }
  const ChosenArray vectors = FindArray(ChoiceOf(algorithm, 0), input, 3, "flow", whose);
  if (!vectors.Array)
  {
    throw InvalidInput(
      "there is no flow to decompose: no array of vectors is chosen, and none is active; choose one, or eastward and "
      "northward components");
  }
  return OnFaces(surface, vectors.OnPoints,
    [&](vtkIdType tuple, const Vector3&)
    {
      Vector3 vector;
      vectors.Array->GetTuple(tuple, vector.data());
      return vector;
    });
}

}
