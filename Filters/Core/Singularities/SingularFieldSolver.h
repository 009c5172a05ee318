#ifndef dmgSingularFieldSolver_h
#define dmgSingularFieldSolver_h

#include "Discretisations/FieldConstraints.h"
#include "Setup/PoissonSolver.h"
#include "Setup/SetupCache.h"
#include "Singularities/PrescribedSingularities.h"
#include "Singularities/SurfaceHolonomy.h"

#include <string>
#include <vector>

namespace dmg
{

/// A power field of magnitude 1 that has prescribed singularities and no others, and turns as little as is possible then.
struct SingularField
{
  Vector<double> Potential; ///< by vertex, a first guess for other singularities
  /// Across each edge, from the face of HalfedgeOf(edge) to that of its twin, besides parallel transport; #E.
  Vector<double> Rotation;
  Vector<Complex> Powers; ///< by face, 1 on the first face of each component
  SolveReport Report;
};

/// Finds the power fields of magnitude 1 on one surface that have prescribed singularities and no others (TrivialConnection.h).
/// The set-up are the levels of functions, or a factor; the system is a harmonic form for each handle and hole.
/// SingularStages keeps one, and its fields.
class SingularFieldSolver
{
public:
  /// \param setups of the surface, which may have levels of functions.
  /// \param holonomy of the surface; both are borrowed.
  /// \param asked options: Cholesky, V-cycles and conjugate gradients as asked for; for all others, Automatic.
  /// \throw InvalidInput too many loops.
  /// \throw SolverFailure, Cancelled
  SingularFieldSolver(SetupCache& setups, const SurfaceHolonomy& holonomy, const SolverOptions& asked,
    const ExecutionContext& context = SerialContext());

  /// Whether these options make the same solver.
  bool HasOptions(const SolverOptions& asked) const;
  /// See PoissonSolver.
  bool HasNewSetup() const { return this->Functions.HasNewSetup(); }

  /// \param times N times the index of every vertex (TimesByVertex). \pre they have the right sums (SurfaceHolonomy::CheckSums)
  /// \param stop tolerances above 1e-6 are taken as that.
  /// \param former field with other singularities to start from, or null.
  /// \param names says how messages call vertices.
  /// \return Not converged: the best that was reached; see its Report.
  /// \throw Cancelled
  SingularField Solve(const std::vector<int>& times, int N, const StoppingCriteria& stop = {},
    const SingularField* former = nullptr, const ExecutionContext& context = SerialContext(),
    const ElementNames& names = {});

  /// Turns the field on each component as a whole, to where it is nearest to constraints in the mean of squares.
  /// \param weights of the constrained faces.
  Vector<Complex> TurnedTo(
    const FieldConstraints& constraints, const Vector<double>& weights, const SingularField& field) const;

private:
  void MakeHarmonicForms(const ExecutionContext& context);
  Vector<double> RotationOf(const Vector<double>& potential, int N) const;

  const TriangleMesh& Mesh;
  const SurfaceHolonomy& Holonomy;
  const SolverOptions Options;
  PoissonSolver Functions;
  Vector<double> Star;              ///< of 1-forms
  SparseMatrix<double> Divergences; ///< of the loops, #V x k
  Eigen::MatrixXd Potentials;       ///< u_k, #V x k
  Eigen::MatrixXd Inverse;          ///< of how much forms turn along loops, k x k
  std::vector<std::string> Warnings;
};

}

#endif
