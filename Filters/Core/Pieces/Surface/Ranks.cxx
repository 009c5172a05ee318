#include "Pieces/Surface/Ranks.h"

#include "Support/Errors.h"

#include <cstdio>
#include <numeric>

namespace dmg
{

namespace
{

std::vector<int> BeginsOf(const std::vector<int>& counts)
{
  std::vector<int> begins(counts.size(), 0);
  std::partial_sum(counts.begin(), counts.end() - 1, begins.begin() + 1);
  return begins;
}

/// A type of MPI that is as large as an item, so that counts of items fit 32 bits where bytes do not.
class ItemType
{
public:
  explicit ItemType(int bytes)
  {
    MPI_Type_contiguous(bytes, MPI_BYTE, &this->Type);
    MPI_Type_commit(&this->Type);
  }
  ~ItemType() { MPI_Type_free(&this->Type); }
  ItemType(const ItemType&) = delete;
  ItemType& operator=(const ItemType&) = delete;

  operator MPI_Datatype() const { return this->Type; }

private:
  MPI_Datatype Type;
};

int RankIn(MPI_Comm communicator)
{
  int rank = 0;
  MPI_Comm_rank(communicator, &rank);
  return rank;
}

int SizeOf(MPI_Comm communicator)
{
  int size = 1;
  MPI_Comm_size(communicator, &size);
  return size;
}

}

void EndWithOthers(MPI_Comm communicator, const std::string& message)
{
  const Ranks all(communicator);
  if (all.Size() > 1)
  {
    // No exception gets from here to the other ranks.
    std::fprintf(stderr, "DirectionalMultigrid: rank %d of %d: %s. All ranks end, as they would wait for this one.\n",
      all.Rank(), all.Size(), message.c_str());
    MPI_Abort(communicator, 1);
  }
}

Ranks::Ranks(MPI_Comm communicator)
  : Processes(RankIn(communicator), SizeOf(communicator))
  , Comm(communicator)
{
}

std::vector<int> Ranks::CountsFromRanks(const std::vector<int>& counts) const
{
  std::vector<int> received(counts.size());
  MPI_Alltoall(counts.data(), 1, MPI_INT, received.data(), 1, MPI_INT, this->Comm);
  return received;
}

void Ranks::ExchangeBytes(const void* items, const std::vector<int>& counts, void* received,
  const std::vector<int>& receivedCounts, int sizeOfItem) const
{
  const std::vector<int> begins = BeginsOf(counts);
  const std::vector<int> receivedBegins = BeginsOf(receivedCounts);
  const ItemType type(sizeOfItem);
  MPI_Alltoallv(items, counts.data(), begins.data(), type, received, receivedCounts.data(), receivedBegins.data(), type,
    this->Comm);
  const long long sent = std::accumulate(counts.begin(), counts.end(), 0LL) - counts[this->Rank()];
  this->Bytes += sent * sizeOfItem;
}

void Ranks::GatherBytes(
  const void* items, int count, void* received, const std::vector<int>& counts, int sizeOfItem) const
{
  const std::vector<int> begins = BeginsOf(counts);
  const ItemType type(sizeOfItem);
  MPI_Allgatherv(items, count, type, received, counts.data(), begins.data(), type, this->Comm);
  this->Bytes += static_cast<long long>(count) * sizeOfItem * (this->Size() - 1);
}

double Ranks::Sum(double here) const
{
  double sum = 0.0;
  MPI_Allreduce(&here, &sum, 1, MPI_DOUBLE, MPI_SUM, this->Comm);
  return sum;
}

long long Ranks::Sum(long long here) const
{
  long long sum = 0;
  MPI_Allreduce(&here, &sum, 1, MPI_LONG_LONG, MPI_SUM, this->Comm);
  return sum;
}

void Ranks::Sum(double* here, int size) const
{
  MPI_Allreduce(MPI_IN_PLACE, here, size, MPI_DOUBLE, MPI_SUM, this->Comm);
}

double Ranks::Max(double here) const
{
  double largest = 0.0;
  MPI_Allreduce(&here, &largest, 1, MPI_DOUBLE, MPI_MAX, this->Comm);
  return largest;
}

void Ranks::Min(std::vector<double>& here) const
{
  MPI_Allreduce(MPI_IN_PLACE, here.data(), static_cast<int>(here.size()), MPI_DOUBLE, MPI_MIN, this->Comm);
}

bool Ranks::Any(bool here) const
{
  return this->Sum(here ? 1LL : 0LL) > 0;
}

void Ranks::Any(std::vector<char>& here) const
{
  MPI_Allreduce(MPI_IN_PLACE, here.data(), static_cast<int>(here.size()), MPI_CHAR, MPI_MAX, this->Comm);
}

long long Ranks::SumBefore(long long here) const
{
  long long before = 0;
  MPI_Exscan(&here, &before, 1, MPI_LONG_LONG, MPI_SUM, this->Comm);
  return this->Rank() == 0 ? 0 : before; // MPI leaves that of rank 0 undefined
}

int Ranks::Least(int here) const
{
  int least = 0;
  MPI_Allreduce(&here, &least, 1, MPI_INT, MPI_MIN, this->Comm);
  return least;
}

std::string Ranks::TextOf(int from, const std::string& here) const
{
  int size = static_cast<int>(here.size());
  MPI_Bcast(&size, 1, MPI_INT, from, this->Comm);
  std::string text = here;
  text.resize(size);
  MPI_Bcast(text.data(), size, MPI_CHAR, from, this->Comm);
  return text;
}

std::vector<std::string> Ranks::Gather(const std::string& here) const
{
  const Received<char> received = this->GatherToAll(std::vector<char>(here.begin(), here.end()));
  std::vector<std::string> texts;
  for (int rank = 0; rank < this->Size(); ++rank)
  {
    texts.emplace_back(
      received.Items.begin() + received.Begins[rank], received.Items.begin() + received.Begins[rank + 1]);
  }
  return texts;
}

}
