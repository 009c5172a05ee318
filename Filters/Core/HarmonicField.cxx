#include "HarmonicField.h"

#include "Hierarchy/MeshHierarchy.h"
#include "Mesh/SpatialOrder.h"
#include "Prolongation/NodalProlongation.h"
#include "Prolongation/PowerFieldProlongation.h"
#include "Prolongation/ScalarProlongation.h"
#include "Solvers/CholeskySolver.h"
#include "Solvers/MultigridSolver.h"
#include "Support/Errors.h"
#include "Support/SparseAssembly.h"
#include "Systems/PowerFieldSystem.h"

#include <chrono>
#include <optional>
#include <string>
#include <utility>

namespace dmg
{

namespace
{

// Below this many unknowns the factorisation is done before multigrid has its levels.
constexpr int LargestSystemForCholesky = 20000;

// The couplings between faces are far from those of a linear function where triangles are uneven; the
// coarse levels, nodal by nature, are not. So the interpolation to the faces is smoothed, and the
// finest level gets more sweeps: all that sweeps gain, they gain there.
constexpr int FinestProlongationSteps = 2;
constexpr int FinestSweepsFactor = 2;

double SecondsSince(std::chrono::steady_clock::time_point start)
{
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// The solver that runs, and why if that was left to us.
std::pair<SolverKind, std::string> ChooseSolver(
  SolverKind asked, int unknowns, const ProlongationOperators* operators)
{
  if (asked != SolverKind::Automatic)
  {
    return { asked, "" };
  }
  const std::string size = std::to_string(unknowns) + " unknowns";
  if (!operators || operators->S0.empty())
  {
    return { SolverKind::Cholesky, ", chosen because there are no coarse levels" };
  }
  if (unknowns <= LargestSystemForCholesky)
  {
    return { SolverKind::Cholesky, ", chosen for " + size + ", few enough to factor at once" };
  }
  return { SolverKind::ConjugateGradients, ", chosen for " + size };
}

/// The prolongations on N-power fields; on the finest level only the rows of free unknowns.
std::vector<SparseMatrix<Complex>> Prolongations(const ProlongationOperators& operators,
  CoarseSpaceKind coarseSpace, int N, const std::vector<int>& freeFaces, const ExecutionContext& context)
{
  const std::vector<TransportOperator>& transports =
    coarseSpace == CoarseSpaceKind::Nodal ? operators.Nodal : operators.SP;
  std::vector<SparseMatrix<Complex>> prolongations;
  for (const TransportOperator& transport : transports)
  {
    prolongations.push_back(OnPowers(transport, N, context));
  }
  if (!prolongations.empty() &&
    static_cast<Eigen::Index>(freeFaces.size()) < prolongations[0].rows())
  {
    prolongations[0] = SelectRows(prolongations[0], freeFaces, context);
  }
  return prolongations;
}

/// Back-substitution, reported as one iteration.
void SolveDirectly(const SparseMatrix<Complex>& A, CholeskySolver<Complex>& solver,
  const Vector<Complex>& b, Vector<Complex>& x, SolveReport& report)
{
  const auto start = std::chrono::steady_clock::now();
  solver.Solve(b, x);
  const double norm = b.norm();
  const double residual = norm > 0.0 ? (b - A * x).norm() / norm : 0.0;
  report.SolveSeconds = SecondsSince(start);
  report.Iterations = { { 0, 0.0, 1.0 }, { 1, report.SolveSeconds, residual } };
  report.Converged = true;
}

}

SurfaceHierarchy BuildSurfaceHierarchy(
  const TriangleMesh& mesh, const HierarchyOptions& options, const ExecutionContext& context)
{
  SurfaceHierarchy result;
  ProlongationOperators& operators = result.Operators;
  operators.NumbersOfVertices.push_back(mesh.NumberOfVertices());
  operators.NumbersOfFaces.push_back(mesh.NumberOfFaces());

  // The work is done in an order that is kind to the caches; coarse levels inherit it.
  const SpatialOrder order(mesh, context);
  const TriangleMesh sorted = order.Apply(mesh);
  TangentFrames fineFaceFrames = order.ApplyToFaces(FaceFrames(mesh, context), context);
  std::vector<Complex> fineCornerTurns; // from level 1 on
  result.CoarseLevels =
    BuildMeshHierarchy(sorted, options, context, [&](const LevelTransition& transition) {
      const TriangleMesh& coarse = transition.Coarse;
      TangentFrames coarseFaceFrames = FaceFrames(coarse, context);
      std::vector<Complex> coarseCornerTurns = CornerTurns(coarse, coarseFaceFrames, context);
      SparseMatrix<double> S0 = ScalarProlongation(transition, context);
      TransportOperator SP =
        PowerFieldProlongation(transition, fineFaceFrames, coarseFaceFrames, context);
      operators.Nodal.push_back(operators.Nodal.empty()
          ? FacesFromVertices(sorted, S0, SP, coarse, coarseCornerTurns, context)
          : VerticesFromVertices(transition.Fine, fineCornerTurns, S0, SP, coarse,
              coarseCornerTurns, context));
      operators.S0.push_back(std::move(S0));
      operators.SP.push_back(std::move(SP));
      operators.NumbersOfVertices.push_back(coarse.NumberOfVertices());
      operators.NumbersOfFaces.push_back(coarse.NumberOfFaces());
      fineFaceFrames = std::move(coarseFaceFrames);
      fineCornerTurns = std::move(coarseCornerTurns);
    });

  if (!operators.S0.empty())
  {
    operators.S0[0] = RenumberRows(operators.S0[0], order.Vertices(), context);
    operators.SP[0] = RenumberRows(operators.SP[0], order.Faces(), context);
    operators.Nodal[0] = RenumberRows(operators.Nodal[0], order.Faces(), context);
  }
  return result;
}

class PowerFieldProblem::Internals
{
public:
  explicit Internals(HarmonicSystem<Complex> system)
    : System(std::move(system))
  {
  }

  HarmonicSystem<Complex> System;
  std::optional<CholeskySolver<Complex>> Cholesky;
  std::optional<MultigridSolver<Complex>> Multigrid; // if not Cholesky
  SolverKind Solver = SolverKind::Cholesky;
  SolveReport Report;
  std::vector<std::string> SystemWarnings;
};

PowerFieldProblem::PowerFieldProblem(const TriangleMesh& mesh, const TangentFrames& faceFrames,
  const ProlongationOperators* operators, const PrescribedFaces& prescribed,
  const PowerFieldOptions& options, const ExecutionContext& context)
{
  const auto start = std::chrono::steady_clock::now();
  context.Checkpoint(0.0);
  this->Internal = std::make_unique<Internals>(
    MakePowerFieldSystem(mesh, faceFrames, options.N, prescribed,
      { options.Smoothness, options.Alignment, options.Constraints }, context));
  Internals& internal = *this->Internal;
  const HarmonicSystem<Complex>& system = internal.System;
  SolveReport& report = internal.Report;
  if (const std::string warning = WarningAboutUnreached(system); !warning.empty())
  {
    internal.SystemWarnings.push_back(warning);
  }

  context.Checkpoint(0.2);
  const auto [solver, reason] = ChooseSolver(options.Solver, system.NumberOfFree(), operators);
  internal.Solver = solver;
  if (solver == SolverKind::Cholesky)
  {
    internal.Cholesky.emplace(system.Matrix());
    report.Solver = "supernodal Cholesky" + reason;
    report.Levels = { { system.NumberOfFree(), internal.Cholesky->NonZeros() } };
    report.Bytes = internal.Cholesky->Bytes();
  }
  else
  {
    if (!operators)
    {
      throw InvalidInput("multigrid needs the prolongation operators of the surface");
    }
    MultigridOptions multigrid;
    multigrid.Cycle.Smoothing.PreSweeps = options.Sweeps;
    multigrid.Cycle.Smoothing.PostSweeps = options.Sweeps;
    multigrid.Cycle.FinestFactor = FinestSweepsFactor;
    if (options.CoarseSpace == CoarseSpaceKind::Nodal)
    {
      multigrid.Coarsening.FinestProlongationSteps = FinestProlongationSteps;
    }
    internal.Multigrid.emplace(system.Matrix(),
      Prolongations(
        *operators, options.CoarseSpace, options.N, system.FreeUnknowns(), context),
      multigrid, PartOfContext(context, 0.2, 1.0));
    report.Solver =
      std::string(solver == SolverKind::VCycles ? "V-cycles"
                                                : "conjugate gradients with a V-cycle") +
      (options.CoarseSpace == CoarseSpaceKind::Nodal ? " on nodal levels"
                                                     : " on levels of face powers") +
      reason;
    report.Levels = internal.Multigrid->Levels();
    report.Bytes = internal.Multigrid->Bytes();
  }
  report.PrepareSeconds = SecondsSince(start);
  report.Warnings = internal.SystemWarnings;
  context.Checkpoint(1.0);
}

PowerFieldProblem::~PowerFieldProblem() = default;

Vector<Complex> PowerFieldProblem::Solve(const Vector<Complex>& values,
  const Vector<Complex>& start, const StoppingCriteria& stop, const ExecutionContext& context)
{
  Internals& internal = *this->Internal;
  const HarmonicSystem<Complex>& system = internal.System;
  SolveReport& report = internal.Report;
  report.Warnings = internal.SystemWarnings;
  const Vector<Complex> b = system.RightHandSide(values);
  Vector<Complex> x;
  if (start.size() > 0)
  {
    x = system.Restrict(start);
  }
  switch (internal.Solver)
  {
    case SolverKind::Cholesky:
      SolveDirectly(system.Matrix(), *internal.Cholesky, b, x, report);
      break;
    case SolverKind::VCycles:
      internal.Multigrid->SolveByCycles(b, stop, x, report, context);
      break;
    default:
      internal.Multigrid->SolveByConjugateGradients(b, stop, x, report, context);
      break;
  }
  return system.Expand(x, values);
}

const SolveReport& PowerFieldProblem::Report() const
{
  return this->Internal->Report;
}

}
