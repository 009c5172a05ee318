#include "Adapters/PieceRequest.h"

#include "vtkExecutive.h"
#include "vtkInformation.h"
#include "vtkInformationIntegerKey.h"
#include "vtkInformationVector.h"
#include "vtkStreamingDemandDrivenPipeline.h"

#include <algorithm>

namespace dmg
{

using Pipeline = vtkStreamingDemandDrivenPipeline;

bool IsPieceZero(vtkInformation* request, vtkInformationVector* outputs)
{
  const int port = std::max(0, request->Get(vtkExecutive::FROM_OUTPUT_PORT())); // -1: all
  vtkInformation* const output = outputs->GetInformationObject(port);
  // "Piece 0 of none" is how the filter downstream asks for nothing.
  return output->Get(Pipeline::UPDATE_PIECE_NUMBER()) == 0 &&
    output->Get(Pipeline::UPDATE_NUMBER_OF_PIECES()) > 0;
}

void RequestWholeInPieceZero(
  vtkInformation* request, vtkInformationVector** inputs, int ports, vtkInformationVector* outputs)
{
  const int numberOfPieces = IsPieceZero(request, outputs) ? 1 : 0;
  for (int i = 0; i < ports; ++i)
  {
    for (int connection = 0; connection < inputs[i]->GetNumberOfInformationObjects(); ++connection)
    {
      vtkInformation* const input = inputs[i]->GetInformationObject(connection);
      input->Set(Pipeline::UPDATE_PIECE_NUMBER(), 0);
      input->Set(Pipeline::UPDATE_NUMBER_OF_PIECES(), numberOfPieces);
      input->Set(Pipeline::UPDATE_NUMBER_OF_GHOST_LEVELS(), 0);
    }
  }
}

}
