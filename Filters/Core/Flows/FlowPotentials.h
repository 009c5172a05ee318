#ifndef dmgFlowPotentials_h
#define dmgFlowPotentials_h

#include "Flows/FlowBoundary.h"
#include "Flows/FlowOperators.h"
#include "Setup/PoissonSolver.h"
#include "Setup/SetupCache.h"

#include <Eigen/Cholesky>

#include <list>
#include <optional>
#include <vector>

namespace dmg
{

/// A potential and a stream function, at vertices.
struct FlowFunctions
{
  Vector<double> Potential;
  Vector<double> StreamFunction;
};

/// Potentials and stream functions of flows on one surface: Poisson problems in which values are fixed on the open or on the closed parts
/// of the boundary. All share one set-up, whatever the boundary is; solvers are made when they are first needed.
class FlowPotentials
{
public:
  /// \param surface is borrowed. Its boundary is closed until SetBoundary.
  FlowPotentials(const FramedMesh& surface, const SolverOptions& options);

  /// Takes another boundary. Solvers that serve it, too, stay.
  /// \param isOpen by edge; see PartsOfBoundary.
  void SetBoundary(const std::vector<char>& isOpen);

  /// u, for which grad u is nearest to the flow among the functions that have the given values on open parts.
  /// \param onOpenParts #V; empty: zero.
  /// \throw Cancelled
  Vector<double> Potential(const FlowDerivatives& of, const StoppingCriteria& stop, const ExecutionContext& context,
    const Vector<double>& onOpenParts = {});

  /// psi, for which J grad psi is nearest to the flow. Constant on each coast, and zero on the first one of each component.
  /// \throw InvalidInput there are too many coasts to hold a function for each.
  /// \throw Cancelled
  Vector<double> StreamFunction(
    const FlowDerivatives& of, const StoppingCriteria& stop, const ExecutionContext& context);

  /// The potential and the stream function that are nearest to the flow among those that are zero on all of the boundary.
  /// \throw Cancelled
  FlowFunctions ZeroOnBoundary(
    const FlowDerivatives& of, const StoppingCriteria& stop, const ExecutionContext& context);

  /// The functions that are 1 on one coast and 0 on all others, of all but the first coast of each component; #V x their number.
  /// Cost: a solve for each, once.
  /// \throw as StreamFunction.
  const Eigen::MatrixXd& FunctionsOfCoasts(const ExecutionContext& context);
  /// FunctionsOfCoasts for the open parts. They are not kept.
  Eigen::MatrixXd FunctionsOfOpenParts(const ExecutionContext& context);

  /// \throw InvalidInput there are too many functions to hold.
  void CheckNumber(int functions, const std::string& name) const;

  const FramedMesh& Surface() const { return this->Geometry; }
  const std::vector<BoundaryPart>& Parts() const { return this->PartsOfSurface; }
  /// The set-ups of the surface, which others may share.
  SetupCache& SharedSetups() { return this->Setups; }
  /// The report of the last solve.
  const SolveReport& Report() const { return this->LastReport; }

  struct StageCounts
  {
    int Setups = 0;    ///< of solvers on the surface
    int Functions = 0; ///< how often those of coasts were made
  };
  const StageCounts& Counts() const { return this->CountsOfStages; }

private:
  /// The solver in which these vertices are fixed.
  PoissonSolver& With(const std::vector<int>& fixed, const ExecutionContext& context);
  Vector<double> Solve(PoissonSolver& solver, const Vector<double>& source, const StoppingCriteria& stop,
    const ExecutionContext& context, const Vector<double>& fixed = {});
  Eigen::MatrixXd FunctionsOf(bool areOpen, const ExecutionContext& context);

  const FramedMesh& Geometry;
  SolverOptions Options;
  const std::vector<int> Boundary; ///< its vertices
  std::vector<BoundaryPart> PartsOfSurface;
  std::vector<int> OpenVertices, ClosedVertices;
  SetupCache Setups;
  std::list<PoissonSolver> Solvers;
  std::optional<Eigen::MatrixXd> StoredFunctions;
  Eigen::LDLT<Eigen::MatrixXd> Energies; ///< of these functions
  SolveReport LastReport;
  StageCounts CountsOfStages;
};

}

#endif
