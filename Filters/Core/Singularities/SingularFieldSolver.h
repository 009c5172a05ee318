#ifndef dmgSingularFieldSolver_h
#define dmgSingularFieldSolver_h

#include "Discretisations/Constraints/FieldConstraints.h"
#include "Setup/PoissonSolver.h"
#include "Setup/SetupCache.h"
#include "Singularities/PrescribedSingularities.h"
#include "Singularities/SurfaceHolonomy.h"

#include <string>
#include <vector>

namespace dmg
{

/// A power field of magnitude 1 with prescribed singularities and no others, of the least rotation.
struct SingularField
{
  Vector<double> Potential; ///< by vertex, a first guess for other singularities
  /// Across each edge, from the face of HalfedgeOf(edge) to that of its twin, besides parallel transport; #E.
  Vector<double> Rotation;
  Vector<Complex> Powers; ///< by face, 1 on the first face of each component
  SolveReport Report;
};

/// Finds the power fields of magnitude 1 on one surface with prescribed singularities and no others (TrivialConnection.h). The set-up is
/// that of functions; the system is a harmonic form for each homology generator. SingularStages keeps one, and its fields.
class SingularFieldSolver
{
public:
  /// \param setups of the surface, which may have levels of functions.
  /// \param holonomy of the surface; both are borrowed.
  /// \param asked options: Cholesky, V-cycles and conjugate gradients as asked for; for all others, Automatic.
  /// \throw InvalidInput there are too many homology generators.
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

  /// Rotates the field rigidly on each component, nearest to the constraints by least squares.
  /// \param weights of the constrained faces.
  Vector<Complex> RotatedTo(
    const FieldConstraints& constraints, const Vector<double>& weights, const SingularField& field) const;

private:
  void MakeHarmonicForms(const ExecutionContext& context);
  Vector<double> RotationOf(const Vector<double>& potential, int N) const;

  const TriangleMesh& Mesh;
  const SurfaceHolonomy& Holonomy;
  const SolverOptions Options;
  PoissonSolver Functions;
  Vector<double> Star;              ///< of 1-forms
  SparseMatrix<double> Divergences; ///< of the generators, #V x k
  Eigen::MatrixXd Potentials;       ///< u_k, #V x k
  Eigen::MatrixXd Inverse;          ///< of w_j^T star1 w_k, k x k
  std::vector<std::string> Warnings;
};

}

#endif
