#ifndef dmgFlowPotentials_h
#define dmgFlowPotentials_h

#include "Analysis/BoundaryLoops.h"
#include "Flows/FlowOperators.h"
#include "Setup/PoissonSolver.h"
#include "Setup/SetupCache.h"

#include <Eigen/Cholesky>

#include <optional>
#include <vector>

namespace dmg
{

/// The meaning of the surface's boundary for a flow.
enum class FlowBoundary
{
  /// A coast: nothing flows through it. The stream function is constant on each loop of the boundary, and zero on the longest of
  /// each component; differences between loops are transports between them.
  Closed,
  /// The edge of a region: the potential is zero there.
  Open,
};

/// Potentials and stream functions of flows on one surface: Poisson problems in which no value is fixed, or those on the boundary. Both
/// share one set-up, whatever the boundary is; solvers are made when they are first needed.
class FlowPotentials
{
public:
  /// \param surface is borrowed.
  FlowPotentials(const FramedMesh& surface, const SolverOptions& options);

  /// u, for which grad u is nearest to the flow. Zero on an open boundary.
  /// \throw Cancelled
  Vector<double> Potential(
    const FlowDerivatives& of, FlowBoundary boundary, const StoppingCriteria& stop, const ExecutionContext& context);

  /// psi, for which J grad psi is nearest to the flow. Constant on each loop of a closed boundary.
  /// \throw InvalidInput there are too many loops to hold a function for each.
  /// \throw Cancelled
  Vector<double> StreamFunction(
    const FlowDerivatives& of, FlowBoundary boundary, const StoppingCriteria& stop, const ExecutionContext& context);

  /// The functions that are 1 on one loop and 0 on all others, of all but the first loop of each component; #V x their number.
  /// Cost: a solve for each, once.
  /// \throw as StreamFunction.
  const Eigen::MatrixXd& FunctionsOfLoops(const ExecutionContext& context);

  /// \throw InvalidInput so many functions are too many to hold.
  void CheckNumber(int functions, const std::string& name) const;

  const FramedMesh& Surface() const { return this->Geometry; }
  const std::vector<BoundaryLoop>& Loops() const { return this->LoopsOfBoundary; }
  /// The report of the last solve.
  const SolveReport& Report() const { return this->LastReport; }

  struct StageCounts
  {
    int Setups = 0;    ///< of solvers on the surface
    int Functions = 0; ///< how often those of loops were made
  };
  const StageCounts& Counts() const { return this->CountsOfStages; }

private:
  /// No value is fixed.
  PoissonSolver& Free(const ExecutionContext& context);
  /// All boundaries are; Free where there is none.
  PoissonSolver& Fixed(const ExecutionContext& context);
  PoissonSolver& Make(std::optional<PoissonSolver>& solver, std::vector<int> fixed, const ExecutionContext& context);
  Vector<double> Solve(
    PoissonSolver& solver, const Vector<double>& source, const StoppingCriteria& stop, const ExecutionContext& context);

  const FramedMesh& Geometry;
  SolverOptions Options;
  const std::vector<BoundaryLoop> LoopsOfBoundary;
  SetupCache Setups;
  std::optional<PoissonSolver> FreeSolver;
  std::optional<PoissonSolver> FixedSolver;
  std::optional<Eigen::MatrixXd> StoredFunctions;
  Eigen::LDLT<Eigen::MatrixXd> Energies; ///< of these functions
  SolveReport LastReport;
  StageCounts CountsOfStages;
};

}

#endif
