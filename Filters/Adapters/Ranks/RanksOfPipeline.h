#ifndef dmgRanksOfPipeline_h
#define dmgRanksOfPipeline_h

#include "vtkSmartPointer.h"
#include "vtkType.h"

#include <functional>
#include <stdexcept>
#include <string>
#include <vector>

class vtkCharArray;
class vtkMultiProcessController;

namespace dmg
{

/// A step has failed on some rank; all ranks throw this.
class FailedTogether : public std::runtime_error
{
public:
  using std::runtime_error::runtime_error;
};

/// The processes of VTK's global controller, as those of a parallel ParaView. But for Rank and Size, every function is collective: all
/// ranks call it, in the same order, from the thread that executes the pipeline.
class RanksOfPipeline
{
public:
  /// The ranks are those of the global controller; there may be none.
  RanksOfPipeline();

  int Rank() const { return this->RankHere; }
  int Size() const { return this->NumberOfRanks; }
  /// Null where there is one process.
  vtkMultiProcessController* Controller() const { return this->All; }

  std::vector<std::string> Gather(const std::string& here) const;
  std::vector<long long> Gather(long long here) const;
  /// Whether all ranks say so.
  bool AreAll(bool here) const;

  /// Runs a step that sends nothing. If it throws anywhere, all ranks throw: Cancelled, or FailedTogether with the message of the
  /// lowest such rank. Otherwise the other ranks would wait for ever.
  void Together(const std::function<void()>& step) const;

  /// Brings a text of bytes to rank 0. \param size on all ranks.
  /// \return the bytes on rank 0; null elsewhere.
  vtkSmartPointer<vtkCharArray> ToFirst(vtkCharArray* bytes, int from, long long size) const;

  /// Brings the bytes of rank 0 to all ranks.
  void FromFirst(vtkCharArray* bytes) const;

private:
  vtkMultiProcessController* All;
  int RankHere = 0;
  int NumberOfRanks = 1;
};

}

#endif
