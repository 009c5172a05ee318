#ifndef dmgFlowToArrays_h
#define dmgFlowToArrays_h

#include "Adapters/Input/FlowFromArrays.h"
#include "Adapters/Surface/PreparedDataSet.h"
#include "Adapters/View/SurfaceView.h"
#include "Flows/HodgeDecomposition.h"
#include "Support/ExecutionContext.h"
#include "Support/Types.h"

#include <memory>
#include <optional>
#include <string>
#include <vector>

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

/// A HodgeDecomposition for the surface of a dataset, and the arrays that show its parts; kept for the next flow on the same surface. Keys
/// are contents, not modification times.
class FlowSurface
{
public:
  /// Takes another surface or solver, if it is another.
  /// \param isGlobe see HodgeDecomposition.
  void SetSurface(const std::shared_ptr<const PreparedDataSet>& surface, const SolverOptions& options, bool isGlobe,
    const ExecutionContext& context);
  /// \param isOpen by edge; see HodgeDecomposition.
  void SetBoundary(const std::vector<char>& isOpen) { this->Decomposition->SetBoundary(isOpen); }

  /// Adds the arrays of vtkHodgeDecomposition to the output of a view of the surface.
  /// \param streamlines, boundaries empty outputs; become the contours of the stream function, and the boundaries of the surface.
  /// \return warnings for the user.
  /// \throw InvalidInput as HodgeDecomposition; there is no boundary of the number ReferenceBoundary.
  std::vector<std::string> Decompose(const FaceFlow& flow, const FlowOptions& options, const SurfaceView& view,
    vtkPolyData* streamlines, vtkPolyData* boundaries, const ExecutionContext& context);

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
