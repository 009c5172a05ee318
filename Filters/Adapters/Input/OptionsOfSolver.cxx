#include "Adapters/Input/OptionsOfSolver.h"

#include "Adapters/Pipeline/PropertyRanges.h"
#include "Support/Errors.h"

#include "vtkDataSet.h"
#include "vtkDataSetAttributes.h"
#include "vtkHarmonicFieldSolver.h"

namespace dmg
{

namespace
{

using Filter = vtkHarmonicFieldSolver;

void CheckProperties(Filter* filter)
{
  CheckRanges({
    { "Discretisation", filter->GetDiscretisation(), Filter::PowerField, Filter::PointPowerField },
    { "Number Of Directions", filter->GetNumberOfDirections(), 1, 8 },
    { "Constraint Type", filter->GetConstraintType(), Filter::Soft, Filter::Hard },
    { "Maximum Distance", filter->GetMaximumDistance(), 0 },
    { "Smoothing Length", filter->GetSmoothingLength(), 0, 1 },
    { "Boundary Rotation", filter->GetBoundaryRotation(), -180, 180 },
    { "Sharp Edges Rotation", filter->GetSharpEdgesRotation(), -180, 180 },
    { "Feature Angle", filter->GetFeatureAngle(), 0, 180 },
    { "Curvature Rotation", filter->GetCurvatureRotation(), -180, 180 },
    { "Curvature Direction", filter->GetCurvatureDirection(), Filter::MaximumCurvature, Filter::MinimumCurvature },
    { "Curvature Scale", filter->GetCurvatureScale(), 0, 100 },
    { "Rotation", filter->GetRotation(), -180, 180 },
    { "Net Source", filter->GetNetSource(), Filter::Refuse, Filter::TakeOut },
    { "Solver", filter->GetSolver(), Filter::Automatic, Filter::CoarseProlongation },
    { "Expected Solves", filter->GetExpectedSolves(), 1 },
    { "Coarse Space", filter->GetCoarseSpace(), Filter::LinearInterpolation, Filter::StructurePreserving },
    { "Tolerance", filter->GetTolerance(), 1e-14, 1 },
    { "Maximum Number Of Iterations", filter->GetMaximumNumberOfIterations(), 1 },
  });
}

FeatureOptions FeaturesOf(Filter* filter)
{
  FeatureOptions options;
  options.BoundaryWeight = filter->GetBoundaryWeight();
  options.BoundaryRotation = filter->GetBoundaryRotation();
  options.SharpEdgesWeight = filter->GetSharpEdgesWeight();
  options.SharpEdgesRotation = filter->GetSharpEdgesRotation();
  options.FeatureAngle = filter->GetFeatureAngle();
  options.CurvatureWeight = filter->GetCurvatureWeight();
  options.CurvatureRotation = filter->GetCurvatureRotation();
  options.CurvatureScale = filter->GetCurvatureScale();
  options.FollowsMinimum = filter->GetCurvatureDirection() == Filter::MinimumCurvature;
  return options;
}

FieldOptions OptionsOf(Filter* filter)
{
  FieldOptions options;
  options.Field.Kind = static_cast<DiscretisationKind>(filter->GetDiscretisation());
  options.Field.N = filter->GetNumberOfDirections();
  options.Alignment = filter->GetSmoothingLength() == 0.0 ? filter->GetAlignment() : 1.0;
  options.Constraints = static_cast<ConstraintKind>(filter->GetConstraintType());
  options.CoarseSpace = static_cast<CoarseSpaceKind>(filter->GetCoarseSpace());
  options.Solver.Kind = static_cast<SolverKind>(filter->GetSolver());
  options.Solver.ExpectedSolves = filter->GetExpectedSolves();
  options.Solver.CompareWithCholesky = filter->GetCompareWithCholesky();
  return options;
}

}

FieldProblem ProblemOf(vtkHarmonicFieldSolver* filter)
{
  CheckProperties(filter);
  FieldProblem problem;
  problem.Options = OptionsOf(filter);
  problem.Stop.RelativeTolerance = filter->GetTolerance();
  problem.Stop.MaximumIterations = filter->GetMaximumNumberOfIterations();
  problem.SmoothingLength = filter->GetSmoothingLength();
  problem.Features = FeaturesOf(filter);
  problem.Combing = filter->GetCombing();
  problem.UnitLength = filter->GetUnitLength();
  problem.HarmonicBasis = filter->GetHarmonicBasis();
  return problem;
}

std::string WhatIsFollowed(
  vtkHarmonicFieldSolver* filter, const ConstraintChoices& choices, vtkDataSet* surface, std::size_t guides)
{
  std::string text;
  const auto say = [&text](bool isFollowed, const std::string& what)
  { text += isFollowed ? (text.empty() ? "" : ", ") + what : ""; };
  const auto nameOf = [](const ArrayChoice& choice)
  { return choice.Name.empty() ? "active vectors" : "array '" + choice.Name + "'"; };
  const bool hasComponents = HasArray(choices.Eastward, surface); // which count instead of vectors
  say(HasArray(choices.Vectors, surface) && !hasComponents, nameOf(choices.Vectors));
  say(hasComponents, nameOf(choices.Eastward) + " and " + nameOf(choices.Northward));
  say(HasArray(choices.Values, surface), nameOf(choices.Values));
  say(HasArray(choices.Source, surface), "source " + nameOf(choices.Source));
  say(guides > 0, std::to_string(guides) + (guides == 1 ? " guide" : " guides"));
  say(filter->GetBoundaryWeight() > 0.0, "boundary");
  say(filter->GetSharpEdgesWeight() > 0.0, "sharp edges");
  say(filter->GetCurvatureWeight() > 0.0, "curvature");
  return text.empty() ? "nothing" : text;
}

namespace
{

/// \throw InvalidInput directions are tensors, and the field has a sign.
void CheckTakesTensors(Filter* filter, const ConstraintChoices& choices, vtkDataSet* surface)
{
  const bool isPower =
    filter->GetDiscretisation() == Filter::PowerField || filter->GetDiscretisation() == Filter::PointPowerField;
  const bool isEven = isPower && filter->GetNumberOfDirections() % 2 == 0;
  for (const int association : { vtkDataObject::FIELD_ASSOCIATION_POINTS, vtkDataObject::FIELD_ASSOCIATION_CELLS })
  {
    const bool isThere = choices.Vectors.Association == association ||
      choices.Vectors.Association == vtkDataObject::FIELD_ASSOCIATION_POINTS_THEN_CELLS;
    if (!isEven && isThere && HoldsTensors(surface->GetAttributes(association)->GetArray(choices.Vectors.Name.c_str())))
    {
      throw InvalidInput("array '" + choices.Vectors.Name +
        "' holds tensors, whose principal directions have no sign; choose a power field and an even Number Of "
        "Directions");
    }
  }
}

}

ConstraintChoices ChoicesOnSurface(vtkHarmonicFieldSolver* filter, vtkDataSet* surface)
{
  ConstraintChoices choices = WithoutFormerField(ChoicesOf(filter), surface);
  choices.Axis = Vector3(filter->GetAxis());
  choices.WeighsTensors = filter->GetTensorWeights();
  if (!filter->GetFollowDirections())
  {
    const bool hasValues = HasArray(choices.Values, surface); // whose mask and weights they are then
    choices.Vectors = choices.Eastward = choices.Northward = {};
    choices.Mask = hasValues ? choices.Mask : ArrayChoice();
    choices.Weights = hasValues ? choices.Weights : ArrayChoice();
  }
  if (filter->GetDiscretisation() != Filter::ScalarFunction)
  {
    choices.Source = {};
  }
  CheckTakesTensors(filter, choices, surface);
  return choices;
}

}
