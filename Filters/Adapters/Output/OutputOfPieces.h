#ifndef dmgOutputOfPieces_h
#define dmgOutputOfPieces_h

#include "Adapters/Input/ProblemFromInputs.h"
#include "Adapters/Ranks/RanksOfPipeline.h"
#include "Adapters/Surface/SolverOfPieces.h"
#include "Support/ExecutionContext.h"

#include <string>

class vtkAlgorithm;
class vtkInformationVector;

namespace dmg
{

/// Collective: the outputs of vtkHarmonicFieldSolver on a surface in pieces, each rank's on its own cells and points.
/// \param followed what the filter says of that, on all ranks alike.
/// \return the reason why the surface has to be gathered; empty where the outputs are made.
std::string SolveInPieces(vtkAlgorithm* filter, const FieldProperties& properties, SolverOfPieces& kept,
  const RanksOfPipeline& ranks, vtkInformationVector** inputs, vtkInformationVector* outputs, std::string& followed,
  const ExecutionContext& context);

}

#endif
