#include "Adapters/Ranks/RanksOfPipeline.h"

#include "Support/Errors.h"

#include "vtkCharArray.h"
#include "vtkCommunicator.h"
#include "vtkMultiProcessController.h"

#include <algorithm>
#include <new>
#include <numeric>

namespace dmg
{

namespace
{

enum class Outcome
{
  Done,
  Failed,
  Stopped
};

Outcome OutcomeOf(const std::function<void()>& step, std::string& message)
{
  try
  {
    step();
    return Outcome::Done;
  }
  catch (const Cancelled&)
  {
    return Outcome::Stopped;
  }
  catch (const std::bad_alloc&)
  {
    message = "there is not enough memory for this surface; use more ranks on more machines, or reduce the number of "
              "triangles with Decimate (vtkDecimatePro)";
    return Outcome::Failed;
  }
  catch (const std::exception& error)
  {
    message = error.what();
    return Outcome::Failed;
  }
}

constexpr int TagOfBytes = 4711; // any number that VTK itself does not use

}

RanksOfPipeline::RanksOfPipeline()
  : All(vtkMultiProcessController::GetGlobalController())
{
  if (this->All && this->All->GetNumberOfProcesses() > 1)
  {
    this->RankHere = this->All->GetLocalProcessId();
    this->NumberOfRanks = this->All->GetNumberOfProcesses();
  }
  else
  {
    this->All = nullptr;
  }
}

std::vector<long long> RanksOfPipeline::Gather(long long here) const
{
  std::vector<long long> all(this->Size(), here);
  if (this->All)
  {
    this->All->AllGather(&here, all.data(), 1);
  }
  return all;
}

bool RanksOfPipeline::AreAll(bool here) const
{
  const std::vector<long long> all = this->Gather(here ? 1LL : 0LL);
  return std::all_of(all.begin(), all.end(), [](long long each) { return each == 1; });
}

std::vector<std::string> RanksOfPipeline::Gather(const std::string& here) const
{
  if (!this->All)
  {
    return { here };
  }
  const std::vector<long long> sizes = this->Gather(static_cast<long long>(here.size()));
  std::vector<vtkIdType> lengths(sizes.begin(), sizes.end());
  std::vector<vtkIdType> begins(lengths.size(), 0);
  std::partial_sum(lengths.begin(), lengths.end() - 1, begins.begin() + 1);
  std::vector<char> joined(begins.back() + lengths.back() + 1); // never empty
  this->All->AllGatherV(here.data(), joined.data(), lengths[this->Rank()], lengths.data(), begins.data());
  std::vector<std::string> texts;
  for (std::size_t rank = 0; rank < lengths.size(); ++rank)
  {
    texts.emplace_back(joined.data() + begins[rank], lengths[rank]);
  }
  return texts;
}

void RanksOfPipeline::Together(const std::function<void()>& step) const
{
  std::string message;
  const Outcome outcome = OutcomeOf(step, message);
  const std::vector<long long> outcomes = this->Gather(static_cast<long long>(outcome));
  const auto isDone = [](long long each) { return each == static_cast<long long>(Outcome::Done); };
  const auto first = std::find_if_not(outcomes.begin(), outcomes.end(), isDone);
  if (first == outcomes.end())
  {
    return;
  }
  if (*first == static_cast<long long>(Outcome::Stopped))
  {
    throw Cancelled();
  }
  const int rank = static_cast<int>(first - outcomes.begin());
  const std::string text = this->Gather(rank == this->Rank() ? message : std::string())[rank];
  throw FailedTogether(rank == 0 ? text : "on rank " + std::to_string(rank) + ": " + text);
}

vtkSmartPointer<vtkCharArray> RanksOfPipeline::ToFirst(vtkCharArray* bytes, int from, long long size) const
{
  auto received = this->Rank() == 0 ? vtkSmartPointer<vtkCharArray>::New() : nullptr;
  this->Together(
    [&]
    {
      if (received && !received->Allocate(size))
      {
        throw std::bad_alloc();
      }
    });
  if (received)
  {
    received->SetNumberOfValues(size);
    this->All->Receive(received->GetPointer(0), size, from, TagOfBytes);
  }
  else if (from == this->Rank())
  {
    this->All->Send(bytes->GetPointer(0), size, 0, TagOfBytes);
  }
  return received;
}

void RanksOfPipeline::FromFirst(vtkCharArray* bytes) const
{
  const long long size = this->Gather(static_cast<long long>(bytes->GetNumberOfValues()))[0];
  this->Together(
    [&]
    {
      if (this->Rank() > 0 && !bytes->Allocate(size))
      {
        throw std::bad_alloc();
      }
    });
  bytes->SetNumberOfValues(size);
  this->All->Broadcast(bytes->GetPointer(0), size, 0);
}

}
