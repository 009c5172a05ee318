#include "Pieces/ProblemAgreement.h"

#include "Support/Errors.h"
#include "Support/ShortText.h"

#include <algorithm>
#include <string>
#include <vector>

namespace dmg
{

namespace
{

std::string TextOf(const Vector3& place)
{
  return " " + ShortText(place[0]) + " " + ShortText(place[1]) + " " + ShortText(place[2]);
}

std::string TextOf(const FieldOptions& options)
{
  const auto number = [](auto kind) { return std::to_string(static_cast<int>(kind)); };
  return "kind " + number(options.Field.Kind) + ", N = " + std::to_string(options.Field.N) + ", areas " +
    number(options.Field.Areas) + ", smoothness " + ShortText(options.Smoothness) + ", alignment " +
    ShortText(options.Alignment) + (options.Constraints == ConstraintKind::Hard ? ", hard" : ", soft") +
    ", coarse space " + number(options.CoarseSpace) + ", solver " + number(options.Solver.Kind);
}

std::string TextOf(const FeatureOptions& features)
{
  return "boundary " + ShortText(features.BoundaryWeight) + " " + ShortText(features.BoundaryRotation) +
    ", sharp edges " + ShortText(features.SharpEdgesWeight) + " " + ShortText(features.SharpEdgesRotation) + " " +
    ShortText(features.FeatureAngle) + ", curvature " + ShortText(features.CurvatureWeight) + " " +
    ShortText(features.CurvatureRotation) + " " + ShortText(features.CurvatureScale) +
    (features.FollowsMinimum ? " minimum" : " maximum");
}

/// Guides by counts and sums, which differ where the guides do.
std::string TextOf(const Guides& guides)
{
  std::size_t points = 0, weights = 0;
  Vector3 sumOfPoints = Vector3::Zero(), sumOfVectors = Vector3::Zero();
  double sumOfWeights = 0.0;
  for (const GuideLine& line : guides.Lines)
  {
    points += line.Points.size();
    weights += line.Weights.size();
    for (const Vector3& point : line.Points)
    {
      sumOfPoints += point;
    }
    for (const double weight : line.Weights)
    {
      sumOfWeights += weight;
    }
    sumOfVectors += line.Direction.value_or(Vector3::Zero());
  }
  for (const GuideVector& vector : guides.Vectors)
  {
    sumOfPoints += vector.Position;
    sumOfVectors += vector.Direction;
    sumOfWeights += vector.Weight;
  }
  return std::to_string(guides.Lines.size()) + " lines of " + std::to_string(points) + " points and " +
    std::to_string(weights) + " weights, " + std::to_string(guides.Vectors.size()) + " vectors, sums" +
    TextOf(sumOfPoints) + "," + TextOf(sumOfVectors) + ", " + ShortText(sumOfWeights) + ", maximum distance " +
    ShortText(guides.MaximumDistance) + (guides.MayMiss ? ", may miss" : "");
}

std::string TextOfOthers(const FieldProblem& problem)
{
  return "tolerance " + ShortText(problem.Stop.RelativeTolerance) + ", iterations " +
    std::to_string(problem.Stop.MaximumIterations) + ", smoothing length " + ShortText(problem.SmoothingLength) +
    ", rotation " + ShortText(problem.Rotation.Everywhere) + (problem.Combing ? ", combed" : "") +
    (problem.UnitLength ? ", unit length" : "") +
    (problem.UnitLengthWhileSmoothing ? ", unit length while smoothing" : "") +
    (problem.HarmonicBasis ? ", basis" : "") +
    (problem.Singularities ? ", " + std::to_string(problem.Singularities->size()) + " singularities" : "");
}

/// Compares by the comparison of the options themselves: no member is forgotten, and no digit.
template <class Options>
void CheckSame(const Ranks& ranks, const Options& here, const std::string& name)
{
  const Received<Options> all = ranks.GatherToAll(std::vector<Options>{ here });
  // A number that is NaN differs from itself; whoever uses it refuses it.
  const auto differs = [&all](const Options& options) { return options == options && !(options == all.Items.front()); };
  const auto other = std::find_if(all.Items.begin(), all.Items.end(), differs);
  if (other != all.Items.end())
  {
    throw InvalidInput(
      "ranks 0 and " + std::to_string(other - all.Items.begin()) + " differ in " + name + "; give all ranks the same");
  }
}

}

void CheckAgreement(const Ranks& ranks, const FieldProblem& problem)
{
  ranks.CheckSame(TextOf(problem.Options), "the field");
  ranks.CheckSame(TextOf(problem.Features), "the features");
  ranks.CheckSame(TextOf(problem.Guides), "the guides");
  ranks.CheckSame(TextOfOthers(problem), "the options");
  // Texts say what differs, where they have it.
  CheckSame(ranks, problem.Options, "an option of the field or its solver");
  CheckSame(ranks, problem.Stop, "a criterion by which the solver stops");
}

}
