#ifndef dmgSurfaceDistance_h
#define dmgSurfaceDistance_h

#include "Drawing/ContourLines.h"
#include "Geodesics/DistanceSources.h"
#include "Mesh/FramedMesh.h"
#include "Support/ExecutionContext.h"
#include "Support/Types.h"

#include <limits>
#include <memory>
#include <string>
#include <vector>

namespace dmg
{

/// Distances along a surface from the nearest source.
struct DistanceField
{
  Vector<double> Distances; ///< #V; NaN where no path leads, or beyond the maximum
  std::vector<int> Sources; ///< #V, the number of the nearest source, -1 where there is no distance
  Points Directions;        ///< #V x 3, unit: away from the source; zero at sources and where there is no distance
  int Unreached = 0;        ///< vertices without a distance
  double Largest = 0.0;     ///< distance, without its sign
  int Taken = 0;            ///< sources
  int TooFar = 0;           ///< points, and segments of lines, that are too far from the surface, or hidden by it
  int Interrupted = 0;      ///< gaps of lines between faces that have no point in common
  bool IsSigned = false;    ///< whether distances inside are negative
  std::vector<std::string> Warnings; ///< one sentence each
};

/// A shortest path over the surface.
struct SurfacePath
{
  std::vector<Vector3> Points; ///< on edges of the surface, from the source to the target; none where no path leads
  double Length = std::numeric_limits<double>::infinity();
  /// That of the field at the target, with its sign: the same as the length, but for errors of both. NaN where no path leads.
  double Distance = std::numeric_limits<double>::quiet_NaN();
  int Source = -1;
};

/// Distances along a surface from points, lines, regions and the boundary, with signs, the nearest source, shortest paths and offset lines.
///
///   dmg::DistanceSources sources;
///   sources.Lines = { stroke };
///   dmg::SurfaceDistance distance(surface, sources);
///   distance.Field().Distances;
///   distance.OffsetLines({ 0.1, 0.2 });
///   distance.PathTo(vertex).Points;
///   distance.PathTo(dmg::Vector3(0, 0, 1)).Length;
///
/// Places in faces become vertices, and lines become edges that stay, of an intrinsic Delaunay triangulation, over which a wavefront runs
/// (FindShortestPaths). SurfaceDistance.md has the method. Exact in planes and on what unfolds into one, of second order
/// elsewhere. Paths are made shortest by flips of edges (MakeShortest): they are locally shortest, and near cut loci a shorter one may lead around
/// the other side of a hill.
/// Cost: O(#V log #V); for each path, O(#F) and its flips. Paths and offset lines change nothing, so that one object serves any number of them.
class SurfaceDistance
{
public:
  /// \param surface is borrowed.
  /// \throw InvalidInput there is no source, or all are too far away and may not be; a number is not finite or of no element.
  /// \throw Cancelled
  SurfaceDistance(const FramedMesh& surface, const DistanceSources& sources, const DistanceOptions& options = {},
    const ExecutionContext& context = SerialContext());
  ~SurfaceDistance();
  SurfaceDistance(SurfaceDistance&&) noexcept;

  const DistanceField& Field() const;

  /// The shortest path to a vertex from its nearest source. From a line it starts at the nearest place of the line.
  /// \throw InvalidInput there is no such vertex.
  /// \throw Cancelled
  SurfacePath PathTo(int vertex, const ExecutionContext& context = SerialContext()) const;
  /// The shortest path to the place of the surface that is nearest to a point. None where that is farther than MaximumSourceDistance.
  /// Cost: n log n more for the first one.
  /// \throw InvalidInput a coordinate is not finite.
  /// \throw Cancelled
  SurfacePath PathTo(const Vector3& point, const ExecutionContext& context = SerialContext()) const;

  /// Lines at given distances, on both sides of sources, or with signs as Field().Distances has them. Their Values count in the sorted
  /// distances.
  /// \throw InvalidInput a distance is not finite, or beyond the maximum.
  ContourLines OffsetLines(std::vector<double> distances, const ExecutionContext& context = SerialContext()) const;

  /// The memory of the triangulation and of the paths.
  long long Bytes() const;

private:
  class Internals;
  std::unique_ptr<Internals> Internal;
};

}

#endif
