#include "Scales/FlowScales.h"

#include "Flows/FlowBoundary.h"
#include "Flows/FlowOperators.h"
#include "Setup/SetupCache.h"

namespace dmg
{
namespace
{

constexpr Complex QuarterTurn(0.0, 1.0);

ScaleFilterOptions WithFixed(const ScaleFilterOptions& asked, const HodgeDecomposition& hodge, bool areOpen)
{
  ScaleFilterOptions options = asked;
  options.Quantity = ScaledQuantity::Function;
  options.Fixed = VerticesOfParts(hodge.Boundaries(), areOpen);
  return options;
}

}

FlowScales::FlowScales(HodgeDecomposition& hodge, const ScaleFilterOptions& asked, const ExecutionContext& context)
  : Surface(hodge.Setups().Surface)
  , Areas(this->Surface.Mesh.FaceAreas())
  , Signs(hodge.Sides().OfVertices)
  , Potentials(hodge.Setups(), WithFixed(asked, hodge, true), context)
{
  if (!hodge.Boundaries().empty())
  {
    this->StreamFunctions.emplace(hodge.Setups(), WithFixed(asked, hodge, false), context);
  }
}

FlowScales::PartsAbove FlowScales::Above(
  const DecomposedFlow& parts, double wavelength, const StoppingCriteria& stop, const ExecutionContext& context)
{
  ScaleFilter& ofStreamFunctions = this->StreamFunctions ? *this->StreamFunctions : this->Potentials;
  const Vector<double> u =
    this->Potentials.Split(parts.Potential, wavelength, stop, PartOfContext(context, 0.0, 0.5)).Above;
  const Vector<double> psi =
    ofStreamFunctions.Split(parts.StreamFunction, wavelength, stop, PartOfContext(context, 0.5, 1.0)).Above;
  return { GradientOnFaces(this->Surface, u, context),
    QuarterTurn * GradientOnFaces(this->Surface, psi.cwiseProduct(this->Signs), context) };
}

SplitFlow FlowScales::Split(
  const DecomposedFlow& parts, double wavelength, const StoppingCriteria& stop, const ExecutionContext& context)
{
  const PartsAbove above = this->Above(parts, wavelength, stop, context);
  SplitFlow split;
  split.GradientBelow = parts.Gradient - above.Gradient;
  split.RotationalBelow = parts.Rotational - above.Rotational;
  split.Below = split.GradientBelow + split.RotationalBelow + parts.Harmonic;
  split.Above = above.Gradient + above.Rotational + parts.Residual;
  return split;
}

FlowSpectra FlowScales::FindSpectra(const DecomposedFlow& parts, const Vector<double>& bounds,
  const StoppingCriteria& stop, const ExecutionContext& context)
{
  const Eigen::Index size = bounds.size();
  Vector<double> ofGradient(size), ofRotational(size);
  for (Eigen::Index k = 0; k < size; ++k)
  {
    const double step = 1.0 / static_cast<double>(size);
    const double done = static_cast<double>(k) * step;
    const PartsAbove above = this->Above(parts, bounds[k], stop, PartOfContext(context, done, done + step));
    ofGradient[k] = FlowProduct(this->Areas, above.Gradient, above.Gradient);
    ofRotational[k] = FlowProduct(this->Areas, above.Rotational, above.Rotational);
  }
  const Vector<double> ofFlow = (ofGradient + ofRotational).array() + parts.ResidualEnergy;
  return { SpectrumOf(bounds, ofFlow, parts.GradientEnergy + parts.RotationalEnergy + parts.ResidualEnergy),
    SpectrumOf(bounds, ofGradient, parts.GradientEnergy), SpectrumOf(bounds, ofRotational, parts.RotationalEnergy) };
}

}
