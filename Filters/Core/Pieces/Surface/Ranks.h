#ifndef dmgRanks_h
#define dmgRanks_h

#include "Support/Processes.h"

#include <mpi.h>

#include <string>
#include <type_traits>
#include <vector>

namespace dmg
{

/// Items from other ranks, in the order of the ranks: the items of rank r are [Begins[r], Begins[r + 1]).
template <class Item>
struct Received
{
  std::vector<Item> Items;
  std::vector<int> Begins;
};

/// Ends the processes of all ranks, after a line on the standard error: for a failure of one rank that the others, which wait
/// for its messages, cannot learn of. Returns where the communicator has one rank only.
void EndWithOthers(MPI_Comm communicator, const std::string& message);

/// Runs a function that sends messages. Memory that runs out on one rank between two agreements (Ranks::Together) ends all ranks.
template <class Function>
decltype(auto) EndingTogether(MPI_Comm communicator, const Function& function)
{
  try
  {
    return function();
  }
  catch (const MemoryRanOut&)
  {
    throw;
  }
  catch (const std::bad_alloc&)
  {
    EndWithOthers(communicator, MemoryRanOut().what());
    throw;
  }
}

/// The processes of MPI that hold a surface together, and their messages.
class Ranks : public Processes
{
public:
  /// \param communicator is borrowed. \pre MPI is initialised.
  explicit Ranks(MPI_Comm communicator);

  MPI_Comm Communicator() const { return this->Comm; }

  /// Sends \p toRanks [r] to rank r.
  template <class Item>
  Received<Item> Exchange(const std::vector<std::vector<Item>>& toRanks) const;
  /// The items of all ranks, the same everywhere.
  template <class Item>
  Received<Item> GatherToAll(const std::vector<Item>& items) const;

  double Sum(double here) const;
  long long Sum(long long here) const;
  /// Element by element, in place.
  void Sum(double* here, int size) const;
  void Sum(std::vector<double>& here) const { this->Sum(here.data(), static_cast<int>(here.size())); }
  double Max(double here) const;
  /// Element by element, in place.
  void Min(std::vector<double>& here) const;
  bool Any(bool here) const;
  /// Element by element.
  void Any(std::vector<char>& here) const;
  /// The sum over all ranks before this one.
  long long SumBefore(long long here) const;

  std::vector<std::string> Gather(const std::string& here) const override;

  /// Bytes that this rank has sent to others by Exchange and GatherToAll.
  long long BytesSent() const { return this->Bytes; }

protected:
  int Least(int here) const override;
  std::string TextOf(int from, const std::string& here) const override;

private:
  std::vector<int> CountsFromRanks(const std::vector<int>& counts) const;
  void ExchangeBytes(const void* items, const std::vector<int>& counts, void* received,
    const std::vector<int>& receivedCounts, int sizeOfItem) const;
  void GatherBytes(const void* items, int count, void* received, const std::vector<int>& counts, int sizeOfItem) const;

  MPI_Comm Comm;
  mutable long long Bytes = 0;
};

template <class Item>
Received<Item> Ranks::Exchange(const std::vector<std::vector<Item>>& toRanks) const
{
  static_assert(std::is_trivially_copyable_v<Item>);
  std::vector<Item> items;
  std::vector<int> counts;
  for (const std::vector<Item>& toRank : toRanks)
  {
    items.insert(items.end(), toRank.begin(), toRank.end());
    counts.push_back(static_cast<int>(toRank.size()));
  }
  const std::vector<int> receivedCounts = this->CountsFromRanks(counts);
  Received<Item> received;
  received.Begins.assign(1, 0);
  for (const int count : receivedCounts)
  {
    received.Begins.push_back(received.Begins.back() + count);
  }
  received.Items.resize(received.Begins.back());
  this->ExchangeBytes(items.data(), counts, received.Items.data(), receivedCounts, sizeof(Item));
  return received;
}

template <class Item>
Received<Item> Ranks::GatherToAll(const std::vector<Item>& items) const
{
  static_assert(std::is_trivially_copyable_v<Item>);
  const int count = static_cast<int>(items.size());
  const std::vector<int> counts = this->CountsFromRanks(std::vector<int>(this->Size(), count));
  Received<Item> received;
  received.Begins.assign(1, 0);
  for (const int fromRank : counts)
  {
    received.Begins.push_back(received.Begins.back() + fromRank);
  }
  received.Items.resize(received.Begins.back());
  this->GatherBytes(items.data(), count, received.Items.data(), counts, sizeof(Item));
  return received;
}

}

#endif
