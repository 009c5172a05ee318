#ifndef dmgSingularStages_h
#define dmgSingularStages_h

#include "Setup/FieldSolution.h"
#include "Setup/StageCounts.h"
#include "Singularities/SingularFieldSolver.h"

#include <memory>
#include <optional>
#include <vector>

namespace dmg
{

/// A field with prescribed singularities, without its discretisation and constraints.
struct SingularProblem
{
  const std::vector<PrescribedSingularity>& Singularities;
  int N;
  const StoppingCriteria& Stop;
  const SolverOptions& Solver;
};

/// The stages of FieldSolver for fields with prescribed singularities, and their keys. Set-up and system depend on the surface
/// and on solver options, the solve on the singularities; constraints rotate its result.
///
/// Each stage is built as a whole and then put in place: a run that stops half-way leaves nothing half-made.
class SingularStages
{
public:
  /// \param surface, setups are borrowed.
  SingularStages(const FramedMesh& surface, SetupCache& setups);

  /// \param discretisation a power field on faces.
  /// \return Not converged: the best that was reached; see its Report.
  /// \throw as FieldSolver::Solve.
  std::shared_ptr<const FieldSolution> Solve(const SingularProblem& problem,
    std::shared_ptr<const Discretisation> discretisation, const Constraints& constraints,
    const ExecutionContext& context, const ElementNames& names);

  const StageCounts& Counts() const { return this->Completed; }

private:
  /// All that a solve depends on, besides the system.
  struct Key
  {
    std::vector<int> Times;
    int N;
    StoppingCriteria Stop;

    friend bool operator==(const Key& a, const Key& b) { return a.Times == b.Times && a.N == b.N && a.Stop == b.Stop; }
  };

  void MakeSystem(
    const Key& key, const SolverOptions& options, const ExecutionContext& context, const ElementNames& names);

  const FramedMesh& Surface;
  SetupCache& Setups;
  StageCounts Completed;
  std::optional<SurfaceHolonomy> Holonomy;
  std::unique_ptr<SingularFieldSolver> System;
  double SetupSeconds = 0.0; ///< of holonomy and system
  std::optional<Key> KeyOfConnection;
  std::shared_ptr<const SingularField> Connection; ///< of this key; without one, where the next solve starts
  std::shared_ptr<const FieldSolution> Solution;   ///< the connection's field, rotated to the constraints
};

}

#endif
