#ifndef dmgProcesses_h
#define dmgProcesses_h

#include "Support/ExecutionContext.h"

#include <functional>
#include <new>
#include <string>
#include <vector>

namespace dmg
{

/// Memory has run out on some process, and all of them throw this.
class MemoryRanOut : public std::bad_alloc
{
public:
  const char* what() const noexcept override
  {
    return "memory has run out on one rank; take more ranks, on more machines, or fewer triangles";
  }
};

/// Processes that work together, the ranks of a parallel program. Every function but Rank and Size is collective: all ranks call it, in
/// the same order, from the thread that entered the core. Subclasses know how messages travel.
class Processes
{
public:
  virtual ~Processes() = default;

  int Rank() const { return this->RankHere; }
  int Size() const { return this->NumberOfRanks; }

  /// Runs a step that sends nothing. If it throws anywhere, all ranks throw what the lowest such rank has thrown: InvalidInput, Cancelled,
  /// MemoryRanOut, or SolverFailure for all else. The message names the rank, if it is not the first. Without this, the other ranks
  /// would wait for ever.
  void Together(const std::function<void()>& step) const;
  /// A checkpoint where all ranks stop as soon as one of them was asked to.
  /// \throw Cancelled
  void Checkpoint(const ExecutionContext& context, double fraction) const;
  /// The text of the lowest rank whose text is not empty; empty if there is none.
  std::string FirstText(const std::string& here) const;

  /// The texts of all ranks.
  virtual std::vector<std::string> Gather(const std::string& here) const = 0;
  /// Checks that all ranks have the same text. \param what the text says, for the message, which names the first line that differs.
  /// \throw InvalidInput
  void CheckSame(const std::string& here, const std::string& what) const;

protected:
  Processes(int rank, int size)
    : RankHere(rank)
    , NumberOfRanks(size)
  {
  }

  virtual int Least(int here) const = 0;
  /// The text of rank \p from.
  virtual std::string TextOf(int from, const std::string& here) const = 0;

private:
  const int RankHere;
  const int NumberOfRanks;
};

}

#endif
