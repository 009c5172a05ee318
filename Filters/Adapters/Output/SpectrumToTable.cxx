#include "Adapters/Output/SpectrumToTable.h"

#include "Adapters/Surface/ArrayNames.h"
#include "Adapters/Surface/NewArrays.h"

#include "vtkDataSetAttributes.h"
#include "vtkTable.h"

namespace dmg
{

void SpectrumTable::Add(const std::string& name, const Spectrum& spectrum) const
{
  const auto add = [this](const std::string& column, const Vector<double>& numbers)
  { this->Table->AddColumn(NewArray<vtkDoubleArray>(column, 1, numbers)); };
  if (this->Table->GetNumberOfColumns() == 0)
  {
    add(ArrayNames::Wavelength, spectrum.Wavelengths);
    add(ArrayNames::Wavenumber, spectrum.Wavenumbers);
  }
  add(name + ArrayNames::PerOctave, spectrum.PerOctave / this->Area);
  add(name + ArrayNames::PerWavenumber, spectrum.PerWavenumber / this->Area);
  add(name + ArrayNames::InBand, spectrum.Energies / this->Area);
  add(name + ArrayNames::AllAbove, spectrum.Above / this->Area);
  this->Table->GetFieldData()->AddArray(
    NewValue<vtkDoubleArray>(name + ArrayNames::Variance, spectrum.Total / this->Area));
}

void SpectrumTable::AddHarmonic(const std::string& name, double energy) const
{
  this->Table->GetFieldData()->AddArray(
    NewValue<vtkDoubleArray>(name + ArrayNames::HarmonicVariance, energy / this->Area));
}

}
