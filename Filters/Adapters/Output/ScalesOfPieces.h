#ifndef dmgScalesOfPieces_h
#define dmgScalesOfPieces_h

#include "Adapters/Input/QuantitiesFromArrays.h"
#include "Adapters/Output/ScalesToArrays.h"
#include "Adapters/Ranks/RanksOfPipeline.h"
#include "Adapters/Surface/SolverOfPieces.h"
#include "Support/ExecutionContext.h"

#include <functional>
#include <string>

class vtkAlgorithm;
class vtkDataSet;
class vtkInformationVector;

namespace dmg
{

/// Scale filters for the datasets of all ranks, each of which has a piece of a surface; kept from one execution to the next.
class ScalesOfPieces
{
public:
  /// The quantities of the piece of this rank.
  using FindFunction = std::function<QuantityArrays(vtkDataSet* piece)>;

  /// Collective: makes the outputs of vtkScaleFilter, each rank's of its own piece; rank 0 has the spectrum and reports the warnings.
  /// \param preparation with the numbering of the caller.
  /// \return the reason why it does not: a clause for the user; empty where it does.
  std::string Filter(vtkAlgorithm* filter, const FindFunction& find, const ScaleSurface::Settings& settings,
    const ScaleOptions& options, const PreparationOptions& preparation, const RanksOfPipeline& ranks,
    vtkInformationVector** inputs, vtkInformationVector* outputs, const ExecutionContext& context);

  const ScaleSurface::StageCounts& Counts() const { return this->Scales.Counts(); }

private:
  SolverOfPieces Pieces;
  int SurfaceOfScales = 0; ///< by SolverOfPieces::NumberOfSurfaces
  ScaleSurface Scales;     ///< refers to the pieces
};

}

#endif
