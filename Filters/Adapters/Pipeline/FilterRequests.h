#ifndef dmgFilterRequests_h
#define dmgFilterRequests_h

class vtkAlgorithm;
class vtkInformation;
class vtkInformationVector;

namespace dmg
{

class RanksOfPipeline;

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

/// Whether piece 0 is requested, which works on the whole.
bool IsPieceZero(vtkInformation* request, vtkInformationVector* outputs);

/// Whether AskForInputs has asked for the piece of this rank. Leaves of composite datasets come as a whole: ranks may have other numbers
/// of them, so that one would wait for the others.
bool AreInPieces(
  const RanksOfPipeline& ranks, vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs);

}

#endif
