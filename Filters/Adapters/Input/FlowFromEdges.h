#ifndef dmgFlowFromEdges_h
#define dmgFlowFromEdges_h

#include "Adapters/Input/FlowFromArrays.h"

#include <string>

namespace dmg
{

/// The array of lines that a flow is read from.
struct EdgeValues
{
  std::string Name;
  bool AreIntegrals = true; ///< else components along the lines
};

/// The flow of a 1-form: numbers of lines between the points of the surface, one for each of its edges. A value belongs to the way from
/// the first point of a line to the second. Lines are matched by the numbers of their points or, where these lie elsewhere on the
/// surface, by coordinates in single precision. Lines that are no edges are passed over. Diagonals of polygons may be left out
/// (FillDiagonals).
/// \throw InvalidInput there is no such array; an edge has no line or two lines with different values; a line that is an edge has more
///   than two points, or its value is not finite. Cost: linear.
FaceFlow FlowFromEdges(
  vtkDataSet* edges, const EdgeValues& values, const SurfaceView& view, const ExecutionContext& context);

}

#endif
