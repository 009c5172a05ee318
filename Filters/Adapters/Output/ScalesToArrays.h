#ifndef dmgScalesToArrays_h
#define dmgScalesToArrays_h

#include "Adapters/Input/QuantitiesFromArrays.h"
#include "Adapters/Surface/ScaleSurface.h"
#include "Adapters/View/SurfaceView.h"
#include "Support/ExecutionContext.h"
#include "Support/Types.h"

#include <string>
#include <vector>

class vtkTable;

namespace dmg
{

/// The results of a scale filter that somebody wants.
struct ScaleOptions
{
  std::vector<double>
    Wavelengths; ///< in the unit of the points times the length scale; empty: one of ten mean edges, or 1 where it varies
  bool AreWholes = false;  ///< vectors are filtered as wholes rather than by their parts
  bool PartsApart = false; ///< of flows that are not, both parts are written, too
  double Tolerance = 1e-6;
  bool HasSpectrum = true;
  double SpectrumFrom = 0.0; ///< wavelengths; 0: four mean edges
  double SpectrumTo = 0.0;   ///< 0: twice the root of the area
  int SpectrumRows = 24;
};

/// A function of a dataset on its way through the filter.
struct ReadFunction
{
  std::string Name;
  bool IsOnPoints = true;
  Vector<double> Given;      ///< by vertex or face
  Vector<double> AtVertices; ///< what is filtered
};

/// A flow of a dataset.
struct ReadFlow
{
  std::string Name;
  bool IsOnPoints = true;
  Vector<Complex> Given;     ///< tangential, by vertex or face
  Vector<double> AtVertices; ///< what is filtered as a whole
  DecomposedFlow Parts;      ///< what is filtered else
};

/// All that is filtered.
struct ReadQuantities
{
  std::vector<ReadFunction> Functions;
  std::vector<ReadFlow> Flows;
};

/// Adds the arrays of vtkScaleFilter to the output of a view of a surface.
/// \param spectrum an empty table.
/// \return warnings for the user.
/// \throw InvalidInput as ScaleFilter, HodgeDecomposition and SpectrumBounds.
std::vector<std::string> AddScales(ScaleSurface& surface, const QuantityArrays& quantities, const ScaleOptions& options,
  const SurfaceView& view, vtkTable* spectrum, const ExecutionContext& context);
/// The same for quantities that were read already, not by parts.
std::vector<std::string> AddScales(ScaleSurface& surface, ReadQuantities quantities, const ScaleOptions& options,
  const SurfaceView& view, vtkTable* spectrum, const ExecutionContext& context);

}

#endif
