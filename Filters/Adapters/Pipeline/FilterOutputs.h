#ifndef dmgFilterOutputs_h
#define dmgFilterOutputs_h

#include "Adapters/Ranks/RanksOfPipeline.h"
#include "Support/Errors.h"
#include "Support/ExecutionContext.h"

#include <exception>
#include <functional>
#include <string>

class vtkAlgorithm;
class vtkInformation;
class vtkInformationVector;

namespace dmg
{

/// The chosen or default array is unusable.
class WrongChoice : public InvalidInput
{
public:
  using InvalidInput::InvalidInput;
};

/// The inputs to work on, and the algorithm's context. The cells of the surface are right (CheckCells), and it has no strips.
using MakeFunction = std::function<void(vtkInformationVector** inputs, const ExecutionContext& context)>;

/// Makes the outputs of all ranks, each of its own piece of the surface, by collective calls. \param inputs those of the pipeline,
/// with pieces of the surface that have neither ghosts nor strips.
/// \return the reason why it has not: a clause for the user, the same on all ranks, as in "flows are found on one process".
using MakeInPiecesFunction = std::function<std::string(
  const RanksOfPipeline& ranks, vtkInformationVector** inputs, const ExecutionContext& context)>;

/// Thrown when an inner filter has reported its error.
class ReportedFailure : public std::exception
{
public:
  const char* what() const noexcept override { return ""; }
};

/// MakeOutputs of any type of function.
/// \param inPieces what to try first on surfaces in pieces, no two of which are equal; may be empty.
int MakeOutputsBy(const MakeFunction& make, const MakeInPiecesFunction& inPieces, vtkAlgorithm* algorithm,
  vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs);

/// RequestData: calls \p make with inputs that are the whole surface and all of the others, and with the algorithm's context, outputs
/// empty, unless the first input has no cells or this is not the piece to work on; sources that do not know of pieces deliver the
/// same to all.
/// The outputs are empty in the end, on all ranks, where \p make throws (Cancelled is no error, all else goes to the algorithm), or where
/// an array or point that it made is not finite, which is an error as well. After a WrongChoice, a first output of the type of the
/// first input is the input: a window goes on to show the surface while its user chooses. Rank 0 reports the errors of all ranks.
/// The field data of the first output say in the text Gathered that pieces were gathered, and so does a line of VTK's output, once
/// for each filter.
/// \return what RequestData returns, the same on all ranks.
template <class Make>
int MakeOutputs(vtkAlgorithm* algorithm, vtkInformation* request, vtkInformationVector** inputs,
  vtkInformationVector* outputs, const Make& make)
{
  // A reference takes no memory, which may be all gone already.
  return MakeOutputsBy(std::cref(make), nullptr, algorithm, request, inputs, outputs);
}

/// MakeOutputs that tries \p inPieces first on surfaces in pieces.
template <class Make, class MakeInPieces>
int MakeOutputs(vtkAlgorithm* algorithm, vtkInformation* request, vtkInformationVector** inputs,
  vtkInformationVector* outputs, const Make& make, const MakeInPieces& inPieces)
{
  return MakeOutputsBy(std::cref(make), std::cref(inPieces), algorithm, request, inputs, outputs);
}

}

#endif
