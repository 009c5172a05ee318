#ifndef dmgLineStarts_h
#define dmgLineStarts_h

#include "Geodesics/EdgePath.h"
#include "Geodesics/IntrinsicTriangulation.h"
#include "Support/ExecutionContext.h"

#include <vector>

namespace dmg
{

/// A vertex that was added on an edge between two others, which may have been added before.
struct VertexOnEdge
{
  int Tail;
  int Head;
  double Part; ///< of the way
};

/// Moves the start of a path along held edges, to where the path is shortest: it leaves the line at a right angle there, or at a corner or an
/// end of the line. Short edges of other directions on the way, as roundings make them, do not stop it.
/// \param path is shortest between its ends.
/// \param surface receives a vertex where the start is none.
/// \return the vertices that were added.
/// \throw Cancelled
std::vector<VertexOnEdge> MoveStart(
  EdgePath& path, IntrinsicTriangulation& surface, const ExecutionContext& context = SerialContext());

}

#endif
