#ifndef dmgSetupCache_h
#define dmgSetupCache_h

#include "Setup/FieldSetup.h"

#include <memory>
#include <optional>
#include <tuple>
#include <vector>

namespace dmg
{

/// The set-up of a solve.
struct PlannedSetup
{
  std::shared_ptr<const MultigridSetup> Levels; ///< or the matrix to factor
  SolverChoice Choice;                          ///< the method that runs on them
  double Seconds = 0.0;                         ///< spent on them, be it in an earlier call
  bool IsNew = false;                           ///< rather than found
  bool HasNewLevels = false;                    ///< whether levels of the surface have been built since the last call
};

/// The set-ups of one surface, whatever is solved for on it: fields of any discretisation, and functions (PoissonSolver).
/// Their key is all that they depend on, compared by contents.
///
/// Levels of the thesis that were built are all kept. So are set-ups, while there is room (SetMemoryLimit): going back to a
/// former N costs none.
class SetupCache
{
public:
  /// \param surface is borrowed.
  explicit SetupCache(const FramedMesh& surface)
    : Surface(surface)
  {
  }

  /// Sets the number of bytes up to which set-ups that are not in use are kept. The default, 1 GiB, is some dozen set-ups of power
  /// fields on a quarter of a million triangles.
  void SetMemoryLimit(long long bytes);

  /// Finds the set-up for these options, or makes it.
  /// \param discretisation that options.Field names.
  /// \param given operators of the surface, or null: the solver's own.
  /// \throw InvalidInput the operators lack those that are needed.
  /// \throw SolverFailure, Cancelled
  PlannedSetup Take(const Discretisation& discretisation, const FieldOptions& options,
    const std::shared_ptr<const ProlongationOperators>& given, const ExecutionContext& context);

  const FramedMesh& Surface;

private:
  /// All that a set-up depends on, besides the surface.
  struct Key
  {
    DiscretisationOptions Field; ///< OptionsThatCount
    CoarseSpaceKind Space;
    bool IsFactored;
    bool SplitsOperator;
    std::shared_ptr<const ProlongationOperators> Operators; ///< null for samples and factors

    friend bool operator==(const Key& a, const Key& b)
    {
      const auto members = [](const Key& key)
      {
        // A member that is forgotten here does not compile.
        const auto& [field, space, isFactored, splits, operators] = key;
        return std::tie(field, space, isFactored, splits, operators);
      };
      return members(a) == members(b);
    }
  };

  struct Entry
  {
    SetupCache::Key Key;
    std::shared_ptr<const MultigridSetup> Levels;
    double Seconds;
  };

  /// Operators of the thesis's levels.
  struct DecimatedOperators
  {
    OperatorSelection Selection;
    std::shared_ptr<const ProlongationOperators> Operators;
    double Seconds;
  };

  const DecimatedOperators& Decimate(const OperatorSelection& selection, const ExecutionContext& context);
  void Forget();

  std::optional<CycleObstacles> Obstacles; ///< of the surface
  std::optional<DecimatedOperators> Decimated;
  std::vector<Entry> Entries; ///< the last one that was asked for stands last
  long long MemoryLimit = 1LL << 30;
  bool HasNewLevels = false;
};

}

#endif
