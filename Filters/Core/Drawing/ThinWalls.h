#ifndef dmgThinWalls_h
#define dmgThinWalls_h

#include "Mesh/FramedMesh.h"
#include "Support/ExecutionContext.h"
#include "Support/Types.h"

#include <vector>

namespace dmg
{

/// Halves the normals of a drawing at thin walls, fins, plates and leaves: where another sheet of the surface, which faces the same or the
/// other way up to 60 degrees, lies behind it within a hundredth of the diagonal of the surface's box. One that faces the other way may
/// be at no distance. Where there is none behind, but one in front that faces the same way, the normal is turned, too.
///
/// Programs that draw lines a little nearer to the viewer than their surface read from the length that such a line shows from its own side
/// alone (vtkFieldDrawingAlgorithm::GetInkShader). Other lines show from both sides.
///
/// \param positions on the surface, of points of a drawing.
/// \param normals of the surface there, unit; some lose half of their length, and some of these are turned.
/// Cost: n log n, and for each point the faces in balls of that diameter in front of it and behind.
/// \throw Cancelled
void HalveNormalsAtThinWalls(const FramedMesh& surface, const std::vector<Vector3>& positions,
  std::vector<Vector3>& normals, const ExecutionContext& context = SerialContext());

}

#endif
