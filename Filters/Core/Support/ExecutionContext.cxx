#include "Support/ExecutionContext.h"

#include "Support/Errors.h"

#include <exception>
#include <mutex>

namespace dmg
{

void ExecutionContext::Checkpoint(double fraction) const
{
  this->ReportProgress(fraction);
  if (this->IsCancelled())
  {
    throw Cancelled();
  }
}

void ExecutionContext::ParallelFor(int begin, int end, int grain, const std::function<void(int, int)>& body) const
{
  if (end <= begin)
  {
    return;
  }
  if (end - begin <= grain || this->NumberOfThreads() == 1)
  {
    body(begin, end);
    return;
  }
  // Thread pools do not carry exceptions; the first one is kept and thrown by the caller's thread.
  std::exception_ptr error;
  std::mutex mutex;
  this->RunInParallel(begin, end, grain,
    [&](int first, int last)
    {
      try
      {
        body(first, last);
      }
      catch (...)
      {
        const std::lock_guard<std::mutex> lock(mutex);
        if (!error)
        {
          error = std::current_exception();
        }
      }
    });
  if (error)
  {
    std::rethrow_exception(error);
  }
}

}
