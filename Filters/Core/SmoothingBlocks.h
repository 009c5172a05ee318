#ifndef dmgSmoothingBlocks_h
#define dmgSmoothingBlocks_h

#include "Mesh/TriangleMesh.h"
#include "Solvers/SchwarzBlocks.h"

/// Unknowns of a surface that multigrid smooths together. Small blocks part all unknowns; where faces are far
/// from equilateral, patches of many faces are added. On those, fields exist that the small blocks cannot
/// tell from rough ones and coarse levels cannot represent.
namespace dmg
{

/// Of face fields, unknowns 2 f and 2 f + 1: fans of faces (PackFans), most of them all those around a vertex.
UnknownBlocks BlocksOfFaceFields(const TriangleMesh& mesh);

/// Of 1-forms, an unknown per edge: the sides of faces that have none in common (PackFaces), and what
/// these leave of others. No patches where subdomains are.
UnknownBlocks BlocksOfOneForms(const TriangleMesh& mesh);

/// Of 1-forms, the sides of all faces where needles are many: faces with less than a tenth of the area of
/// an equilateral triangle with their longest side. Overlapping subdomains of up to ten thousand unknowns
/// or so, to be solved for by sparse factors (SubdomainSmoother). Fields run along chains of needles, with
/// next to no energy, farther than patches reach. None where needles are alone or few together.
/// Cost: linear in the number of faces.
UnknownBlocks SubdomainsOfOneForms(const TriangleMesh& mesh);

}

#endif
