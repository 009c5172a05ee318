#include "Setup/SetupCache.h"

#include "Discretisations/MakeDiscretisation.h"
#include "StructurePreserving/SurfaceHierarchy.h"
#include "Support/Stopwatch.h"

#include <algorithm>
#include <utility>

namespace dmg
{

const SetupCache::DecimatedOperators& SetupCache::Decimate(
  const OperatorSelection& asked, const ExecutionContext& context)
{
  OperatorSelection selection = asked;
  if (this->Decimated && this->Decimated->Selection.Includes(selection))
  {
    return *this->Decimated;
  }
  if (this->Decimated)
  {
    selection.Add(this->Decimated->Selection); // what was built once is kept when more is needed
  }
  const Stopwatch watch;
  auto operators = std::make_shared<const ProlongationOperators>(
    BuildSurfaceHierarchy(this->Surface.Mesh, HierarchyOptions(), context, selection).Operators);
  this->Decimated = DecimatedOperators{ selection, std::move(operators), watch.Seconds() };
  this->HasNewLevels = true;
  return *this->Decimated;
}

PlannedSetup SetupCache::Take(const Discretisation& discretisation, const FieldOptions& options,
  const std::shared_ptr<const ProlongationOperators>& given, const ExecutionContext& context)
{
  if (!this->Obstacles)
  {
    constexpr bool HasHarmonicFields = true;
    this->Obstacles = ObstaclesOf(this->Surface.Mesh, HasHarmonicFields, context);
  }
  const SolverPlan plan = PlanSolver(discretisation, options, given.get(), *this->Obstacles);
  std::shared_ptr<const ProlongationOperators> operators = plan.NeedsLevels() ? given : nullptr;
  double seconds = 0.0;
  if (plan.NeedsLevels() && !given && !plan.BuildsSamples)
  {
    const DecimatedOperators& decimated = this->Decimate(plan.Selection, PartOfContext(context, 0.0, 0.6));
    operators = decimated.Operators;
    seconds = decimated.Seconds;
  }
  const Key key{ OptionsThatCount(options.Field), options.CoarseSpace, !plan.NeedsLevels(), plan.SplitsOperator,
    operators };
  const auto known =
    std::find_if(this->Entries.begin(), this->Entries.end(), [&key](const Entry& entry) { return entry.Key == key; });
  const bool isNew = known == this->Entries.end();
  if (!isNew)
  {
    std::rotate(known, known + 1, this->Entries.end());
  }
  else
  {
    const Stopwatch watch;
    auto levels = MakeSetup(this->Surface, discretisation, operators.get(), plan, options.CoarseSpace,
      PartOfContext(context, operators ? 0.6 : 0.0, 1.0));
    this->HasNewLevels |= plan.BuildsSamples;
    this->Entries.push_back({ key, std::move(levels), watch.Seconds() });
    this->Forget();
  }
  const Entry& entry = this->Entries.back();
  return { entry.Levels, plan.ChoiceOn(*entry.Levels), seconds + entry.Seconds, isNew,
    std::exchange(this->HasNewLevels, false) };
}

void SetupCache::SetMemoryLimit(long long bytes)
{
  this->MemoryLimit = bytes;
  this->Forget();
}

/// The oldest ones that there is no room for; never the last.
void SetupCache::Forget()
{
  long long bytes = 0;
  auto first = this->Entries.end();
  while (first != this->Entries.begin())
  {
    bytes += (first - 1)->Levels->Bytes();
    if (bytes > this->MemoryLimit && first != this->Entries.end())
    {
      break;
    }
    --first;
  }
  this->Entries.erase(this->Entries.begin(), first);
}

}
