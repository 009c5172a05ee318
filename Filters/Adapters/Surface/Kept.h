#ifndef dmgKept_h
#define dmgKept_h

#include "Adapters/Pipeline/LeavesOfExecution.h"
#include "Adapters/Surface/PreparedDataSet.h"

#include "vtkAlgorithm.h"
#include "vtkCommand.h"

#include <algorithm>
#include <memory>
#include <string>
#include <utility>

namespace dmg
{

/// An engine of the core on the surface of a dataset, kept for as long as surface and options are the same. Keys are contents, not modification
/// times: equal surfaces are one (PrepareDataSet).
/// \tparam Engine borrows the surface, and has Counts(), which can be added, and Bytes().
/// \tparam Options decide whether another engine is needed; the engine itself takes all others.
template <class Engine, class Options>
class EngineOfSurface
{
public:
  using StageCounts = decltype(std::declval<const Engine&>().Counts());

  /// The engine for a surface and options. \param make makes one, where the one at hand is of others, which is given back first.
  template <class Make>
  Engine& Take(const std::shared_ptr<const PreparedDataSet>& surface, const Options& options, const Make& make)
  {
    if (!this->Held || this->Prepared != surface || !(this->Taken == options))
    {
      this->Former = this->Counts();
      this->Held.reset();
      this->Prepared = surface;
      this->Held.reset(new Engine(make()));
      this->Taken = options;
    }
    return *this->Held;
  }

  /// Whether the engine is on a surface.
  bool IsOn(const std::shared_ptr<const PreparedDataSet>& surface) const
  {
    return this->Held && this->Prepared == surface;
  }
  /// \pre Take; so all others.
  Engine& operator*() const { return *this->Held; }
  Engine* operator->() const { return this->Held.get(); }
  const PreparedDataSet& Surface() const { return *this->Prepared; }

  /// Over all surfaces.
  StageCounts Counts() const { return this->Held ? this->Former + this->Held->Counts() : this->Former; }
  long long Bytes() const { return this->Held ? this->Held->Bytes() : 0; }

private:
  std::shared_ptr<const PreparedDataSet> Prepared;
  std::unique_ptr<Engine> Held;
  Options Taken{};
  StageCounts Former{}; ///< of engines before it
};

/// A filter keeps a value from one execution to the next for each leaf of a composite dataset, or for the only dataset; it is found again by
/// its content. Leaves are added while those before take less than a GiB.
/// \tparam Value has Counts() and Bytes(), as EngineOfSurface.
template <class Value>
class Kept
{
public:
  using StageCounts = decltype(std::declval<const Value&>().Counts());

  /// \param filter outlives its events.
  explicit Kept(vtkAlgorithm* filter)
  {
    filter->AddObserver(vtkCommand::StartEvent, this, &Kept::BeginExecution);
    filter->AddObserver(vtkCommand::EndEvent, this, &Kept::EndExecution);
  }
  Kept(const Kept&) = delete;
  Kept& operator=(const Kept&) = delete;

  /// The value of the next leaf. \param digest of its surface (ContentDigest).
  Value& Of(const std::string& digest)
  {
    constexpr long long Limit = 1LL << 30;
    long long bytes = 0;
    this->Leaves.ForEach([&bytes](const Value& value) { bytes += value.Bytes(); });
    ++this->NumberOfLeaves;
    return this->Leaves.Of(digest, bytes < Limit);
  }

  /// Whether the dataset of this execution is a leaf of a composite one.
  bool IsInLeaf() const { return this->OpenExecutions > 1; }
  /// Whether the last leaf was the first one of this execution.
  bool IsFirstLeaf() const { return this->NumberOfLeaves == 1; }

  /// Over all surfaces.
  StageCounts Counts() const
  {
    StageCounts counts = this->Former;
    this->Leaves.ForEach([&counts](const Value& value) { counts = counts + value.Counts(); });
    return counts;
  }

private:
  /// The executions of leaves begin and end within that of their composite dataset.
  void BeginExecution()
  {
    if (this->OpenExecutions++ == 0)
    {
      this->NumberOfLeaves = 0;
      this->Leaves.Begin([this](const Value& value) { this->Former = this->Former + value.Counts(); });
    }
  }
  void EndExecution() { this->OpenExecutions = std::max(0, this->OpenExecutions - 1); }

  LeavesOfExecution<Value> Leaves;
  StageCounts Former{}; ///< of leaves that are forgotten
  int OpenExecutions = 0;
  int NumberOfLeaves = 0; ///< of this execution so far
};

}

#endif
