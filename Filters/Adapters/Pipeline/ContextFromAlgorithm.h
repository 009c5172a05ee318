#ifndef dmgContextFromAlgorithm_h
#define dmgContextFromAlgorithm_h

#include "Support/ExecutionContext.h"

#include "vtkVersionMacros.h"

#include <tbb/task_arena.h>

#include <atomic>
#include <memory>
#include <thread>

// VTK 9.2 of ParaView 5.11 is the first whose algorithms also hear of aborts upstream.
#define DMG_VTK_CHECKS_ABORT (VTK_VERSION_NUMBER >= VTK_VERSION_CHECK(9, 2, 20230111))

class vtkAlgorithm;

namespace dmg
{

/// Lends a filter's progress, abort flag and VTK's threads to the core, for one execution. Progress never goes back: where a part of the work is done once more,
/// it stands.
///
/// Threads are those of vtkSMPTools with its backend and limit. Where the backend is Sequential and
/// nobody asked for that (ParaView's packages default to it), they are TBB's, as many as STDThread
/// would start: that one does so for every loop, which made solving half as slow again.
/// VTK_SMP_BACKEND_IN_USE=Sequential keeps loops in one thread.
class ContextFromAlgorithm : public ExecutionContext
{
public:
  /// Borrows the algorithm. To be made in the thread that executes it.
  explicit ContextFromAlgorithm(vtkAlgorithm* algorithm);
  ~ContextFromAlgorithm() override;

  int NumberOfThreads() const override { return this->Threads; }

  /// Asks the algorithm when called by the thread that made this object; other threads hear the
  /// answer of the last time.
  bool IsCancelled() const override;

protected:
  void ReportProgress(double fraction) const override;

  /// An exception in the body ends the loop early and is thrown again in the calling thread.
  void RunInParallel(int begin, int end, int grain, const std::function<void(int, int)>& body) const override;

private:
  vtkAlgorithm* const Algorithm;
  const std::thread::id Caller;
  std::unique_ptr<tbb::task_arena> Arena; // null: vtkSMPTools
  int Threads;
  mutable std::atomic<bool> Cancelled{ false };
  mutable double Progress = 0.0; // told so far
};

}

#endif
