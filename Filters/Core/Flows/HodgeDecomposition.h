#ifndef dmgHodgeDecomposition_h
#define dmgHodgeDecomposition_h

#include "Flows/FlowPotentials.h"
#include "Mesh/PositiveSide.h"

#include <memory>
#include <string>
#include <vector>

namespace dmg
{

/// The parts that are computed; each is the same, whichever others are.
struct FlowParts
{
  bool Gradient = true;
  bool Rotational = true;
  bool Harmonic = true;
  bool Steering = false; ///< two solves more
};

/// A flow as a sum of parts that are orthogonal to each other in the integral over the surface. Parts are vectors on faces,
/// complex numbers in their frames; those that were not asked for are empty. Counter-clockwise is as seen from the positive side of
/// the surface (PositiveSide.h).
struct DecomposedFlow
{
  Vector<Complex> Gradient;   ///< grad u
  Vector<Complex> Rotational; ///< grad psi after a quarter turn counter-clockwise
  Vector<Complex> Harmonic;   ///< a combination of the harmonic basis
  /// The flow without all other parts. With all parts computed, it is the variation within rings of faces that functions linear
  /// on faces do not resolve, and vanishes with the size of the faces where the flow is smooth.
  Vector<Complex> Residual;
  /// The flow that the boundary alone decides: the flow without the gradient of a potential and the turned gradient of a stream function that
  /// are zero on all of the boundary. It has neither divergence nor vorticity inside, whatever the boundary is. It holds the residual, and
  /// is no addend of its own.
  Vector<Complex> Steering;

  Vector<double> Potential;      ///< u, at vertices: a mean of zero on each component where no boundary fixes it
  Vector<double> StreamFunction; ///< psi, the same
  Vector<double> Coefficients;   ///< of the harmonic basis
  FlowDerivatives Derivatives;   ///< of the flow, integrated; FittedDerivatives.h has densities

  // Squared magnitudes, integrated; zero for parts that were not computed.
  double Energy = 0.0; ///< of the flow
  double GradientEnergy = 0.0;
  double RotationalEnergy = 0.0;
  double HarmonicEnergy = 0.0;
  double ResidualEnergy = 0.0;

  // One number per part of the boundary. They sum to the divergence and the vorticity of the surface.
  Vector<double> Flux;         ///< out of the surface
  Vector<double> Circulation;  ///< along the part, with the surface to the left
  Vector<double> StreamValues; ///< the stream function; its mean over parts that are open

  bool Converged = true;
  std::vector<std::string> Warnings; ///< one sentence each, for the user
};

/// Decomposes flows on one surface (HodgeDecomposition.md):
///
///   boundary        potential u           stream function psi       dimension of the harmonic part
///   Closed          any                   constant on each loop     2 g
///   Open            zero on all loops     any                       2 g + b - 1, 2 g on closed components
///   partly open     zero on open parts    constant on each coast    2 g + o - 1, 2 g where o is 0
///
/// for components of genus g with b loops, of which o are open, all or in part. A coast is a loop that is closed, or an arc of one.
/// Solvers and harmonic basis are made when they are first needed and kept: each further flow costs two solves at most.
///
///   dmg::HodgeDecomposition hodge(surface, dmg::FlowBoundary::Closed);
///   const dmg::DecomposedFlow parts = hodge.Decompose(flow);
class HodgeDecomposition
{
public:
  /// \param surface is borrowed.
  /// \param isGlobe the surface lies around the origin, whatever its shape (FindSides).
  HodgeDecomposition(
    const FramedMesh& surface, FlowBoundary boundary, const SolverOptions& options = {}, bool isGlobe = false);
  ~HodgeDecomposition();
  HodgeDecomposition(HodgeDecomposition&&) noexcept;

  /// Takes another boundary. The set-up of the solvers stays.
  void SetBoundary(FlowBoundary boundary);
  /// \param isOpen by edge, #E: whether the boundary is open there; else it is closed. Inner edges do not count.
  void SetBoundary(const std::vector<char>& isOpen);

  /// \param flow #F, in the frames of the faces.
  /// \param stop of the solves. Parts are orthogonal to about its tolerance.
  /// \throw InvalidInput the flow is not finite, has another size, or is longer than 1e40 or shorter than 1e-40 everywhere; harmonic
  ///   fields or coasts are too many to hold.
  /// \throw SolverFailure, Cancelled
  DecomposedFlow Decompose(const Vector<Complex>& flow, const FlowParts& parts = {},
    const StoppingCriteria& stop = { 1e-11, 200 }, const ExecutionContext& context = SerialContext());

  /// An orthonormal basis of the harmonic parts, 2 #F x k: components of vectors in the frames of the faces.
  const Eigen::MatrixXd& HarmonicBasis(const ExecutionContext& context = SerialContext());
  /// A part at the vertices, in their frames: the mean of the faces around, by angle.
  Vector<Complex> AtVertices(const Vector<Complex>& part, const ExecutionContext& context = SerialContext());
  /// The loops of the boundary; of those that are partly open, their arcs.
  const std::vector<BoundaryPart>& Boundaries() const;
  /// The set-ups of the surface, for others that solve for functions on it.
  SetupCache& Setups();
  /// The positive side, by which vorticity, stream functions and circulations have their signs.
  const SidesOfSurface& Sides() const;
  /// The report of the last solve, without a solver before the first.
  const SolveReport& Report() const;

  struct StageCounts
  {
    int Setups = 0; ///< of solvers on the surface
    int Bases = 0;  ///< of harmonic fields or of stream functions of coasts
    int Solves = 0; ///< for potentials and stream functions

    friend StageCounts operator+(const StageCounts& a, const StageCounts& b)
    {
      return { a.Setups + b.Setups, a.Bases + b.Bases, a.Solves + b.Solves };
    }
  };
  StageCounts Counts() const;
  /// The memory of the last solver.
  long long Bytes() const { return this->Report().Bytes; }

private:
  class Internals;
  std::unique_ptr<Internals> Internal;
};

}

#endif
