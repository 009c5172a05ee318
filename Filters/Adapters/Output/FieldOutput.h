#ifndef dmgFieldOutput_h
#define dmgFieldOutput_h

#include "Adapters/Input/ProblemFromInputs.h"
#include "Adapters/Surface/SolverOfDataSet.h"
#include "Support/ExecutionContext.h"

#include <string>

class vtkInformationVector;

namespace dmg
{

/// Writes the outputs of a filter that computes a field. All arrays are new ones, so that whoever changes them in place changes no
/// other output.
/// \param followed WhatIsFollowed.
/// \param outputs the surface with the field, its edges, the history of the iterations and the paths of guides.
void WriteField(const SolverOfDataSet& surface, const Field& field, const FieldInputs& inputs,
  const FieldProperties& properties, const std::string& followed, vtkInformationVector* outputs,
  const ExecutionContext& context);

}

#endif
