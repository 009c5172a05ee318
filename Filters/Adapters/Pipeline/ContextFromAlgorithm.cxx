#include "Adapters/Pipeline/ContextFromAlgorithm.h"

#include "vtkAlgorithm.h"
#include "vtkSMPTools.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <exception>

namespace dmg
{

namespace
{

bool SequentialByDefault()
{
  return std::strcmp(vtkSMPTools::GetBackend(), "Sequential") == 0 && std::getenv("VTK_SMP_BACKEND_IN_USE") == nullptr;
}

/// The number of threads of STDThread, within a limit set by the environment or the application.
int NumberOfStandardThreads()
{
  vtkSMPTools::Config config; // limit and nesting as they are
  config.Backend = "STDThread";
  config.NestedParallelism = vtkSMPTools::GetNestedParallelism();
  int threads = 1;
  vtkSMPTools::LocalScope(config, [&threads] { threads = vtkSMPTools::GetEstimatedNumberOfThreads(); });
  return threads;
}

}

ContextFromAlgorithm::ContextFromAlgorithm(vtkAlgorithm* algorithm)
  : Algorithm(algorithm)
  , Caller(std::this_thread::get_id())
  , Threads(1)
{
  if (SequentialByDefault())
  {
    this->Threads = NumberOfStandardThreads();
    this->Arena = std::make_unique<tbb::task_arena>(this->Threads);
  }
  else
  {
    this->Threads = vtkSMPTools::GetEstimatedNumberOfThreads();
  }
}

ContextFromAlgorithm::~ContextFromAlgorithm() = default;

bool ContextFromAlgorithm::IsCancelled() const
{
  if (!this->Cancelled && std::this_thread::get_id() == this->Caller)
  {
#if DMG_VTK_CHECKS_ABORT
    // Also hears of aborts upstream, but not of a flag that was set without its time.
    this->Cancelled = this->Algorithm->GetAbortExecute() || this->Algorithm->CheckAbort();
#else
    this->Cancelled = this->Algorithm->GetAbortExecute() != 0;
#endif
  }
  return this->Cancelled;
}

void ContextFromAlgorithm::ReportProgress(double fraction) const
{
  this->Progress = std::max(this->Progress, fraction);
  this->Algorithm->UpdateProgress(this->Progress);
}

void ContextFromAlgorithm::RunInParallel(int begin, int end, int grain, const std::function<void(int, int)>& body) const
{
  if (this->Arena)
  {
    this->Arena->execute(
      [begin, end, grain, &body]
      {
        tbb::parallel_for(tbb::blocked_range<int>(begin, end, grain),
          [&body](const tbb::blocked_range<int>& piece) { body(piece.begin(), piece.end()); });
      });
    return;
  }
  // Not every backend carries exceptions over to the calling thread.
  std::exception_ptr error;
  std::atomic<bool> failed{ false };
  const auto guarded = [&body, &error, &failed](vtkIdType first, vtkIdType last)
  {
    if (failed)
    {
      return;
    }
    try
    {
      body(static_cast<int>(first), static_cast<int>(last));
    }
    catch (...)
    {
      if (!failed.exchange(true))
      {
        error = std::current_exception();
      }
    }
  };
  vtkSMPTools::For(begin, end, grain, guarded);
  if (error)
  {
    std::rethrow_exception(error);
  }
}

}
