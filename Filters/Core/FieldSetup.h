#ifndef dmgFieldSetup_h
#define dmgFieldSetup_h

#include "Discretisations/Discretisation.h"
#include "FactorChoice.h"
#include "FieldOptions.h"
#include "Levels/HierarchyOptions.h"
#include "Levels/ProlongationOperators.h"
#include "Solvers/MultigridSetup.h"
#include "Support/ExecutionContext.h"

#include <memory>

namespace dmg
{

/// The plan of a solve and the levels of the surface that it needs, decided once, before any work.
struct SolverPlan
{
  SolverChoice Choice;
  SolverChoice WithoutLevels; ///< in its place where the surface turns out to have one level
  /// By cycles that keep roughness and penalties apart (Discretisation::Coarsen); else the system is assembled.
  bool KeepsApart = false;
  /// Levels that the solver needs, where none are given.
  HierarchyOptions Levels;
  OperatorSelection Selection; ///< besides the nodal operators

  bool NeedsLevels() const { return this->Choice.Kind != SolverKind::Cholesky; }
  const SolverChoice& ChoiceOn(const MultigridSetup& setup) const
  {
    return setup.HasLevels ? this->Choice : this->WithoutLevels;
  }
  /// Whether Levels are samples that are made, read and forgotten in the set-up.
  bool TakesSamples() const { return this->KeepsApart && this->Levels.Levels == LevelConstruction::Sampling; }
};

/// Whether the solver wants the levels of the thesis, which take long to build and may have been stored: for structure-preserving
/// coarse spaces, and for solvers that start on coarse levels. The others take samples, or factor.
bool WantsDecimation(const FieldOptions& options);

/// \param given operators of the surface, or null: those of Levels will be built.
/// \param obstacles of the surface, harmonic fields included; they count where the solver is to be chosen.
SolverPlan PlanSolver(const Discretisation& discretisation, const FieldOptions& options,
  const ProlongationOperators* given, const CycleObstacles& obstacles);

/// The last part of the set-up: what the planned solver needs of the surface, whatever is prescribed.
/// \param operators given or built; used during the call only. Null: the system is factored, or samples are
///   taken and forgotten as soon as possible; they are much memory, and made in less time than what is made of them.
///   Where there are too few faces for samples the system is factored.
/// \throw InvalidInput the operators lack those that are needed, or there are none.
/// \throw SolverFailure, Cancelled
/// Cost: assembly, where the system is assembled; else several products of sparse matrices, linear
/// in the number of faces.
std::shared_ptr<const MultigridSetup> MakeSetup(const FramedMesh& surface, const Discretisation& discretisation,
  const ProlongationOperators* operators, const SolverPlan& plan, CoarseSpaceKind space,
  const ExecutionContext& context);

}

#endif
