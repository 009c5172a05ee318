#ifndef dmgExecutionContext_h
#define dmgExecutionContext_h

#include <functional>

namespace dmg
{

/// The link between a long computation and its caller: progress, cancellation and threads.
///
/// The core owns no threads. Filters lend it VTK's (Adapters/ContextFromAlgorithm), tests and
/// benchmarks lend it TBB's (Testing/Support), and SerialContext lends none.
///
/// Same input, same bits, for any number of these threads: an index of a loop writes only its own result, and sums have an
/// order of their own. BLAS has threads besides (OPENBLAS_NUM_THREADS), on which the bits of factors may depend.
class ExecutionContext
{
public:
  virtual ~ExecutionContext() = default;

  /// A point where the computation may stop. There is one at least every tenth of a second unless a function says
  /// otherwise.
  /// \param fraction done of the part at hand, in [0, 1].
  /// \throw Cancelled the caller asked to stop.
  /// Call it from the thread that entered the core, never inside ParallelFor.
  void Checkpoint(double fraction) const;

  /// Calls body(first, last) for consecutive pieces of [begin, end), possibly at the same time.
  /// Pieces hold about \p grain indices; a loop of at most \p grain indices runs in the calling
  /// thread. A body may have loops of its own.
  void ParallelFor(int begin, int end, int grain, const std::function<void(int first, int last)>& body) const;

  /// The number of pieces that may run at the same time; >= 1. Results must not depend on it.
  virtual int NumberOfThreads() const { return 1; }

  /// True as soon as the caller asked to stop.
  virtual bool IsCancelled() const { return false; }

protected:
  /// \param fraction done of the whole computation, in [0, 1].
  virtual void ReportProgress(double fraction) const = 0;

  /// Called only with begin + grain < end.
  virtual void RunInParallel(int begin, int end, int grain, const std::function<void(int, int)>& body) const = 0;

  friend class PartOfContext;
};

/// One thread, no progress, no cancellation.
class SerialContext : public ExecutionContext
{
protected:
  void ReportProgress(double) const override {}
  void RunInParallel(int begin, int end, int, const std::function<void(int, int)>& body) const override
  {
    body(begin, end);
  }
};

/// The part [from, to] of another context's progress, for a function that is one step of several.
class PartOfContext : public ExecutionContext
{
public:
  PartOfContext(const ExecutionContext& whole, double from, double to)
    : Whole(whole)
    , From(from)
    , To(to)
  {
  }

  int NumberOfThreads() const override { return this->Whole.NumberOfThreads(); }
  bool IsCancelled() const override { return this->Whole.IsCancelled(); }

protected:
  void ReportProgress(double fraction) const override
  {
    this->Whole.ReportProgress(this->From + fraction * (this->To - this->From));
  }
  void RunInParallel(int begin, int end, int grain, const std::function<void(int, int)>& body) const override
  {
    this->Whole.RunInParallel(begin, end, grain, body);
  }

private:
  const ExecutionContext& Whole;
  const double From;
  const double To;
};

}

#endif
