#include "Pieces/Ranks.h"

#include "Support/Errors.h"

#include <cstdio>
#include <numeric>

namespace dmg
{

namespace
{

/// The exceptions of the core, in the order in which they count where several ranks throw.
enum class Outcome
{
  Done,
  Invalid,
  Failed,
  NoMemory,
  Stopped
};

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
    return Outcome::NoMemory;
  }
  catch (const InvalidInput& error)
  {
    message = error.what();
    return Outcome::Invalid;
  }
  catch (const std::exception& error)
  {
    message = error.what();
    return Outcome::Failed;
  }
}

[[noreturn]] void Throw(Outcome outcome, const std::string& message)
{
  switch (outcome)
  {
    case Outcome::Stopped:
      throw Cancelled();
    case Outcome::NoMemory:
      throw MemoryRanOut();
    case Outcome::Invalid:
      throw InvalidInput(message);
    default:
      throw SolverFailure(message);
  }
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
  : Comm(communicator)
{
  MPI_Comm_rank(this->Comm, &this->RankHere);
  MPI_Comm_size(this->Comm, &this->NumberOfRanks);
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

void Ranks::Together(const std::function<void()>& step) const
{
  std::string message;
  const Outcome outcome = OutcomeOf(step, message);
  int first = outcome == Outcome::Done ? this->Size() : this->Rank();
  MPI_Allreduce(MPI_IN_PLACE, &first, 1, MPI_INT, MPI_MIN, this->Comm);
  if (first == this->Size())
  {
    return;
  }
  int head[] = { static_cast<int>(outcome), static_cast<int>(message.size()) };
  MPI_Bcast(head, 2, MPI_INT, first, this->Comm);
  message.resize(head[1]);
  MPI_Bcast(message.data(), head[1], MPI_CHAR, first, this->Comm);
  Throw(static_cast<Outcome>(head[0]), message);
}

void Ranks::Checkpoint(const ExecutionContext& context, double fraction) const
{
  this->Together([&] { context.Checkpoint(fraction); });
}

std::string Ranks::FirstText(const std::string& here) const
{
  int first = here.empty() ? this->Size() : this->Rank();
  MPI_Allreduce(MPI_IN_PLACE, &first, 1, MPI_INT, MPI_MIN, this->Comm);
  if (first == this->Size())
  {
    return "";
  }
  int size = static_cast<int>(here.size());
  MPI_Bcast(&size, 1, MPI_INT, first, this->Comm);
  std::string text = here;
  text.resize(size);
  MPI_Bcast(text.data(), size, MPI_CHAR, first, this->Comm);
  return text;
}

void Ranks::CheckSame(const std::string& text, const std::string& what) const
{
  const Received<char> texts = this->GatherToAll(std::vector<char>(text.begin(), text.end()));
  for (int rank = 1; rank < this->Size(); ++rank)
  {
    const std::string first(texts.Items.begin(), texts.Items.begin() + texts.Begins[1]);
    const std::string other(texts.Items.begin() + texts.Begins[rank], texts.Items.begin() + texts.Begins[rank + 1]);
    if (other != first)
    {
      throw InvalidInput("ranks 0 and " + std::to_string(rank) + " differ in " + what + ": \"" + first + "\" and \"" +
        other + "\"; give all ranks the same");
    }
  }
}

}
