#ifndef dmgProblemFromInputs_h
#define dmgProblemFromInputs_h

#include "Adapters/Input/GuidesFromDataSets.h"
#include "Adapters/Input/SingularitiesOnSurface.h"
#include "Adapters/View/SurfaceView.h"
#include "FieldProblem.h"
#include "FieldSolver.h"

#include <string>
#include <vector>

class vtkAlgorithm;
class vtkDataSet;
class vtkInformationVector;

namespace dmg
{

/// The properties of a filter that computes a field.
struct FieldProperties
{
  FieldProblem Problem; ///< without constraints and singularities, which the inputs add
  PreparationOptions Preparation;
  ConstraintArrays Choices;      ///< of arrays of the surface
  bool FollowsDirections = true; ///< false: as if no arrays were chosen for directions of the surface
  ConstraintArrays GuideChoices;
  std::string SingularityIndexArray;
  bool AllDirections = false; ///< whether the output has all N directions
};

/// The inputs of the filter.
struct FieldInputs
{
  vtkDataSet* Surface = nullptr;
  ConstraintArrays Choices; ///< of arrays of the surface
  GuideInput Guides;
  dmg::Singularities Singularities;
};

/// \param inputs of all ports; \p surface is that of port 0.
/// \throw InvalidInput directions of the surface are tensors, and the field has a sign; fields of this kind have no singularities.
FieldInputs InputsOf(const FieldProperties& properties, vtkDataSet* surface, vtkInformationVector** inputs);

/// Adds the constraints to a problem: arrays of the surface, their rotation, and guides.
/// \param surface made of FieldInputs::Surface; null where a rank has no piece of it.
/// \return the directions that are left out.
/// \throw InvalidInput as ConstraintsFromArrays, AddRotation and GuidesFrom.
UnusableDirections ReadInputs(const FieldInputs& inputs, const FramedSurface* surface, FieldProblem& problem);

/// The problem on a whole surface: the properties of the filter, and all inputs as they are read there. The filter warns of those that are left
/// out.
/// \param solver on the surface of the view.
/// \throw InvalidInput as ReadInputs, CheckPrescribes and BringToSurface.
FieldProblem ProblemOf(vtkAlgorithm* filter, const FieldProperties& properties, const FieldInputs& inputs,
  const SurfaceView& view, FieldSolver& solver);

/// \pre Nothing is prescribed. \throw InvalidInput arrays or guides are chosen all the same.
void CheckPrescribes(const FieldInputs& inputs);

/// The things that the field follows, in words, such as "array 'Wind', 2 guides, boundary"; "nothing" where it is the smoothest one.
/// \param features Field::Features.
std::string WhatIsFollowed(const FieldInputs& inputs, const std::vector<SurfaceFeature>& features);

}

#endif
