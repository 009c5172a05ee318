#include "Scales/Spectrum.h"

#include "Support/Errors.h"
#include "Support/ShortText.h"

#include <cmath>
#include <string>

namespace dmg
{
namespace
{

void CheckBounds(const Vector<double>& bounds)
{
  const Eigen::Index size = bounds.size();
  bool areAscending = size > 1 && bounds[0] > 0.0 && std::isfinite(bounds[size - 1]);
  for (Eigen::Index k = 1; k < size; ++k)
  {
    areAscending &= bounds[k] > bounds[k - 1];
  }
  if (!areAscending)
  {
    throw InvalidInput("the bounds of a spectrum are not two or more positive wavelengths that ascend; give such");
  }
}

}

Vector<double> SpectrumBounds(double from, double to, int rows)
{
  if (rows < 1)
  {
    throw InvalidInput("the spectrum has " + std::to_string(rows) + " rows; give 1 or more");
  }
  if (!(from > 0.0 && to > from && std::isfinite(to)))
  {
    throw InvalidInput("the spectrum goes from the wavelength " + ShortText(from) + " to " + ShortText(to) +
      "; give a positive one, and a longer one");
  }
  Vector<double> bounds(rows + 1);
  for (int k = 0; k <= rows; ++k)
  {
    bounds[k] = from * std::pow(to / from, static_cast<double>(k) / rows);
  }
  return bounds;
}

Spectrum SpectrumOf(const Vector<double>& bounds, const Vector<double>& above, double total)
{
  CheckBounds(bounds);
  const Eigen::Index rows = bounds.size() - 1;
  Spectrum spectrum;
  spectrum.Total = total;
  spectrum.Wavelengths = (bounds.head(rows).array() * bounds.tail(rows).array()).sqrt();
  spectrum.Wavenumbers = 2.0 * Pi / spectrum.Wavelengths.array();
  spectrum.Energies = above.tail(rows) - above.head(rows);
  spectrum.PerOctave =
    spectrum.Energies.array() / (bounds.tail(rows).array() / bounds.head(rows).array()).log() * std::log(2.0);
  spectrum.PerWavenumber = spectrum.Energies.array() /
    (2.0 * Pi * (bounds.head(rows).array().inverse() - bounds.tail(rows).array().inverse()));
  spectrum.Above = above.tail(rows);
  spectrum.Energies[0] += above[0];
  spectrum.Energies[rows - 1] += total - above[rows];
  return spectrum;
}

std::vector<Spectrum> FindSpectra(ScaleFilter& filter, const std::vector<Vector<double>>& quantities,
  const Vector<double>& bounds, const StoppingCriteria& stop, const ExecutionContext& context)
{
  CheckBounds(bounds);
  const auto size = static_cast<Eigen::Index>(quantities.size());
  Eigen::MatrixXd above(bounds.size(), size);
  const double step = 1.0 / static_cast<double>(bounds.size() * std::max<Eigen::Index>(size, 1));
  for (Eigen::Index k = 0; k < bounds.size(); ++k)
  {
    for (Eigen::Index i = 0; i < size; ++i)
    {
      const double done = static_cast<double>(k * size + i) * step;
      above(k, i) =
        filter.Energy(filter.Split(quantities[i], bounds[k], stop, PartOfContext(context, done, done + step)).Above);
    }
  }
  std::vector<Spectrum> spectra;
  for (Eigen::Index i = 0; i < size; ++i)
  {
    spectra.push_back(SpectrumOf(bounds, above.col(i), filter.Energy(filter.Varying(quantities[i]))));
  }
  return spectra;
}

}
