#ifndef dmgFlowToArrays_h
#define dmgFlowToArrays_h

#include "Adapters/Input/FlowFromArrays.h"
#include "Adapters/Surface/PreparedDataSet.h"
#include "Flows/HodgeDecomposition.h"
#include "Support/ExecutionContext.h"
#include "Support/Types.h"

#include <memory>
#include <optional>
#include <string>
#include <vector>

class vtkDataSet;
class vtkPolyData;

namespace dmg
{

/// The arrays of a decomposed flow that somebody wants.
struct FlowOptions
{
  FlowParts Parts;
  bool Derivatives = true;
  double LengthScale = 1.0;  ///< the length of the unit of the points
  int NumberOfContours = 0;  ///< of the stream function
  int ReferenceBoundary = 0; ///< against which transports of boundaries are measured
  double Lift = 0.0;         ///< of these lines off the surface, relative to the diagonal of its bounding box
  bool IsOfCentres = false;  ///< the surface ends at the centres of cells, half a cell before its boundary
};

/// The arrays of vectors among those that FlowSurface adds.
std::vector<std::string> NamesOfParts();
/// All arrays of cells and points that FlowSurface adds.
std::vector<std::string> NamesOfFlowArrays();

/// A HodgeDecomposition for the surface of a dataset, and the arrays that show its parts; kept for the next flow on the same surface. Keys
/// are contents, not modification times.
class FlowSurface
{
public:
  /// Takes another surface or solver, if it is another.
  /// \param isGlobe see HodgeDecomposition.
  /// \throw InvalidInput as MeshFromDataSet.
  void SetSurface(vtkDataSet* input, const PreparationOptions& preparation, const SolverOptions& options, bool isGlobe,
    const ExecutionContext& context);
  /// \param isOpen by edge; see HodgeDecomposition.
  void SetBoundary(const std::vector<char>& isOpen) { this->Decomposition->SetBoundary(isOpen); }

  /// The things that were done to the surface.
  const PreparationReport& Preparation() const { return this->Prepared->Report; }
  FramedSurface Surface() const { return this->Prepared->Surface(); }

  /// Adds the arrays of vtkHodgeDecomposition to \p output, a copy of the \p input.
  /// \param streamlines, boundaries empty outputs; become the contours of the stream function, and the boundaries of the surface.
  /// \return warnings for the user.
  /// \throw InvalidInput as HodgeDecomposition; there is no boundary of the number ReferenceBoundary.
  std::vector<std::string> Decompose(const FaceFlow& flow, const FlowOptions& options, vtkDataSet* input,
    vtkDataSet* output, vtkPolyData* streamlines, vtkPolyData* boundaries, const ExecutionContext& context);

  /// Over all surfaces.
  HodgeDecomposition::StageCounts Counts() const;

private:
  /// Takes the decomposition away.
  void Forget();

  SolverOptions Options;
  bool IsGlobe = false;
  std::shared_ptr<const PreparedDataSet> Prepared;
  Unfilled<Corner> CornersOfFaces;
  std::optional<HodgeDecomposition> Decomposition; ///< it refers to the surface
  HodgeDecomposition::StageCounts FormerCounts;    ///< of those before it
};

}

#endif
