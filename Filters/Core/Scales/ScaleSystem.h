#ifndef dmgScaleSystem_h
#define dmgScaleSystem_h

#include "Mesh/SurfaceSizes.h"
#include "Scales/ScaleFilter.h"
#include "Setup/FieldOptions.h"
#include "Solvers/Krylov/LinearOperator.h"
#include "Solvers/Krylov/SolveReport.h"
#include "Solvers/Krylov/StoppingCriteria.h"
#include "Support/ExecutionContext.h"
#include "Support/Types.h"

#include <functional>
#include <memory>

namespace dmg
{

/// The matrices of a scale filter and their solver, wherever the unknowns are: all on one process, or on each rank those of its piece. Then all
/// functions but the constant ones of data are collective, and sizes are those of the whole surface.
///
/// A quantity has numbers by vertex. Unknowns are those of it that this process solves for, in the order of its solver.
class ScaleSystem
{
public:
  virtual ~ScaleSystem() = default;

  Vector<double> Areas; ///< by vertex; zero where another process has the unknowns
  int NumbersPerVertex = 1;
  SurfaceSizes Sizes;
  double MeanArea = 1.0;          ///< of vertices
  Vector<double> Mass;            ///< areas of unknowns over MeanArea
  double LargestEigenvalue = 0.0; ///< of M^-1 R, about
  bool HasFixed = false;          ///< whether some vertices keep their values
  bool HasUnknowns = true;        ///< whether not all do
  bool HasNewSetup = true;        ///< whether the set-up of the surface was made for this system

  /// R, without the rows that are fixed.
  virtual const LinearOperator<double>& Stiffness() const = 0;
  /// R + s M. \pre SetShift.
  virtual const LinearOperator<double>& Shifted() const = 0;

  /// The system stage: makes R + s M and an approximate inverse of R + s' M.
  /// \param report gets the solver, its levels and bytes.
  virtual void SetShift(double s, double ofInverse, SolveReport& report, const ExecutionContext& context) = 0;
  /// Solves A x = b with that inverse.
  /// \param isSquared A is R M^-1 R + s^2 M rather than R + s M.
  virtual Vector<double> Solve(const LinearOperator<double>& A, bool isSquared, const Vector<double>& b,
    const StoppingCriteria& stop, SolveReport& report, const ExecutionContext& context) = 0;

  /// Makes the mean of a function zero on each component in which nothing is fixed.
  virtual void Centre(Vector<double>& quantity) const = 0;
  virtual Vector<double> UnknownsOf(const Vector<double>& quantity, const ExecutionContext& context) const = 0;
  virtual Vector<double> QuantityOf(const Vector<double>& unknowns, const ExecutionContext& context) const = 0;

  /// The largest of the numbers of all processes.
  virtual double Max(double here) const { return here; }
  /// Runs a step that may throw, so that all processes throw where one does.
  virtual void Together(const std::function<void()>& step) const { step(); }
};

/// The options of the set-up that these options need.
FieldOptions FieldOptionsOf(const ScaleFilterOptions& options);

/// \throw InvalidInput as the constructor of ScaleFilter.
void CheckOptions(const ScaleFilterOptions& options, int numberOfVertices);

/// The equations on one process.
/// \param setups of the surface, borrowed.
std::unique_ptr<ScaleSystem> SystemOfSurface(
  SetupCache& setups, const ScaleFilterOptions& options, const ExecutionContext& context);

}

#endif
