#ifndef dmgFieldSetup_h
#define dmgFieldSetup_h

#include "Discretisations/Discretisation.h"
#include "Levels/ProlongationOperators.h"
#include "Setup/FactorChoice.h"
#include "Setup/FieldOptions.h"
#include "Solvers/MultigridSetup.h"
#include "Solvers/SolverChoice.h"
#include "Support/ExecutionContext.h"

#include <memory>

namespace dmg
{

/// The plan of a solve and the levels of the surface that it needs, decided once, before any work.
struct SolverPlan
{
  SolverChoice Choice;
  SolverChoice Fallback; ///< if the surface turns out to have one level
  /// Whether R and D stay apart (Discretisation::Coarsen); else the system is assembled.
  bool SplitsOperator = false;
  /// Whether the set-up samples the surface itself, and frees the samples when the hierarchy is made.
  bool BuildsSamples = false;
  double SampleDistance = DefaultSampleDistance;
  /// Structure-preserving operators that the solver needs.
  OperatorSelection Selection;

  bool NeedsLevels() const { return this->Choice.Method->NeedsLevels; }
  const SolverChoice& ChoiceOn(const MultigridSetup& setup) const
  {
    return setup.HasLevels ? this->Choice : this->Fallback;
  }
};

/// Whether the solver wants the levels of the thesis, which take long to build and may have been stored: for structure-preserving
/// coarse spaces, and for solvers that start on coarse levels. The others take samples, or factor.
bool WantsDecimation(const FieldOptions& options);

/// \param given operators of the surface, or null: the solver's own.
/// \param obstacles of the surface, harmonic fields included; they count where the solver is to be chosen.
SolverPlan PlanSolver(const Discretisation& discretisation, const FieldOptions& options,
  const ProlongationOperators* given, const CycleObstacles& obstacles);

/// Builds the hierarchy that the plan asks for. Constraints have no influence.
/// \param operators given or built; used during the call only. Null: the system is factored, or samples are computed and freed before
///   the hierarchy is finished. A surface of too few faces for samples is factored.
/// \throw InvalidInput the operators lack those that are needed, or there are none.
/// \throw SolverFailure, Cancelled
/// Cost: assembly, where the system is assembled; else several products of sparse matrices, linear
/// in the number of faces.
std::shared_ptr<const MultigridSetup> MakeSetup(const FramedMesh& surface, const Discretisation& discretisation,
  const ProlongationOperators* operators, const SolverPlan& plan, CoarseSpaceKind space,
  const ExecutionContext& context);

}

#endif
