#ifndef dmgEvenlySpacedLines_h
#define dmgEvenlySpacedLines_h

#include "Drawing/DirectionsOnFaces.h"
#include "Drawing/UnfoldedSurface.h"
#include "Support/ExecutionContext.h"

#include <vector>

namespace dmg
{

struct LineOptions
{
  /// Between lines of one family, in the unit of the points; > 0.
  double Separation = 1.0;
  /// A line ends where it comes nearer to another one of its family than this times Separation, in (0, 0.9]: it begins
  /// at Separation, and converges or diverges from its neighbours on its way.
  double StopRatio = 0.6;
  /// Shorter lines are not drawn; closed ones, too. In the unit of the points; >= 0.
  double MinimumLength = 0.0;
  /// Triangles that lines may cross in all; they take 0.1 KB each.
  int MostSegments = 20000000;
};

/// Polylines on a surface.
struct LinesOnSurface
{
  // per point
  std::vector<Vector3> Positions;
  std::vector<int> Faces;         ///< one on which it lies
  std::vector<double> Magnitudes; ///< of the field; on an edge, the mean of both sides
  // per line
  std::vector<int> Offsets; ///< the first point, and the end of the last line
  std::vector<double> Lengths;
  std::vector<int> Families;  ///< of the direction along which it started (DirectionsOnFaces), at its seed
  std::vector<char> IsClosed; ///< whether the last point goes on to the first

  double LongestLeftOut = 0.0; ///< length of the longest line that was too short

  int NumberOfLines() const { return static_cast<int>(this->Lengths.size()); }
};

/// Lines along all families of a field, evenly spaced (B. Jobard and W. Lefer, Creating evenly-spaced streamlines of
/// arbitrary density, 1997; on surfaces B. Spencer et al., Evenly spaced streamlines for surfaces, 2009).
///
/// Each line begins beside an earlier one, at the distance Separation, or in the middle of a face that no line of the
/// family is near. It is followed both ways, exactly from face to face (LineTracer), until the field ends, or until it
/// comes within StopRatio of that distance of a line of its family, or of itself. The distance is measured to the lines
/// themselves, not to samples of them, over the surface and not through it. One that comes back to its seed, within a
/// tenth of Separation, is closed.
///
/// Lines are in the order in which they were drawn. The same for any number of threads: one draws.
/// Cost: linear in faces and in the length of all lines; a line looks at the faces within Separation of it a few times.
/// \throw Cancelled, InvalidInput (lines that cross more triangles than MostSegments)
LinesOnSurface EvenlySpacedLines(const UnfoldedSurface& surface, const DirectionsOnFaces& field,
  const LineOptions& options, const ExecutionContext& context = SerialContext());

}

#endif
