#ifndef dmgScaleFilter_h
#define dmgScaleFilter_h

#include "Mesh/FramedMesh.h"
#include "Mesh/SurfaceSizes.h"
#include "Solvers/Krylov/SolveReport.h"
#include "Solvers/Krylov/StoppingCriteria.h"
#include "Solvers/SolverOptions.h"
#include "Support/ExecutionContext.h"
#include "Support/Types.h"

#include <memory>
#include <vector>

namespace dmg
{

class ScaleSystem;
class SetupCache;

/// The quantities that are filtered.
enum class ScaledQuantity
{
  /// Values at vertices, one per vertex. The mean over each component of the surface, by area, stays below all wavelengths.
  Function,
  /// Tangent vectors at vertices, two numbers per vertex in VertexFrames, as wholes. A wavenumber is that of the connection
  /// Laplacian, which compares vectors by parallel transport.
  Vectors,
};

struct ScaleFilterOptions
{
  ScaledQuantity Quantity = ScaledQuantity::Function;
  /// 1 or 2. Order 2 separates scales more sharply.
  int Order = 2;
  /// Vertices, ascending, at which a function keeps its values, as a stream function does along a coast. Nothing is above there, and the
  /// harmonic function of these values stays below all wavelengths, as means do elsewhere. Not of vectors.
  std::vector<int> Fixed;
  /// A wavelength that varies: at each vertex it is so many times that of Split, > 0. Empty: 1 everywhere. Constants and means stay, since c^2 scales the
  /// conductivity of the Laplacian. Not of vectors.
  std::vector<double> RelativeWavelengths;
  /// The length of the unit of the points, in the unit of wavelengths.
  double LengthScale = 1.0;
  /// Kind, ExpectedSolves and Sweeps count. Full multigrid is taken as Automatic.
  SolverOptions Solver;
};

/// A quantity as the sum of its larger and its smaller scales.
struct SplitScales
{
  Vector<double> Below; ///< the smooth part, of wavenumbers below that of the wavelength
  Vector<double> Above; ///< the rest; both sum to the quantity, up to rounding of the larger one
};

/// The share of its amplitude that a wave keeps below a wavelength, in (0, 1): 1 / (1 + 2 (wavelength / wave)^(2 order)). A wave of that
/// length keeps a third at either order.
/// \param wave its length.
double AmplitudeBelow(double wavelength, double wave, int order);

/// Values of faces as a function at vertices, which is filtered in their place: the means of the faces around, by what the vertex has of
/// them (VoronoiShares).
Vector<double> FunctionOfFaces(const TriangleMesh& mesh, const Vector<double>& onFaces);
/// The way back: the means of the corners, by the same shares. Both ways keep the mean over the surface.
Vector<double> MeansOfFaces(const TriangleMesh& mesh, const Vector<double>& atVertices);

/// Splits functions or tangent vectors on a surface at a wavelength (Scales.md). With c = wavelength / (2 pi), the part x below solves
///
///   order 1   (M + 2 c^2 L) x = M b
///   order 2   (M + 2 c^4 L M^-1 L) x = M b
///
/// with the Laplacian L and the lumped mass M. A mode of wavenumber k keeps AmplitudeBelow of its length 2 pi / k.
///
///   dmg::ScaleFilter filter(surface);
///   const dmg::SplitScales eddies = filter.Split(height, 200.0);
///
/// The set-up of the surface serves all wavelengths and all quantities of one kind. It is shared with all solvers of a SetupCache. Another
/// wavelength costs coarse matrices or a factor. Another quantity costs one solve.
class ScaleFilter
{
public:
  /// \param surface is borrowed.
  /// \throw InvalidInput the order is neither 1 nor 2; fixed vertices are out of range or not ascending, or are of vectors; so relative
  ///   wavelengths, where they are not positive and finite, or not one per vertex.
  /// \throw SolverFailure, Cancelled
  explicit ScaleFilter(const FramedMesh& surface, const ScaleFilterOptions& options = {},
    const ExecutionContext& context = SerialContext());
  /// \param setups of the surface, which is borrowed.
  explicit ScaleFilter(
    SetupCache& setups, const ScaleFilterOptions& options = {}, const ExecutionContext& context = SerialContext());
  /// A filter of any equations of ScaleSystem, as those of FilterInPieces.
  /// \param options of the system.
  ScaleFilter(std::unique_ptr<ScaleSystem> system, const ScaleFilterOptions& options);
  ~ScaleFilter();
  ScaleFilter(ScaleFilter&&) noexcept;

  /// \param quantity one or two numbers per vertex.
  /// \param wavelength > 0, in the unit of the points times LengthScale. The report warns of one that the mesh does not resolve, or that is longer than the
  ///   surface, with the amplitude that such waves keep.
  /// \param stop The smaller part, as it seems from the quantity, is solved for to the tolerance, relative in the norm of its equations.
  /// \return not converged: the best that was reached; see Report(). Where cycles do not converge in 100 iterations or more, conjugate
  ///   gradients with a factor take over, and a warning says so.
  /// \throw InvalidInput numbers are missing or not finite; the wavelength is not positive and finite.
  /// \throw SolverFailure, Cancelled
  SplitScales Split(const Vector<double>& quantity, double wavelength, const StoppingCriteria& stop = { 1e-6, 200 },
    const ExecutionContext& context = SerialContext());

  /// A function without its means over components, in which nothing is fixed: all that can be above a wavelength. Vectors as they are.
  Vector<double> Varying(const Vector<double>& quantity) const;
  /// The integral of the square of a quantity.
  double Energy(const Vector<double>& quantity) const;
  /// The mean of a function over the surface.
  double Mean(const Vector<double>& function) const;
  /// M, one area per vertex: the weights of means and energies.
  const Vector<double>& Areas() const;
  const SurfaceSizes& Sizes() const;
  /// The report of the last split, empty before the first.
  const SolveReport& Report() const;
  /// Whether this filter has made a set-up of the surface; else it was there.
  bool HasNewSetup() const;

private:
  class Internals;
  std::unique_ptr<Internals> Internal;
};

}

#endif
