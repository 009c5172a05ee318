#ifndef dmgFieldOutput_h
#define dmgFieldOutput_h

#include "Adapters/Input/ProblemFromInputs.h"
#include "Adapters/View/SurfaceView.h"
#include "Support/ExecutionContext.h"

#include <string>

class vtkInformationVector;

namespace dmg
{

/// Writes the outputs of a filter that computes a field. All arrays are new ones, so that whoever changes them in place changes no
/// other output.
/// \param setupSeconds for the surface and the field on it. \param followed WhatIsFollowed.
/// \param outputs the surface with the field, its edges, the history of the iterations and the paths of guides.
void WriteField(SurfaceView& view, const Field& field, double setupSeconds, const FieldInputs& inputs,
  const FieldProperties& properties, const std::string& followed, vtkInformationVector* outputs,
  const ExecutionContext& context);

}

#endif
