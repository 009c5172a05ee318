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

/// Caps: faces with an angle above 150 degrees, whose circumscribed circles have radii above their longest sides. Gradients of functions that are
/// linear on faces are accurate to the radius of this circle, not to the longest side (Kobayashi and Tsuchiya, "A Babuska-Aziz type proof
/// of the circumradius condition", 2014). Right triangles are accurate to half of their longest side, however thin they are.
struct CapFaces
{
  double Share = 0.0; ///< of the area
  /// The mean of these radii over that of the longest sides of the faces, halved; both by area. It is above 1.
  double RelativeRadius = 0.0;
};

/// Cost: linear in the number of faces.
CapFaces FindCaps(const TriangleMesh& mesh, const ExecutionContext& context = SerialContext());

}

#endif
