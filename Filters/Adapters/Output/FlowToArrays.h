#ifndef dmgFlowToArrays_h
#define dmgFlowToArrays_h

#include "Adapters/Surface/MeshFromDataSet.h"
#include "HodgeDecomposition.h"
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
  double LengthScale = 1.0; ///< the length of the unit of the points
};

/// A HodgeDecomposition for the surface of a dataset, and the arrays that show its parts; kept for the next flow on the same surface. Keys
/// are contents, not modification times.
class FlowSurface
{
public:
  /// Takes another surface, boundary or solver, if it is another.
  /// \throw InvalidInput as MeshFromDataSet.
  void SetSurface(vtkDataSet* input, const PreparationOptions& preparation, FlowBoundary boundary,
    const SolverOptions& options, const ExecutionContext& context);

  /// The things that were done to the surface.
  const PreparationReport& Preparation() const { return this->PreparationOfSurface; }
  FramedSurface Surface() const { return { *this->On, this->Relation }; }

  /// Adds the arrays of vtkHodgeDecomposition to \p output, a copy of the \p input.
  /// \param vectors of the flow, one per face.
  /// \return warnings for the user.
  std::vector<std::string> Decompose(const Points& vectors, const FlowOptions& options, vtkDataSet* input,
    vtkDataSet* output, const ExecutionContext& context);

private:
  std::string Digest;
  FlowBoundary Boundary = FlowBoundary::Closed;
  SolverOptions Options;
  SurfaceRelation Relation;
  PreparationReport PreparationOfSurface;
  std::unique_ptr<FramedMesh> On;
  Unfilled<Corner> CornersOfFaces;
  std::optional<HodgeDecomposition> Decomposition; ///< it refers to On
};

/// Makes \p lines those where the array StreamFunction of a surface has \p number values, evenly spaced inside of its range; none, where there is no such
/// array or it is constant.
void ContoursOfStreamFunction(vtkDataSet* surface, int number, vtkPolyData* lines);

}

#endif
