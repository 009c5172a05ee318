#include "ProblemConstraints.h"

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

/// \param mayMiss whether guides may be left out.
/// \throw InvalidInput guides are given, and nothing is prescribed.
void CheckFollowsSomething(const Constraints& constraints, const GuidesReport& guides, bool mayMiss)
{
  if (mayMiss && !guides.IsAllTaken())
  {
    return;
  }
  if (constraints.AreEmpty() && !guides.IsAllTaken())
  {
    throw InvalidInput("no direction is prescribed; " + guides.LeftOut());
  }
  if (constraints.AreEmpty())
  {
    throw InvalidInput(
      "no direction is prescribed: the lines of the guides have no length or their vectors are zero, or "
      "their mask or weights are; choose others, or clear " +
      TextOf(Remedy::Guides) + " for the smoothest field");
  }
}

/// \throw InvalidInput the length is negative or not finite.
void WeighBySmoothingLength(
  double relative, const TriangleMesh& mesh, const Discretisation& discretisation, Constraints& constraints)
{
  if (!(relative > 0.0) || !std::isfinite(relative))
  {
    throw InvalidInput(
      TextOf(Remedy::SmoothingLength) + " is " + ShortText(relative) + "; make it positive, or 0 for none");
  }
  const Points& positions = mesh.VertexPositions();
  const double length = relative * (positions.colwise().maxCoeff() - positions.colwise().minCoeff()).norm();
  const auto [onFaces, atVertices] = discretisation.WeightsOfIntegral();
  const auto scale = [length](auto& all, double factor)
  {
    for (auto& constraint : all)
    {
      constraint.Weight *= factor / (length * length);
    }
  };
  scale(constraints.OnFaces, onFaces);
  scale(constraints.AtVertices, atVertices);
  scale(constraints.Values, atVertices);
}

std::string WarningOfCancelling(const std::vector<int>& faces, const ElementNames& names)
{
  const std::size_t others = faces.size() - 1;
  return "the directions prescribed on " + names.Face(faces[0]) +
    (others == 0 ? "" : " and " + std::to_string(others) + (others == 1 ? " other" : " others")) +
    " cancel, as opposite vectors do for a field of one direction, so nothing is followed there; take one of them out, "
    "or choose a " +
    TextOf(Remedy::Directions) + " to which they are alike";
}

}

const NearestPlaces& ProblemConstraints::Places()
{
  if (!this->PlacesOfSurface)
  {
    this->PlacesOfSurface = std::make_unique<NearestPlaces>(this->Surface);
  }
  return *this->PlacesOfSurface;
}

const PrincipalCurvatures& ProblemConstraints::Curvatures(double scale, const ExecutionContext& context)
{
  if (!this->CurvaturesAtScale || this->CurvaturesAtScale->first != scale)
  {
    this->CurvaturesAtScale.emplace(scale, FindPrincipalDirections(this->Surface, scale, context).Faces);
  }
  return this->CurvaturesAtScale->second;
}

FollowedConstraints ProblemConstraints::Follow(const FieldProblem& problem, const Discretisation& discretisation,
  const ExecutionContext& context, const ElementNames& names)
{
  FollowedConstraints followed{ problem.Constraints, {}, {} };
  if (problem.SmoothingLength != 0.0)
  {
    WeighBySmoothingLength(problem.SmoothingLength, this->Surface.Mesh, discretisation, followed.Constraints);
  }
  this->FollowGuides(problem, followed, context);
  if (problem.Options.Field.Kind == DiscretisationKind::ScalarFunction)
  {
    return followed;
  }
  const int N = discretisation.DirectionsPerPoint();
  const std::size_t warnings = followed.Warnings.size();
  this->FollowFeatures(problem, N, followed, context);
  const bool isNothingSaid = followed.Warnings.size() == warnings; // else it is said why nothing is followed
  this->Rotate(problem, isNothingSaid, followed, names);
  const std::vector<int> cancelling = LeaveOutCancelling(followed.Constraints.OnFaces, this->Surface.Faces, N);
  if (!cancelling.empty())
  {
    followed.Warnings.push_back(WarningOfCancelling(cancelling, names));
  }
  return followed;
}

void ProblemConstraints::FollowGuides(
  const FieldProblem& problem, FollowedConstraints& followed, const ExecutionContext& context)
{
  if (problem.Guides.AreEmpty())
  {
    return;
  }
  const FollowedGuides guides = dmg::FollowGuides(problem.Guides, this->Places(), context);
  Append(followed.Constraints.OnFaces, guides.Directions);
  CheckFollowsSomething(followed.Constraints, guides.Report, problem.Guides.MayMiss);
  if (!guides.Report.IsAllTaken())
  {
    followed.Warnings.push_back(guides.Report.LeftOut());
  }
  followed.Guides = guides.Report;
}

void ProblemConstraints::FollowFeatures(
  const FieldProblem& problem, int N, FollowedConstraints& followed, const ExecutionContext& context)
{
  CheckFeatures(problem.Features);
  const PrincipalCurvatures* curvatures = nullptr;
  if (problem.Features.CurvatureWeight > 0.0 && N % 2 == 0)
  {
    if (problem.Options.Constraints == ConstraintKind::Hard && !problem.Singularities)
    {
      throw InvalidInput("principal directions are followed on all triangles, which hard constraints would leave no "
                         "freedom; " +
        TextOf(Remedy::SoftConstraints) + ", or " + TextOf(Remedy::CurvatureWeight) + " to 0");
    }
    curvatures = &this->Curvatures(problem.Features.CurvatureScale, context);
  }
  const FollowedFeatures features = dmg::FollowFeatures(this->Surface, N, problem.Features, curvatures);
  Append(followed.Constraints.OnFaces, features.Directions);
  Append(followed.Warnings, features.Warnings);
}

void ProblemConstraints::Rotate(
  const FieldProblem& problem, bool isNothingSaid, FollowedConstraints& followed, const ElementNames& names) const
{
  if (problem.Rotation.AreZero())
  {
    return;
  }
  const Constraints& constraints = followed.Constraints;
  if (isNothingSaid && constraints.OnFaces.empty() && constraints.AtVertices.empty())
  {
    followed.Warnings.push_back(
      "nothing is followed that the field could be turned against, so " + TextOf(Remedy::RotationOfNothing));
    return;
  }
  Turn(followed.Constraints, this->Surface, problem.Rotation, names);
}

}
