#ifndef dmgSmoothingBlocks_h
#define dmgSmoothingBlocks_h

#include "Mesh/TriangleMesh.h"
#include "Solvers/LeastSquares/SchwarzBlocks.h"

/// Unknowns of a surface that multigrid smooths together. Small blocks part all unknowns. Where faces are far
/// from equilateral, patches of many faces are added: fields exist there that the small blocks cannot tell from
/// rough ones and coarse levels cannot represent. Patches gain iterations rather than time: without them 1-forms take 15
/// instead of 9 on t02, 19 instead of 12 on t05, and face fields 29 instead of 13 and twice the time of a second solve on
/// bnd_camelhead; on the median of 14 surfaces they gain no time.
namespace dmg
{

/// Of face fields, unknowns 2 f and 2 f + 1: fans of faces (PackFans), most of them all those around a vertex.
/// Cost: linear in the number of faces.
UnknownBlocks BlocksOfFaceFields(const TriangleMesh& mesh);

/// Of 1-forms, an unknown per edge: the sides of faces that have none in common (PackFaces), and what
/// these leave of others. Cost as above.
UnknownBlocks BlocksOfOneForms(const TriangleMesh& mesh);

}

#endif
