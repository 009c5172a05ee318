#include "Adapters/PieceRequest.h"

#include "vtkExecutive.h"
#include "vtkInformation.h"
#include "vtkInformationIntegerKey.h"
#include "vtkInformationVector.h"
#include "vtkStreamingDemandDrivenPipeline.h"

#include <algorithm>

namespace dmg
{

void RequestWholeInPieceZero(
  vtkInformation* request, vtkInformationVector** inputs, int ports, vtkInformationVector* outputs)
{
  using Pipeline = vtkStreamingDemandDrivenPipeline;
  const int port = std::max(0, request->Get(vtkExecutive::FROM_OUTPUT_PORT())); // -1: all
  const int piece = outputs->GetInformationObject(port)->Get(Pipeline::UPDATE_PIECE_NUMBER());
  for (int i = 0; i < ports; ++i)
  {
    for (int connection = 0; connection < inputs[i]->GetNumberOfInformationObjects(); ++connection)
    {
      vtkInformation* const input = inputs[i]->GetInformationObject(connection);
      input->Set(Pipeline::UPDATE_PIECE_NUMBER(), 0);
      input->Set(Pipeline::UPDATE_NUMBER_OF_PIECES(), piece == 0 ? 1 : 0);
      input->Set(Pipeline::UPDATE_NUMBER_OF_GHOST_LEVELS(), 0);
    }
  }
}

}
