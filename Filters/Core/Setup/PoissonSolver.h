#ifndef dmgPoissonSolver_h
#define dmgPoissonSolver_h

#include "Mesh/FramedMesh.h"
#include "Operators/FunctionSource.h"
#include "Solvers/Krylov/SolveReport.h"
#include "Solvers/Krylov/StoppingCriteria.h"
#include "Solvers/SolverOptions.h"
#include "Support/ExecutionContext.h"
#include "Support/Types.h"

#include <memory>
#include <vector>

namespace dmg
{

class SetupCache;

/// Solves Poisson problems with the same fixed vertices: finds functions u, linear on faces, with
///
///   L u = source  at free vertices,   u = values  at fixed ones,   L = d0^T star1 d0 the cotangent Laplacian.
///
/// -Laplace u = f has the source IntegratedSource(mesh, f), or lumped Star0 times f. On a boundary without fixed vertices the flux is
/// zero. On a component
/// without fixed vertices the integral of u is zero, and the source has to sum to zero.
///
///   dmg::PoissonSolver solver(surface, { vertex, other });
///   const dmg::Vector<double> u = solver.Solve(source, values);
///
/// The problem is that of fields that are functions with hard constraints (ScalarFunction.h), and so is the choice of the method. A
/// solver makes its matrix once. The levels of the surface, or the analysis of a factor, are made once for all solvers of a SetupCache.
class PoissonSolver
{
public:
  /// \param surface is borrowed.
  /// \param fixed vertices, ascending, each once; may be empty.
  /// \param options Kind, ExpectedSolves and Sweeps count. Full multigrid is taken as Automatic.
  /// \throw InvalidInput fixed vertices are out of range or not ascending.
  /// \throw SolverFailure, Cancelled
  PoissonSolver(const FramedMesh& surface, std::vector<int> fixed, const SolverOptions& options = {},
    const ExecutionContext& context = SerialContext());
  /// \param setups of the surface, which is borrowed.
  PoissonSolver(SetupCache& setups, std::vector<int> fixed, const SolverOptions& options = {},
    const ExecutionContext& context = SerialContext());
  ~PoissonSolver();
  PoissonSolver(PoissonSolver&&) noexcept;

  /// \param source one per vertex, or empty for zero; at fixed vertices it has no effect.
  /// \param values one per fixed vertex, or empty for zero.
  /// \param start first guess, one per vertex, or empty. Factors need none.
  /// \return one per vertex. Not converged: the best that was reached; see Report().
  /// \throw InvalidInput numbers are missing or not finite; the source of a component without fixed vertices does not sum to
  ///   zero, but for 1e-9 of the sum of its magnitudes, and is to be refused.
  /// \throw Cancelled
  Vector<double> Solve(const Vector<double>& source, const Vector<double>& values = {},
    const StoppingCriteria& stop = {}, const ExecutionContext& context = SerialContext(),
    NetSource net = NetSource::Refuse, const Vector<double>& start = {});

  /// The report of the last solve; before one, of the matrix.
  const SolveReport& Report() const;
  /// Whether this solver has made a set-up of the surface; else it was there.
  bool HasNewSetup() const;
  const std::vector<int>& Fixed() const;

private:
  class Internals;
  std::unique_ptr<Internals> Internal;
};

}

#endif
