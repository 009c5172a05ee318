#ifndef dmgSpectrumToTable_h
#define dmgSpectrumToTable_h

#include "Scales/Spectrum.h"

#include <string>

class vtkTable;

namespace dmg
{

/// A table with a row for each wavelength of spectra, and columns for each quantity: mean squares, which are energies over the area.
class SpectrumTable
{
public:
  /// \param table is filled; borrowed. \param area in the unit of the energies' integrals.
  SpectrumTable(vtkTable* table, double area)
    : Table(table)
    , Area(area)
  {
  }

  /// Adds the columns of a quantity, after the first one those of the wavelengths. \pre all have the same bounds.
  void Add(const std::string& name, const Spectrum& spectrum) const;
  /// Adds to the field data what has no wavelength.
  void AddHarmonic(const std::string& name, double energy) const;

private:
  vtkTable* const Table;
  const double Area;
};

}

#endif
