#ifndef dmgContourLines_h
#define dmgContourLines_h

#include "Mesh/PositiveSide.h"
#include "Support/ExecutionContext.h"
#include "Support/Types.h"

#include <vector>

namespace dmg
{

/// Lines on a surface where a function has given values. A line has larger values to its right, seen from the positive side, so that it
/// runs like the flow whose stream function is drawn.
struct ContourLines
{
  Points Positions;
  std::vector<int> Values; ///< of points: the index of the value there
  std::vector<int>
    Order; ///< points along the lines, one line after the other; a closed line names its first point again at its end
  std::vector<int> Offsets; ///< of lines in Order, and its size
};

/// \param places of the vertices: those of the mesh or, to draw lines that no face hides, above it.
/// \param u one per vertex; linear on faces.
/// \param values ascending.
/// Cost: linear.
ContourLines FindContourLines(const TriangleMesh& mesh, const Points& places, const Vector<double>& u,
  const std::vector<double>& values, const SidesOfSurface& sides, const ExecutionContext& context = SerialContext());

}

#endif
