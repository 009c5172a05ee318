// Flows below and above a wavelength, by potential and stream function.

#include "Scales/FlowScales.h"

#include "Flows/FlowOperators.h"
#include "Support/MeshFactory.h"
#include "Support/Random.h"

#include "FlatCylinder.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace dmg;
using namespace dmg::test;

namespace
{

constexpr Complex I(0.0, 1.0);
const StoppingCriteria Tight{ 1e-12, 300 };

Vector<Complex> Noise(int size)
{
  Random random(9);
  Vector<Complex> noise(size);
  for (Complex& vector : noise)
  {
    vector = { random.Uniform(-1.0, 1.0), random.Uniform(-1.0, 1.0) };
  }
  return noise;
}

ScaleFilterOptions OptionsOf(int order)
{
  ScaleFilterOptions options;
  options.Order = order;
  return options;
}

double Largest(const Vector<Complex>& x)
{
  return x.cwiseAbs().maxCoeff();
}

/// The share of a flow that stays below, where it is a mode.
double Kept(const FramedMesh& surface, const Vector<Complex>& below, const Vector<Complex>& flow)
{
  const Vector<double> areas = surface.Mesh.FaceAreas();
  return FlowProduct(areas, below, flow) / FlowProduct(areas, flow, flow);
}

}

TEST(FlowScales, ModesOfAChannelKeepTheirAmplitude)
{
  const FlatCylinder cylinder(24, 12);
  const FramedMesh surface(cylinder.Shape().Mesh());
  HodgeDecomposition hodge(surface, FlowBoundary::Closed);
  const double wavelength = 2.0;
  for (const int order : { 1, 2 })
  {
    FlowScales scales(hodge, OptionsOf(order));
    const Vector<Complex> gradient = GradientOnFaces(surface, cylinder.Mode(2, 3));
    const Vector<Complex> rotational = I * GradientOnFaces(surface, cylinder.Mode(4, 1, true));
    const SplitFlow split = scales.Split(hodge.Decompose(gradient + rotational), wavelength, Tight);
    const double ofGradient = AmplitudeBelow(wavelength, cylinder.LengthOf(2, 3), order);
    const double ofRotational = AmplitudeBelow(wavelength, cylinder.LengthOf(4, 1), order);
    EXPECT_LT(Largest(split.GradientBelow - ofGradient * gradient), 1e-8 * Largest(gradient));
    EXPECT_LT(Largest(split.RotationalBelow - ofRotational * rotational), 1e-8 * Largest(rotational));
    EXPECT_LT(Largest(split.Below + split.Above - gradient - rotational), 1e-9 * Largest(gradient));
    EXPECT_TRUE(scales.ReportOfPotential().Converged);
    EXPECT_TRUE(scales.ReportOfStreamFunction().Converged);
  }
}

/// The even flow through a channel is the turned gradient of the height, which is constant along each coast: the transport between them.
TEST(FlowScales, TransportsBetweenCoastsStayAtAnyWavelength)
{
  const FlatCylinder cylinder(24, 12);
  const FramedMesh surface(cylinder.Shape().Mesh());
  const Vector<Complex> around = I * GradientOnFaces(surface, surface.Mesh.VertexPositions().col(2));
  HodgeDecomposition hodge(surface, FlowBoundary::Closed);
  FlowScales scales(hodge);
  for (const double wavelength : { 0.3, 3.0, 3000.0 })
  {
    EXPECT_LT(Largest(scales.Split(hodge.Decompose(around), wavelength).Above), 1e-9 * Largest(around));
  }
}

TEST(FlowScales, HarmonicFlowsStayAndTheResidualIsAbove)
{
  const FramedMesh surface(IrregularTorus(20, 12, 3).Mesh());
  const Vector<Complex> flow = Noise(surface.Mesh.NumberOfFaces());
  HodgeDecomposition hodge(surface, FlowBoundary::Closed);
  FlowScales scales(hodge);
  const DecomposedFlow parts = hodge.Decompose(flow);
  const SplitFlow whole = scales.Split(parts, 1e-8);
  EXPECT_LT(Largest(whole.Above - parts.Residual), 1e-6 * Largest(flow));
  const SplitFlow none = scales.Split(parts, 1e8);
  EXPECT_LT(Largest(none.Below - parts.Harmonic), 1e-6 * Largest(flow));
  EXPECT_GT(Largest(parts.Harmonic), 1e-3);
}

/// Flat and without sources or vortices: a parallel field, whichever wavelengths there are.
TEST(FlowScales, AnEvenFlowOnAFlatTorusStays)
{
  const FramedMesh torus(FlatTorus(8, 2).Mesh());
  HodgeDecomposition hodge(torus, FlowBoundary::Closed);
  FlowScales scales(hodge);
  const Eigen::VectorXd field = hodge.HarmonicBasis().col(0);
  const Eigen::Map<const Vector<Complex>> flow(
    reinterpret_cast<const Complex*>(field.data()), torus.Mesh.NumberOfFaces());
  const Vector<double> speeds = flow.cwiseAbs();
  EXPECT_LT(speeds.maxCoeff() - speeds.minCoeff(), 1e-9);
  for (const double wavelength : { 0.3, 30.0 })
  {
    EXPECT_LT(Largest(scales.Split(hodge.Decompose(flow), wavelength).Above), 1e-9);
  }
}

/// By the Hodge Laplacian k^2 = l (l + 1): a solid rotation has that of the function z.
TEST(FlowScales, AmplitudesOnTheSphereConvergeWithOrderTwo)
{
  double errors[2];
  for (const int subdivisions : { 3, 4 })
  {
    const FramedMesh sphere(Icosphere(subdivisions).Mesh());
    const Vector<double> z = sphere.Mesh.VertexPositions().col(2);
    const Vector<Complex> rotation = I * GradientOnFaces(sphere, z);
    const Vector<Complex> gradient = GradientOnFaces(sphere, z.array().cube() * 5.0 - 3.0 * z.array()); // l = 3
    HodgeDecomposition hodge(sphere, FlowBoundary::Closed);
    FlowScales scales(hodge);
    const SplitFlow split = scales.Split(hodge.Decompose(rotation + gradient), 2.0, Tight);
    const double ofRotation = AmplitudeBelow(2.0, 2.0 * Pi / std::sqrt(2.0), 2);
    const double ofGradient = AmplitudeBelow(2.0, 2.0 * Pi / std::sqrt(12.0), 2);
    errors[subdivisions - 3] = std::max(std::abs(Kept(sphere, split.RotationalBelow, rotation) - ofRotation),
      std::abs(Kept(sphere, split.GradientBelow, gradient) - ofGradient));
  }
  EXPECT_LT(errors[1], 4e-3);
  EXPECT_GT(errors[0] / errors[1], 3.5);
  EXPECT_LT(errors[0] / errors[1], 4.5);
}

TEST(FlowScales, RowsSumToTheEnergyWithoutTheHarmonicPart)
{
  for (const FlowBoundary boundary : { FlowBoundary::Closed, FlowBoundary::Open })
  {
    const FramedMesh surface(Annulus(24, 6).Mesh());
    HodgeDecomposition hodge(surface, boundary);
    FlowScales scales(hodge);
    const DecomposedFlow parts = hodge.Decompose(Noise(surface.Mesh.NumberOfFaces()));
    const FlowSpectra spectra = scales.FindSpectra(parts, SpectrumBounds(0.1, 4.0, 6));
    EXPECT_NEAR(spectra.Flow.Energies.sum(), parts.Energy - parts.HarmonicEnergy, 1e-9 * parts.Energy);
    EXPECT_NEAR(spectra.Gradient.Energies.sum(), parts.GradientEnergy, 1e-12 * parts.Energy);
    EXPECT_NEAR(spectra.Rotational.Energies.sum(), parts.RotationalEnergy, 1e-12 * parts.Energy);
    const Vector<double> rest = spectra.Flow.Energies - spectra.Gradient.Energies - spectra.Rotational.Energies;
    EXPECT_NEAR(rest[0], parts.ResidualEnergy, 1e-9 * parts.Energy);
    EXPECT_LT(rest.tail(5).cwiseAbs().maxCoeff(), 1e-9 * parts.Energy);
  }
}

TEST(FlowScales, SharesTheSetupOfTheDecomposition)
{
  const FramedMesh surface(IrregularSphere(3, 2).Mesh());
  HodgeDecomposition hodge(surface, FlowBoundary::Closed);
  const DecomposedFlow parts = hodge.Decompose(Noise(surface.Mesh.NumberOfFaces()));
  ScaleFilter filter(hodge.Setups());
  EXPECT_FALSE(filter.HasNewSetup());
}
