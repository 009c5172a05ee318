#ifndef dmgTransportToArrays_h
#define dmgTransportToArrays_h

#include "Adapters/View/SurfaceView.h"
#include "Constraints/Constraints.h"
#include "Geodesics/ParallelTransport.h"
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

/// A vertex with a direction in its tangent plane.
struct PlacedDirection
{
  int Vertex;
  Vector3 Position; ///< of the vertex
  Vector3 Direction;
  bool IsGiven; ///< rather than any direction in the place of one that is perpendicular to the surface
};

/// A ParallelTransport for the surface of a dataset, and the arrays that show its results; kept for the next call on the same surface.
/// Keys are contents, not modification times.
class TransportSurface
{
public:
  /// Takes another surface or time step, if it is another.
  /// \throw InvalidInput the time step is out of range.
  void SetSurface(const std::shared_ptr<const PreparedDataSet>& surface, const TransportOptions& options,
    const ExecutionContext& context);

  /// A direction at the vertex that is nearest to a place, the first of several; without a place, at VertexInFront.
  /// \throw InvalidInput the place is not finite; the direction is zero or not finite.
  PlacedDirection Place(const std::optional<Vector3>& place, const Vector3& direction) const;

  /// Adds TransportedVectors to the output of a view of the surface.
  /// \throw InvalidInput a vector is too long or too short to compute with.
  /// \return warnings for the user.
  std::vector<std::string> AddVectors(
    const Constraints& sources, const SurfaceView& view, const ExecutionContext& context);

  /// Adds the arrays of the logarithmic map.
  /// \param textureSize the side of the square that a texture covers; 0: twice the largest distance.
  /// \param circles an empty output; becomes \p numberOfCircles lines of equal distance, evenly spaced.
  void AddMap(const PlacedDirection& from, double textureSize, int numberOfCircles, const SurfaceView& view,
    vtkPolyData* circles, const ExecutionContext& context);

  /// Held by factors.
  long long Bytes() const { return this->Transport->Bytes(); }
  /// Over all surfaces.
  ParallelTransport::StageCounts Counts() const;

private:
  /// Takes the factors away.
  void Forget();

  TransportOptions Options;
  std::shared_ptr<const PreparedDataSet> Prepared;
  std::optional<ParallelTransport> Transport; ///< it refers to the surface
  ParallelTransport::StageCounts OfFormer;    ///< of those before it
};

}

#endif
