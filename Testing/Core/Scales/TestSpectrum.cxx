// Energy by wavelength.

#include "Scales/Spectrum.h"

#include "Support/Errors.h"
#include "Support/MeshFactory.h"
#include "Support/NamedSurfaces.h"
#include "Support/Random.h"

#include "FlatCylinder.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

using namespace dmg;
using namespace dmg::test;

namespace
{

const StoppingCriteria Tight{ 1e-12, 300 };

Vector<double> Noise(int size)
{
  Random random(4);
  Vector<double> noise(size);
  for (double& number : noise)
  {
    number = random.Uniform(-1.0, 1.0);
  }
  return noise;
}

ScaleFilterOptions OptionsOf(int order)
{
  ScaleFilterOptions options;
  options.Order = order;
  return options;
}

}

TEST(Spectrum, RowsSumToTheWholeVariance)
{
  for (const NamedSurface& named : SmallSurfaces())
  {
    SCOPED_TRACE(named.Name);
    const FramedMesh surface(named.Shape.Mesh());
    const Vector<double> f = Noise(surface.Mesh.NumberOfVertices());
    ScaleFilter filter(surface);
    const Spectrum spectrum = FindSpectra(filter, { f }, SpectrumBounds(0.1, 8.0, 7))[0];
    const Vector<double> varying = filter.Varying(f);
    const double variance = filter.Areas().dot(varying.cwiseAbs2());
    EXPECT_NEAR(spectrum.Total, variance, 1e-14 * variance);
    EXPECT_NEAR(spectrum.Energies.sum(), variance, 1e-12 * variance);
    EXPECT_GT(spectrum.Energies.minCoeff(), -1e-6 * variance);
  }
}

/// Of the modes of a grid, eigenvalues are known but for rounding.
TEST(Spectrum, AModeHasTheEnergiesOfItsAmplitude)
{
  const FlatCylinder cylinder(24, 16);
  const FramedMesh surface(cylinder.Shape().Mesh());
  const Vector<double> mode = cylinder.Mode(3, 2);
  const double wave = cylinder.LengthOf(3, 2);
  const Vector<double> bounds = SpectrumBounds(0.6, 6.0, 12);
  for (const int order : { 1, 2 })
  {
    ScaleFilter filter(surface, OptionsOf(order));
    const Spectrum spectrum = FindSpectra(filter, { mode }, bounds, Tight)[0];
    const auto above = [&](double wavelength)
    { return spectrum.Total * std::pow(1.0 - AmplitudeBelow(wavelength, wave, order), 2); };
    for (int k = 0; k < 12; ++k)
    {
      const double between = above(bounds[k + 1]) - above(bounds[k]);
      EXPECT_NEAR(spectrum.Above[k], above(bounds[k + 1]), 1e-9 * spectrum.Total);
      EXPECT_NEAR(spectrum.PerOctave[k], between / (std::log2(10.0) / 12.0), 1e-8 * spectrum.Total);
      EXPECT_NEAR(
        spectrum.PerWavenumber[k], between / (2.0 * Pi / bounds[k] - 2.0 * Pi / bounds[k + 1]), 1e-8 * spectrum.Total);
    }
  }
}

/// With a share 1 - a of the amplitude above, the energy per octave is proportional to a (1 - a)^2 , which is largest at a = 1/3.
TEST(Spectrum, AModePeaksInTheBandOfItsWavelength)
{
  const FlatCylinder cylinder(40, 24);
  const FramedMesh surface(cylinder.Shape().Mesh());
  for (const int order : { 1, 2 })
  {
    ScaleFilter filter(surface, OptionsOf(order));
    for (const int waves : { 1, 2, 5 })
    {
      const double wave = cylinder.LengthOf(waves, waves);
      const Spectrum spectrum = FindSpectra(filter, { cylinder.Mode(waves, waves) }, SpectrumBounds(0.4, 12.0, 40))[0];
      int peak = 0;
      spectrum.PerOctave.maxCoeff(&peak);
      EXPECT_LT(std::abs(std::log2(spectrum.Wavelengths[peak] / wave)), std::log2(30.0) / 40.0) << waves;
    }
  }
}

TEST(Spectrum, MeansDoNotCount)
{
  const FlatCylinder cylinder(12, 8);
  const FramedMesh surface(cylinder.Shape().Mesh());
  const Vector<double> f = Noise(surface.Mesh.NumberOfVertices());
  ScaleFilter filter(surface);
  const std::vector<Spectrum> spectra =
    FindSpectra(filter, { f, Vector<double>(f.array() + 100.0) }, SpectrumBounds(1.0, 4.0, 5));
  EXPECT_LT((spectra[0].Energies - spectra[1].Energies).cwiseAbs().maxCoeff(), 1e-6 * spectra[0].Total);
}

TEST(Spectrum, BoundsAreEquallyWideAndCheckedByName)
{
  const Vector<double> bounds = SpectrumBounds(1.0, 8.0, 3);
  EXPECT_LT((bounds - Eigen::Vector4d(1, 2, 4, 8)).norm(), 1e-14);
  EXPECT_THROW(SpectrumBounds(1.0, 8.0, 0), InvalidInput);
  EXPECT_THROW(SpectrumBounds(0.0, 8.0, 2), InvalidInput);
  EXPECT_THROW(SpectrumBounds(8.0, 8.0, 2), InvalidInput);
  EXPECT_THROW(SpectrumBounds(1.0, std::numeric_limits<double>::infinity(), 2), InvalidInput);
  EXPECT_THROW(SpectrumOf(Eigen::Vector2d(2, 1), Eigen::Vector2d(0, 0), 1.0), InvalidInput);
}
