#include "Adapters/Input/ProblemFromInputs.h"

#include "Adapters/Input/ConstraintsFromArrays.h"
#include "Adapters/Input/GuideDataSets.h"
#include "Support/Errors.h"

#include "vtkDataSet.h"
#include "vtkHarmonicFieldSolver.h"

namespace dmg
{

void CheckPrescribes(const ConstraintChoices& choices, const FieldInputs& inputs)
{
  if (HasDirections(choices, inputs.Surface))
  {
    throw InvalidInput("no direction is prescribed: the directions of the surface are zero, perpendicular to it or not "
                       "finite, or its mask "
                       "or weights are zero; "
                       "choose other arrays for Directions, Mask and Weights, or none for the smoothest field");
  }
  if (!DataSetsOf(inputs.Guides.Data).empty())
  {
    throw InvalidInput(
      "no direction is prescribed: the lines of the guides have no length or their vectors are zero, or "
      "their mask or weights are; choose others, or clear Guides for the smoothest field");
  }
}

UnusableDirections ReadInputs(vtkHarmonicFieldSolver* filter, const ConstraintChoices& choices,
  const FieldInputs& inputs, const FramedSurface* surface, FieldProblem& problem)
{
  UnusableDirections unusable;
  if (surface)
  {
    problem.Constraints = ConstraintsFromArrays(choices, inputs.Surface, *surface, unusable);
  }
  problem.Constraints.Net =
    filter->GetNetSource() == vtkHarmonicFieldSolver::TakeOut ? NetSource::TakeOut : NetSource::Refuse;
  problem.Guides = GuidesFrom(inputs.Guides, unusable);
  if (surface && problem.Options.Field.Kind != DiscretisationKind::ScalarFunction) // which nothing turns
  {
    problem.Rotation = RotationFromArray(choices.Rotation, filter->GetRotation(), inputs.Surface, *surface);
  }
  return unusable;
}

}
