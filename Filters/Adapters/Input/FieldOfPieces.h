#ifndef dmgFieldOfPieces_h
#define dmgFieldOfPieces_h

#include "Adapters/Input/ProblemFromInputs.h"
#include "Adapters/Ranks/RanksOfPipeline.h"
#include "Adapters/Surface/SolverOfPieces.h"
#include "Support/ExecutionContext.h"

#include <string>

class vtkAlgorithm;
class vtkInformationVector;

namespace dmg
{

/// A field on a surface in pieces, as one rank has it.
struct FieldOfPieces
{
  std::string ReasonToGather; ///< the same on all ranks; if it is not empty, there is no field
  const Field* Solution = nullptr;
  FieldInputs Inputs;
  std::string Followed; ///< WhatIsFollowed, on all ranks alike
};

/// Collective: reads the inputs of a filter whose surface is in pieces, and solves. Rank 0 reports the warnings.
FieldOfPieces SolveInPieces(vtkAlgorithm* filter, const FieldProperties& properties, SolverOfPieces& kept,
  const RanksOfPipeline& ranks, vtkInformationVector** inputs, const ExecutionContext& context);

}

#endif
