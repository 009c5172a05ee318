#include "Adapters/Input/ProblemFromInputs.h"

#include "Adapters/Input/ConstraintsFromArrays.h"
#include "Adapters/Input/GuideDataSets.h"
#include "Adapters/Pipeline/PanelWords.h"
#include "Discretisations/MakeDiscretisation.h"
#include "Support/Errors.h"

#include "vtkDataSet.h"
#include "vtkDataSetAttributes.h"
#include "vtkInformationVector.h"

#include <algorithm>
#include <utility>

namespace dmg
{

namespace
{

/// \throw InvalidInput directions are tensors, and the field has a sign.
void CheckTakesTensors(const DiscretisationOptions& field, const ChosenArray& vectors, vtkDataSet* surface)
{
  const bool isEven = field.DirectionsPerPoint() % 2 == 0;
  for (const int association : { vtkDataObject::FIELD_ASSOCIATION_POINTS, vtkDataObject::FIELD_ASSOCIATION_CELLS })
  {
    const bool isThere =
      vectors.Association == association || vectors.Association == vtkDataObject::FIELD_ASSOCIATION_POINTS_THEN_CELLS;
    if (!isEven && isThere && HoldsTensors(surface->GetAttributes(association)->GetArray(vectors.Name.c_str())))
    {
      throw InvalidInput("array '" + vectors.Name +
        "' holds tensors, whose principal directions have no sign; choose a power field and an even Number Of "
        "Directions");
    }
  }
}

ConstraintArrays ChoicesOnSurface(const FieldProperties& properties, vtkDataSet* surface)
{
  ConstraintArrays choices = WithoutFormerField(properties.Choices, surface);
  if (properties.Problem.Options.Field.HasDirections())
  {
    choices.Values = choices.Source = {}; // of functions alone
  }
  if (!properties.FollowsDirections)
  {
    const bool hasValues = HasArray(choices.Values, surface); // whose mask and weights they are then
    choices.Vectors = choices.Eastward = choices.Northward = {};
    choices.Mask = hasValues ? choices.Mask : ChosenArray();
    choices.Weights = hasValues ? choices.Weights : ChosenArray();
  }
  CheckTakesTensors(properties.Problem.Options.Field, choices.Vectors, surface);
  return choices;
}

}

FieldInputs InputsOf(const FieldProperties& properties, vtkDataSet* surface, vtkInformationVector** inputs)
{
  const double maximumDistance = properties.Problem.Guides.MaximumDistance;
  FieldInputs all{ surface, ChoicesOnSurface(properties, surface),
    GuidesOf(inputs, { 1, 3, 4, 5 }, properties.GuideChoices, maximumDistance),
    { DataOf(inputs[2]), properties.SingularityIndexArray, maximumDistance } };
  if (!all.Singularities.Data.empty())
  {
    WithSingularitiesAtVertices(properties.Problem.Options.Field); // throws where there are none
  }
  return all;
}

UnusableDirections ReadInputs(const FieldInputs& inputs, const FramedSurface* surface, FieldProblem& problem)
{
  UnusableDirections unusable;
  if (surface)
  {
    Constraints constraints = ConstraintsFromArrays(inputs.Choices, inputs.Surface, *surface, unusable);
    constraints.Net = problem.Constraints.Net;
    problem.Constraints = std::move(constraints);
  }
  problem.Guides = GuidesFrom(inputs.Guides, unusable);
  if (surface && problem.Options.Field.HasDirections())
  {
    AddRotation(inputs.Choices.Rotation, inputs.Surface, *surface, problem.Rotation);
  }
  return unusable;
}

FieldProblem ProblemOf(vtkAlgorithm* filter, const FieldProperties& properties, const FieldInputs& inputs,
  const SurfaceView& view, FieldSolver& solver)
{
  FieldProblem problem = properties.Problem;
  const UnusableDirections unusable = ReadInputs(inputs, &view.Surface(), problem);
  if (problem.Constraints.AreEmpty() && problem.Guides.AreEmpty())
  {
    CheckPrescribes(inputs);
  }
  if (!inputs.Singularities.Data.empty())
  {
    problem.Singularities = BringToSurface(inputs.Singularities, problem.Options.Field.N, solver.Places());
  }
  Warn(filter, { TextOf(unusable) });
  Warn(filter, WarningsOf(inputs.Guides));
  return problem;
}

void CheckPrescribes(const FieldInputs& inputs)
{
  if (HasDirections(inputs.Choices, inputs.Surface))
  {
    throw InvalidInput(
      "no direction is prescribed: those of the surface are zero, perpendicular, not finite or masked out; "
      "choose other arrays for Directions, Mask and Weights, or none for the smoothest field");
  }
  if (!DataSetsOf(inputs.Guides.Data).empty())
  {
    throw InvalidInput(
      "no direction is prescribed: the guides' lines have no length, or their vectors, mask or weights "
      "are zero; choose others, or clear Guides for the smoothest field");
  }
}

std::string WhatIsFollowed(const FieldInputs& inputs, const std::vector<SurfaceFeature>& features)
{
  std::string text;
  const auto say = [&text](bool isFollowed, const std::string& what)
  { text += isFollowed ? (text.empty() ? "" : ", ") + what : ""; };
  const auto has = [&inputs](const ChosenArray& choice) { return HasArray(choice, inputs.Surface); };
  const auto nameOf = [](const ChosenArray& choice)
  { return choice.Name.empty() ? "active vectors" : "array '" + choice.Name + "'"; };
  const ConstraintArrays& choices = inputs.Choices;
  const bool hasComponents = has(choices.Eastward); // which count instead of vectors
  const std::size_t guides = inputs.Guides.Data.size();
  say(has(choices.Vectors) && !hasComponents, nameOf(choices.Vectors));
  say(hasComponents, nameOf(choices.Eastward) + " and " + nameOf(choices.Northward));
  say(has(choices.Values), nameOf(choices.Values));
  say(has(choices.Source), "source " + nameOf(choices.Source));
  say(guides > 0, std::to_string(guides) + (guides == 1 ? " guide" : " guides"));
  const auto follows = [&features](SurfaceFeature feature)
  { return std::find(features.begin(), features.end(), feature) != features.end(); };
  say(follows(SurfaceFeature::Boundary), "boundary");
  say(follows(SurfaceFeature::SharpEdges), "sharp edges");
  say(follows(SurfaceFeature::PrincipalDirections), "curvature");
  return text.empty() ? "nothing" : text;
}

}
