#include "PropertiesOfSolver.h"

#include "Adapters/Pipeline/PropertyRanges.h"

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
  return options;
}

FieldProblem ProblemOf(Filter* filter)
{
  FieldProblem problem;
  problem.Options = OptionsOf(filter);
  problem.Stop.RelativeTolerance = filter->GetTolerance();
  problem.Stop.MaximumIterations = filter->GetMaximumNumberOfIterations();
  problem.SmoothingLength = filter->GetSmoothingLength();
  problem.Features = FeaturesOf(filter);
  problem.Guides.MaximumDistance = filter->GetMaximumDistance();
  problem.Constraints.Net = filter->GetNetSource() == Filter::TakeOut ? NetSource::TakeOut : NetSource::Refuse;
  problem.Rotation.Everywhere = problem.Options.Field.HasDirections() ? filter->GetRotation() * (Pi / 180.0) : 0.0;
  problem.Combing = filter->GetCombing();
  problem.UnitLength = filter->GetUnitLength();
  problem.UnitLengthWhileSmoothing = filter->GetUnitLengthWhileSmoothing();
  problem.HarmonicBasis = filter->GetHarmonicBasis();
  return problem;
}

}

FieldProperties PropertiesOf(vtkHarmonicFieldSolver* filter, const ConstraintArrays& guideChoices)
{
  CheckProperties(filter);
  FieldProperties properties{ ProblemOf(filter), { Numbering::Spatial, filter->GetJoinPoints(), filter->GetStrict() },
    ChoicesOf(filter), filter->GetFollowDirections(), guideChoices, filter->GetSingularityIndexArray(),
    filter->GetAllDirections() };
  properties.Choices.Axis = Vector3(filter->GetAxis());
  properties.Choices.WeighsTensors = filter->GetTensorWeights();
  return properties;
}

}
