#ifndef dmgSpectrum_h
#define dmgSpectrum_h

#include "Scales/ScaleFilter.h"
#include "Support/ExecutionContext.h"
#include "Support/Types.h"

#include <vector>

namespace dmg
{

/// The energy of a quantity, the integral of its square, by wavelength: a row for each band between two neighbouring bounds. Its rows are
/// differences of the energies that are above the bounds, which low passes do not give as sharply: a single wave is largest, per octave, in
/// the band that has its wavelength, at either order.
struct Spectrum
{
  Vector<double> Wavelengths; ///< of the rows, ascending: the geometric means of the bounds
  Vector<double> Wavenumbers; ///< 2 pi over these
  /// Energies are those of the rows. The first row has all shorter waves as well, and the last one all longer ones; they sum to Total.
  Vector<double> Energies;
  Vector<double> PerOctave;     ///< energies between the bounds, over the octaves between them
  Vector<double> PerWavenumber; ///< the same over the wavenumbers between them
  Vector<double> Above;         ///< the energy above the longer bound of each row
  double Total = 0.0;           ///< without what no wavelength is above of, as means
};

/// Bounds of a number of bands that are equally wide in octaves.
/// \param from, to the first and the last bound.
/// \throw InvalidInput the number is below 1; \p from is not positive, or \p to is not larger and finite.
Vector<double> SpectrumBounds(double from, double to, int rows);

/// \param bounds two or more, > 0, ascending.
/// \param above the energies above each bound.
/// \param total all that is above a bound of zero.
Spectrum SpectrumOf(const Vector<double>& bounds, const Vector<double>& above, double total);

/// The spectra of some quantities. Means of functions do not count.
/// \param filter without fixed vertices.
/// \param bounds see SpectrumOf.
/// \throw as ScaleFilter::Split. Cost: that of Split for each bound and quantity, with one system stage per bound.
std::vector<Spectrum> FindSpectra(ScaleFilter& filter, const std::vector<Vector<double>>& quantities,
  const Vector<double>& bounds, const StoppingCriteria& stop = { 1e-6, 200 },
  const ExecutionContext& context = SerialContext());

}

#endif
