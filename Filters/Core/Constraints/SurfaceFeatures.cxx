#include "Constraints/SurfaceFeatures.h"

#include "Support/Errors.h"
#include "Support/Remedy.h"
#include "Support/ShortText.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace dmg
{

namespace
{

Vector3 Along(const TriangleMesh& mesh, int halfedge)
{
  return mesh.Position(mesh.Head(halfedge)) - mesh.Position(mesh.Tail(halfedge));
}

/// The confidence below which rounding of coordinates makes the directions, as on a sphere: curvatures differ by less than 1 %.
constexpr double LeastConfidence = 1e-4;

void CheckFeatureWeight(const std::string& name, double weight)
{
  const bool isOn = weight >= SmallestFeatureWeight && weight <= LargestFeatureWeight;
  if (!isOn && weight != 0.0)
  {
    throw InvalidInput(name + " is " + ShortText(weight) + "; make it 0, for off, or from " +
      ShortText(SmallestFeatureWeight) + " to " + ShortText(LargestFeatureWeight) + ", and turn the field by " +
      TextOf(Remedy::Rotation) + " if it is to go another way");
  }
}

}

void CheckFeatures(const FeatureOptions& options)
{
  CheckFeatureWeight(TextOf(Remedy::BoundaryWeight), options.BoundaryWeight);
  CheckFeatureWeight(TextOf(Remedy::SharpEdgesWeight), options.SharpEdgesWeight);
  CheckFeatureWeight(TextOf(Remedy::CurvatureWeight), options.CurvatureWeight);
}

std::vector<Constraint> AlongBoundary(const TriangleMesh& mesh, const WeightsOfFaces& weights, double weight)
{
  std::vector<Constraint> directions;
  for (int h = 0; h < 3 * mesh.NumberOfFaces(); ++h)
  {
    const Vector3 along = Along(mesh, h);
    const double length = along.norm();
    const int face = TriangleMesh::FaceOf(h);
    if (mesh.Twin(h) < 0 && length > 0.0 && !weights.IsFlat(face))
    {
      directions.push_back({ face, along / length, weight * weights.OfLine(face, length), h % 3 });
    }
  }
  return directions;
}

std::vector<Constraint> AlongSharpEdges(
  const FramedMesh& surface, const WeightsOfFaces& weights, double degrees, double weight)
{
  const TriangleMesh& mesh = surface.Mesh;
  std::vector<Constraint> directions;
  for (int h = 0; h < 3 * mesh.NumberOfFaces(); ++h)
  {
    if (mesh.Twin(h) < 0)
    {
      continue;
    }
    const int face = TriangleMesh::FaceOf(h), other = TriangleMesh::FaceOf(mesh.Twin(h));
    const Vector3 along = Along(mesh, h);
    const double length = along.norm();
    if (!(length > 0.0) || weights.IsFlat(face) || weights.IsFlat(other))
    {
      continue;
    }
    const Vector3 normal = surface.Faces.Normal(face), beyond = surface.Faces.Normal(other);
    const double angle = std::atan2(normal.cross(beyond).norm(), normal.dot(beyond));
    if (angle * 180.0 / Pi > degrees)
    {
      directions.push_back({ face, along / length, weight * weights.OfLine(face, length), h % 3 });
    }
  }
  return directions;
}

std::vector<Constraint> AlongCurvature(const FramedMesh& surface, const WeightsOfFaces& weights,
  const PrincipalCurvatures& ofFaces, bool followsMinimum, double weight)
{
  const Complex turn = followsMinimum ? Complex(0.0, 1.0) : Complex(1.0);
  std::vector<Constraint> directions;
  for (int face = 0; face < surface.Mesh.NumberOfFaces(); ++face)
  {
    if (ofFaces.Confidence[face] > 0.0)
    {
      directions.push_back({ face, surface.Faces.ToVector(face, turn * ofFaces.MaximumDirections[face]),
        weight * ofFaces.Confidence[face] * weights.OfFace() });
    }
  }
  return directions;
}

bool AreClear(const PrincipalCurvatures& curvatures)
{
  return (curvatures.Confidence.array() > LeastConfidence).any();
}

std::vector<Constraint> AlongFeature(SurfaceFeature feature, const FramedMesh& surface, const WeightsOfFaces& weights,
  const FeatureOptions& options, const PrincipalCurvatures* ofFaces)
{
  std::vector<Constraint> directions;
  double degrees = 0.0;
  switch (feature)
  {
    case SurfaceFeature::Boundary:
      directions = AlongBoundary(surface.Mesh, weights, options.BoundaryWeight);
      degrees = options.BoundaryRotation;
      break;
    case SurfaceFeature::SharpEdges:
      directions = AlongSharpEdges(surface, weights, options.FeatureAngle, options.SharpEdgesWeight);
      degrees = options.SharpEdgesRotation;
      break;
    case SurfaceFeature::PrincipalDirections:
      directions = AlongCurvature(surface, weights, *ofFaces, options.FollowsMinimum, options.CurvatureWeight);
      degrees = options.CurvatureRotation;
      break;
  }
  for (Constraint& along : directions)
  {
    along.Direction = Turned(along.Direction, surface.Faces, along.Element, degrees * Pi / 180.0);
  }
  return directions;
}

FollowedFeatures FollowFeatures(int N, const FeatureOptions& options,
  const std::function<bool(SurfaceFeature feature, std::vector<Constraint>& directions)>& find)
{
  CheckFeatures(options);
  FollowedFeatures followed;
  const auto follow = [&](SurfaceFeature feature, const std::string& ifNone)
  {
    if (find(feature, followed.Directions))
    {
      followed.Features.push_back(feature);
    }
    else if (options.WarnsOfMissing)
    {
      followed.Warnings.push_back(ifNone);
    }
  };
  if (options.BoundaryWeight > 0.0)
  {
    follow(
      SurfaceFeature::Boundary, "the surface has no boundary, so " + TextOf(Remedy::BoundaryWeight) + " has no effect");
  }
  if (N % 2 != 0)
  {
    const bool hasEdges = options.SharpEdgesWeight > 0.0, hasCurvature = options.CurvatureWeight > 0.0;
    if (options.WarnsOfMissing && (hasEdges || hasCurvature))
    {
      followed.Warnings.push_back("sharp edges and principal directions are lines without a sign, which a field of " +
        std::to_string(N) + (N == 1 ? " direction" : " directions") + " cannot follow, so " +
        (hasEdges ? TextOf(Remedy::SharpEdgesWeight) : "") + (hasEdges && hasCurvature ? " and " : "") +
        (hasCurvature ? TextOf(Remedy::CurvatureWeight) : "") + (hasEdges && hasCurvature ? " have" : " has") +
        " no effect; choose an even " + TextOf(Remedy::Directions));
    }
    return followed;
  }
  if (options.SharpEdgesWeight > 0.0)
  {
    follow(SurfaceFeature::SharpEdges,
      "no edge of the surface is sharper than " + TextOf(Remedy::FeatureAngle) + ", so " +
        TextOf(Remedy::SharpEdgesWeight) + " has no effect");
  }
  if (options.CurvatureWeight > 0.0)
  {
    follow(SurfaceFeature::PrincipalDirections,
      "the surface bends alike in all directions, so " + TextOf(Remedy::CurvatureWeight) + " has no effect");
  }
  return followed;
}

FollowedFeatures FollowFeatures(
  const FramedMesh& surface, int N, const FeatureOptions& options, const PrincipalCurvatures* ofFaces)
{
  std::optional<WeightsOfFaces> weights;
  return FollowFeatures(N, options,
    [&](SurfaceFeature feature, std::vector<Constraint>& directions)
    {
      if (feature == SurfaceFeature::PrincipalDirections && !AreClear(*ofFaces))
      {
        return false;
      }
      if (!weights)
      {
        weights.emplace(surface.Mesh, SizesOf(surface.Mesh));
      }
      const std::vector<Constraint> along = AlongFeature(feature, surface, *weights, options, ofFaces);
      directions.insert(directions.end(), along.begin(), along.end());
      return !along.empty();
    });
}

}
