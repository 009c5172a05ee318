#include "Adapters/Output/FeaturesOfSurface.h"

#include "Adapters/Input/ChosenArrays.h"
#include "Constraints/SurfaceFeatures.h"
#include "Support/Errors.h"

#include "vtkDataArray.h"
#include "vtkHarmonicFieldSolver.h"
#include "vtkPolyData.h"

namespace dmg
{

namespace
{

constexpr double Degree = Pi / 180.0;

FeatureOptions FeaturesOf(vtkHarmonicFieldSolver* filter)
{
  FeatureOptions options;
  options.BoundaryWeight = filter->GetBoundaryWeight();
  options.BoundaryRotation = filter->GetBoundaryRotation();
  options.SharpEdgesWeight = filter->GetSharpEdgesWeight();
  options.SharpEdgesRotation = filter->GetSharpEdgesRotation();
  options.FeatureAngle = filter->GetFeatureAngle();
  options.CurvatureWeight = filter->GetCurvatureWeight();
  options.CurvatureRotation = filter->GetCurvatureRotation();
  options.FollowsMinimum = filter->GetCurvatureDirection() == vtkHarmonicFieldSolver::MinimumCurvature;
  return options;
}

/// Elements of the other kind get the mean of those that they touch.
RotationAngles AnglesOf(vtkHarmonicFieldSolver* filter, vtkPolyData* input, const FramedSurface& surface)
{
  RotationAngles angles;
  angles.Everywhere = filter->GetRotation() * Degree;
  const ChosenArray chosen = FindArray(ChoicesOf(filter).Rotation, input, 1, "rotation", "the surface");
  if (!chosen.Array)
  {
    return angles;
  }
  const TriangleMesh& mesh = surface.On.Mesh;
  angles.Faces.setZero(mesh.NumberOfFaces());
  angles.Vertices.setZero(mesh.NumberOfVertices());
  for (int vertex = 0; vertex < mesh.NumberOfVertices(); ++vertex)
  {
    if (chosen.OnPoints)
    {
      angles.Vertices[vertex] = Degree * chosen.Array->GetComponent(surface.Numbering.PointOf(vertex), 0);
      mesh.VisitFan(
        vertex, [&](int halfedge) { angles.Faces[TriangleMesh::FaceOf(halfedge)] += angles.Vertices[vertex] / 3.0; });
      continue;
    }
    int faces = 0;
    mesh.VisitFan(vertex,
      [&](int halfedge)
      {
        const vtkIdType cell = surface.Numbering.CellOf(TriangleMesh::FaceOf(halfedge));
        angles.Vertices[vertex] += Degree * chosen.Array->GetComponent(cell, 0);
        ++faces;
      });
    angles.Vertices[vertex] /= faces;
  }
  for (int face = 0; !chosen.OnPoints && face < mesh.NumberOfFaces(); ++face)
  {
    angles.Faces[face] = Degree * chosen.Array->GetComponent(surface.Numbering.CellOf(face), 0);
  }
  return angles;
}

}

std::vector<std::string> FollowFeatures(vtkHarmonicFieldSolver* filter, vtkPolyData* input, SolvedSurface& surface,
  Constraints& directions, const ExecutionContext& context)
{
  const FramedSurface framed = surface.Surface();
  if (filter->GetDiscretisation() == vtkHarmonicFieldSolver::ScalarFunction)
  {
    return {};
  }
  const int kind = filter->GetDiscretisation();
  const bool isPower = kind == vtkHarmonicFieldSolver::PowerField || kind == vtkHarmonicFieldSolver::PointPowerField;
  const int N = isPower ? filter->GetNumberOfDirections() : 1;
  const FeatureOptions options = FeaturesOf(filter);
  CheckFeatures(options);
  const PrincipalCurvatures* curvatures = nullptr;
  if (options.CurvatureWeight > 0.0 && N % 2 == 0)
  {
    const bool hasSingularities = filter->GetNumberOfInputConnections(2) > 0; // then ConstraintType has no effect
    if (filter->GetConstraintType() == vtkHarmonicFieldSolver::Hard && !hasSingularities)
    {
      throw InvalidInput("principal directions are followed on all triangles, which hard constraints would leave no "
                         "freedom; set Constraint Type to Soft, or Curvature Weight to 0");
    }
    curvatures = &surface.Curvatures(filter->GetCurvatureScale(), context);
  }
  FollowedFeatures followed = FollowFeatures(framed.On, N, options, curvatures);
  directions.OnFaces.insert(directions.OnFaces.end(), followed.Directions.begin(), followed.Directions.end());
  const RotationAngles angles = AnglesOf(filter, input, framed);
  const bool turns = angles.Everywhere != 0.0 || angles.Faces.size() > 0;
  const bool isNothingSaid = followed.Warnings.empty(); // else they tell why nothing is followed
  if (turns && isNothingSaid && directions.OnFaces.empty() && directions.AtVertices.empty())
  {
    followed.Warnings.push_back("nothing is followed that the field could be turned against, so Rotation and Rotation "
                                "Array have no effect; add what it shall follow, or set them to 0 and None");
  }
  else if (turns)
  {
    Turn(directions, framed.On, angles, framed.Numbering.Names());
  }
  const std::vector<int> cancelling = LeaveOutCancelling(directions.OnFaces, framed.On.Faces, N);
  if (!cancelling.empty())
  {
    const std::size_t others = cancelling.size() - 1;
    followed.Warnings.push_back("the directions prescribed on " + framed.Numbering.Names().Face(cancelling[0]) +
      (others == 0 ? "" : " and " + std::to_string(others) + (others == 1 ? " other" : " others")) +
      " cancel, as opposite vectors do for a field of one direction, so nothing is followed there; take one of them "
      "out, or "
      "choose a Number Of Directions to which they are alike");
  }
  return std::move(followed.Warnings);
}

}
