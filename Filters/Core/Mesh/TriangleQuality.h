#ifndef dmgTriangleQuality_h
#define dmgTriangleQuality_h

#include "Mesh/TriangleMesh.h"
#include "Support/ExecutionContext.h"

namespace dmg
{

/// The quality of a face, 4 sqrt(3) area / sum of its squared edge lengths: 1 for an equilateral triangle, 0 for one
/// without area (Bank and Smith 1997). Below 0.1 the longest edge is at least 17 times the height on it.
double TriangleQuality(const TriangleMesh& mesh, int face);

/// The share of the faces whose quality is below a limit; 0 where there are no faces.
/// Cost: linear in the number of faces.
double ShareOfFacesBelow(double quality, const TriangleMesh& mesh, const ExecutionContext& context);

}

#endif
