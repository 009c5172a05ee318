#ifndef dmgFlowScales_h
#define dmgFlowScales_h

#include "Flows/HodgeDecomposition.h"
#include "Scales/ScaleFilter.h"
#include "Scales/Spectrum.h"

#include <optional>

namespace dmg
{

/// A decomposed flow below and above a wavelength: vectors on faces, complex numbers in their frames.
struct SplitFlow
{
  Vector<Complex> GradientBelow;   ///< of the potential below
  Vector<Complex> RotationalBelow; ///< of the stream function below
  Vector<Complex> Below;           ///< both, and the harmonic part
  Vector<Complex> Above;           ///< the rest, with the residual; both sum to the flow
};

/// The energy of a flow by wavelength.
struct FlowSpectra
{
  Spectrum Flow; ///< gradient, rotational part and residual; the residual stands in the first row
  Spectrum Gradient;
  Spectrum Rotational;
};

/// Splits flows at a wavelength by their parts: potential and stream function are filtered as functions (ScaleFilter), with the values that the
/// boundary gives them fixed. So the part below has no sources where the flow has none, nothing flows through its coasts, and
/// transports between coasts stay. The harmonic part is below all wavelengths. A wavenumber is that of the potential or stream function: on a
/// sphere of radius R, k^2 = l (l + 1) / R^2.
///
///   dmg::HodgeDecomposition hodge(surface, dmg::FlowBoundary::Closed);
///   dmg::FlowScales scales(hodge);
///   const dmg::SplitFlow split = scales.Split(hodge.Decompose(flow), 200.0);
class FlowScales
{
public:
  /// \param hodge with the boundary of the flows; its set-up is shared. Borrowed, as its surface is.
  /// \param options Order and Solver count.
  /// \throw as ScaleFilter.
  explicit FlowScales(HodgeDecomposition& hodge, const ScaleFilterOptions& options = {},
    const ExecutionContext& context = SerialContext());

  /// \param parts all of a flow, by the decomposition.
  /// \throw as ScaleFilter::Split. Cost: two solves, and two system stages where the wavelength is another one.
  SplitFlow Split(const DecomposedFlow& parts, double wavelength, const StoppingCriteria& stop = { 1e-6, 200 },
    const ExecutionContext& context = SerialContext());

  /// \param bounds see SpectrumOf. Cost: that of Split for each.
  FlowSpectra FindSpectra(const DecomposedFlow& parts, const Vector<double>& bounds,
    const StoppingCriteria& stop = { 1e-6, 200 }, const ExecutionContext& context = SerialContext());

  /// The reports of the last split.
  const SolveReport& ReportOfPotential() const { return this->Potentials.Report(); }
  const SolveReport& ReportOfStreamFunction() const { return this->OfStreamFunctions().Report(); }
  /// Whether a set-up of the surface has been made for this; else it was there.
  bool HasNewSetup() const { return this->Potentials.HasNewSetup(); }

private:
  const ScaleFilter& OfStreamFunctions() const
  {
    return this->StreamFunctions ? *this->StreamFunctions : this->Potentials;
  }
  /// The vectors of the potential and of the stream function above a wavelength.
  struct PartsAbove
  {
    Vector<Complex> Gradient, Rotational;
  };
  PartsAbove Above(
    const DecomposedFlow& parts, double wavelength, const StoppingCriteria& stop, const ExecutionContext& context);

  const FramedMesh& Surface;
  const Vector<double> Areas; ///< of faces
  const Vector<double> Signs; ///< of stream functions, by vertex, as the cells turn
  ScaleFilter Potentials;
  std::optional<ScaleFilter> StreamFunctions; ///< where other vertices are fixed than for potentials
};

}

#endif
