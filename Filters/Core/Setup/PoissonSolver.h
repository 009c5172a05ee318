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

/// Finds functions u, linear on faces, with
///
///   L u = source  at free vertices,   u = values  at held ones,   L = d0^T star1 d0 the cotangent Laplacian.
///
/// Vertex v has the integral of the source over its area, so that -Laplace u = f has the source A_v f_v (Star0). On a boundary
/// without held vertices the flux is zero. On a component without held vertices u has a mean of zero by area, and the source
/// has to sum to zero.
///
///   dmg::PoissonSolver solver(surface, { vertex, other });
///   const dmg::Vector<double> u = solver.Solve(source, values);
///
/// The levels of the surface, or the analysis of a factor, are made once, and also serve solvers with other held
/// vertices; each solver makes its matrix once and solves for any number of sources and values. The method is chosen as for fields
/// that are functions (ScalarFunction.h): multigrid for large surfaces and few solves, else a sparse factor.
class PoissonSolver
{
public:
  /// \param surface is borrowed.
  /// \param held vertices, ascending, each once; may be empty.
  /// \param options Kind, ExpectedSolves and Sweeps count. Nested iterations are taken as Automatic.
  /// \throw InvalidInput held vertices are out of range or not ascending.
  /// \throw SolverFailure, Cancelled
  PoissonSolver(const FramedMesh& surface, std::vector<int> held, const SolverOptions& options = {},
    const ExecutionContext& context = SerialContext());
  /// The same with the set-ups of a surface, among which there may be that of functions already.
  PoissonSolver(SetupCache& setups, std::vector<int> held, const SolverOptions& options = {},
    const ExecutionContext& context = SerialContext());
  /// The same surface with other held vertices, whose set-up is shared.
  PoissonSolver(const PoissonSolver& other, std::vector<int> held, const ExecutionContext& context = SerialContext());
  ~PoissonSolver();
  PoissonSolver(PoissonSolver&&) noexcept;

  /// \param source one per vertex, or empty for zero; at held vertices it has no effect.
  /// \param values one per held vertex, or empty for zero.
  /// \param start first guess, one per vertex, or empty. Factors need none.
  /// \return one per vertex. Not converged: the best that was reached; see Report().
  /// \throw InvalidInput numbers are missing or not finite; the source of a component without held vertices does not sum to
  ///   zero, but for 1e-9 of the sum of its magnitudes, and is to be refused.
  /// \throw Cancelled
  Vector<double> Solve(const Vector<double>& source, const Vector<double>& values = {},
    const StoppingCriteria& stop = {}, const ExecutionContext& context = SerialContext(),
    NetSource net = NetSource::Refuse, const Vector<double>& start = {});

  /// The report of the last solve; before one, of the matrix.
  const SolveReport& Report() const;
  /// The number of set-ups of surfaces that this solver and those that share it have made: one, or none where it was there.
  int NumberOfSetups() const;
  const std::vector<int>& Held() const;

private:
  class Internals;
  std::unique_ptr<Internals> Internal;
};

}

#endif
