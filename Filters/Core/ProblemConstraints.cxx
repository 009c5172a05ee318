#include "ProblemConstraints.h"

#include "Mesh/NormalParts.h"
#include "Support/Errors.h"
#include "Support/Remedy.h"
#include "Support/ShortText.h"

#include <cmath>

namespace dmg
{
namespace
{

template <class Item>
void Append(std::vector<Item>& all, const std::vector<Item>& more)
{
  all.insert(all.end(), more.begin(), more.end());
}

/// \throw InvalidInput guides are given, and nothing is prescribed.
[[noreturn]] void RefuseNothing(const GuidesReport& guides)
{
  if (!guides.IsAllTaken())
  {
    throw InvalidInput("no direction is prescribed; " + guides.LeftOut());
  }
  throw InvalidInput("no direction is prescribed: the lines of the guides have no length or their vectors are zero, or "
                     "their mask or weights are; choose others, or clear " +
    TextOf(Remedy::Guides) + " for the smoothest field");
}

/// \throw InvalidInput the length is negative or not finite.
void CheckSmoothingLength(double relative)
{
  if (!(relative > 0.0) || !std::isfinite(relative))
  {
    throw InvalidInput(
      TextOf(Remedy::SmoothingLength) + " is " + ShortText(relative) + "; make it positive, or 0 for none");
  }
}

/// \param weights of an integral over the surface.
void WeighByLength(double length, const Discretisation::IntegralWeights& weights, Constraints& constraints)
{
  const auto scale = [length](auto& all, double factor)
  {
    for (auto& constraint : all)
    {
      constraint.Weight *= factor / (length * length);
    }
  };
  scale(constraints.OnFaces, weights.OnFaces);
  scale(constraints.AtVertices, weights.AtVertices);
  scale(constraints.Values, weights.AtVertices);
}

std::string WarningOfCancelling(const CancellingFaces& faces)
{
  const long long others = faces.Number - 1;
  return "the directions prescribed on " + faces.First +
    (others == 0 ? "" : " and " + std::to_string(others) + (others == 1 ? " other" : " others")) +
    " cancel, as opposite vectors do for a field of one direction, so nothing is followed there; take one of them out, "
    "or choose a " +
    TextOf(Remedy::Directions) + " to which they are alike";
}

}

FollowedConstraints ProblemConstraints::Follow(const FieldProblem& problem, const Discretisation& discretisation,
  const ExecutionContext& context, const ElementNames& names)
{
  FollowedConstraints followed{ problem.Constraints, {}, {}, {} };
  if (problem.SmoothingLength != 0.0)
  {
    CheckSmoothingLength(problem.SmoothingLength);
    WeighByLength(problem.SmoothingLength * this->Sizes().Diagonal(), this->WeightsOfIntegral(discretisation),
      followed.Constraints);
  }
  this->AddGuides(problem, followed, context);
  if (!problem.Options.Field.HasDirections())
  {
    return followed;
  }
  this->TakeOutNormalParts(followed.Constraints.AtVertices);
  const int N = discretisation.DirectionsPerPoint();
  const std::size_t warnings = followed.Warnings.size();
  this->AddFeatures(problem, N, followed, context);
  const bool isNothingSaid = followed.Warnings.size() == warnings; // else it is said why nothing is followed
  this->Rotate(problem, isNothingSaid, followed, names);
  const CancellingFaces cancelling = this->TakeOutCancelling(followed.Constraints.OnFaces, N, names);
  if (cancelling.Number > 0)
  {
    followed.Warnings.push_back(WarningOfCancelling(cancelling));
  }
  return followed;
}

void ProblemConstraints::AddGuides(
  const FieldProblem& problem, FollowedConstraints& followed, const ExecutionContext& context)
{
  if (problem.Guides.AreEmpty())
  {
    return;
  }
  const FollowedGuides guides = this->DirectionsOfGuides(problem.Guides, context);
  Append(followed.Constraints.OnFaces, guides.Directions);
  const bool mayFollowNothing = problem.Guides.MayMiss && !guides.Report.IsAllTaken();
  if (!this->IsAnywhere(!followed.Constraints.AreEmpty()) && !mayFollowNothing)
  {
    RefuseNothing(guides.Report);
  }
  if (!guides.Report.IsAllTaken())
  {
    followed.Warnings.push_back(guides.Report.LeftOut());
  }
  followed.Guides = guides.Report;
}

void ProblemConstraints::AddFeatures(
  const FieldProblem& problem, int N, FollowedConstraints& followed, const ExecutionContext& context)
{
  CheckFeatures(problem.Features);
  const bool followsCurvature = problem.Features.CurvatureWeight > 0.0 && N % 2 == 0;
  if (followsCurvature && problem.Options.Constraints == ConstraintKind::Hard && !problem.Singularities)
  {
    throw InvalidInput("principal directions are followed on all triangles, which hard constraints would leave no "
                       "freedom; " +
      TextOf(Remedy::SoftConstraints) + ", or " + TextOf(Remedy::CurvatureWeight) + " to 0");
  }
  const FollowedFeatures features = this->DirectionsOfFeatures(problem.Features, N, context);
  Append(followed.Constraints.OnFaces, features.Directions);
  followed.Features = features.Features;
  Append(followed.Warnings, features.Warnings);
}

void ProblemConstraints::Rotate(
  const FieldProblem& problem, bool isNothingSaid, FollowedConstraints& followed, const ElementNames& names)
{
  if (!this->IsAnywhere(!problem.Rotation.AreZero()))
  {
    return;
  }
  const Constraints& constraints = followed.Constraints;
  const bool isAny = this->IsAnywhere(!constraints.OnFaces.empty() || !constraints.AtVertices.empty());
  if (isNothingSaid && !isAny)
  {
    followed.Warnings.push_back(TextOf(Remedy::RotationOfNothing));
    return;
  }
  this->Turn(followed.Constraints, problem.Rotation, names);
}

const NearestPlaces& ConstraintsOnMesh::Places()
{
  if (!this->PlacesOfSurface)
  {
    this->PlacesOfSurface = std::make_unique<NearestPlaces>(this->Surface);
  }
  return *this->PlacesOfSurface;
}

SurfaceSizes ConstraintsOnMesh::Sizes()
{
  return SizesOf(this->Surface.Mesh);
}

FollowedGuides ConstraintsOnMesh::DirectionsOfGuides(const Guides& guides, const ExecutionContext& context)
{
  FollowedGuides followed = FollowGuides(guides, this->Places(), context);
  dmg::TakeOutNormalParts(followed, this->Surface.Mesh);
  return followed;
}

FollowedFeatures ConstraintsOnMesh::DirectionsOfFeatures(
  const FeatureOptions& options, int N, const ExecutionContext& context)
{
  const bool followsCurvature = options.CurvatureWeight > 0.0 && N % 2 == 0;
  return FollowFeatures(
    this->Surface, N, options, followsCurvature ? &this->Curvatures(options.CurvatureScale, context) : nullptr);
}

void ConstraintsOnMesh::TakeOutNormalParts(std::vector<Constraint>& atVertices)
{
  const TriangleMesh& mesh = this->Surface.Mesh;
  for (Constraint& at : atVertices)
  {
    if (at.Element >= 0 && at.Element < mesh.NumberOfVertices())
    {
      at.Direction = WithoutNormalPart(mesh, at.Element, at.Direction);
    }
  }
}

void ConstraintsOnMesh::Turn(Constraints& constraints, const RotationAngles& angles, const ElementNames& names)
{
  dmg::Turn(constraints, this->Surface, angles, names);
}

CancellingFaces ConstraintsOnMesh::TakeOutCancelling(std::vector<Constraint>& onFaces, int N, const ElementNames& names)
{
  const std::vector<int> faces = LeaveOutCancelling(onFaces, this->Surface.Faces, N);
  return { static_cast<long long>(faces.size()), faces.empty() ? "" : names.Face(faces[0]) };
}

const PrincipalCurvatures& ConstraintsOnMesh::Curvatures(double scale, const ExecutionContext& context)
{
  if (!this->CurvaturesAtScale || this->CurvaturesAtScale->first != scale)
  {
    this->CurvaturesAtScale.emplace(scale, FindPrincipalDirections(this->Surface, scale, context).Faces);
  }
  return this->CurvaturesAtScale->second;
}

}
