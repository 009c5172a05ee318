#ifndef dmgGatheredInputs_h
#define dmgGatheredInputs_h

#include "Adapters/Ranks/RanksOfPipeline.h"

#include "vtkSmartPointer.h"

#include <string>
#include <vector>

class vtkAlgorithm;
class vtkInformation;
class vtkInformationVector;

namespace dmg
{

/// Whether the dataset of a filter's first input may be in pieces: a vtkPolyData or a vtkUnstructuredGrid. Others come as a whole:
/// composite datasets, since ranks may have different leaves, and grids, of which a source makes any part.
bool ComesInPieces(vtkInformationVector* port);

/// The lines of PrintSelf, without counters.
std::string PropertiesOf(vtkAlgorithm* algorithm);

/// Collective. \throw InvalidInput ranks differ in PropertiesOf.
void CheckSameProperties(const RanksOfPipeline& ranks, vtkAlgorithm* algorithm);

/// Collective. Whether no rank has a cell.
bool AreEmpty(const RanksOfPipeline& ranks, vtkInformationVector* port);

/// Collective. Whether several ranks have cells, and no two the same ones, as where each rank has read the same file.
bool AreDifferentPieces(const RanksOfPipeline& ranks, vtkInformationVector* port);

/// The inputs of a filter, joined from the pieces that ranks have. Pieces that are equal are one.
class GatheredInputs
{
public:
  enum class Place
  {
    OnFirst,      ///< all inputs on the first rank
    SurfaceApart, ///< the pieces of the first input stay where they are; the others are on all ranks
  };

  /// Collective. \pre the first input of each rank has data that come in pieces.
  /// \throw InvalidInput the first rank has not enough memory (CheckFits).
  /// \throw Cancelled
  GatheredInputs(const RanksOfPipeline& ranks, vtkAlgorithm* algorithm, vtkInformationVector** inputs, Place place);

  /// The ports, as the pipeline hands them to a filter that runs on one process. \pre this is rank 0, or SurfaceApart.
  vtkInformationVector** Get() { return this->Ports.data(); }
  /// The number of cells and of ranks that were gathered, and the memory; empty where the surface was on the first rank already.
  const std::string& Note() const { return this->Text; }

private:
  void Gather(const RanksOfPipeline& ranks, vtkInformation* input, bool isSurface);

  std::string Text;
  std::vector<vtkSmartPointer<vtkInformationVector>> Copies;
  std::vector<vtkInformationVector*> Ports;
};

}

#endif
