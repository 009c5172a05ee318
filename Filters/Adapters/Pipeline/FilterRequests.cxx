#include "Adapters/Pipeline/FilterRequests.h"

#include "Adapters/Data/SkinOfVolume.h"
#include "Adapters/Pipeline/TouchingLeaves.h"
#include "Adapters/Ranks/GatheredInputs.h"
#include "Adapters/Ranks/RanksOfPipeline.h"

#include "vtkAlgorithm.h"
#include "vtkDataObject.h"
#include "vtkDataSet.h"
#include "vtkExecutive.h"
#include "vtkInformation.h"
#include "vtkInformationDoubleVectorKey.h"
#include "vtkInformationIntegerKey.h"
#include "vtkInformationVector.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"
#include "vtkStreamingDemandDrivenPipeline.h"

#include <algorithm>
#include <set>
#include <vector>

namespace dmg
{
namespace
{

using Pipeline = vtkStreamingDemandDrivenPipeline;

/// The output that is asked for.
vtkInformation* AskedOf(vtkInformation* request, vtkInformationVector* outputs)
{
  const int port = std::max(0, request->Get(vtkExecutive::FROM_OUTPUT_PORT())); // -1: all
  return outputs->GetInformationObject(port);
}

/// Whether the executive asks with an empty grid what becomes of grids of adaptive mesh refinement (AMR). Such a dataset holds only grids,
/// and the skins of volumes are none; the outputs come as blocks.
bool IsForGridsOfAmr(vtkDataSet* input)
{
  return input->GetDataObjectType() == VTK_UNIFORM_GRID && input->GetNumberOfPoints() == 0;
}

/// Whether the piece of this rank is asked for, of as many pieces as ranks.
bool IsPieceOfRank(const RanksOfPipeline& ranks, vtkInformation* asked)
{
  return ranks.Size() > 1 && asked->Get(Pipeline::UPDATE_NUMBER_OF_PIECES()) == ranks.Size() &&
    asked->Get(Pipeline::UPDATE_PIECE_NUMBER()) == ranks.Rank();
}

}

int TakeAnyDataSet(vtkInformation* port)
{
  port->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkDataSet");
  return 1;
}

int MakeOutputLikeInput(vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  vtkDataSet* const input =
    vtkDataSet::GetData(inputs[0]); // none: the executive says so, but after this; or a block that is a table
  vtkInformation* const output = outputs->GetInformationObject(0);
  vtkDataObject* const former = output->Get(vtkDataObject::DATA_OBJECT());
  if (!input || IsForGridsOfAmr(input) || IsStructuredVolume(inputs[0]->GetInformationObject(0)))
  {
    if (!vtkPolyData::SafeDownCast(former))
    {
      output->Set(vtkDataObject::DATA_OBJECT(), vtkSmartPointer<vtkPolyData>::New());
    }
  }
  else if (!former || !former->IsA(input->GetClassName()))
  {
    output->Set(vtkDataObject::DATA_OBJECT(), vtk::TakeSmartPointer(input->NewInstance()));
  }
  return 1;
}

int GatherTimes(vtkAlgorithm* algorithm, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  std::set<double> steps, ends;
  for (int port = 0; port < algorithm->GetNumberOfInputPorts(); ++port)
  {
    for (int k = 0; k < inputs[port]->GetNumberOfInformationObjects(); ++k)
    {
      vtkInformation* const input = inputs[port]->GetInformationObject(k);
      const double* const times = input->Get(Pipeline::TIME_STEPS());
      const double* const range = input->Get(Pipeline::TIME_RANGE());
      steps.insert(times, times + input->Length(Pipeline::TIME_STEPS()));
      ends.insert(range, range + input->Length(Pipeline::TIME_RANGE()));
    }
  }
  ends.insert(steps.begin(), steps.end());
  const std::vector<double> all(steps.begin(), steps.end());
  for (int port = 0; !ends.empty() && port < outputs->GetNumberOfInformationObjects(); ++port)
  {
    vtkInformation* const output = outputs->GetInformationObject(port);
    const double range[] = { *ends.begin(), *ends.rbegin() };
    output->Set(Pipeline::TIME_RANGE(), range, 2);
    if (!all.empty())
    {
      output->Set(Pipeline::TIME_STEPS(), all.data(), static_cast<int>(all.size()));
    }
  }
  return 1;
}

int AskForInputs(
  vtkAlgorithm* algorithm, vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  algorithm->SetAbortExecute(0);
  const RanksOfPipeline ranks;
  // The executive asks for each leaf of a composite dataset after what it has forwarded.
  const bool isLeaf = request->Get(vtkExecutive::ALGORITHM_AFTER_FORWARD()) != 0;
  BeginExecution(algorithm, isLeaf);
  const bool inPieces = !isLeaf && IsPieceOfRank(ranks, AskedOf(request, outputs)) && ComesInPieces(inputs[0]);
  const int piece = inPieces ? ranks.Rank() : 0;
  const int numberOfPieces = inPieces ? ranks.Size() : IsPieceZero(request, outputs) ? 1 : 0;
  for (int port = 0; port < algorithm->GetNumberOfInputPorts(); ++port)
  {
    for (int connection = 0; connection < inputs[port]->GetNumberOfInformationObjects(); ++connection)
    {
      vtkInformation* const input = inputs[port]->GetInformationObject(connection);
      input->Set(Pipeline::UPDATE_PIECE_NUMBER(), piece);
      input->Set(Pipeline::UPDATE_NUMBER_OF_PIECES(), numberOfPieces);
      input->Set(Pipeline::UPDATE_NUMBER_OF_GHOST_LEVELS(), 0);
    }
  }
  return 1;
}

bool IsPieceZero(vtkInformation* request, vtkInformationVector* outputs)
{
  vtkInformation* const output = AskedOf(request, outputs);
  // "Piece 0 of none" is how the filter downstream asks for nothing.
  return output->Get(Pipeline::UPDATE_PIECE_NUMBER()) == 0 && output->Get(Pipeline::UPDATE_NUMBER_OF_PIECES()) > 0;
}

bool AreInPieces(
  const RanksOfPipeline& ranks, vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  return IsPieceOfRank(ranks, AskedOf(request, outputs)) && ComesInPieces(inputs[0]) &&
    IsPieceOfRank(ranks, inputs[0]->GetInformationObject(0));
}

}
