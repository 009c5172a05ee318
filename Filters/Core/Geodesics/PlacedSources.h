#ifndef dmgPlacedSources_h
#define dmgPlacedSources_h

#include "Constraints/SegmentOnSurface.h"
#include "Geodesics/DistanceSources.h"
#include "Geodesics/ShortestPaths.h"
#include "Geodesics/SplitSurface.h"
#include "Mesh/FramedMesh.h"
#include "Mesh/PositiveSide.h"
#include "Support/ExecutionContext.h"
#include "Support/Types.h"

#include <cstddef>
#include <string>
#include <vector>

namespace dmg
{

/// \throw InvalidInput there is no such element.
void RequireElement(int element, int size, const std::string& name);

/// \throw InvalidInput a coordinate is not finite.
void CheckPosition(const Vector3& position, const std::string& name);

/// \throw InvalidInput a number is not finite or of no element.
void CheckSources(const FramedMesh& surface, const DistanceSources& sources, const DistanceOptions& options);

/// Sources as lines and vertices of a surface that is split for them.
class PlacedSources
{
public:
  /// \throw Cancelled
  PlacedSources(const FramedMesh& surface, const DistanceSources& sources, const DistanceOptions& options,
    const ExecutionContext& context);

  /// The vertices at distance 0; those of lines are among them.
  std::vector<PathStart> StartsOn(const TriangleMesh& split) const;

  SplitSurface Split;
  int Taken = 0;
  int TooFar = 0;
  int Interrupted = 0;
  bool HasPoints = false;

private:
  using Line = SplitSurface::Line;
  using InsideOfLine = SplitSurface::InsideOfLine;
  /// The end of what has been added of a line.
  struct End
  {
    int Vertex = -1;
    int Face = -1;
    Vector3 PartStart = Vector3::Zero(); ///< of the last part
  };

  int NumberOfRegion() const;
  void AddStart(int vertex, int source);
  void AddElements();
  void AddRegion(int number);
  void AddPlaces(const ExecutionContext& context);
  void Advance(double places, const ExecutionContext& context);
  void AddLine(const std::vector<Vector3>& points, int number, const SegmentOnSurface& segments,
    const SidesOfSurface& sides, const ExecutionContext& context);
  bool AddPart(const SegmentPart& part, const Line& line, End& end);

  const FramedMesh& Surface;
  const DistanceSources& Sources;
  const DistanceOptions& Options;
  std::vector<PathStart> Starts; ///< but for those of lines
  std::size_t All = 0;           ///< places
  double Done = 0.0;
  int Steps = 0;
};

}

#endif
