#ifndef dmgFilterRequests_h
#define dmgFilterRequests_h

#include "Adapters/Ranks/RanksOfPipeline.h"
#include "Support/Errors.h"
#include "Support/ExecutionContext.h"

#include <exception>
#include <functional>

class vtkAlgorithm;
class vtkInformation;
class vtkInformationVector;

namespace dmg
{

/// The array that is chosen, or that stands for no choice, is none that the filter could work on.
class WrongChoice : public InvalidInput
{
public:
  using InvalidInput::InvalidInput;
};

/// Answers of all filters to the pipeline. Their result depends on the whole surface.
///
/// In a parallel run, where each rank is asked for its own piece, all ranks ask for their pieces of a surface that comes in pieces
/// (ComesInPieces). These are gathered on rank 0 (GatheredInputs), which works on the whole, and the others stay empty. RequestData
/// is then collective. Otherwise piece 0 asks for the whole and works on it, and the other pieces stay empty.

/// FillInputPortInformation of the surface: any dataset, of which MeshFromDataSet takes the cells of two dimensions.
int TakeAnyDataSet(vtkInformation* port);

/// RequestDataObject of filters whose first output is of the type of their first input, as a vtkPassInputTypeAlgorithm; a vtkPolyData
/// where that is an image or another grid of rows with cells of three dimensions.
/// Other outputs come from VTK, by FillOutputPortInformation.
int MakeOutputLikeInput(vtkInformationVector** inputs, vtkInformationVector* outputs);

/// RequestInformation of filters with several input ports: the outputs change with time as any of the inputs does. By itself,
/// VTK looks at the first input alone, and does not ask the others for another time.
int GatherTimes(vtkAlgorithm* algorithm, vtkInformationVector** inputs, vtkInformationVector* outputs);

/// RequestUpdateExtent: asks for the rank's piece of all inputs, or for the whole where piece 0 is requested, and for nothing elsewhere.
/// A request to abort that came after the end of the last execution is forgotten.
int AskForInputs(
  vtkAlgorithm* algorithm, vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs);

/// The inputs to work on, and the algorithm's context. The cells of the surface are right (CheckCells), and it has no strips.
using MakeFunction = std::function<void(vtkInformationVector** inputs, const ExecutionContext& context)>;

/// Makes the outputs of all ranks, each of its own piece of the surface, by collective calls. \param inputs those of the pipeline,
/// with pieces of the surface that have neither ghosts nor strips.
/// \return the reason why it has not: a clause for the user, the same on all ranks, as in "flows are found on one process".
using MakeInPiecesFunction = std::function<std::string(
  const RanksOfPipeline& ranks, vtkInformationVector** inputs, const ExecutionContext& context)>;

/// make() throws this where a filter inside of this one has reported its error already.
class ToldFailure : public std::exception
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
