#ifndef dmgPreparationToFieldData_h
#define dmgPreparationToFieldData_h

#include "Mesh/PositiveSide.h"
#include "Preparation/PreparedSurface.h"

#include <vector>

class vtkAlgorithm;
class vtkDataSet;
class vtkFieldData;

namespace dmg
{

/// Writes what was done to a surface as the text SurfacePreparation, as in "3 cells turned, 12 points joined", and the
/// options as SurfaceOptions, where they are not the default ones. Nothing stands there where nothing was done.
void AddPreparation(const PreparationReport& report, const PreparationOptions& options, vtkFieldData* fieldData);

/// Writes the sides from which counter-clockwise is positive, in words, as PositiveSide.
void AddPositiveSide(const std::vector<PositiveSide>& sides, vtkFieldData* fieldData);

/// The options by which the filter that wrote the field of a surface has prepared it, or the default ones: a field is
/// drawn on the mesh that it was computed on.
PreparationOptions PreparationOf(vtkDataSet* surface);

/// Warns of cells and points that the repair changed.
void WarnOfPreparation(vtkAlgorithm* algorithm, const PreparationReport& report);

}

#endif
