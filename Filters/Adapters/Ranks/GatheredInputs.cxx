#include "Adapters/Ranks/GatheredInputs.h"

#include "Adapters/Ranks/DigestOfData.h"
#include "Adapters/Ranks/GatheringMemory.h"
#include "Adapters/Ranks/JoinedPieces.h"
#include "Support/Errors.h"

#include "vtkAlgorithm.h"
#include "vtkCharArray.h"
#include "vtkCommunicator.h"
#include "vtkDataObject.h"
#include "vtkDataSet.h"
#include "vtkIndent.h"
#include "vtkInformation.h"
#include "vtkInformationIntegerKey.h"
#include "vtkInformationVector.h"
#include "vtkNew.h"
#include "vtkPolyData.h"
#include "vtkStreamingDemandDrivenPipeline.h"
#include "vtkUnstructuredGrid.h"

#include <algorithm>
#include <set>
#include <sstream>

namespace dmg
{

namespace
{

using Pipeline = vtkStreamingDemandDrivenPipeline;

/// Whether each rank has data that no rank before it has, too.
std::vector<char> HaveOwn(const RanksOfPipeline& ranks, vtkDataObject* data)
{
  std::string here;
  ranks.Together([&] { here = data ? OutlineOf(data) : ""; });
  std::vector<std::string> all = ranks.Gather(here);
  const auto areDifferent = [&all]
  {
    std::set<std::string> different;
    return std::all_of(all.begin(), all.end(),
      [&different](const std::string& each) { return each.empty() || different.insert(each).second; });
  };
  if (!areDifferent())
  {
    ranks.Together([&] { here += here.empty() ? "" : " " + DigestOfData(data); });
    all = ranks.Gather(here);
  }
  std::vector<char> have;
  for (auto each = all.begin(); each != all.end(); ++each)
  {
    have.push_back(!each->empty() && std::find(all.begin(), each, *each) == each);
  }
  return have;
}

double Bytes(vtkDataObject* data)
{
  return 1024.0 * static_cast<double>(data->GetActualMemorySize());
}

GatheringMemory MemoryFor(const RanksOfPipeline& ranks, vtkDataObject* data, const std::vector<char>& have)
{
  auto* const dataset = vtkDataSet::SafeDownCast(data);
  const bool hasHere = have[ranks.Rank()] != 0;
  const std::vector<long long> bytes = ranks.Gather(hasHere ? static_cast<long long>(Bytes(data)) : 0LL);
  const std::vector<long long> cells = ranks.Gather(hasHere && dataset ? dataset->GetNumberOfCells() : 0LL);
  GatheringMemory memory;
  memory.Ranks = static_cast<int>(std::count(have.begin(), have.end(), 1));
  for (std::size_t rank = 0; rank < bytes.size(); ++rank)
  {
    memory.Cells += cells[rank];
    memory.WholeBytes += static_cast<double>(bytes[rank]);
    memory.SentBytes += rank > 0 ? static_cast<double>(bytes[rank]) : 0.0;
  }
  return memory;
}

/// The pieces of all ranks that have one of their own, on rank 0; empty elsewhere.
std::vector<vtkSmartPointer<vtkDataObject>> PiecesOnFirst(
  const RanksOfPipeline& ranks, vtkDataObject* data, const std::vector<char>& have)
{
  std::vector<vtkSmartPointer<vtkDataObject>> pieces;
  vtkNew<vtkCharArray> bytes;
  ranks.Together(
    [&]
    {
      if (have[ranks.Rank()])
      {
        const vtkSmartPointer<vtkDataObject> own = WithoutGhosts(data);
        if (ranks.Rank() == 0)
        {
          pieces.push_back(own);
        }
        else if (!vtkCommunicator::MarshalDataObject(own, bytes))
        {
          throw UnexpectedFailure("the piece of this rank could not be packed to be sent");
        }
      }
    });
  const std::vector<long long> sizes = ranks.Gather(static_cast<long long>(bytes->GetNumberOfValues()));
  for (int from = 1; from < ranks.Size(); ++from)
  {
    if (have[from])
    {
      vtkSmartPointer<vtkCharArray> received = ranks.ToFirst(bytes, from, sizes[from]);
      ranks.Together(
        [&]
        {
          if (ranks.Rank() == 0)
          {
            pieces.push_back(vtkCommunicator::UnMarshalDataObject(received));
            if (!pieces.back())
            {
              throw UnexpectedFailure("the piece of rank " + std::to_string(from) + " could not be unpacked");
            }
          }
        });
    }
  }
  return pieces;
}

/// Brings the data of rank 0 to all ranks.
void ShareOfFirst(const RanksOfPipeline& ranks, vtkInformation* input)
{
  vtkNew<vtkCharArray> bytes;
  ranks.Together(
    [&]
    {
      if (ranks.Rank() == 0 && !vtkCommunicator::MarshalDataObject(vtkDataObject::GetData(input), bytes))
      {
        throw UnexpectedFailure("an input could not be packed to be sent");
      }
    });
  ranks.FromFirst(bytes);
  ranks.Together(
    [&]
    {
      if (ranks.Rank() > 0)
      {
        const vtkSmartPointer<vtkDataObject> data = vtkCommunicator::UnMarshalDataObject(bytes);
        if (!data)
        {
          throw UnexpectedFailure("an input of rank 0 could not be unpacked");
        }
        input->Set(vtkDataObject::DATA_OBJECT(), data);
      }
    });
}

}

bool ComesInPieces(vtkInformationVector* port)
{
  vtkDataObject* const data = vtkDataObject::GetData(port);
  return vtkPolyData::SafeDownCast(data) || vtkUnstructuredGrid::SafeDownCast(data);
}

std::string PropertiesOf(vtkAlgorithm* algorithm)
{
  std::ostringstream base;
  std::ostringstream all;
  algorithm->vtkAlgorithm::PrintSelf(base, vtkIndent()); // objects in memory, times, observers
  algorithm->PrintSelf(all, vtkIndent());
  std::string properties = std::string("filter: ") + algorithm->GetClassName() + "\n";
  for (int port = 0; port < algorithm->GetNumberOfInputPorts(); ++port)
  {
    properties += "connections of input " + std::to_string(port) + ": " +
      std::to_string(algorithm->GetNumberOfInputConnections(port)) + "\n";
  }
  std::istringstream own(all.str().substr(std::min(all.str().size(), base.str().size())));
  for (std::string line; std::getline(own, line);)
  {
    const bool isCount = line.find("NumberOfSetups:") == 0 || line.find("NumberOfSystems:") == 0 ||
      line.find("NumberOfSolves:") == 0 || line.find("Period:") == 0;
    properties += isCount ? "" : line + "\n";
  }
  return properties;
}

void CheckSameProperties(const RanksOfPipeline& ranks, vtkAlgorithm* algorithm)
{
  std::string properties;
  ranks.Together([&] { properties = PropertiesOf(algorithm); });
  ranks.CheckSame(properties, "a property");
}

bool AreEmpty(const RanksOfPipeline& ranks, vtkInformationVector* port)
{
  const std::vector<long long> cells =
    ranks.Gather(static_cast<long long>(vtkDataSet::GetData(port)->GetNumberOfCells()));
  return std::all_of(cells.begin(), cells.end(), [](long long each) { return each == 0; });
}

bool AreDifferentPieces(const RanksOfPipeline& ranks, vtkInformationVector* port)
{
  vtkDataSet* const data = vtkDataSet::GetData(port);
  const std::vector<long long> cells = ranks.Gather(static_cast<long long>(data->GetNumberOfCells()));
  const std::vector<char> have = HaveOwn(ranks, data->GetNumberOfCells() > 0 ? data : nullptr);
  const auto pieces = std::count_if(cells.begin(), cells.end(), [](long long each) { return each > 0; });
  return pieces > 1 && std::count(have.begin(), have.end(), 1) == pieces;
}

GatheredInputs::GatheredInputs(
  const RanksOfPipeline& ranks, vtkAlgorithm* algorithm, vtkInformationVector** inputs, Place place)
{
  for (int port = 0; port < algorithm->GetNumberOfInputPorts(); ++port)
  {
    auto copies = vtkSmartPointer<vtkInformationVector>::New();
    for (int connection = 0; connection < inputs[port]->GetNumberOfInformationObjects(); ++connection)
    {
      vtkNew<vtkInformation> copy;
      copy->Copy(inputs[port]->GetInformationObject(connection));
      if (port > 0 || place == Place::OnFirst)
      {
        copy->Set(Pipeline::UPDATE_PIECE_NUMBER(), 0);
        copy->Set(Pipeline::UPDATE_NUMBER_OF_PIECES(), 1);
        this->Gather(ranks, copy, port == 0);
        if (place == Place::SurfaceApart)
        {
          ShareOfFirst(ranks, copy);
        }
      }
      copies->Append(copy);
    }
    this->Copies.push_back(copies);
    this->Ports.push_back(copies);
  }
}

void GatheredInputs::Gather(const RanksOfPipeline& ranks, vtkInformation* input, bool isSurface)
{
  vtkDataObject* const data = vtkDataObject::GetData(input);
  const std::vector<char> have = HaveOwn(ranks, data);
  if (std::none_of(have.begin() + 1, have.end(), [](char each) { return each != 0; }))
  {
    return;
  }
  const GatheringMemory memory = MemoryFor(ranks, data, have);
  ranks.Together(
    [&]
    {
      if (ranks.Rank() == 0)
      {
        CheckFits(memory, FreeMemory());
      }
    });
  const std::vector<vtkSmartPointer<vtkDataObject>> pieces = PiecesOnFirst(ranks, data, have);
  ranks.Together(
    [&]
    {
      if (ranks.Rank() == 0)
      {
        const vtkSmartPointer<vtkDataObject> joined = JoinedPieces(pieces);
        if (isSurface && !vtkDataSet::SafeDownCast(joined))
        {
          throw InvalidInput(
            "the pieces of the surface on different ranks are datasets of different types; apply Extract Surface "
            "(vtkGeometryFilter) first");
        }
        input->Set(vtkDataObject::DATA_OBJECT(), joined);
      }
    });
  if (isSurface)
  {
    this->Text = std::to_string(memory.Cells) + " cells of " + std::to_string(memory.Ranks) +
      (memory.Ranks == 1 ? " rank were gathered on the first rank, " : " ranks were gathered on the first one, ") +
      TextOfBytes(memory.WholeBytes) + " of memory";
  }
}

}
