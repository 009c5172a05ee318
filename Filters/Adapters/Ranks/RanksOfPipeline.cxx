#include "Adapters/Ranks/RanksOfPipeline.h"

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

constexpr int TagOfBytes = 4711; // any number that VTK itself does not use

/// Null where there is one process.
vtkMultiProcessController* ControllerOfSeveral()
{
  vtkMultiProcessController* const all = vtkMultiProcessController::GetGlobalController();
  return all && all->GetNumberOfProcesses() > 1 ? all : nullptr;
}

}

RanksOfPipeline::RanksOfPipeline()
  : Processes(ControllerOfSeveral() ? ControllerOfSeveral()->GetLocalProcessId() : 0,
      ControllerOfSeveral() ? ControllerOfSeveral()->GetNumberOfProcesses() : 1)
  , All(ControllerOfSeveral())
{
}

int RanksOfPipeline::Least(int here) const
{
  int least = here;
  if (this->All)
  {
    this->All->AllReduce(&here, &least, 1, vtkCommunicator::MIN_OP);
  }
  return least;
}

std::string RanksOfPipeline::TextOf(int from, const std::string& here) const
{
  std::string text = here;
  if (this->All)
  {
    auto size = static_cast<vtkIdType>(here.size());
    this->All->Broadcast(&size, 1, from);
    text.resize(size);
    this->All->Broadcast(text.data(), size, from);
  }
  return text;
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
  return this->Least(here ? 1 : 0) == 1;
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
