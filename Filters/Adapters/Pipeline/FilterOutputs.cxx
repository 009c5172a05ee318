#include "Adapters/Pipeline/FilterOutputs.h"

#include "Adapters/Data/CellChecks.h"
#include "Adapters/Data/SkinOfVolume.h"
#include "Adapters/Data/WithoutStrips.h"
#include "Adapters/Pipeline/ContextFromAlgorithm.h"
#include "Adapters/Pipeline/FilterRequests.h"
#include "Adapters/Pipeline/FiniteArrays.h"
#include "Adapters/Pipeline/PanelWords.h"
#include "Adapters/Pipeline/ReportedMessages.h"
#include "Adapters/Pipeline/TouchingLeaves.h"
#include "Adapters/Ranks/GatheredInputs.h"
#include "Adapters/Ranks/JoinedPieces.h"

#include "vtkAlgorithm.h"
#include "vtkDataSet.h"
#include "vtkDemandDrivenPipeline.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkNew.h"
#include "vtkSmartPointer.h"
#include "vtkTrivialProducer.h"

#include <algorithm>
#include <new>
#include <vector>

namespace dmg
{
namespace
{

/// Whether the surface of a piece other than the first may be another one than that of the first. Sources that do not know of
/// pieces, as readers of PLY files, deliver the whole surface for each of them. Data that a program hands on are what it has there.
bool MayBePart(vtkAlgorithm* algorithm)
{
  vtkAlgorithm* source = algorithm;
  while (source->GetNumberOfInputPorts() > 0 && source->GetNumberOfInputConnections(0) > 0)
  {
    source = source->GetInputAlgorithm(0, 0);
  }
  return source == algorithm || vtkTrivialProducer::SafeDownCast(source);
}

void Empty(vtkInformationVector* outputs)
{
  for (int port = 0; port < outputs->GetNumberOfInformationObjects(); ++port)
  {
    vtkDataObject::GetData(outputs, port)->Initialize();
  }
}

/// Marks the outputs as not generated, so that the next update runs again, and takes the request to abort as fulfilled.
int Aborted(vtkAlgorithm* algorithm, vtkInformationVector* outputs)
{
  for (int port = 0; port < outputs->GetNumberOfInformationObjects(); ++port)
  {
    vtkInformation* const information = outputs->GetInformationObject(port);
    vtkDataObject::GetData(information)->ReleaseData();
    information->Set(vtkDemandDrivenPipeline::DATA_NOT_GENERATED(), 1);
  }
#if DMG_VTK_CHECKS_ABORT
  algorithm->SetAbortOutput(true);
#endif
  algorithm->SetAbortExecute(0);
  return 1;
}

/// Whether the first output is of the type of the first input.
bool HandsSurfaceOn(vtkAlgorithm* algorithm)
{
  const std::string type = algorithm->GetOutputPortInformation(0)->Get(vtkDataObject::DATA_TYPE_NAME());
  return type == "vtkDataSet";
}

/// \param isTold whether this rank reports the message; it is empty where it is reported already.
int Failed(vtkAlgorithm* algorithm, vtkInformationVector** inputs, vtkInformationVector* outputs,
  const std::string& message, bool isTold)
{
  Empty(outputs);
  if (!message.empty() && HasFailedBefore(algorithm, inputs, message))
  {
    return 1; // as the pipeline adds an error of its own for each failure
  }
  if (isTold && !message.empty())
  {
    vtkErrorWithObjectMacro(algorithm, << message);
  }
  return 0;
}

void CheckOutputs(vtkInformationVector* outputs, vtkDataSet* input)
{
  for (int port = 0; port < outputs->GetNumberOfInformationObjects(); ++port)
  {
    CheckArraysAreFinite(vtkDataObject::GetData(outputs, port), input);
  }
}

/// The inputs of a filter with another surface, so that arrays of its outputs are known as those of this surface.
class InputsWithSurface
{
public:
  InputsWithSurface(vtkAlgorithm* algorithm, vtkInformationVector** inputs, vtkDataSet* surface)
    : Ports(inputs, inputs + algorithm->GetNumberOfInputPorts())
  {
    vtkNew<vtkInformation> first;
    first->Copy(inputs[0]->GetInformationObject(0));
    first->Set(vtkDataObject::DATA_OBJECT(), surface);
    this->First->Append(first);
    this->Ports[0] = this->First;
  }

  vtkInformationVector** Get() { return this->Ports.data(); }

private:
  vtkNew<vtkInformationVector> First;
  std::vector<vtkInformationVector*> Ports;
};

/// \return what a filter works on, of cells of two dimensions, without strips. \pre CheckCells.
vtkSmartPointer<vtkDataSet> SurfaceOfInput(vtkDataSet* given)
{
  return IsVolume(given) ? SkinOfVolume(given) : WithoutStrips(given);
}

void MakeAndCheck(const MakeFunction& make, vtkAlgorithm* algorithm, vtkInformationVector** inputs,
  vtkInformationVector* outputs, const ExecutionContext& context)
{
  vtkDataSet* const given = vtkDataSet::GetData(inputs[0]);
  CheckCells(given, "the surface");
  const vtkSmartPointer<vtkDataSet> surface = SurfaceOfInput(given);
  make(InputsWithSurface(algorithm, inputs, surface).Get(), context);
  CheckOutputs(outputs, surface);
  WarnOfTouchingLeaves(algorithm, surface);
  if (IsVolume(given))
  {
    ReportOnce(algorithm, outputs, "Skin", "the dataset has cells of three dimensions; its skin is the surface");
  }
}

/// Collective: the cells of all datasets that come in, before anything reads them.
void CheckInputs(const RanksOfPipeline& ranks, vtkAlgorithm* algorithm, vtkInformationVector** inputs)
{
  ranks.Together(
    [&]
    {
      for (int port = 0; port < algorithm->GetNumberOfInputPorts(); ++port)
      {
        for (int k = 0; k < inputs[port]->GetNumberOfInformationObjects(); ++k)
        {
          if (auto* const dataset = vtkDataSet::GetData(inputs[port], k))
          {
            CheckCells(dataset, port == 0 ? "the surface" : "input " + std::to_string(port));
          }
        }
      }
    });
}

/// Collective: whether some rank has a piece of a volume.
bool AreOfVolume(const RanksOfPipeline& ranks, vtkInformationVector** inputs)
{
  const std::vector<long long> all = ranks.Gather(IsVolume(vtkDataSet::GetData(inputs[0])) ? 1LL : 0LL);
  return std::count(all.begin(), all.end(), 0LL) < static_cast<long long>(all.size());
}

/// Makes the outputs of all ranks in pieces, without ghosts and strips. \return the reason why it has not.
std::string MakeInPieces(const RanksOfPipeline& ranks, const MakeInPiecesFunction& inPieces, vtkAlgorithm* algorithm,
  vtkInformationVector** inputs, vtkInformationVector* outputs, const ExecutionContext& context)
{
  vtkSmartPointer<vtkDataSet> surface;
  ranks.Together(
    [&] { surface = WithoutStrips(vtkDataSet::SafeDownCast(WithoutGhosts(vtkDataObject::GetData(inputs[0])))); });
  const std::string reason = inPieces(ranks, InputsWithSurface(algorithm, inputs, surface).Get(), context);
  if (reason.empty())
  {
    ranks.Together([&] { CheckOutputs(outputs, surface); });
  }
  return reason;
}

/// Collective: the pieces of all ranks, worked on by the first one.
void MakeOfPieces(const RanksOfPipeline& ranks, const MakeFunction& make, const MakeInPiecesFunction& inPieces,
  vtkAlgorithm* algorithm, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  const ContextFromAlgorithm context(algorithm);
  ranks.Checkpoint(context, 0.0);
  CheckSameProperties(ranks, algorithm);
  CheckInputs(ranks, algorithm, inputs);
  if (AreEmpty(ranks, inputs[0]))
  {
    return;
  }
  std::string reason = "this filter works on whole surfaces";
  if (AreOfVolume(ranks, inputs))
  {
    reason = "the skin of a volume is that of the whole";
  }
  else if (inPieces && AreDifferentPieces(ranks, inputs[0]))
  {
    reason = MakeInPieces(ranks, inPieces, algorithm, inputs, outputs, context);
    if (reason.empty())
    {
      return;
    }
  }
  GatheredInputs gathered(ranks, algorithm, inputs, GatheredInputs::Place::OnFirst);
  std::string wrongChoice;
  ranks.Together(
    [&]
    {
      try
      {
        if (ranks.Rank() == 0)
        {
          MakeAndCheck(make, algorithm, gathered.Get(), outputs, context);
        }
      }
      catch (const WrongChoice& error)
      {
        wrongChoice = error.what();
      }
      context.Checkpoint(1.0);
    });
  if (!ranks.Gather(wrongChoice)[0].empty())
  {
    throw WrongChoice(wrongChoice); // all ranks hand their pieces on
  }
  if (ranks.Rank() == 0 && !gathered.Note().empty())
  {
    ReportOnce(algorithm, outputs, "Gathered", gathered.Note() + ", since " + reason);
  }
}

/// Whether the input is a block beside others that has no surface: beams and node sets go through, and tables are left out.
bool HasGoneThrough(vtkAlgorithm* algorithm, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  vtkDataSet* const block = vtkDataSet::GetData(inputs[0]);
  if (!block)
  {
    vtkWarningWithObjectMacro(algorithm,
      "a block is a " << vtkDataObject::GetData(inputs[0])->GetClassName() << ", which has no cells, and is left out");
    return true;
  }
  if (!IsOnLeaf(algorithm) || block->GetNumberOfCells() == 0)
  {
    return false;
  }
  CheckCells(block, "the surface");
  if (HasSurface(block))
  {
    return false;
  }
  if (HandsSurfaceOn(algorithm))
  {
    vtkDataObject::GetData(outputs, 0)->ShallowCopy(block);
  }
  ReportOnce(algorithm, outputs, "Block", "a block has no cells of two or three dimensions and goes through as it is");
  return true;
}

/// The whole surface, where there is one process or only the first one works.
void MakeOfWhole(const MakeFunction& make, vtkAlgorithm* algorithm, vtkInformation* request,
  vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  vtkDataSet* const input = vtkDataSet::GetData(inputs[0]);
  if (input->GetNumberOfElements(vtkDataObject::CELL) == 0 && input->GetNumberOfElements(vtkDataObject::POINT) == 0)
  {
    return; // points without cells are refused
  }
  if (IsPieceZero(request, outputs))
  {
    MakeAndCheck(make, algorithm, inputs, outputs, ContextFromAlgorithm(algorithm));
  }
  else if (MayBePart(algorithm))
  {
    vtkWarningWithObjectMacro(algorithm,
      "a piece of the surface other than the first holds "
        << input->GetNumberOfCells()
        << " cells, which are ignored; if the surface is distributed, gather it in piece 0 first");
  }
}

}

int MakeOutputsBy(const MakeFunction& make, const MakeInPiecesFunction& inPieces, vtkAlgorithm* algorithm,
  vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  const RanksOfPipeline ranks;
  const bool areInPieces = AreInPieces(ranks, request, inputs, outputs);
  const auto failed = [&](const std::string& message) // of all ranks, where these work together
  { return Failed(algorithm, inputs, outputs, InPanelWords(message), !areInPieces || ranks.Rank() == 0); };
  try
  {
    Empty(outputs);
    if (HasGoneThrough(algorithm, inputs, outputs))
    {
      return 1;
    }
    if (areInPieces)
    {
      MakeOfPieces(ranks, make, inPieces, algorithm, inputs, outputs);
    }
    else
    {
      MakeOfWhole(make, algorithm, request, inputs, outputs);
    }
    return 1;
  }
  catch (const Cancelled&)
  {
    return Aborted(algorithm, outputs);
  }
  catch (const MemoryRanOut& error)
  {
    return failed(error.what());
  }
  catch (const std::bad_alloc&)
  {
    return failed("there is not enough memory for this surface; free some, or reduce the number of triangles with "
                  "Decimate (vtkDecimatePro)");
  }
  catch (const WrongChoice& error)
  {
    failed(error.what());
    if (HandsSurfaceOn(algorithm))
    {
      vtkDataObject::GetData(outputs, 0)->ShallowCopy(SurfaceOfInput(vtkDataSet::GetData(inputs[0])));
    }
    return 1; // nothing failed on the way, which the pipeline would add as an error of its own
  }
  catch (const std::exception& error)
  {
    return failed(error.what());
  }
}

}
